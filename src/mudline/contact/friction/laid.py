"""The centreline of a trench along the line as it was laid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.vectors import dot, gathered, scaled


class _Pieces(NamedTuple):
    """A straight piece of the line for each of some points (k,): start, span (k, 3), its square and its element."""

    start: FloatArray
    span: FloatArray
    square: FloatArray
    element: IndexArray

    def rows(self, rows: IndexArray) -> _Pieces:
        """Some of them."""
        return _Pieces(gathered(self.start, rows), gathered(self.span, rows), self.square[rows], self.element[rows])


class _Settled(NamedTuple):
    """Nearest points (k, 3), their elements (k,), -1 for nodes without one, and their shares of these (k,)."""

    found: FloatArray
    element: IndexArray
    share: FloatArray


class LaidCentreline:
    """The line through the nodes as they were laid: straight between the two nodes of an element.

    A node looks for its nearest point from its own place along the line, so that a stretch of the line which happens to
    pass nearby is not taken for its own trench. Points are those of the `nodes` (k,), which are all unless told.
    """

    def __init__(self, laid: FloatArray, element_nodes: IndexArray, nodes: IndexArray | None = None) -> None:
        known = ~np.isnan(laid[:, 0])  # NaN stands for nodes without a position
        self._ends = element_nodes if known.all() else element_nodes[known[element_nodes].all(axis=1)]
        places = np.asfortranarray(laid)
        start, span = (gathered(places, end) for end in self._ends.T)
        span -= start
        square = dot(span, span)
        square[~(square > 0.0)] = np.inf  # a piece without length has its foot at its start
        self._pieces = _Pieces(start, span, square, np.arange(len(start)))
        self._elements_at = _two_of_each(self._ends, len(laid))
        beside = self._elements_at if nodes is None else self._elements_at[nodes]
        self._beside = [self._of_elements(elements) for elements in beside.T]

    def nearest(self, points: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `Centreline` of `trench`."""
        found, elements, share = self._settled(points, None)
        inside = np.flatnonzero((share > 0.0) & (share < 1.0))
        across = np.broadcast_to(np.eye(3), (len(points), 3, 3)).copy()
        piece = self._pieces.rows(elements[inside])
        across[inside] -= piece.span[:, :, None] * piece.span[:, None, :] / piece.square[:, None, None]
        # a node without elements is its own centreline
        across[elements < 0] = 0.0
        return found, across

    def feet(self, points: FloatArray, rows: IndexArray | None = None) -> FloatArray:
        """See `Centreline` of `trench`."""
        return self._settled(points, rows).found

    def nearest_along(
        self, points: FloatArray, lateral: FloatArray, rows: IndexArray | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """See `Centreline` of `trench`."""
        found, elements, share = self._settled(points, rows)
        inside = np.flatnonzero((share > 0.0) & (share < 1.0))
        gradient = lateral.copy()
        piece, held = self._pieces.rows(elements[inside]), gathered(lateral, inside)
        gradient[inside] = held - scaled(piece.span, dot(held, piece.span) / piece.square)
        gradient[elements < 0] = 0.0
        return found, gradient

    def _settled(self, points: FloatArray, rows: IndexArray | None) -> _Settled:
        """Of the two pieces beside the node the nearer one, and from there along the line as long as it gets nearer."""
        one, other = self._beside if rows is None else (pieces.rows(rows) for pieces in self._beside)
        share, found, distance = _foot(points, one)
        second, foot, away = _foot(points, other)
        nearer = away < distance
        np.copyto(share, second, where=nearer)
        np.copyto(distance, away, where=nearer)
        np.copyto(found, foot, where=nearer[:, np.newaxis])
        current = np.where(nearer, other.element, one.element)
        settled = _Settled(found, current, share)
        self._walk(points, settled, distance)
        (alone,) = (current < 0).nonzero()
        if alone.size:
            found[alone], share[alone] = points[alone], 0.0
        return settled

    def _walk(self, points: FloatArray, settled: _Settled, distance: FloatArray) -> None:
        """Go on beyond the ends of elements that the feet stand on."""
        found, current, shares = settled
        (held,) = (((shares <= 0.0) | (shares >= 1.0)) & (distance > 0.0)).nonzero()
        while held.size:
            following = self._beyond(current[held], shares[held])
            (ahead,) = (following >= 0).nonzero()
            held, following = held[ahead], following[ahead]
            share, foot, away = _foot(gathered(points, held), self._pieces.rows(following))
            nearer = away < distance[held]
            held, share = held[nearer], share[nearer]
            current[held], found[held], shares[held], distance[held] = (
                following[nearer],
                foot[nearer],
                share,
                away[nearer],
            )

    def _of_elements(self, elements: IndexArray) -> _Pieces:
        """The pieces of elements (k,), NaN for those that are -1."""
        there = elements >= 0
        if not len(self._ends):
            nowhere = np.full((3, len(elements)), np.nan).T
            return _Pieces(nowhere, nowhere, nowhere[:, 0], elements)
        piece = self._pieces.rows(np.where(there, elements, 0))
        piece.start[~there] = np.nan
        return piece._replace(element=elements)

    def _beyond(self, elements: IndexArray, share: FloatArray) -> IndexArray:
        """The element behind the end that the foot stands on; -1 inside an element and at the end of the line."""
        end = np.where(share <= 0.0, self._ends[elements, 0], self._ends[elements, 1])
        one, other = self._elements_at[end].T
        following = np.where(one == elements, other, one)
        return np.where((share > 0.0) & (share < 1.0), -1, following)


def _foot(points: FloatArray, piece: _Pieces) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Share of the piece, nearest point and distance of each point."""
    away = points - piece.start
    share = dot(away, piece.span)
    share /= piece.square
    np.minimum(np.maximum(share, 0.0, out=share), 1.0, out=share)
    foot = scaled(piece.span, share)
    foot += piece.start
    np.subtract(points, foot, out=away)
    distance = dot(away, away)
    return share, foot, np.sqrt(distance, out=distance)


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
