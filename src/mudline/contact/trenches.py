"""Stage `trench`: where the nodes are in their trenches, and what these add to the lateral limits of friction."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.contact.extras import NodeTrench
from mudline.contact.friction.return_mapping import ExtraLimit
from mudline.contact.friction.trench import Centreline, LaidCentreline, StraightCentreline
from mudline.contact.inputs import ContactInput
from mudline.contact.vectors import dot, gathered, nothing


class InTrench(NamedTuple):
    """Nodes (n,) in their trenches.

    extra: what the trench adds to the lateral limit.
    away: (n, 3) way from the centreline to the node.
    gradient: (n, 3) derivative of the offset along u2 by the node's position. Both are 0 for nodes without a trench,
        and None where no derivatives were asked for.
    """

    extra: ExtraLimit
    away: FloatArray | None = None
    gradient: FloatArray | None = None


class TrenchStage:
    """The trenches of an input."""

    def __init__(self, inputs: ContactInput, trench: NodeTrench) -> None:
        self._elements = inputs.element_nodes
        self._law = trench.law
        self._inner, self._outer = 0.5 * trench.law.bottom, 0.5 * trench.law.upper
        self._laid: tuple[FloatArray, LaidCentreline] | None = None
        straight, known = trench.straight, ~np.isnan(trench.law.peak)
        self._along_line = np.flatnonzero(np.isnan(straight[:, 0]) & known)
        self._straight: list[tuple[Centreline, IndexArray]] = [
            (
                StraightCentreline((y0, z0), (y1, z1)),
                np.flatnonzero((straight == (y0, z0, y1, z1)).all(axis=1) & known),
            )
            for y0, z0, y1, z1 in np.unique(straight[~np.isnan(straight[:, 0])], axis=0).tolist()
        ]

    def locate(
        self, points: FloatArray, lateral: FloatArray, laid: FloatArray, pressed: BoolArray, *, detailed: bool = True
    ) -> InTrench:
        """Where nodes at `points` (n, 3) are, whose u2 is `lateral` (n, 3); the line was `laid` (n, 3) first.

        Only `pressed` nodes (n,) are looked for.
        """
        count = len(points)
        offset = np.zeros(count)
        away, gradient = (nothing(count), nothing(count)) if detailed else (None, None)
        for line, nodes in [(self._laid_line(laid), self._along_line), *self._straight]:
            rows = _rows(pressed[nodes])
            held = nodes if rows is None else nodes[rows]
            places, across = gathered(points, held), gathered(lateral, held)
            if away is None or gradient is None:
                places -= line.feet(places, rows)
            else:
                feet, gradient[held] = line.nearest_along(places, across, rows)
                places -= feet
                away[held] = places
            offset[held] = dot(across, places)
        return InTrench(self._extra(offset), away, gradient)

    def _extra(self, offset: FloatArray) -> ExtraLimit:
        """What trenches add at offsets (n,): nothing but beside their walls."""
        distance = np.abs(offset)
        (walls,) = ((distance > self._inner) & (distance < self._outer)).nonzero()
        found = self._law.rows(walls).limit(offset[walls])
        extra = ExtraLimit(*np.zeros((3, len(offset))))
        extra.force[walls], extra.slope[walls], extra.outward[walls] = found.force, found.slope, found.outward
        return extra

    def _laid_line(self, laid: FloatArray) -> LaidCentreline:
        """The line as it was `laid`, prepared once: the states of a run share that array."""
        kept = self._laid
        if kept is None or kept[0] is not laid:
            # in one assignment, so that threads which share the stage see pairs that belong together
            self._laid = kept = (laid, LaidCentreline(laid, self._elements, self._along_line))
        return kept[1]


def _rows(wanted: BoolArray) -> IndexArray | None:
    """The rows to reckon where some are `wanted`; None for all of them, which takes no longer than most of them."""
    (rows,) = wanted.nonzero()
    return None if 2 * len(rows) > len(wanted) else rows
