"""The tangent of the nodal reactions: one row and column for each of the 3 n coordinates, as sparse triples.

    d R = A d x + B d v,   R reactions, x positions, v velocities, each (n, 3) in the order of its rows.

Inside a facet of the bed A is the exact derivative of the step with what it remembers held fixed; over a curved bed the
normal is held too. Friction makes A unsymmetric. B holds the velocity of the suction law.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.friction.directions import senses
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.stages import StepDetail

if TYPE_CHECKING:
    from mudline.contact.lateral import LateralSprings
    from mudline.contact.sliding import Sliding


class Triples(NamedTuple):
    """A sparse matrix (size, size): `values` (k,) at `rows` and `columns` (k,); what stands twice is added."""

    rows: IndexArray
    columns: IndexArray
    values: FloatArray
    size: int

    def dense(self) -> FloatArray:
        """The matrix as an array, for small ones."""
        matrix = np.zeros((self.size, self.size))
        np.add.at(matrix, (self.rows, self.columns), self.values)
        return matrix


class Tangent(NamedTuple):
    """Derivatives of the reactions by positions, and by velocities."""

    by_position: Triples
    by_velocity: Triples


class _Blocks:
    """Collects 3 x 3 blocks d R_a / d x_b."""

    def __init__(self, nodes: int) -> None:
        self._size = 3 * nodes
        self._rows: list[IndexArray] = []
        self._columns: list[IndexArray] = []
        self._values: list[FloatArray] = []

    def add(self, at: IndexArray, by: IndexArray, blocks: FloatArray) -> None:
        """Blocks (k, 3, 3) of the nodes `at` (k,) by the nodes `by` (k,)."""
        axes = np.arange(3)
        shape = blocks.shape
        self._rows.append(np.broadcast_to((3 * at[:, None] + axes)[:, :, None], shape).reshape(-1))
        self._columns.append(np.broadcast_to((3 * by[:, None] + axes)[:, None, :], shape).reshape(-1))
        self._values.append(blocks.reshape(-1))

    def triples(self) -> Triples:
        """All of them."""
        nothing: IndexArray = np.zeros(0, dtype=np.intp)
        return Triples(
            np.concatenate([nothing, *self._rows]),
            np.concatenate([nothing, *self._columns]),
            np.concatenate([np.zeros(0), *self._values]),
            self._size,
        )


class _Line(NamedTuple):
    """What the parts of a tangent share: per node the normal (n, 3), per element its ends (m, 2) and L / 2 (m,)."""

    normal: FloatArray
    ends: IndexArray
    half: FloatArray


def assemble(inputs: ContactInput, points: FloatArray, result: ContactResult, detail: StepDetail) -> Tangent:
    """The tangent of one step at `points` (n, 3), from its result and its details."""
    nodes = len(inputs.node_ids)
    line = _Line(np.asarray(result.normal), inputs.element_nodes, 0.5 * inputs.length)
    stiffness = np.nan_to_num(result.stiffness)
    own = np.zeros(nodes) if detail.nodal is None else detail.nodal[0]
    by_position, by_velocity = _Blocks(nodes), _Blocks(nodes)
    _normal(line, stiffness, own, by_position)
    damping = np.zeros(len(stiffness))
    if detail.suction is not None:
        elements, suction = detail.suction
        damping[elements] = 0.0 - suction.by_velocity
        _normal(line, damping, np.zeros(nodes), by_velocity)
    if detail.lateral is not None:
        _lateral(line, points, detail.lateral, by_position)
    if detail.sliding is not None:
        sliding = detail.sliding
        closed = np.flatnonzero((sliding.force.history.states[:, 0] > 0) & (result.normal_force > 0.0))
        axes = np.stack(sliding.directions, axis=1)
        push = np.einsum("nij,ni->nj", axes, sliding.force.by_compression)
        _by_spring(axes, sliding, closed, by_position)
        _by_turning(line, points, sliding, closed, by_position)
        _by_compression(line, push, closed, (stiffness, own), by_position)
        _by_compression(line, push, closed, (damping, np.zeros(nodes)), by_velocity)
    return Tangent(by_position.triples(), by_velocity.triples())


def _normal(line: _Line, stiffness: FloatArray, own: FloatArray, blocks: _Blocks) -> None:
    """Normal forces along fixed normals: `stiffness` (m,) by depth of the elements, `own` (n,) by that of nodes."""
    used = np.flatnonzero(stiffness)
    share = -0.5 * line.half[used] * stiffness[used]
    for at in line.ends[used].T:
        for by in line.ends[used].T:
            blocks.add(at, by, share[:, None, None] * _outer(line.normal[at], line.normal[by]))
    nodes = np.flatnonzero(own)
    blocks.add(nodes, nodes, -own[nodes, None, None] * _outer(line.normal[nodes], line.normal[nodes]))


def _lateral(line: _Line, points: FloatArray, springs: LateralSprings, blocks: _Blocks) -> None:
    """Lateral springs: along their direction, which turns with the element."""
    ends = line.ends[springs.elements]
    first, second = ends.T
    mean = line.normal[first] + line.normal[second]
    mean = mean / _size(mean)[:, None]
    turn = _turning(points[second] - points[first], mean)  # of n x t by the second end, minus that by the first
    force = -0.5 * springs.stiffness * springs.elongation
    middle = springs.arm
    for by, sign in ((first, -1.0), (second, 1.0)):
        by_place = 0.5 * springs.direction + sign * np.einsum("ki,kij->kj", middle, turn)
        slope = (-0.5 * springs.stiffness)[:, None] * by_place
        block = _outer(springs.direction, slope) + force[:, None, None] * sign * turn
        for at in (first, second):
            blocks.add(at, by, block)


def _turning(span: FloatArray, normal: FloatArray) -> FloatArray:
    """Derivative (k, 3, 3) by the end of `span` (k, 3) of the unit vector n x t, t the projection of the span."""
    flat = span - np.einsum("ki,ki->k", span, normal)[:, None] * normal
    size = _size(flat)
    able = size > 0.0  # an element without direction takes one that does not turn
    along = np.divide(flat, size[:, None], out=np.zeros_like(flat), where=able[:, None])
    # d t = (I - t t - n n) d span / |flat|, and n x (that) = -t (n x t . d span) ... only n x t is left of the plane
    across = np.cross(normal, along)
    return 0.0 - _outer(along, across) / np.where(able, size, 1.0)[:, None, None]


def _by_spring(axes: FloatArray, sliding: Sliding, closed: IndexArray, blocks: _Blocks) -> None:
    """Springs, and limits that follow the offset in a trench, along u1 and u2."""
    along = np.einsum("nij,njk->nik", sliding.force.by_position, axes)
    if sliding.offset_gradient is not None:
        along += sliding.force.by_offset[:, :, None] * sliding.offset_gradient[:, None, :]
    own = np.einsum("nij,nik->njk", axes, along)
    blocks.add(closed, closed, own[closed])


def _by_compression(
    line: _Line, push: FloatArray, closed: IndexArray, stiffness: tuple[FloatArray, FloatArray], blocks: _Blocks
) -> None:
    """The limits follow the normal force: `push` (n, 3) is d friction / d N, `stiffness` that of elements and nodes."""
    elements, own = stiffness
    blocks.add(closed, closed, -own[closed, None, None] * _outer(push[closed], line.normal[closed]))
    held = np.zeros(len(own), np.bool_)
    held[closed] = True
    for at in line.ends.T:
        used = np.flatnonzero((elements != 0.0) & held[at])
        share = -0.5 * line.half[used] * elements[used]
        for by in line.ends[used].T:
            blocks.add(at[used], by, share[:, None, None] * _outer(push[at[used]], line.normal[by]))


def _by_turning(line: _Line, points: FloatArray, sliding: Sliding, closed: IndexArray, blocks: _Blocks) -> None:
    """What changes as u1 and u2 follow the line: the directions of the forces, elongations and offsets.

    A turn by an angle a about the normal makes d u1 = a u2, d u2 = -a u1.
    """
    force, (first, second) = sliding.force, sliding.directions
    by_angle = np.stack([force.elongation[:, 1], 0.0 - force.elongation[:, 0]], axis=1)
    change = np.einsum("nij,nj->ni", force.by_position, by_angle)
    if sliding.to_centreline is not None:
        change += force.by_offset * (0.0 - np.einsum("ni,ni->n", first, sliding.to_centreline))[:, None]
    turned = change[:, 0, None] * first + change[:, 1, None] * second
    turned += force.force[:, 0, None] * second - force.force[:, 1, None] * first
    held = np.zeros(len(points), np.bool_)
    held[closed] = True
    held &= sliding.follows
    start, end = line.ends.T
    span = points[end] - points[start]
    length = _size(span)
    unit = np.divide(span, length[:, None], out=np.zeros_like(span), where=length[:, None] > 0.0)
    total = np.zeros_like(points)
    sense = senses(line.ends, len(points))
    for side, at in enumerate(line.ends.T):
        np.add.at(total, at, unit * sense[:, side, None])
    flat = total - np.einsum("ni,ni->n", total, line.normal)[:, None] * line.normal
    size = _size(flat)
    for side, at in enumerate((start, end)):
        used = np.flatnonzero(held[at] & (length > 0.0) & (size[at] > 0.0))
        node = at[used]
        sideways = second[node] - np.einsum("ni,ni->n", second[node], unit[used])[:, None] * unit[used]
        angle = sideways * (sense[used, side] / (length[used] * size[node]))[:, None]
        block = _outer(turned[node], angle)
        blocks.add(node, end[used], block)
        blocks.add(node, start[used], 0.0 - block)


def _outer(one: FloatArray, other: FloatArray) -> FloatArray:
    product: FloatArray = one[:, :, None] * other[:, None, :]
    return product


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    return size
