"""The panels of a picture of results by name: what each shows, which there are without being asked for, and why not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal, NamedTuple

import numpy as np

from mudline.results.plot_data import PlotData

PICTURES = ("png", "svg", "pdf")
"""Forms of a picture."""
ANIMATIONS = ("gif", "html")
"""Forms of an animation."""
MOST_FRAMES = 100
"""Frames of an animation; of longer series these at even distances."""


class PanelError(ValueError):
    """A panel that does not exist, or that the results have nothing for."""


class Panel(NamedTuple):
    """A panel.

    Attributes:
        meaning: what it shows, for help and documentation.
        axis: its horizontal axis: arc length, time, or one of its own.
        missing: why some results have nothing for it; "" where they have.
        usual: whether it is drawn when no panels are asked for.
    """

    meaning: str
    axis: Literal["arc length", "time", "own"]
    missing: Callable[[PlotData], str]
    usual: Callable[[PlotData], bool]


def _without_elements(_data: PlotData) -> str:
    return "" if _data.elements.size else "no element has positions of both its nodes"


def _without_steps(data: PlotData) -> str:
    return "" if data.steps > 1 else "it needs time steps, and this is one state"


def _without_suction(data: PlotData) -> str:
    return _without_elements(data) or ("" if data.pulls else "no element has suction or a curve that pulls")


def _without_friction(data: PlotData) -> str:
    return "" if data.slides else "there is neither friction nor a lateral spring"


def _without_curves(data: PlotData) -> str:
    return "" if data.on_curve.size else "no evaluated element has a force-embedment curve"


def _without_loop(data: PlotData) -> str:
    if data.steps > 1 and not data.looped.size:
        return "it needs the numbers of elements: give --plot-elements"
    return _without_steps(data)


def _both(*found: Callable[[PlotData], str]) -> Callable[[PlotData], str]:
    return lambda data: next((why for each in found if (why := each(data))), "")


def _always(_data: PlotData) -> bool:
    return True


def _in_contact(data: PlotData) -> bool:
    return bool(data.touched.any())


PANELS = {
    "line": Panel("the line on the seabed with its touchdown points", "arc length", _without_elements, _always),
    "force": Panel("seabed reaction per unit length", "arc length", _without_elements, _in_contact),
    "suction": Panel(
        "suction per unit length and its states, when it is largest",
        "arc length",
        _without_suction,
        lambda data: data.pulled is not None,
    ),
    "friction": Panel(
        "axial and lateral force on the nodes, when it is largest",
        "arc length",
        _both(_without_elements, _without_friction),
        lambda data: data.slid is not None,
    ),
    "embedment": Panel("embedment of the elements", "arc length", _without_elements, _always),
    "stiffness": Panel(
        "seabed stiffness", "arc length", _without_elements, lambda data: _in_contact(data) and data.steps == 1
    ),
    "envelope": Panel(
        "largest, mean and least force and embedment over the steps",
        "arc length",
        _both(_without_elements, _without_steps),
        _in_contact,
    ),
    "curves": Panel("force-embedment curves with the evaluated points", "own", _without_curves, _in_contact),
    "loop": Panel("force over penetration of the elements of --plot-elements", "own", _without_loop, _always),
    "touchdown": Panel(
        "touchdown points and length in contact over time",
        "time",
        _both(_without_elements, _without_steps),
        lambda data: any(np.isfinite(data.touchdown[line, "first"].most).any() for line in data.lines),
    ),
    "traces": Panel(
        "total reaction, largest force, elements in contact and deepest embedment over time",
        "time",
        _without_steps,
        _always,
    ),
}
"""In the order in which they are drawn."""


def panel_names(names: Sequence[str]) -> tuple[str, ...]:
    """Return names of panels in their order, each once; raises PanelError for one that does not exist."""
    for name in names:
        if name not in PANELS:
            raise PanelError(f"no panel is called {name!r}: the panels are {', '.join(PANELS)}")
    return tuple(dict.fromkeys(names))


def require(data: PlotData, names: Sequence[str]) -> None:
    """Raise PanelError for the first of some panels that the results have nothing for."""
    for name in panel_names(names):
        if why := PANELS[name].missing(data):
            raise PanelError(f"the panel {name} cannot be drawn: {why}")


def usual(data: PlotData) -> tuple[str, ...]:
    """Return the panels that are drawn when none are asked for: those that the results have something to show in."""
    return tuple(name for name, panel in PANELS.items() if not panel.missing(data) and panel.usual(data))
