"""The force-embedment curves of a deck: named ones and those of element sets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.codes import CRV001, CRV003, CRV011
from mudline.curves import CurveError, ForceCurve
from mudline.diagnostics import Where
from mudline.keywords.table import Table
from mudline.scene.context import Context
from mudline.scene.numbering import Floats, Indices

if TYPE_CHECKING:
    from mudline.keywords.library.embedment import Embedment
    from mudline.keywords.library.seabed_stiffness import SeabedStiffness

_CODES = {code.code: code for code in (CRV001, CRV003, CRV011)}


@dataclass(frozen=True, slots=True)
class SceneCurve:
    """A curve of the deck: its name (that of its set for `*EMBEDMENT`), its points as given, where it stands.

    `points` (n, 2) leaves out rows that could not be read; `rows` (n,) are their places in the table. `curve` is None
    when no curve can be made of them.
    """

    name: str
    points: Floats
    rows: Indices
    where: Where
    curve: ForceCurve | None
    embedment: bool

    def point(self, index: int, column: int = 0) -> Where:
        """Where a point of `points` stands."""
        return self.where._replace(path=(*self.where.path, "points", int(self.rows[index]), column))


def read_curves(context: Context) -> tuple[list[SceneCurve], list[SceneCurve]]:
    """The curves of `*SEABED STIFFNESS` and those of `*EMBEDMENT`, in the order of the file."""
    named = [
        _curve(context, str(entry.name), entry.points, where._replace(path=("curves", index)), embedment=False)
        for where, block in context.deck.blocks("SEABED STIFFNESS")
        for index, entry in enumerate(cast("SeabedStiffness", block).curves)
    ]
    by_set = [
        _curve(context, entry.set_name or "ALL", entry.points, where._replace(path=("curves", index)), embedment=True)
        for where, block in context.deck.blocks("EMBEDMENT")
        for index, entry in enumerate(cast("Embedment", block).curves)
    ]
    return named, by_set


def _curve(context: Context, name: str, table: Table, where: Where, *, embedment: bool) -> SceneCurve:
    points = np.column_stack([table.column(0), table.column(1)])
    rows = np.flatnonzero(~np.isnan(points).any(axis=1) & (table.lengths == 2))
    points = points[rows]
    curve: ForceCurve | None = None
    clashing = _clashing(points)
    keep = np.setdiff1d(np.arange(len(points)), clashing)
    scene_curve = SceneCurve(name, points, rows, where, None, embedment)
    for index in clashing.tolist():
        ratio, force = points[index].tolist()
        message = f"a second force at ratio {ratio!r} ({force!r}): the slope there would be infinite"
        context.tell(CRV003, message, scene_curve.point(index))
    try:
        curve = ForceCurve(points[keep], name)
    except CurveError as error:
        unread = len(rows) < len(table) or context.deck.origin.damaged(where)
        if error.code != CRV001.code:
            context.tell(_CODES[error.code], str(error), scene_curve.point(int(keep[error.index])))
        elif not unread and not clashing.size:
            count = len(np.unique(points, axis=0))
            message = f"curve {name!r} has {count} distinct point{'s' * (count != 1)}: at least two are needed"
            context.tell(CRV001, message, where)
    return SceneCurve(name, points, rows, where, curve, embedment)


def _clashing(points: Floats) -> Indices:
    """Indices of points whose ratio an earlier point has with another force."""
    if len(points) < 2:
        return np.zeros(0, dtype=np.intp)
    order = np.argsort(points[:, 0], kind="stable")
    ratios, forces = points[order].T
    starts = np.flatnonzero(np.concatenate([[True], ratios[1:] != ratios[:-1]]))
    first_force = np.repeat(forces[starts], np.diff([*starts, len(ratios)]))
    return np.sort(order[forces != first_force])
