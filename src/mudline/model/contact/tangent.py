"""The tangent of the nodal reactions: one row and column for each of the 3 n coordinates, as sparse triples.

    d R = A d x + B d v,   R reactions, x positions, v velocities, each (n, 3) row by row.

Inside a facet of the seabed A is the exact derivative of the step, with the history held fixed; over a curved seabed
the normal is held too. Friction makes A unsymmetric. B is the derivative by velocity of suction and damping.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.directions import Directions, directions_of, level, projected
from mudline.model.contact.laws import Moving, PathLaw, law_module
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import ContactState, LawTables

if TYPE_CHECKING:
    from mudline.model.contact.laws.friction import ExtraLimit, FrictionLaw


class Triples(NamedTuple):
    """A sparse matrix (size, size): `values` (k,) at `rows` and `columns` (k,); duplicate entries are added."""

    rows: IndexArray
    columns: IndexArray
    values: FloatArray
    size: int

    def __repr__(self) -> str:
        return short_repr(self)

    def dense(self) -> FloatArray:
        """Return the matrix as a dense array; for small matrices."""
        matrix = np.zeros((self.size, self.size))
        np.add.at(matrix, (self.rows, self.columns), self.values)
        return matrix


class Tangent(NamedTuple):
    """Derivatives of the reactions by positions and by velocities."""

    by_position: Triples
    by_velocity: Triples

    def __repr__(self) -> str:
        return short_repr(self)


class _BlockSum:
    """Collector of 3 x 3 blocks d R_a / d x_b."""

    def __init__(self, nodes: int) -> None:
        self._size = 3 * nodes
        self._rows: list[IndexArray] = []
        self._columns: list[IndexArray] = []
        self._values: list[FloatArray] = []

    def add(self, at: IndexArray, by: IndexArray, blocks: FloatArray) -> None:
        """Add the derivatives (k, 3, 3) of the reactions of nodes `at` (k,) by the positions of nodes `by` (k,)."""
        axes = np.arange(3)
        shape = blocks.shape
        self._rows.append(np.broadcast_to((3 * at[:, None] + axes)[:, :, None], shape).reshape(-1))
        self._columns.append(np.broadcast_to((3 * by[:, None] + axes)[:, None, :], shape).reshape(-1))
        self._values.append(blocks.reshape(-1))

    def triples(self) -> Triples:
        """Return all blocks as triples."""
        nothing: IndexArray = np.zeros(0, dtype=np.intp)
        return Triples(
            np.concatenate([nothing, *self._rows]),
            np.concatenate([nothing, *self._columns]),
            np.concatenate([np.zeros(0), *self._values]),
            self._size,
        )


Heights = tuple[FloatArray, FloatArray]
"""Derivatives of normal forces by the heights of elements (m,) and of nodes (n,)."""


class _Step(NamedTuple):
    """Common data of the parts of a tangent.

    Attributes:
        points, normal: (n, 3).
        slope: (n, 3) gradient of the height above the seabed, `normal` outside of trenches.
        ends: (m, 2) nodes of the elements.
        half: (m,) half lengths.
        before, after: states before and after the step.
    """

    tables: LawTables
    points: FloatArray
    normal: FloatArray
    slope: FloatArray
    ends: IndexArray
    half: FloatArray
    result: ContactResult
    before: ContactState
    after: ContactState


def assemble(
    tables: LawTables,
    points: FloatArray,
    speed: FloatArray | None,
    result: ContactResult,
    states: tuple[ContactState, ContactState],
    *,
    back: bool = False,
) -> Tangent:
    """Return the tangent of one step at `points` (n, 3) with velocities (n,) along the normals.

    `states` are those before and after the step, `result` is its result. `back`: elements on a path reverse.
    """
    nodes = len(points)
    normal = np.asarray(result.normal)
    slope, laid = normal, points if states[0].laid is None else states[0].laid
    if tables.level is not None:
        slope = normal + level(tables, points, laid, normal).gradient
    step = _Step(tables, points, normal, slope, tables.given.element_nodes, tables.half, result, *states)
    stiffness, own = np.nan_to_num(_turned_round(step) if back else result.stiffness), _nodal_stiffness(step)
    by_position, by_velocity = _BlockSum(nodes), _BlockSum(nodes)
    _add_normal(step, (stiffness, own), step.slope, by_position)
    damping, own_damping = np.zeros(len(stiffness)), np.zeros(nodes)
    if speed is not None:
        damping, own_damping = _damping(step, speed)
        _add_normal(step, (damping, own_damping), normal, by_velocity)
    if tables.lateral is not None:
        _add_lateral(step, by_position)
    if tables.friction is not None:
        _add_friction(step, (stiffness, own), (damping, own_damping), by_position, by_velocity)
    return Tangent(by_position.triples(), by_velocity.triples())


def _turned_round(step: _Step) -> FloatArray:
    """Return the stiffness (m,) of an increment opposite to the last, for elements whose force follows a path."""
    stiffness, paths = step.result.stiffness.copy(), step.after.paths
    for rows in step.tables.normal:
        if paths is not None and isinstance(rows.law, PathLaw):
            held = paths[rows.path : rows.path + len(rows.rows)]
            turned = rows.law.turned_round(held, step.tables.diameter[rows.rows], rows.columns)
            stiffness[rows.rows] = np.where(step.result.contact[rows.rows], turned, stiffness[rows.rows])
    return stiffness


def _nodal_stiffness(step: _Step) -> FloatArray:
    """Return the stiffness (n,) of the springs of nodes."""
    stiffness = np.zeros(len(step.points))
    for rows in step.tables.nodal:
        z = 0.0 - step.result.gap[rows.rows]
        slope = rows.law.reaction(z, 0.0, *rows.columns)[1]
        stiffness[rows.rows] = np.where(z > rows.law.onset(*rows.columns), slope, 0.0)
    return stiffness


def _damping(step: _Step, speed: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return minus d force / d pull-out velocity of elements (m,) and of nodes (n,)."""
    tables, depth = step.tables, step.result.depth
    uplift = (0.0 if tables.onset is None else tables.onset) - depth
    if tables.unloading is not None and step.after.unloading is not None:
        uplift[tables.unloading.rows] = step.after.unloading.bottom - depth[tables.unloading.rows]
    ends, states = step.ends, (step.before.suction, step.after.suction)
    of_elements = depth, 0.5 * speed[ends[:, 0]] + 0.5 * speed[ends[:, 1]], uplift
    of_nodes = 0.0 - step.result.gap, speed, step.result.gap
    damping, own = np.zeros(len(depth)), np.zeros(len(speed))
    for assigned in tables.given.assigned.values():
        if assigned.law.damping is not None:
            target, values = (own, of_nodes) if assigned.law.acts_on == "nodes" else (damping, of_elements)
            z, v, height = (value[assigned.rows] for value in values)
            target[assigned.rows] += assigned.law.damping(Moving(z, v, height, *states), assigned.parameters)
    return damping, own


