"""Random documents that follow the declarations: values, rows, blocks of every keyword with a model, whole decks."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import strategies as st

from mudline.basics.units import UNITS
from mudline.language.deck.document import FORMAT
from mudline.language.keywords import catalogue
from mudline.language.keywords.library.analysis import Database, TimeSpan, TimeStepping
from mudline.language.keywords.library.floating_bodies import MatrixRow
from mudline.language.keywords.library.geometric_sets import FORMATS_OF, GeometricSet
from mudline.language.keywords.library.preprocessor import VariedParameter
from mudline.language.keywords.library.random_seas import JonswapSea, OchiHubbleSea, SpectrumByPoints, TorsethaugenSea
from mudline.language.keywords.library.seabed_surface import SeabedProfile
from mudline.language.keywords.model import FEWEST_POINTS, Block, FieldSpec, ListRow, Record, Row, Rows, record_schema
from mudline.language.keywords.values import Kind
from mudline.language.syntax.rows import spells_number
from tests.helpers.builders.spellings import EQUATIONS, NAMES, labels, no_head, texts
from tests.helpers.builders.spellings import comments as comment_lines

Values = dict[str, Any]
"""What JSON holds of a deck, a block or a record."""
Keyword = tuple[str, str]


def declared(keyword: Keyword) -> type[Block]:
    """The class of a keyword in a section."""
    found = catalogue.block_class(*keyword)
    assert found is not None
    return found


KEYWORDS: list[Keyword] = [
    (section, keyword)
    for section in catalogue.SECTIONS
    for keyword in catalogue.keywords()
    if catalogue.block_class(section, keyword)
]
"""Every keyword with a model, after its section."""

remarks = comment_lines.map(lambda text: text[1:])
"""What follows the C of a comment."""


# --------------------------------------------------------------------------------------------------------------- values

_SPECIAL = (
    *(-0.0, 0.0, 5e-324, -2.2250738585072014e-308, 1.7976931348623157e308),
    *(1e22, 1e23, 0.1 + 0.2, 1e-5, 123456789.0),
)

reals = st.sampled_from(_SPECIAL) | st.floats(allow_nan=False, allow_infinity=False) | st.floats(-1e4, 1e4)
"""Finite doubles: the smallest, the largest, those that are hard to spell."""

wholes = st.integers(-(2**53), 2**53) | st.integers(0, 300)
equations = st.sampled_from(EQUATIONS) | st.text("abc +-*/()^019._\u00e9", max_size=12).map(lambda inner: f"=[{inner}]")

_WORDS = (
    *("_x", "__", "Gr\u00f6\u00dfe 2", "\u6d77\u5e95", "a\u2028b", "\U0001f30a", "%su%", "C"),
    *("c x", "GEN", "it's", "a.b-c", "#1", "\\"),
)


def sayable(name: str) -> bool:
    """Whether a name is a field by itself wherever a name may stand; numbers parted by blanks are several."""
    words = name.split()
    numbers = [word for word in words if spells_number(word)]
    return name == name.strip(" \t") and bool(words) and (len(words) == 1 or len(numbers) < len(words))


names = st.sampled_from([*NAMES, *_WORDS]) | st.text(
    "abcXYZ019 ._%+-:;()'\u00e9\u00df\xa0\u2028", min_size=1, max_size=10
).map(str.strip).filter(sayable)
"""Names that keyword text can say, those that look like something else included."""


def _no_number(name: str) -> bool:
    return not spells_number(name) and name.lower().lstrip("+-") not in ("nan", "inf", "infinity")


BY_KIND: dict[Kind, st.SearchStrategy[object]] = {
    Kind.REAL: st.one_of(reals, reals, reals, wholes, equations),
    Kind.WHOLE: st.one_of(wholes, wholes, equations),
    Kind.IDENT: st.one_of(wholes, wholes, labels),
    Kind.WHOLE_OR_LABEL: st.one_of(wholes, labels, equations),
    Kind.REAL_OR_NAME: st.one_of(reals, equations, names.filter(_no_number)),
    Kind.NAME: names,
    Kind.TITLE: st.lists(names, min_size=1, max_size=3).map(", = ".join),
    Kind.OTHER: names.filter(_no_number),
}


# ----------------------------------------------------------------------------------------------------------------- rows


def cell(slot: FieldSpec) -> st.SearchStrategy[Any]:
    """One value of a field: a choice, a value of its kind, or a row; none behind which lines are kept."""
    older = slot.about.older if isinstance(slot.about.older, tuple) else ()
    choices = [choice for choice in slot.choices if choice not in (*(slot.about.opaque or ()), *older)]
    options: list[st.SearchStrategy[Any]] = [st.sampled_from(choices)] if choices else []
    options += [BY_KIND[slot.kind]] if slot.kind and slot.about.opaque is None else []
    options += [row(slot.row)] if slot.row else []
    value = st.one_of(options).map(lambda given: _in_range(slot, given))
    return st.lists(value, min_size=1, max_size=4) if slot.many else value


def _in_range(slot: FieldSpec, given: object) -> object:
    """A value that the declaration allows: the same, without its sign, or the nearest to a limit."""
    if not isinstance(given, int | float) or not slot.about.fault(given):
        return given
    about = slot.about
    nearest = about.at_most if about.at_most is not None else about.at_least if about.above is None else about.above + 1
    return next(value for value in (abs(given), nearest) if value is not None and not about.fault(value))


@st.composite
def line(draw: st.DrawFn, columns: list[FieldSpec]) -> Values:
    """Fields of a line, those at its end left out, those that may be empty sometimes None."""
    fewest = max((index + 1 for index, slot in enumerate(columns) if slot.required), default=0)
    count = draw(st.integers(fewest, len(columns)))
    return {
        slot.json: None if not slot.required and draw(st.integers(0, 3)) == 0 else draw(cell(slot))
        for slot in columns[:count]
    }


def row(part: type[Row]) -> st.SearchStrategy[Any]:
    """A row: an object, or a list where the declaration says so."""
    values = line([slot for slot in record_schema(part).columns if slot.about.older is not True])
    return values.map(lambda given: list(given.values())) if issubclass(part, ListRow) else values


def table(slot: FieldSpec, fewest: int) -> st.SearchStrategy[list[list[Any]]]:
    """Rows of a table; the same few of them many times over make a long one."""
    assert slot.row is not None
    cells = line(record_schema(slot.row).columns).map(lambda given: list(given.values()))
    if slot.row is MatrixRow:
        return st.lists(cells, min_size=6, max_size=6)
    curve = isinstance(slot.about, Rows) and slot.about.curve
    rows = st.lists(cells, min_size=max(fewest, FEWEST_POINTS if curve else 0), max_size=4)
    return st.tuples(rows, st.sampled_from([1, 1, 1, 12])).map(lambda pair: pair[0] * pair[1])


# -------------------------------------------------------------------------------------------------------------- records


def _slots(part: type[GeometricSet | SeabedProfile | VariedParameter]) -> dict[str, FieldSpec]:
    return {slot.json: slot for slot in record_schema(part).slots}


@st.composite
def _geometric_set(draw: st.DrawFn, made: Values) -> Values:
    """One property line, of the format that OPTION= says."""
    slots = _slots(GeometricSet)
    formats = ("flexible", "rigid", "mooring", "truss")
    chosen = draw(st.sampled_from(formats))
    foreign = {name for name, slot in slots.items() if chosen.upper() not in FORMATS_OF.get(slot.key, [chosen.upper()])}
    rest = {key: value for key, value in made.items() if key not in formats and key not in foreign}
    return rest | {"option": chosen.upper(), chosen: draw(cell(slots[chosen]))}


@st.composite
def _seabed_profile(draw: st.DrawFn, made: Values) -> Values:
    """The settings of the type."""
    kind = draw(st.sampled_from(["SLOPING", "2D", "3D"]))
    needed = "slope" if kind == "SLOPING" else "file"
    given = {key: made[key] for key in ("direction",) if key in made and kind != "3D"}
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


_OF_CHOICE: dict[str, tuple[str, dict[str, str]]] = {
    "current_profile": ("type", {"UNIFORM": "uniform", "PIECEWISE LINEAR": "profile", "SUBROUTINE": "user"}),
    "database": ("time", {"ALL": "", "SELECTED": "interval", "END": ""}),
    "flex_joint": ("type", {"LINEAR": "stiffness", "NONLINEAR": "points"}),
    "label_line": ("thing", {"NODE": "node", "ELEMENT": "element"}),
    "matrix_type": ("type", {"CONSTANT": "matrix", "FREQUENCY": "frequencies", "CUTOFF": "matrix"}),
    "endurance_curve": ("type", {"LOG-LINEAR": "segments", "DATA PAIRS": "points"}),
    "pip_curve": ("type", {"DATA PAIRS": "points", "POWER LAW": "law"}),
    "regular_wave": ("option", {"ONE": "wave", "MANY": "directed_band"}),
    "springs": ("type", {"LINEAR": "stiffness", "NONLINEAR": "points"}),
    "tolerances": ("analysis", {"STATIC": "steps", "TIME": "steps", "FREQUENCY": "frequency"}),
    "vessel_drift": ("type", {"SINUSOIDAL": "sinusoid", "FILE": "file"}),
}
"""By the rule of a record: the field that chooses, and which of the others each choice has."""
_ONE_OF: dict[str, tuple[str, ...]] = {
    "body_coefficients": ("file", "headings"),
    "body_matrices": ("file", "types"),
    "criteria": ("variable", "option"),
    "flex_joint": ("element", "set"),
    "pip_link": ("stiffness", "curve", "bulkhead"),
    "springs": ("element", "set"),
    "vessel_coefficients": ("file", "headings"),
    "vessel_rao": ("file", "headings", "lines"),
    "winch_set": ("length", "file", "profile"),
}
"""By the rule of a record: the fields of which it has one."""


@st.composite
def _of_one(draw: st.DrawFn, part: type[Record], made: Values) -> Values:
    """What a record has of fields that exclude each other."""
    slots = {slot.json: slot for slot in record_schema(part).slots}
    if part.rule in _OF_CHOICE:
        key, fields = _OF_CHOICE[part.rule]
        choice = draw(st.sampled_from(sorted(fields)))
        made = {name: value for name, value in made.items() if name not in ("band", "single", *fields.values())} | {
            key: choice
        }
        if fields[choice]:
            made[fields[choice]] = draw(given(slots[fields[choice]]))
    if part.rule in _ONE_OF:
        chosen = draw(st.sampled_from(_ONE_OF[part.rule]))
        made = {name: value for name, value in made.items() if name not in _ONE_OF[part.rule]}
        made[chosen] = draw(given(slots[chosen]))
    return made


def given(slot: FieldSpec) -> st.SearchStrategy[Any]:
    """A value of a field, a record or a row at least."""
    if isinstance(slot.about, Rows):
        return table(slot, 1)
    if slot.record:
        return st.lists(record(next(iter(slot.record.values())), 1), min_size=1, max_size=2)
    return cell(slot)


@st.composite
def _time(draw: st.DrawFn, _made: Values) -> Values:
    """The lines of the step that is chosen."""
    slots = {slot.json: slot for slot in record_schema(TimeSpan).slots}
    step = draw(st.sampled_from(["FIXED", "VARIABLE"]))
    found: Values = {"step": step, step.lower(): draw(cell(slots[step.lower()]))}
    if step == "VARIABLE":
        limits = draw(given(slots["limits"]))
        found["limits"] = [one | ({"length": 1.0, "since": 5.0} if index else {}) for index, one in enumerate(limits)]
    return found


@st.composite
def _time_stepping(draw: st.DrawFn, _made: Values) -> Values:
    """The parameters of one scheme, given once."""
    slots = {slot.json: slot for slot in record_schema(TimeStepping).slots}
    chosen = draw(st.sampled_from(["infinity", "alphas", "hilber_hughes"]))
    kind = {"type": "HILBER-HUGHES"} if chosen == "hilber_hughes" else {}
    return kind | {chosen: draw(cell(slots[chosen]))}


@st.composite
def _database(draw: st.DrawFn, made: Values) -> Values:
    """A start for selected times only."""
    found = draw(_of_one(Database, made))
    return found if found["time"] == "SELECTED" else {"time": found["time"]}


@st.composite
def _jonswap_sea(draw: st.DrawFn, _made: Values) -> Values:
    """The line of what is chosen."""
    slots = {slot.json: slot for slot in record_schema(JonswapSea).slots}
    frequency, spec = draw(st.sampled_from(["AREA", "GP"])), draw(st.sampled_from(["NORMAL", "HSTZ", "HSTP"]))
    row_ = ("area" if frequency == "AREA" else "progression") + ("_shape" if spec == "NORMAL" else "_height")
    return {"frequency": frequency, "spec": spec, row_: draw(cell(slots[row_]))}


def _sea_of(record: type[Record]) -> Callable[[Values], st.SearchStrategy[Values]]:
    """The line of its frequencies, and what else it has."""
    slots = {slot.json: slot for slot in record_schema(record).slots}

    def line(made: Values, frequency: str) -> st.SearchStrategy[Values]:
        slot = "area" if frequency == "AREA" else "progression"
        rest = {key: value for key, value in made.items() if key not in ("area", "progression")}
        return cell(slots[slot]).map(lambda row_: rest | {"frequency": frequency, slot: row_})

    return lambda made: st.sampled_from(["AREA", "GP"]).flatmap(lambda frequency: line(made, frequency))


def _each_once(made: Values) -> st.SearchStrategy[Values]:
    """One line for a kind of run."""
    kinds = {line["analysis"]: line for line in made.get("tolerances", [])}
    return st.just(made | {"tolerances": [*kinds.values()]})


def _moored_alone(made: Values) -> st.SearchStrategy[Values]:
    """A moored vessel stands alone."""
    bodies = made.get("bodies", [])
    return st.just(made | {"bodies": bodies[:1] if any("tag" in body for body in bodies) else bodies})


def _two_ranges(made: Values) -> st.SearchStrategy[Values]:
    """Exactly two lines."""
    return st.just(made | {"ranges": [{"start": 1, "end": 2}, {"start": 3, "end": "{a}"}]})


def _buoy(made: Values) -> st.SearchStrategy[Values]:
    """Three lines, or six."""
    count = 6 if "option" in made else 3
    lines = st.lists(st.lists(reals, min_size=3, max_size=3), min_size=count, max_size=count)
    return lines.map(lambda drawn: made | {"lines": drawn})


ARRANGED: dict[str, Callable[[Values], st.SearchStrategy[Values]]] = {
    "clear_element_sets": _two_ranges,
    "current_coeff": _moored_alone,
    "database": _database,
    "geometric_set": _geometric_set,
    "jonswap_sea": _jonswap_sea,
    "point_buoy_lines": _buoy,
    "ochi_hubble_sea": _sea_of(OchiHubbleSea),
    "torsethaugen_sea": _sea_of(TorsethaugenSea),
    "spectrum_by_points": _sea_of(SpectrumByPoints),
    "seabed_profile": _seabed_profile,
    "time": _time,
    "time_stepping": _time_stepping,
    "tolerance": _each_once,
    "trench_set": _trench_set,
    "wind_coeff": _moored_alone,
    "varied_parameter": _varied_parameter,
}
"""By the rule of the record."""


@st.composite
def record(draw: st.DrawFn, part: type[Record], index: int = 0) -> Values:
    """The values of a record, or of a whole block; `index` is its place among its siblings."""
    found = record_schema(part)
    first = found.slots[0]
    plain = [slot for slot in found.columns if not slot.row and not slot.many]
    own_line = plain if len(plain) == len(found.columns) else []
    own_line = [slot for slot in own_line if slot.about.older is not True]
    made: Values = draw(line(own_line)) if own_line else {}
    for slot in (slot for slot in found.slots if slot.about.older is not True):
        opens = index > 0 and slot is first and bool(slot.key)
        if slot in own_line or not (slot.required or opens or draw(st.booleans())):
            continue
        if slot in found.tables:
            made[slot.json] = draw(table(slot, fewest=0 if made and slot.required else 1))
        elif slot.record:
            made[slot.json] = draw(records(list(slot.record.values())))
        else:
            made[slot.json] = draw(cell(slot))
    if part.rule in ARRANGED:
        made = draw(ARRANGED[part.rule](made))
    elif part.rule in _OF_CHOICE or part.rule in _ONE_OF:
        made = draw(_of_one(part, made))
    if all(value in (None, []) for value in made.values()) and not issubclass(part, Block):
        made[first.json] = draw(cell(first))  # a record is lines
    told = draw(st.lists(remarks, max_size=2))
    return made | ({"comments": draw(comments(told, 6))} if told else {})


@st.composite
def records(draw: st.DrawFn, kinds: list[type[Record]]) -> list[Values]:
    """A list of records; nothing would part two that are rows only."""
    made: list[Values] = []
    last: type[Record] | None = None
    for _ in range(draw(st.integers(0, 3))):
        kind = draw(st.sampled_from(kinds))
        if kind is not last or record_schema(kind).slots[0] not in record_schema(kind).tables:
            made.append(draw(record(kind, len(made))))
            last = kind
    return made


@st.composite
def comments(draw: st.DrawFn, told: list[str], items: int) -> list[Values]:
    """Comments before some of a number of items, or behind the last."""
    return [{"before": draw(st.integers(0, items)), "text": text} for text in told]


# ----------------------------------------------------------------------------------------------------- blocks and decks


def block(keyword: Keyword) -> st.SearchStrategy[Values]:
    """A block of a keyword."""
    return record(declared(keyword)).map(lambda values: {"keyword": keyword[1], **values})


opaque: st.SearchStrategy[Values] = st.builds(
    lambda keyword, lines: {"keyword": keyword, "lines": lines},
    st.sampled_from(["TITLE", "LINES", "NEW THING", "GEL\u00c4NDE", "A,B", ""]),
    st.lists(texts.map(no_head), max_size=4),
)
"""A block without a model."""

_SECTIONS = [*dict.fromkeys(section for section, _ in KEYWORDS), "CLEAR", "NEW THING", "\u6d77\u5e95"]


@st.composite
def section(draw: st.DrawFn, blocks: int = 3) -> Values:
    """A section, known or not, with stray lines and comments."""
    name = draw(st.sampled_from(_SECTIONS))
    known = [block(keyword) for keyword in KEYWORDS if keyword[0] == name]
    made: Values = {"name": name, "blocks": draw(st.lists(st.one_of(*known, opaque), max_size=blocks))}
    if draw(st.integers(0, 3)) == 0:
        made["lines"] = ["stray" + line for line in draw(st.lists(texts, min_size=1, max_size=2))]
    told = draw(st.lists(remarks, max_size=2))
    return made | ({"comments": draw(comments(told, blocks + 1))} if told else {})


@st.composite
def document(draw: st.DrawFn) -> Values:
    """A whole deck."""
    made: Values = {"format": FORMAT, "source": draw(st.sampled_from(["a.keyxm", "\u00e9 b"]))}
    made["units"] = draw(st.sampled_from(list(UNITS)))
    told = draw(st.lists(remarks, max_size=2))
    if told:
        made["comments"] = draw(comments(told, 4))
    if draw(st.booleans()):
        made["preamble"] = draw(st.lists(comment_lines | st.sampled_from(["", "a title", " 1, 2"]), max_size=3))
    made["sections"] = draw(st.lists(section(), max_size=3))
    return made


def alone(keyword: Keyword, values: Values) -> Values:
    """A document of one block."""
    return {"format": FORMAT, "sections": [{"name": keyword[0], "blocks": [values]}]}
