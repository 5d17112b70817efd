"""Curves of a deck, whatever keyword gives them: points over an abscissa, linear between them.

Force-embedment curves, which elements follow, are resolved here too.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import Literal, NamedTuple, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.fields import CRV001, CRV003, CRV011
from mudline.language.deck.model import Opaque
from mudline.language.diagnostics import Blocks, Problem, Where
from mudline.language.keywords.contents import is_curve
from mudline.language.keywords.model import Block, FieldSpec, Part, Rows, has_fields, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.keywords.writer import field_text
from mudline.model.curves import CurveError, ForceCurve
from mudline.model.scene.context import Context
from mudline.model.scene.numbering import Floats, Indices, Mask
from mudline.model.scene.sections import read_surroundings

_CODES = {code.code: code for code in (CRV001, CRV011)}
OF_SEABED = "force-embedment curve"
"""Kind of curve that elements on the seabed follow."""
OF_CURRENT = "current profile"
_DOWN = ("depth below surface", "L")
_OF_OPTION = {"DESCEND": _DOWN, "DESCENDING": _DOWN, "XL": ("place over length", "-")}
"""Abscissa of a current profile and its unit, if OPTION= replaces the elevation."""


ENDS = {
    "slope": "its end sections go on beyond them",
    "value": "beyond the last it keeps its value (inferred)",
    "none": "no page says what it is beyond them",
}
"""Continuation of a curve beyond its points, in words."""


class SceneCurve(NamedTuple):
    """Curve of the deck, of any keyword.

    kind: its kind in words.
    keyword: its keyword.
    name: its name, or that of its set for `*EMBEDMENT`; "" if it could not be read.
    points: points (n, 2), abscissa first, without rows that could not be read.
    rows: places (n,) of the points in their table.
    where, title: places of the curve and of its name.
    table: field of its points.
    axes: names of abscissa and ordinate.
    units: their dimensions, such as `L` and `F/L`.
    ends: continuation beyond its points.
    reach: abscissas between which it is known; a current profile ends at the surface of the sea.
    whole: all points could be read and fit together.
    embedment: the curve is of `*EMBEDMENT`.
    curve: curve of the points that fit together, None if they do not form a curve.
    """

    kind: str
    keyword: str
    name: str
    points: Floats
    rows: Indices
    where: Where
    title: Where
    table: str
    axes: tuple[str, str]
    units: tuple[str, str]
    ends: Literal["slope", "value", "none"]
    reach: tuple[float, float]
    whole: bool
    embedment: bool
    curve: ForceCurve | None = None

    def point(self, index: int) -> Where:
        """Return the place of a point of `points`."""
        return self.where.inside(self.table, int(self.rows[index]))

    @property
    def usable(self) -> bool:
        """True if the curve has all points of the deck."""
        return self.curve is not None and self.whole

    @property
    def of_seabed(self) -> bool:
        """True if elements on the seabed follow the curve."""
        return self.kind == OF_SEABED


def read_curves(context: Context) -> tuple[list[SceneCurve], list[SceneCurve], list[SceneCurve]]:
    """Return the curves of `*SEABED STIFFNESS`, those of `*EMBEDMENT`, and all others, in the order of the file."""
    named, by_set = (
        [_made(context, curve) for where, block in context.blocks(keyword) for curve in _curves(block, where)]
        for keyword in ("SEABED STIFFNESS", "EMBEDMENT")
    )
    if not all(curve.name for curve in named):
        context.unread.add("SEABED STIFFNESS")
    others = [
        _made(context, curve)
        for where, _, block in context.deck.every_block()
        if type(block) is not Opaque and has_fields(type(block), is_curve)
        for curve in _curves(cast("Block", block), where)
        if not curve.of_seabed
    ]
    return named, by_set, [_below_surface(context, curve) if curve.kind == OF_CURRENT else curve for curve in others]


def _made(context: Context, given: SceneCurve) -> SceneCurve:
    """Return a curve with the curve that its points form.

    Points that do not form a curve are reported: too few points, two values at one abscissa, sections with slopes that
        a float64 cannot hold. A curve of the seabed is made of the points that fit together.
    """
    blocks = None if given.of_seabed else Blocks.NEVER
    clashing, _ = clashes_and_repeats(given.points)
    keep = np.delete(np.arange(len(given.points)), clashing)
    for index in clashing[: MOST_REPORTED + 1].tolist():
        (over, ordinate), (at, value) = given.axes, given.points[index].tolist()
        message = f"a second {ordinate} at {over} {at!r} ({value!r}): the slope there would be infinite; remove one"
        context.note(Problem(CRV003, message, where=given.point(index), blocks=blocks))
    whole = given.whole and not clashing.size
    try:
        curve = ForceCurve(given.points[keep], given.name)
    except CurveError as error:
        if error.index >= 0:  # the message counts points, which holds only when none is left out
            fault = str(error) if whole else "the slope to this point cannot be held by a float64"
            place = given.point(int(keep[error.index]))
            context.note(Problem(_CODES[error.code], f"{fault}: correct the point", where=place, blocks=blocks))
        elif whole:
            has = "one distinct point" if len(given.points) else "no point"
            message = f"{given.kind} {shown(given.name)} has {has}: it needs at least two"
            place = given.where if given.of_seabed else given.title
            context.note(Problem(CRV001, message, where=place, blocks=blocks))
        return given._replace(whole=whole)
    return given._replace(whole=whole, curve=curve if given.of_seabed or not clashing.size else None)


def clashes_and_repeats(points: Floats) -> tuple[Indices, Indices]:
    """Return indices of points at the ratio of an earlier point: those with another force, and exact repeats."""
    if np.count_nonzero(points[1:, 0] > points[:-1, 0]) == len(points) - 1:  # sorted, as nearly all are
        none: Indices = np.zeros(0, np.intp)
        return none, none
    order = np.argsort(points[:, 0], kind="stable")
    ratios, forces = points[order].T
    begins: Mask = np.append(True, ratios[1:] != ratios[:-1])[: len(ratios)]
    first = np.maximum.accumulate(np.where(begins, np.arange(len(ratios)), 0))
    differs = forces != forces[first]
    return np.sort(order[differs]), np.sort(order[~differs & ~begins])


def _below_surface(context: Context, curve: SceneCurve) -> SceneCurve:
    """Return a current profile without its part above the surface of the sea."""
    low, high = curve.reach
    if curve.axes[0] == _DOWN[0]:
        low = max(low, 0.0)
    elif curve.units[0] == "L":
        depth = read_surroundings(context.deck).depth
        high = min(high, depth) if depth > low else high
    return curve._replace(reach=(low, high))


def _curves(block: Block, where: Where) -> Iterator[SceneCurve]:
    """Yield the curves of a block, named by the first settings of the records that they are in."""
    for path, slot, table in block.walk(is_curve):
        part: Part = block
        names, title = list[str](), where
        for end in range(2, len(path), 2):  # the records on the way to the table: a field and a number each
            part = block.at(path[:end])[1]
            settings = [(each, _given(part, each)) for each in record_schema(type(part)).keys.values()]
            if given := [(each, value) for each, value in settings if value is not None]:
                first, value = min(given, key=lambda each: each[0].about.names is not Names.SET)
                names.append(_written(first, value))
                title = where.inside(*path[:end], first.json)
        name = ", ".join(filter(None, names))
        own = _curve(slot, table, block.keyword, name, (where.inside(*path[:-1]), title))
        over = _OF_OPTION.get(str(getattr(part, "option", None)))
        yield own._replace(axes=(over[0], own.axes[1]), units=(over[1], own.units[1])) if over else own


def _given(part: Part, slot: FieldSpec) -> object:
    """Return the value of a setting; of one that names a set, also its default."""
    value: object = getattr(part, slot.name)
    return (slot.about.default or None) if value is None and slot.about.names is Names.SET else value


def _written(slot: FieldSpec, value: object) -> str:
    """Return a name, or the setting with its value if that is not a name."""
    if isinstance(value, str):
        return value
    values = value if isinstance(value, list) else [value]
    return slot.label + ", ".join(field_text(each) for each in values[:3] if isinstance(each, float | int | str))


def _curve(slot: FieldSpec, table: Table, keyword: str, name: str, places: tuple[Where, Where]) -> SceneCurve:
    about = cast("Rows", slot.about)
    columns = record_schema(about.row).columns
    axes = about.axes
    over, ordinate = (columns[axis] for axis in axes)
    both = np.column_stack([table.column(axis) for axis in axes])
    rows = np.flatnonzero(~np.isnan(both).any(axis=1))
    points = both[rows]
    first, last = points[:, 0].min(initial=inf), points[:, 0].max(initial=-inf)
    low = -inf if about.ends == "slope" or (about.ends == "value" and first < 0.0) else float(first)
    return SceneCurve(
        about.curve,
        keyword,
        name,
        points,
        rows,
        *places,
        slot.json,
        (over.label, ordinate.label),
        (over.about.unit, ordinate.about.unit),
        about.ends,
        (low, float(last) if about.ends == "none" else inf),
        len(rows) == len(both),
        keyword == "EMBEDMENT",
    )
