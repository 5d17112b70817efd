"""Positions of nodes in their trenches, and the resistance that trenches add to friction; see `laws.trench`."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray, summed
from mudline.model.contact.input import AssignedLaw, ContactInput, ElementError
from mudline.model.contact.laws.friction import ExtraLimit
from mudline.model.contact.laws.trench import (
    LEVEL,
    PEAK,
    TABLE,
    WALL,
    TrenchRows,
    lowered,
    resistance,
    share_of_piece,
    slopes,
    table_rows,
    wall_coefficient,
)
from mudline.model.contact.line import Incidence
from mudline.model.contact.vectors import LEAST_SQUARE

_ENDS = ("start_y", "start_z", "end_y", "end_z")


def trench_rows(given: ContactInput, friction: FloatArray, kinds: tuple[int, ...] = (PEAK, WALL, TABLE)) -> TrenchRows:
    """Return the trenches of the nodes; `friction` (n,) are the lateral coefficients. LEVEL has depths as amounts.

    Each end of an element counts with half of its length; equal trenches of the elements at a node are one row. Nodes
    with a breakout have no trench: the breakout is a limit of its own.

    Raises:
        ValueError: the wall of a trench locks itself: mu2 tan(theta) >= 1.
        ElementError: half of an element's length times the resistance overflows.
    """
    columns = [_of_law(given, kind, friction) for kind in kinds]
    nodes, keys, ends, amounts = (np.concatenate(parts) for parts in zip(*columns, strict=True))
    if "breakout" in given.assigned and LEVEL not in kinds:
        held = ~np.isin(nodes, given.assigned["breakout"].rows)
        nodes, keys, ends, amounts = nodes[held], keys[held], ends[held], amounts[held]
    straight = ~np.isnan(ends[:, 0])
    lines, line = _distinct(ends[straight])
    of_line = np.full(len(ends), -1.0)
    of_line[straight] = line
    rows, at = _distinct(np.column_stack([nodes, keys, of_line]))
    span = lines[:, 2:] - lines[:, :2]
    with np.errstate(all="ignore"):
        direction = span / np.hypot(span[:, 0], span[:, 1])[:, None]
    node = rows[:, 0].astype(np.intp)
    return TrenchRows(
        node,
        np.searchsorted(node, np.arange(len(given.node_ids) + 1)).astype(np.intp),
        rows[:, 1].astype(np.int8),
        rows[:, 2].copy(),
        rows[:, 3].copy(),
        2.0 / (rows[:, 3] - rows[:, 2]),
        np.bincount(at, amounts, len(rows)).astype(np.float64),
        rows[:, 4].astype(np.int32),
        rows[:, 5].astype(np.int32),
        np.ascontiguousarray(np.column_stack([lines[:, :2], direction])),
        tuple(map(table_rows, given.tables)),
    )


def _distinct(table: FloatArray) -> tuple[FloatArray, IndexArray]:
    """Return the distinct rows (n, k) in ascending order, and the index of each row of the table among them.

    The result is that of `np.unique` along an axis, whose comparison of rows takes ten times as long.
    """
    order = np.lexsort(table.T[::-1])
    ascending = table[order]
    is_new = np.ones(len(table), dtype=bool)
    is_new[1:] = (ascending[1:] != ascending[:-1]).any(axis=1)
    which = np.empty(len(table), dtype=np.intp)
    which[order] = np.cumsum(is_new) - 1
    return ascending[is_new], which


_NAMES = {PEAK: "trench peak", WALL: "trench wall", TABLE: "trench table", LEVEL: "trench level"}


def _of_law(
    given: ContactInput, kind: int, friction: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return nodes, keys, centrelines (2 k, 4) and amounts at both ends (2 k,) of the elements with one law.

    Keys (2 k, 4) are the kind, the half widths, and the table.
    """
    law = given.assigned.get(_NAMES[kind])
    if law is None:
        return np.empty(0), np.empty((0, 4)), np.empty((0, 4)), np.empty(0)
    ends = given.element_nodes[law.rows]
    half = 0.5 * given.length[law.rows]
    table = law["table"] if kind == TABLE else np.full(len(law.rows), -1.0)
    keys = np.column_stack([np.full(len(law.rows), float(kind)), 0.5 * law["bottom"], 0.5 * law["upper"], table])
    lines = np.column_stack([law[name] for name in _ENDS])
    amounts = []
    for end in ends.T:
        if kind == PEAK:
            amounts.append(half * law["peak"])
        elif kind == TABLE:
            amounts.append(half)
        else:
            whole = law["depth"] if kind == LEVEL else _wall(given, law, end, friction)
            amounts.append(whole * half / _lengths(given)[end])
        if not np.isfinite(amounts[-1]).all():
            element = int(given.element_ids[law.rows[np.flatnonzero(~np.isfinite(amounts[-1]))[0]]])
            raise ElementError(f"element {element}: the resistance of its trench overflows", element)
    nodes = ends.T.reshape(-1).astype(np.float64)
    return nodes, np.concatenate([keys, keys]), np.concatenate([lines, lines]), np.concatenate(amounts)


