"""Stage `trench`: where the nodes are in their trenches, and what these add to the lateral limits of friction."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.extras import NodeTrench
from mudline.contact.friction.return_mapping import ExtraLimit
from mudline.contact.friction.trench import LaidCentreline, StraightCentreline
from mudline.contact.inputs import ContactInput
from mudline.contact.vectors import dot


class InTrench(NamedTuple):
    """Nodes (n,) in their trenches.

    away: (n, 3) way from the centreline to the node.
    gradient: (n, 3) derivative of the offset along u2 by the node's position.
    extra: what the trench adds to the lateral limit.
    """

    away: FloatArray
    gradient: FloatArray
    extra: ExtraLimit


class TrenchStage:
    """The trenches of an input."""

    def __init__(self, inputs: ContactInput, trench: NodeTrench) -> None:
        self._elements = inputs.element_nodes
        self._law = trench.law
        self._laid: tuple[FloatArray, LaidCentreline] | None = None
        straight = trench.straight
        self._straight = [
            (StraightCentreline((y0, z0), (y1, z1)), np.flatnonzero((straight == (y0, z0, y1, z1)).all(axis=1)))
            for y0, z0, y1, z1 in np.unique(straight[~np.isnan(straight[:, 0])], axis=0).tolist()
        ]

    def locate(self, points: FloatArray, lateral: FloatArray, laid: FloatArray) -> InTrench:
        """Where nodes at `points` (n, 3) are, whose u2 is `lateral` (n, 3); the line was `laid` (n, 3) first."""
        nearest, gradient = self._laid_line(laid).nearest_along(points, lateral)
        for centreline, nodes in self._straight:
            nearest[nodes], gradient[nodes] = centreline.nearest_along(points[nodes], lateral[nodes])
        away = points - nearest
        return InTrench(away, gradient, self._law.limit(dot(lateral, away)))

    def _laid_line(self, laid: FloatArray) -> LaidCentreline:
        """The line as it was `laid`, prepared once: the states of a run share that array."""
        kept = self._laid
        if kept is None or kept[0] is not laid:
            # in one assignment, so that threads which share the stage see pairs that belong together
            self._laid = kept = (laid, LaidCentreline(laid, self._elements))
        return kept[1]
