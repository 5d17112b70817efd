"""The force-embedment curves of a deck: named ones and those of element sets."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import short_repr
from mudline.language.codes.fields import CRV001, CRV003, CRV011
from mudline.language.diagnostics import Where
from mudline.language.keywords.table import Table
from mudline.language.keywords.text import shown
from mudline.language.keywords.unknown import known_name
from mudline.model.scene.context import Context
from mudline.model.scene.numbering import Floats, Indices, Mask

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_curves import Embedment, SeabedStiffness
    from mudline.model.curves import CurveError, ForceCurve

_CODES = {code.code: code for code in (CRV001, CRV011)}
_NOWHERE = np.zeros(0, dtype=np.intp)


class SceneCurve(NamedTuple):
    """A curve of the deck: its name (that of its set for `*EMBEDMENT`), its points as given, where it stands.

    `points` (n, 2) leaves out rows that could not be read; `rows` (n,) are their places in the table. `curve` is made
    of those that fit together, None when they make no curve; `whole` says that these are all. `named` says that the
    name, or the set, could be read.
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
        """Where a point of `points` stands."""
        return self.where.inside("points", int(self.rows[index]))

    @property
    def usable(self) -> bool:
        """Whether the curve is what the deck says."""
        return self.curve is not None and self.whole

    @property
    def title(self) -> Where:
        """Where its name stands: the value of CURVE= or SET=."""
        return self.where.inside("set" if self.embedment else "name")


def read_curves(context: Context) -> tuple[list[SceneCurve], list[SceneCurve]]:
    """The curves of `*SEABED STIFFNESS` and those of `*EMBEDMENT`, in the order of the file."""
    named = [
        _curve(context, known_name(entry.name), entry.points, where.inside("curves", index), embedment=False)
        for where, block in context.blocks("SEABED STIFFNESS")
        for index, entry in enumerate(cast("SeabedStiffness", block).curves)
    ]
    by_set = [
        _curve(context, set_name(entry.set_name), entry.points, place, embedment=True)
        for where, block in context.blocks("EMBEDMENT")
        for index, entry in enumerate(cast("Embedment", block).curves)
        for place in (where.inside("curves", index),)
    ]
    return named, by_set


def set_name(name: str | None) -> str | None:
    """The name that a SET= of a seabed law gives: ALL without a SET=, None where it could not be read."""
    return "ALL" if name is None else known_name(name)


def _curve(context: Context, name: str | None, table: Table, where: Where, *, embedment: bool) -> SceneCurve:
    if name is None and not embedment:
        context.unread.add("SEABED STIFFNESS")
    points, rows = _points(table)
    clashing, _ = clashes_and_repeats(points)
    whole = len(rows) == len(table) and not clashing.size
    keep = (
        np.setdiff1d(np.arange(len(points)), clashing, assume_unique=True)
        if clashing.size
        else np.arange(len(points), dtype=np.intp)
    )
    curve, error = _made(points[keep] if clashing.size else points, name or "")
    found = SceneCurve(name or "", points, rows, where, curve, whole, embedment, name is not None)
    for index in clashing[: MOST_REPORTED + 1].tolist():
        ratio, force = points[index].tolist()
        message = f"a second force at ratio {ratio!r} ({force!r}): the slope there would be infinite; remove one"
        context.report(CRV003, message, found.point(index))
    if error is not None and error.index >= 0:  # the message counts points, which holds only when none is left out
        fault = str(error) if len(keep) == len(table) else "the slope to this point cannot be held by a float64"
        context.report(_CODES[error.code], f"{fault}: correct the point", found.point(int(keep[error.index])))
    elif error is not None and whole:
        has = "one distinct point" if len(points) else "no point"
        context.report(CRV001, f"curve {shown(found.name)} has {has}: it needs at least two", where)
    return found


def _points(table: Table) -> tuple[Floats, Indices]:
    """The points (n, 2) of a table, those that have two numbers, and their rows."""
    values = table.values
    full = values.shape[1] == 2 and (table.full or np.minimum.reduce(table.lengths, initial=2) == 2)
    if full and not isnan(np.minimum.reduce(values, axis=None, initial=0.0)):
        return values.copy(), np.arange(len(values), dtype=np.intp)
    points = np.column_stack((table.column(0), table.column(1)))
    rows = ((table.lengths == 2) & ~(np.isnan(points[:, 0]) | np.isnan(points[:, 1]))).nonzero()[0]
    return points[rows], rows


def _made(points: Floats, name: str) -> tuple[ForceCurve | None, CurveError | None]:
    """The curve of some points, or why they make none."""
    from mudline.model.curves import CurveError, ForceCurve  # noqa: PLC0415 - a deck without curves does without it

    try:
        return ForceCurve(points, name), None
    except CurveError as error:
        return None, error


def clashes_and_repeats(points: Floats) -> tuple[Indices, Indices]:
    """Indices of points at the ratio of an earlier one: those with another force than the first there, and the same."""
    if np.count_nonzero(points[1:, 0] > points[:-1, 0]) == max(len(points) - 1, 0):
        return _NOWHERE, _NOWHERE
    order = np.argsort(points[:, 0], kind="stable")
    ratios, forces = points[order].T
    begins: Mask = np.append(True, ratios[1:] != ratios[:-1])
    starts = np.flatnonzero(begins)
    first_force = np.repeat(forces[starts], np.diff(np.append(starts, len(ratios))))
    other = forces != first_force
    return np.sort(order[other]), np.sort(order[~other & ~begins])
