"""Strategies that make the values of some records fit one another, as their validators want it."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import strategies as st

from mudline.keywords.library.geometric_sets import GeometricSet
from mudline.keywords.library.seabed_profile import SeabedProfile
from mudline.keywords.library.variation import VariedParameter
from mudline.keywords.model import Slot, layout
from tests.generated.lines import Values, cell


def _slots(part: type[GeometricSet | SeabedProfile | VariedParameter]) -> dict[str, Slot]:
    return {slot.json: slot for slot in layout(part).slots}


@st.composite
def _geometric_set(draw: st.DrawFn, made: Values) -> Values:
    """One property line, of the format that OPTION= says."""
    slots = _slots(GeometricSet)
    formats = ("flexible", "rigid", "mooring", "truss")
    chosen = draw(st.sampled_from(formats))
    rest = {key: value for key, value in made.items() if key not in formats}
    return rest | {"option": chosen.upper(), chosen: draw(cell(slots[chosen]))}


@st.composite
def _seabed_profile(draw: st.DrawFn, made: Values) -> Values:
    """The settings of the type."""
    kind = draw(st.sampled_from(["SLOPING", "2D", "3D"]))
    needed = "slope" if kind == "SLOPING" else "file"
    given = {key: made[key] for key in ("direction",) if key in made}
    if kind != "SLOPING":
        given["interpolation"] = draw(st.sampled_from(["LINEAR", "CUBIC SPLINE" if kind == "2D" else "CUBIC"]))
    return given | {"type": kind, needed: draw(cell(_slots(SeabedProfile)[needed]))}


@st.composite
def _varied_parameter(draw: st.DrawFn, made: Values) -> Values:
    """A list of values, or a range."""
    chosen = draw(st.sampled_from(["values", "generate"]))
    return {"parameter": made["parameter"], chosen: draw(cell(_slots(VariedParameter)[chosen]))}


def _trench_set(made: Values) -> st.SearchStrategy[Values]:
    """Rows stand below PEAK=TABLE only."""
    return st.just(made | {"peak": "TABLE"} if "table" in made else made)


ARRANGED: dict[str, Callable[[Values], st.SearchStrategy[Values]]] = {
    "geometric_set": _geometric_set,
    "seabed_profile": _seabed_profile,
    "trench_set": _trench_set,
    "varied_parameter": _varied_parameter,
}
"""By the rule of the record."""