def _add_normal(step: _Step, by_height: Heights, slope: FloatArray, blocks: _BlockSum) -> None:
    """Add normal forces along fixed normals, from derivatives by the heights of elements (m,) and of nodes (n,)."""
    stiffness, own = by_height
    used = np.flatnonzero(stiffness)
    share = -0.5 * step.half[used] * stiffness[used]
    for at in step.ends[used].T:
        for by in step.ends[used].T:
            blocks.add(at, by, share[:, None, None] * _outer(step.normal[at], slope[by]))
    nodes = np.flatnonzero(own)
    blocks.add(nodes, nodes, -own[nodes, None, None] * _outer(step.normal[nodes], slope[nodes]))


def _add_lateral(step: _Step, blocks: _BlockSum) -> None:
    """Add lateral springs along their direction, which turns with the element."""
    lateral, before, after = step.tables.lateral, step.before.touchdown, step.after.touchdown
    if lateral is None or before is None or after is None:
        return
    rows = np.flatnonzero(step.result.contact[lateral.rows])
    new = np.isnan(before[rows, 0])
    stiffness = np.where(new, 0.0, lateral.columns[0][rows])  # at touchdown there is no force yet
    first, second = step.ends[lateral.rows[rows]].T
    mean = step.normal[first] + step.normal[second]
    mean = mean / _size(mean)[:, None]
    span = step.points[second] - step.points[first]
    across = np.cross(mean, projected(_unit(span)[0], mean))
    arm = 0.5 * step.points[first] + 0.5 * step.points[second] - after[rows]
    blocks_by = law_module("linear").lateral_tangent(stiffness, across, arm, _turning(span, mean))
    for by, block in zip((first, second), blocks_by, strict=True):
        for at in (first, second):
            blocks.add(at, by, block)


def _turning(span: FloatArray, normal: FloatArray) -> FloatArray:
    """Return the derivative (k, 3, 3) by `span` (k, 3) of the unit vector n x t, t the projected span."""
    flat = span - np.einsum("ki,ki->k", span, normal)[:, None] * normal
    along, size = _unit(flat)
    # an element without direction has the default direction, which does not turn
    # d t = (I - t t - n n) d span / |flat|, whose part along n x t alone gives n x d t = -t (n x t . d span) / |flat|
    across = np.cross(normal, along)
    return 0.0 - _outer(along, across) / np.where(size > 0.0, size, 1.0)[:, None, None]


