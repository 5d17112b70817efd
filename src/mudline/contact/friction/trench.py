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
from mudline.contact.friction.return_mapping import ExtraLimit
from mudline.contact.vectors import dot, scaled


class Centreline(Protocol):
    """The line that a trench follows."""

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The nearest points (n, 3) of the line to `points` (n, 3), each the place of its own node.

        Also how the way from there to the point changes with the point, (n, 3, 3).
        """


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
        start, end = np.array(self.start), np.array(self.end)
        along = (end - start) / np.hypot(*(end - start))
        found = points.copy()
        found[:, 1:] = start + ((points[:, 1:] - start) @ along)[:, None] * along
        across = np.zeros((3, 3))
        across[1:, 1:] = np.eye(2) - np.outer(along, along)
        return found, np.broadcast_to(across, (len(points), 3, 3))

    def nearest_along(self, points: FloatArray, lateral: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same; of the changes only that along `lateral` (n, 3), as gradients (n, 3)."""
        found, across = self.nearest(points)
        return found, lateral @ across[0] if len(points) else lateral.copy()


class LaidCentreline:
    """The line through the nodes as they were laid: straight between the two nodes of an element.

    A node looks for its nearest point from its own place along the line, so that a stretch of the line which happens to
    pass nearby is not taken for its own trench.
    """

    def __init__(self, laid: FloatArray, element_nodes: IndexArray) -> None:
        known = ~np.isnan(laid[:, 0])  # NaN stands for nodes without a position
        self._ends = element_nodes[known[element_nodes].all(axis=1)]
        self._start = laid[self._ends[:, 0]]
        self._span = laid[self._ends[:, 1]] - self._start
        self._square = dot(self._span, self._span)
        self._elements_at = _two_of_each(self._ends, len(laid))

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The nearest points of the laid line; see `Centreline`."""
        found, elements, inside = self._settled(points)
        across = np.broadcast_to(np.eye(3), (len(points), 3, 3)).copy()
        span, square = self._span[elements[inside]], self._square[elements[inside]]
        across[inside] -= span[:, :, None] * span[:, None, :] / square[:, None, None]
        # a node without elements is its own centreline
        across[elements < 0] = 0.0
        return found, across

    def nearest_along(self, points: FloatArray, lateral: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same; of the changes only that along `lateral` (n, 3), as gradients (n, 3)."""
        found, elements, inside = self._settled(points)
        gradient = lateral.copy()
        span, square = self._span.take(elements[inside], axis=0), self._square[elements[inside]]
        held = lateral.take(inside, axis=0)
        gradient[inside] = held - scaled(span, dot(held, span) / square)
        gradient[elements < 0] = 0.0
        return found, gradient

    def _settled(self, points: FloatArray) -> tuple[FloatArray, IndexArray, IndexArray]:
        """Nearest points, their elements (-1 for nodes without one), and which nodes' points are inside of theirs."""
        current, other = self._elements_at.T.copy()
        held = np.flatnonzero(current >= 0)
        found = points.copy()
        share, found[held], distance = self._foot(points[held], current[held])
        beside = np.flatnonzero(other[held] >= 0)
        second, foot, away = self._foot(points[held[beside]], other[held[beside]])
        nearer = away < distance[beside]
        better = beside[nearer]
        share[better], distance[better], found[held[better]] = second[nearer], away[nearer], foot[nearer]
        current[held[better]] = other[held[better]]
        shares = np.zeros(len(points))
        shares[held] = share
        while held.size:
            following = self._beyond(current[held], share)
            ahead = np.flatnonzero(following >= 0)
            held, following, before = held[ahead], following[ahead], distance[ahead]
            share, foot, distance = self._foot(points[held], following)
            nearer = distance < before
            held, share, distance = held[nearer], share[nearer], distance[nearer]
            current[held], found[held], shares[held] = following[nearer], foot[nearer], share
        return found, current, np.flatnonzero((shares > 0.0) & (shares < 1.0))

    def _foot(self, points: FloatArray, elements: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Share of the element, nearest point and distance of each point on an element."""
        start, span = self._start.take(elements, axis=0), self._span.take(elements, axis=0)
        square = self._square[elements]
        share = dot(points - start, span) / np.where(square > 0.0, square, np.inf)
        np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
        foot = scaled(span, share)
        foot += start
        away = points - foot
        return share, foot, np.sqrt(dot(away, away))

    def _beyond(self, elements: IndexArray, share: FloatArray) -> IndexArray:
        """The element behind the end that the foot stands on; -1 inside an element and at the end of the line."""
        end = np.where(share <= 0.0, self._ends[elements, 0], self._ends[elements, 1])
        one, other = self._elements_at[end].T
        following = np.where(one == elements, other, one)
        return np.where((share > 0.0) & (share < 1.0), -1, following)


def _two_of_each(element_nodes: IndexArray, nodes: int) -> IndexArray:
    """The first two elements (n, 2) at each node, -1 where there are fewer."""
    node = element_nodes.reshape(-1)
    order = np.argsort(node, kind="stable")
    ordered = node[order]
    first = np.searchsorted(ordered, np.arange(nodes))
    found = np.full((nodes, 2), -1, dtype=np.intp)
    for rank in range(2):
        at = first + rank
        there = at < len(ordered)
        there[there] = ordered[at[there]] == np.flatnonzero(there)
        found[there, rank] = order[at[there]] // 2
    return found