def _wall(given: ContactInput, law: AssignedLaw, nodes: IndexArray, friction: FloatArray) -> FloatArray:
    """Return the increase of the coefficient of friction by the wall at nodes (k,) of elements."""
    added = wall_coefficient(law["depth"], law["bottom"], law["upper"], friction[nodes])
    locked = np.flatnonzero(~(np.isfinite(added) & (added >= 0.0)))
    if locked.size:
        node = int(given.node_ids[nodes[locked[0]]])
        raise ValueError(f"node {node} lies in a trench whose wall locks itself: mu2 tan(theta) is 1 or more")
    return added


def _lengths(given: ContactInput) -> FloatArray:
    """Return half of the total length of the elements at each node; 1 where that is 0."""
    total = summed(0.5 * given.length, given.element_nodes, len(given.node_ids))
    return np.where(total > 0.0, total, 1.0)


class _Pieces(NamedTuple):
    """Straight pieces of a centreline.

    A straight centreline is a piece without ends, with a span of length 1 in the plan.

    Attributes:
        start, span: (3, 1, k) start and vector to the end.
        inverse: (k,) 1 / length^2.
        first, last: shares at the ends.
    """

    start: FloatArray
    span: FloatArray
    inverse: FloatArray
    first: FloatArray | float = 0.0
    last: FloatArray | float = 1.0


class Beside(NamedTuple):
    """The two pieces next to each of some nodes (k,).

    Attributes:
        pieces: the pieces.
        elements: their elements.
        far: shares at the ends away from the node; NaN at the end of the line.
        straight: nodes with a straight centreline.
        alone: nodes without any piece.
    """

    pieces: tuple[_Pieces, _Pieces]
    elements: tuple[IndexArray, IndexArray]
    far: tuple[FloatArray, FloatArray]
    straight: IndexArray
    alone: IndexArray


class Away(NamedTuple):
    """Nodes (steps, k) relative to a centreline.

    Attributes:
        vector: (3, steps, k) from the nearest point of the centreline.
        element: element of the nearest point, -1 for straight centrelines and nodes without any.
        share: share of the element at the nearest point.
    """

    vector: FloatArray
    element: IndexArray
    share: FloatArray


