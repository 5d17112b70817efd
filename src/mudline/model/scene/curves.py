"""Curves of a deck, whatever keyword gives them: points over an abscissa, linear between them.

Force-embedment curves, which elements follow, are resolved here too.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import inf, isnan
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import short_repr
from mudline.language.codes.fields import CRV001, CRV003, CRV011
from mudline.language.deck.model import Deck, Opaque
from mudline.language.diagnostics import Blocks, Problem, Where
from mudline.language.keywords.fields import Setting
from mudline.language.keywords.model import Block, FieldSpec, Part, Row, Rows, record_schema
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.unknown import known_name
from mudline.language.keywords.values import Names
from mudline.language.keywords.writer import field_text
from mudline.model.scene.context import Context
from mudline.model.scene.deck_values import number
from mudline.model.scene.numbering import Floats, Indices, Mask

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_curves import Embedment, SeabedStiffness
    from mudline.model.curves import ForceCurve


_CODES = {code.code: code for code in (CRV001, CRV011)}
_NOWHERE = np.zeros(0, dtype=np.intp)


class SceneCurve(NamedTuple):
    """Force-embedment curve of the deck.

    name: its name, or that of its set for `*EMBEDMENT`.
    points: points (n, 2) as given, without rows that could not be read.
    rows: places (n,) of the points in the table.
    where: place of the curve in the deck.
    curve: curve of the points that fit together, None if they do not form a curve.
    whole: all points fit together.
    embedment: the curve is of `*EMBEDMENT`.
    named: the name, or the set, could be read.
    """

    name: str
    points: Floats
    rows: Indices
    where: Where
    curve: ForceCurve | None
    whole: bool
    embedment: bool
    named: bool

    def __repr__(self) -> str:
        return short_repr(self)

    def point(self, index: int) -> Where:
        """Return the place of a point of `points`."""
        return self.where.inside("points", int(self.rows[index]))

    @property
    def usable(self) -> bool:
        """True if the curve has all points of the deck."""
        return self.curve is not None and self.whole

    @property
    def title(self) -> Where:
        """Place of its name: the value of CURVE= or SET=."""
        return self.where.inside("set" if self.embedment else "name")


def read_curves(context: Context) -> tuple[list[SceneCurve], list[SceneCurve]]:
    """Return the curves of `*SEABED STIFFNESS` and those of `*EMBEDMENT`, in the order of the file."""
    named = [
        _seabed_curve(context, known_name(entry.name), entry.points, where.inside("curves", index), embedment=False)
        for where, block in context.blocks("SEABED STIFFNESS")
        for index, entry in enumerate(cast("SeabedStiffness", block).curves)
    ]
    by_set = [
        _seabed_curve(context, set_name(entry.set_name), entry.points, place, embedment=True)
        for where, block in context.blocks("EMBEDMENT")
        for index, entry in enumerate(cast("Embedment", block).curves)
        for place in (where.inside("curves", index),)
    ]
    return named, by_set


def set_name(name: str | None) -> str | None:
    """Return the name that a SET= of a seabed law gives: ALL without a SET=, None if it could not be read."""
    return "ALL" if name is None else known_name(name)


def _seabed_curve(context: Context, name: str | None, table: Table, where: Where, *, embedment: bool) -> SceneCurve:
    if name is None and not embedment:
        context.unread.add("SEABED STIFFNESS")
    points, rows = _points(table)
    entry = SceneCurve(name or "", points, rows, where, None, len(rows) == len(table), embedment, name is not None)
    curve, whole = _made(context, entry, OF_SEABED, ("ratio", "force"), where)
    return entry._replace(curve=curve, whole=whole)


def _points(table: Table) -> tuple[Floats, Indices]:
    """Return the points (n, 2) of a table that have two numbers, and their rows."""
    values = table.values
    full = values.shape[1] == 2 and np.minimum.reduce(table.lengths, initial=2) == 2
    if full and not isnan(np.minimum.reduce(values, axis=None, initial=0.0)):
        return values.copy(), np.arange(len(values), dtype=np.intp)
    points = np.column_stack((table.column(0), table.column(1)))
    rows = ((table.lengths == 2) & ~(np.isnan(points[:, 0]) | np.isnan(points[:, 1]))).nonzero()[0]
    return points[rows], rows


def _made(
    context: Context,
    deck_curve: SceneCurve | DeckCurve,
    kind: str,
    axes: tuple[str, str],
    title: Where,
    blocks: Blocks | None = None,
) -> tuple[ForceCurve | None, bool]:
    """Return the curve of the points that fit together, if they form one, and True if these are all.

    Points that do not form a curve are reported: too few points, two values at one abscissa, sections with slopes that
        a float64 cannot hold.
    """
    from mudline.model.curves import CurveError, ForceCurve  # noqa: PLC0415 - a deck without curves does without it

    clashing, _ = clashes_and_repeats(deck_curve.points)
    whole, keep = deck_curve.whole and not clashing.size, np.arange(len(deck_curve.points), dtype=np.intp)
    if clashing.size:
        keep = np.setdiff1d(keep, clashing, assume_unique=True)
    for index in clashing[: MOST_REPORTED + 1].tolist():
        at, value = deck_curve.points[index].tolist()
        message = f"a second {axes[1]} at {axes[0]} {at!r} ({value!r}): the slope there would be infinite; remove one"
        context.note(Problem(CRV003, message, where=deck_curve.point(index), blocks=blocks))
    try:
        return ForceCurve(deck_curve.points[keep], deck_curve.name), whole
    except CurveError as error:
        if error.index >= 0:  # the message counts points, which holds only when none is left out
            fault = str(error) if whole else "the slope to this point cannot be held by a float64"
            place = deck_curve.point(int(keep[error.index]))
            context.note(Problem(_CODES[error.code], f"{fault}: correct the point", where=place, blocks=blocks))
        elif whole:
            has = "one distinct point" if len(deck_curve.points) else "no point"
            message = f"{kind} {shown(deck_curve.name)} has {has}: it needs at least two"
            context.note(Problem(CRV001, message, where=title, blocks=blocks))
    return None, whole


def clashes_and_repeats(points: Floats) -> tuple[Indices, Indices]:
    """Return indices of points at the ratio of an earlier point: those with another force, and exact repeats."""
    if np.count_nonzero(points[1:, 0] > points[:-1, 0]) == max(len(points) - 1, 0):
        return _NOWHERE, _NOWHERE
    order = np.argsort(points[:, 0], kind="stable")
    ratios, forces = points[order].T
    begins: Mask = np.append(True, ratios[1:] != ratios[:-1])
    starts = np.flatnonzero(begins)
    first_force = np.repeat(forces[starts], np.diff(np.append(starts, len(ratios))))
    differs = forces != first_force
    return np.sort(order[differs]), np.sort(order[~differs & ~begins])


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


class DeckCurve(NamedTuple):
    """Curve of any keyword.

    kind: its kind in words.
    keyword, name: its keyword and its name.
    points: points (n, 2), abscissa first.
    rows: places (n,) of the points in their table, without those that could not be read.
    whole: all points could be read.
    where, title: places of its points and of its name.
    axes: names of abscissa and ordinate.
    units: their dimensions, such as `L` and `F/L`.
    ends: continuation beyond its points.
    reach: abscissas between which it is known; a current profile ends at the surface of the sea.
    """

    kind: str
    keyword: str
    name: str
    points: Floats
    rows: Indices
    whole: bool
    where: Where
    title: Where
    axes: tuple[str, str]
    units: tuple[str, str]
    ends: Literal["slope", "value", "none"]
    reach: tuple[float, float]

    def __repr__(self) -> str:
        return short_repr(self)

    def point(self, index: int) -> Where:
        """Return the place of a point of `points`."""
        return self.where.inside(int(self.rows[index]))

    def made(self) -> ForceCurve | None:
        """Return the curve as it is evaluated, if its points form one."""
        from mudline.model.curves import CurveError, ForceCurve  # noqa: PLC0415 - a deck without curves does without it

        try:
            return ForceCurve(self.points, self.name)
        except CurveError:
            return None


def other_curves(deck: Deck) -> Iterator[DeckCurve]:
    """Yield the curves of a deck except those of its seabed, in the order of the file."""
    for where, _, block in deck.every_block():
        if type(block) is not Opaque and _has_curves(type(block)):
            for curve in _curves(block, block.keyword, where, "", where):
                yield _below_surface(deck, curve) if curve.kind == OF_CURRENT else curve


def _below_surface(deck: Deck, curve: DeckCurve) -> DeckCurve:
    """Return a current profile without its part above the surface of the sea."""
    low, high = curve.reach
    if curve.axes[0] == _DOWN[0]:
        low = max(low, 0.0)
    elif curve.units[0] == "L":
        oceans = [block for _, block in deck.blocks("OCEAN")]
        depth = number(oceans[-1], "depth", inf) if oceans else inf
        high = min(high, depth) if depth > low else high
    return curve._replace(reach=(low, high))


@cache
def _has_curves(part: type[Part]) -> bool:
    """Return True if a part, or a record in it, has a table that is a curve, and not of the seabed."""
    slots = record_schema(part).slots
    return any(
        (isinstance(slot.about, Rows) and slot.about.curve not in ("", OF_SEABED))
        or any(_has_curves(record) for record in slot.record.values())
        for slot in slots
    )


def _curves(part: Part, keyword: str, where: Where, name: str, title: Where) -> Iterator[DeckCurve]:
    if not issubclass(type(part), Block):
        settings = (slot for slot in record_schema(type(part)).slots if isinstance(slot.about, Setting))
        given = [slot for slot in settings if getattr(part, slot.name) is not None]
        if given:
            first = min(given, key=lambda slot: slot.about.names is not Names.SET)
            name = ", ".join(filter(None, [name, _written(first, getattr(part, first.name))]))
            title = where.inside(first.json)
    for slot in record_schema(type(part)).slots:
        value = getattr(part, slot.name)
        if isinstance(slot.about, Rows) and slot.about.curve and isinstance(value, Table):
            own = _curve(slot, value, keyword, name, (where.inside(slot.json), title))
            over = _OF_OPTION.get(str(getattr(part, "option", None)))
            yield own._replace(axes=(over[0], own.axes[1]), units=(over[1], own.units[1])) if over else own
        elif slot.record:
            for index, child in enumerate(value):
                if _has_curves(cast("type[Part]", type(child))):
                    yield from _curves(child, keyword, where.inside(slot.json, index), name, title)


def _written(slot: FieldSpec, value: object) -> str:
    """Return a name, or the setting with its value if that is not a name."""
    if isinstance(value, str):
        return value
    values = value if isinstance(value, list) else [value]
    return slot.label + ", ".join(field_text(each) for each in values[:3] if isinstance(each, float | int | str))


def _curve(slot: FieldSpec, table: Table, keyword: str, name: str, places: tuple[Where, Where]) -> DeckCurve:
    about = cast("Rows", slot.about)
    columns = record_schema(cast("type[Row]", about.row)).columns
    over, ordinate = about.axes
    both = np.column_stack([table.column(over), table.column(ordinate)])
    rows = np.flatnonzero(~np.isnan(both).any(axis=1))
    axes = (columns[over], columns[ordinate])
    first, last = both[rows][:, 0].min(initial=inf), both[rows][:, 0].max(initial=-inf)
    low = -inf if about.ends == "slope" or (about.ends == "value" and first < 0.0) else float(first)
    return DeckCurve(
        about.curve,
        keyword,
        name,
        both[rows],
        rows,
        len(rows) == len(both),
        *places,
        (axes[0].label, axes[1].label),
        (axes[0].about.unit, axes[1].about.unit),
        about.ends,
        (low, float(last) if about.ends == "none" else inf),
    )


def check_curves(context: Context) -> None:
    """Report faults of the curves that are not those of the seabed."""
    for curve in other_curves(context.deck):
        _made(context, curve, curve.kind, curve.axes, curve.title, Blocks.NEVER)
