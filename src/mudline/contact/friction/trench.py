"""Trenches: a peak resistance against sideways motion towards their walls (a phenomenological reading, INFERRED).

The lateral limit is mu N + L_t PEAK s(|y|), y the offset from the centreline along u2. s is 0 up to half of the bottom
width, rises linearly to 1 at the middle of the wall and falls linearly to 0 at half of the upper width. It acts against
outward motion only. The bed is not lowered.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.friction.laid import LaidCentreline
from mudline.contact.friction.return_mapping import ExtraLimit

__all__ = ["Centreline", "LaidCentreline", "StraightCentreline", "TrenchLaw"]


class Centreline(Protocol):
    """The line that a trench follows."""

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The nearest points (n, 3) of the line to `points` (n, 3), each the place of its own node.

        Also how the way from there to the point changes with the point, (n, 3, 3).
        """

    def feet(self, points: FloatArray, rows: IndexArray | None = None) -> FloatArray:
        """The nearest points alone; `rows` says which of the nodes the points are those of."""

    def nearest_along(
        self, points: FloatArray, lateral: FloatArray, rows: IndexArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """The nearest points; of the changes only that along `lateral` (n, 3), as gradients (n, 3)."""


@dataclass(frozen=True, slots=True, eq=False)
class TrenchLaw:
    """Trenches of nodes (n,); NaN where a node has none.

    Attributes:
        bottom: widths of the bottom, > 0.
        upper: upper widths, > bottom.
        peak: peak forces on the node: L_t PEAK.
    """

    bottom: FloatArray
    upper: FloatArray
    peak: FloatArray

    def rows(self, rows: IndexArray) -> TrenchLaw:
        """The trenches of some nodes."""
        return TrenchLaw(self.bottom[rows], self.upper[rows], self.peak[rows])

    def limit(self, offset: FloatArray) -> ExtraLimit:
        """What the trench adds at offsets (n,) from the centreline."""
        inner, outer = 0.5 * self.bottom, 0.5 * self.upper
        half = 0.5 * (outer - inner)
        distance = np.abs(offset)
        rising = (distance > inner) & (distance <= inner + half)
        falling = (distance > inner + half) & (distance < outer)
        share = np.where(rising, (distance - inner) / half, 0.0)
        share = np.where(falling, (outer - distance) / half, share)
        slope = np.where(rising, 1.0, np.where(falling, -1.0, 0.0)) / half
        side = np.where(rising | falling, np.sign(offset), 0.0)
        known = ~np.isnan(self.peak)
        return ExtraLimit(
            np.where(known, self.peak * share, 0.0),
            np.where(known, self.peak * slope * np.sign(offset), 0.0),
            np.where(known, side, 0.0),
        )


@dataclass(frozen=True, slots=True, eq=False)
class StraightCentreline:
    """The straight line through two points (Y, Z) of the plan, unbounded, at every elevation."""

    start: tuple[float, float]
    end: tuple[float, float]

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The foot of each point in the plan, at the point's own elevation; see `Centreline`."""
        along = self._along
        across = np.zeros((3, 3))
        across[1:, 1:] = np.eye(2) - np.outer(along, along)
        return self.feet(points), np.broadcast_to(across, (len(points), 3, 3))

    def feet(self, points: FloatArray, rows: IndexArray | None = None) -> FloatArray:
        """See `Centreline`."""
        del rows  # one line for all nodes
        along, start = self._along, np.array(self.start)
        found = np.array(points, order="F")
        found[:, 1:] -= start
        # not as a matrix product: what that rounds depends on how many points there are
        way = found[:, 1] * along[0]
        way += found[:, 2] * along[1]
        for axis in range(2):
            np.multiply(way, along[axis], out=found[:, 1 + axis])
        found[:, 1:] += start
        return found

    def nearest_along(
        self, points: FloatArray, lateral: FloatArray, rows: IndexArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """See `Centreline`."""
        del rows
        found, across = self.nearest(points)
        return found, lateral @ across[0] if len(points) else lateral.copy()

    @property
    def _along(self) -> FloatArray:
        way: FloatArray = np.array(self.end) - np.array(self.start)
        way /= np.hypot(*way)
        return way