class LaidCentreline:
    """The line through the nodes as they were laid (n, 3), straight between the two nodes of an element.

    The search for the nearest point starts at the node's own place along the line. Another stretch of the line that
    passes nearby is therefore not taken for the trench. Elements at a node without a position (NaN) are left out.
    """

    def __init__(self, laid: FloatArray, line: Incidence) -> None:
        known = ~np.isnan(laid[:, 0])
        if not known.all():
            line = Incidence(line.ends[known[line.ends].all(axis=1)], len(laid))
        # a last piece, without element and length, for nodes without pieces
        self.ends, self.elements_at = np.append(line.ends, [[-1, -1]], axis=0), line.beside
        axes = np.ascontiguousarray(laid.T)
        start, end = line.at(axes)
        span = end - start
        with np.errstate(all="ignore"):
            square = span[0] * span[0] + span[1] * span[1] + span[2] * span[2]
            inverse = np.where(square > LEAST_SQUARE, 1.0 / square, 0.0)
        pieces = np.pad(np.concatenate([start, span, inverse[None]]), ((0, 0), (0, 1)))
        self.start, self.span, self.inverse = pieces[:3], pieces[3:6], pieces[6]
        self._kept: dict[int, tuple[TrenchRows, Beside]] = {}

    def beside(self, trench: TrenchRows) -> Beside:
        """Return the pieces next to the nodes of some trenches, computed once."""
        if id(trench) not in self._kept:  # kept with them: while they live no other trenches have their id
            self._kept[id(trench)] = trench, self._pieces_beside(trench)
        return self._kept[id(trench)][1]

    def _pieces_beside(self, trench: TrenchRows) -> Beside:
        nodes, straight = trench.nodes, trench.line >= 0
        first, second = self.elements_at[nodes].T
        alone = (first < 0) & ~straight
        second = np.where(second < 0, first, second)
        lines = trench.lines[np.maximum(trench.line, 0)] if len(trench.lines) else np.zeros((len(nodes), 4))
        pieces, far = [], []
        for element in (first, second):
            piece, end = self._piece(element), np.where(self.ends[element, 1] == nodes, 0.0, 1.0)
            far.append(np.where(straight | alone, np.nan, end))
            pieces.append(_with_lines(piece, lines, straight) if straight.any() else piece)
        rows = np.flatnonzero(straight), np.flatnonzero(alone)
        return Beside((pieces[0], pieces[1]), (first, second), (far[0], far[1]), *rows)

    def _piece(self, at: IndexArray) -> _Pieces:
        return _Pieces(self.start.take(at, axis=1)[:, None], self.span.take(at, axis=1)[:, None], self.inverse[at])

    def away(self, beside: Beside, points: FloatArray) -> Away:
        """Return vectors from the nearest points of the centreline to `points` (3, steps, k)."""
        share, away, square = _foot(points, beside.pieces[0])
        second, second_away, distance = _foot(points, beside.pieces[1])
        nearer = distance < square
        share = np.where(nearer, second, share)
        away = np.where(nearer, second_away, away)
        element = np.where(nearer, beside.elements[1], beside.elements[0])
        ends = share == np.where(nearer, beside.far[1], beside.far[0])
        if ends.any():
            self._walk(points, (share, away, np.where(nearer, distance, square), element), np.flatnonzero(ends))
        if beside.straight.size:  # at the point's own elevation
            away[0][:, beside.straight] = 0.0
        if beside.alone.size:
            away[..., beside.alone] = 0.0
        return Away(away, element, share)

    def _walk(
        self,
        points: FloatArray,
        nearest: tuple[FloatArray, FloatArray, FloatArray, IndexArray],
        held: IndexArray,
    ) -> None:
        """Continue beyond the ends of pieces where the nearest points are, as long as the distance decreases."""
        shares, away, squares, elements = nearest
        held = held[squares.flat[held] > 0.0]
        while held.size:
            share, current = shares.flat[held], elements.flat[held]
            node = np.where(share <= 0.0, self.ends[current, 0], self.ends[current, 1])
            first, second = self.elements_at[node].T
            following = np.where(first == current, second, first)
            following[(share > 0.0) & (share < 1.0)] = -1
            held, following = held[following >= 0], following[following >= 0]
            share, vectors, square = _foot(points.reshape(3, 1, -1)[..., held], self._piece(following))
            nearer = square[0] < squares.flat[held]
            held = held[nearer]
            shares.flat[held], squares.flat[held] = share[0, nearer], square[0, nearer]
            elements.flat[held] = following[nearer]
            away.reshape(3, -1)[:, held] = vectors[:, 0, nearer]


def _with_lines(piece: _Pieces, lines: FloatArray, straight: BoolArray) -> _Pieces:
    """Return the pieces with straight centrelines for the nodes that have one."""
    places = np.pad(lines.reshape(-1, 2, 2), ((0, 0), (0, 0), (1, 0))).T[:, :, None]
    start = np.where(straight, places[:, 0], piece.start)
    span = np.where(straight, places[:, 1], piece.span)
    ends = np.where(straight, -np.inf, 0.0), np.where(straight, np.inf, 1.0)
    return _Pieces(start, span, np.where(straight, 1.0, piece.inverse), *ends)