def _add_friction(
    step: _Step, by_height: Heights, damping: Heights, by_position: _BlockSum, by_velocity: _BlockSum
) -> None:
    """Add friction, which depends on the normal forces; these have derivatives by the heights of elements and nodes."""
    from mudline.model.contact.laws.friction import slide  # noqa: PLC0415 - only now is it needed

    tables, law, history = step.tables, step.tables.friction, step.before.friction
    if law is None or history is None:
        raise TypeError("the state has no friction: it belongs to another model")
    absent = np.isnan(step.result.gap)
    places = np.where(absent[:, None], 0.0, step.points)
    compression = np.where(absent, 0.0, step.result.normal_force)
    directions = directions_of(tables, step.points, step.normal)
    friction, extra = slide(law, history, places, directions.axes, compression), None
    if tables.trench is not None:
        from mudline.model.contact.trenches import added_limit  # noqa: PLC0415 - most friction has no trench

        laid = tables.laid_line(step.points if step.before.laid is None else step.before.laid)
        pressed, forward = np.maximum(compression, 0.0), friction.elongation[:, 1] > 0.0
        extra = added_limit(tables.trench, laid, places, directions.axes, pressed, forward)
    if tables.breakout is not None:
        law, extra = _breaking_out(step, law, directions, places, compression, extra)
        extra.outward[tables.breakout.rows] = np.sign(friction.elongation[tables.breakout.rows, 1])
    if extra is not None:
        friction = slide(law, history, places, directions.axes, compression, extra)
    by_place, push, turned = friction.tangent(directions.axes, extra)
    closed = np.flatnonzero((step.result.friction_state_of(0) > 0) & (step.result.normal_force > 0.0))
    by_position.add(closed, closed, by_place[closed])
    _add_turning(step, directions, turned, closed, by_position)
    _add_compression(step, push, closed, by_height, step.slope, by_position)
    _add_compression(step, push, closed, damping, step.normal, by_velocity)


def _breaking_out(
    step: _Step,
    law: FrictionLaw,
    directions: Directions,
    places: FloatArray,
    compression: FloatArray,
    extra: ExtraLimit | None,
) -> tuple[FrictionLaw, ExtraLimit]:
    """Return the law with softened springs, and the breakout as a negative extra limit; embedments are held."""
    from mudline.model.contact.laws.friction import ExtraLimit  # noqa: PLC0415 - only now is it needed

    rows = step.tables.breakout
    if rows is None or step.before.breakout is None or step.after.breakout is None:
        raise TypeError("the state has no breakout: it belongs to another model")
    nodes, (first, second) = rows.rows, (axis[rows.rows] for axis in directions.axes)
    extra = extra or ExtraLimit.none(len(places))
    away = places[nodes] - step.after.breakout[:3].T
    coefficient = law.coefficients[nodes, 1]
    pressed = coefficient * np.maximum(compression[nodes], 0.0)
    so_far, (far, deep) = step.before.breakout[3], step.after.breakout[3:]
    share, by_distance, softer = law_module("breakout").tangent(
        so_far, (far, deep), (away * second).sum(axis=1), pressed, rows.columns
    )
    extra.force[nodes], extra.by_normal_force[nodes] = pressed * (share - 1.0), coefficient * (share - 1.0)
    extra.by_offset[nodes], extra.gradient[nodes] = by_distance, second
    extra.by_angle[nodes] = -(away * first).sum(axis=1)
    mobilisation = law.mobilisation.copy()
    mobilisation[nodes, 1] /= softer
    return replace(law, mobilisation=mobilisation), extra


def _add_compression(
    step: _Step,
    push: FloatArray,
    closed: IndexArray,
    by_height: Heights,
    slope: FloatArray,
    blocks: _BlockSum,
) -> None:
    """Add the dependence of the limits on the normal force: `push` (n, 3) is d friction / d N."""
    elements, own = by_height
    blocks.add(closed, closed, -own[closed, None, None] * _outer(push[closed], slope[closed]))
    held = _marked(closed, len(own))
    for at in step.ends.T:
        used = np.flatnonzero((elements != 0.0) & held[at])
        share = -0.5 * step.half[used] * elements[used]
        for by in step.ends[used].T:
            blocks.add(at[used], by, share[:, None, None] * _outer(push[at[used]], slope[by]))


def _add_turning(
    step: _Step, directions: Directions, turned: FloatArray, closed: IndexArray, blocks: _BlockSum
) -> None:
    """Add the turning of u1 and u2 with the line; `turned` (n, 3) is d friction by a turn about the normal."""
    held = _marked(closed, len(step.points)) & directions.follows
    second, (start, end) = directions.axes[1], step.ends.T
    span = step.points[end] - step.points[start]
    unit, length = _unit(span)
    for side, at in enumerate((start, end)):
        used = np.flatnonzero(held[at] & (length > 0.0) & (directions.size[at] > 0.0))
        node = at[used]
        sideways = second[node] - np.einsum("ni,ni->n", second[node], unit[used])[:, None] * unit[used]
        angle = sideways * (directions.senses[used, side] / (length[used] * directions.size[node]))[:, None]
        block = _outer(turned[node], angle)
        blocks.add(node, end[used], block)
        blocks.add(node, start[used], 0.0 - block)


def _marked(rows: IndexArray, count: int) -> BoolArray:
    marked = np.zeros(count, np.bool_)
    marked[rows] = True
    return marked


def _outer(a: FloatArray, b: FloatArray) -> FloatArray:
    return a[:, :, None] * b[:, None, :]


def _size(vectors: FloatArray) -> FloatArray:
    size: FloatArray = np.sqrt(np.einsum("ij,ij->i", vectors, vectors))
    return size


def _unit(vectors: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return unit vectors, 0 for vectors without length, and the lengths (k,)."""
    size = _size(vectors)
    return np.divide(vectors, size[:, None], out=np.zeros_like(vectors), where=size[:, None] > 0.0), size