def _foot(points: FloatArray, piece: _Pieces) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the share (steps, k) of each piece, the vector (3, steps, k) from its nearest point and its square."""
    away = points - piece.start
    share: FloatArray = share_of_piece((away[0], away[1], away[2]), tuple(piece.span), piece.inverse)
    np.maximum(share, piece.first, out=share)
    np.minimum(share, piece.last, out=share)
    away -= share * piece.span
    squares = away * away
    return share, away, squares[0] + squares[1] + squares[2]


class Lowered(NamedTuple):
    """Depth (n,) by which the seabed is lowered at nodes, and its gradient (n, 3) with u2 held."""

    depth: FloatArray
    gradient: FloatArray


def level_at(trench: TrenchRows, line: LaidCentreline, points: FloatArray, lateral: FloatArray) -> Lowered:
    """Return depth and gradient of the trenches below nodes at `points` (n, 3) with u2 (n, 3)."""
    total = Lowered(np.zeros(len(points)), np.zeros(points.shape))
    _, offset, gradient = _offsets(trench, line, points, lateral)
    share, slope = lowered(np.abs(offset), trench.inner, trench.outer)
    np.add.at(total.depth, trench.nodes, trench.amount * share)
    np.add.at(total.gradient, trench.nodes, (trench.amount * slope * np.sign(offset))[:, None] * gradient)
    return total


def _offsets(
    trench: TrenchRows, line: LaidCentreline, points: FloatArray, lateral: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return vectors (k, 3) of the rows from the centreline, offsets and offset gradients (k, 3)."""
    at, beside = trench.nodes, line.beside(trench)
    where = line.away(beside, points[at].T[:, None])
    away = where.vector[:, 0].T
    return away, (away * lateral[at]).sum(axis=1), _offset_gradient(line, trench, beside, where, lateral[at])


def added_limit(
    trench: TrenchRows,
    line: LaidCentreline,
    points: FloatArray,
    axes: tuple[FloatArray, FloatArray],
    normal_force: FloatArray,
    forward: BoolArray,
) -> ExtraLimit:
    """Return the limit that trenches add at `points` (n, 3) on the side of each node's pull; `forward` (n,): along +u2.

    `gradient` and `by_angle` are those of the force, whose derivative `by_offset` is 1.
    """
    count = len(points)
    limit = ExtraLimit.none(count)._replace(by_offset=np.ones(count), outward=np.where(forward, 1.0, -1.0))
    at, (away, offset, gradient) = trench.nodes, _offsets(trench, line, points, axes[1])
    side = np.where((offset > 0.0) == forward[at], 1.0, 0.0) * (offset != 0.0)
    by_distance, by_normal = slopes(trench, offset)
    slope = side * by_distance * np.sign(offset)
    np.add.at(limit.force, at, side * resistance(trench, offset[None], normal_force[at][None])[0])
    np.add.at(limit.by_normal_force, at, side * by_normal)
    np.add.at(limit.gradient, at, slope[:, None] * gradient)
    np.subtract.at(limit.by_angle, at, slope * (axes[0][at] * away).sum(axis=1))
    return limit


def _offset_gradient(
    line: LaidCentreline, rows: TrenchRows, beside: Beside, where: Away, lateral: FloatArray
) -> FloatArray:
    """Return the derivative (k, 3) of the offset along u2 by the node's position; it is 0 along the nearest piece."""
    along = np.zeros(lateral.shape)
    share, element = where.share[0], where.element[0]
    inside = np.flatnonzero((rows.line < 0) & (share > 0.0) & (share < 1.0) & (element >= 0))
    if inside.size:
        span = line.span[:, element[inside]].T
        along[inside] = span * np.sqrt(line.inverse[element[inside]])[:, None]
    along[beside.straight, 1:] = rows.lines[rows.line[beside.straight], 2:]
    gradient: FloatArray = lateral - (lateral * along).sum(axis=1)[:, None] * along
    gradient[beside.straight, 0] = 0.0  # at the point's own elevation
    gradient[beside.alone] = 0.0
    return gradient
