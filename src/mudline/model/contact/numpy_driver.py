"""The laws driven by numpy, a batch of steps at a time: elements, then nodes.

Positions are given, so everything without history is computed for a batch of steps at once. Only the states of suction,
stick points and touchdown points go from step to step. Nothing is checked here: `contact.result` refuses results that
are not finite.
"""

from __future__ import annotations

import ctypes
import sys
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.model.contact import vectors
from mudline.model.contact.arrays import BoolArray, FloatArray, Picked, as_range, taken
from mudline.model.contact.laws import law_module
from mudline.model.contact.numpy_elements import ElementLaws, Work
from mudline.model.contact.result import ContactResult
from mudline.model.contact.seabed import FlatSeabed, Seabed
from mudline.model.contact.tables import ContactState, LawTables, StepBatch
from mudline.model.contact.vectors import Components, in_plane

if TYPE_CHECKING:
    from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw
    from mudline.model.contact.laws.trench import TrenchRows
    from mudline.model.contact.trenches import LaidCentreline

BLOCK = 32768
"""Elements or nodes, times steps, of a batch: work arrays of short lines stay in the second-level cache."""
_KEPT = {-3: 2**25, -1: 2**29}
"""Options of `mallopt`: largest kept array (M_MMAP_THRESHOLD), kept memory of the heap (M_TRIM_THRESHOLD)."""


class NumpyDriver:
    """Evaluator of batches of steps. Holds no state of a series; may be shared by threads."""

    def __init__(self, tables: LawTables, seabed: Seabed) -> None:
        _keep_freed_memory()
        self._tables, self._seabed = tables, seabed
        self.steps = max(1, BLOCK // max(len(tables.half), len(tables.given.node_ids), 1))
        """Number of steps at a time that is fastest."""
        flat = isinstance(seabed, FlatSeabed)
        slides = tables.friction is not None or tables.lateral is not None
        self._components = (2 if flat else 3) if slides else 0
        self._elements, self._nodes = ElementLaws(tables), NodeLaws(tables, flat=flat)

    def locate(self, points: FloatArray, part: ContactResult) -> None:
        """Write gaps and normals of `part` (steps, n)."""
        if self._seabed.same_normal is None:
            self._seabed.locate(points, part.gap, part.normal)
        else:
            self._seabed.gaps(points, part.gap)

    def run(self, batch: StepBatch, part: ContactResult, state: ContactState) -> None:
        """Write a batch to `part` except gaps and normals, which are there already; `state` is updated in place."""
        steps, elements = len(batch.points), len(self._tables.half)
        lateral = self._components if self._tables.lateral is not None else 0
        work = Work(
            np.ascontiguousarray(batch.points.transpose(2, 0, 1)) if self._components else np.empty((0, 0, 0)),
            np.zeros((steps, elements + 2)),
            np.zeros((self._components, steps, elements + 2)),
            np.zeros((lateral, steps, elements + 2)),
            np.zeros((steps, elements + 2)) if self._tables.embeds else np.empty((0, 0)),
            None if self._tables.trench is None else self._tables.laid_line(batch.laid),
        )
        self._elements.run(batch, part, state, work)
        self._nodes.run(batch.speed, part, state, work)


def _keep_freed_memory() -> None:
    """Let the GNU C library keep the arrays of a batch for the next batch.

    By default it returns large arrays to the system as soon as they are freed. Touching new memory costs more than the
    computations in it: a fifth of the time of a million nodes.
    """
    set_option = getattr(ctypes.CDLL(None), "mallopt", None) if sys.platform == "linux" else None
    if set_option is not None:
        for option, size in _KEPT.items():
            set_option(option, size)


class _Breakout(NamedTuple):
    """Nodes with a breakout, over the steps of a batch.

    Attributes:
        at: their columns among all nodes.
        law: parameters.
        embedment: their ratios z/D (steps, k), or (steps, 1) equal for all.
        held: (5, k) their history, written in place.
    """

    at: Picked
    law: tuple[FloatArray, ...]
    embedment: FloatArray
    held: FloatArray

    def soften(self, step: int, scaled: tuple[FloatArray, FloatArray], points: FloatArray, across: Components) -> None:
        """Scale the lateral springs and limits (k,) of a step to points (3, k)."""
        from mudline.model.contact.laws.breakout import reached, shares  # noqa: PLC0415 - most friction has no breakout

        at, law, held, axes = self.at, self.law, self.held, len(across)
        away = tuple(points[3 - axes :, at] - held[3 - axes : 3])
        distance = vectors.PLANES[axes].dot(tuple(axis[at] if len(axis) > 1 else axis for axis in across), away)
        held[3], held[4] = reached((held[3], held[4]), distance, self.embedment[step], law)
        share, _, softer = shares(held[3], held[4], law)
        for values, factor in zip(scaled, (softer, share), strict=True):
            values[at] *= factor

    def begin(self, points: FloatArray, on: BoolArray) -> None:
        """Reset the history of nodes that were not in contact."""
        on = on[self.at]
        self.held[:3] = np.where(on, self.held[:3], points[:, self.at])
        self.held[3:] = np.where(on, self.held[3:], 0.0)

    def end(self, held: BoolArray) -> None:
        """Clear the history of nodes that are out of contact."""
        self.held[...] = np.where(held[self.at], self.held, [[np.nan]] * 3 + [[0.0]] * 2)


class NodeLaws:
    """The laws of all nodes, over the steps of a batch."""

    def __init__(self, tables: LawTables, *, flat: bool) -> None:
        self._tables, self._flat = tables, flat
        self._plane = vectors.PLANES[2 if flat else 3]
        self._nodal = [(rows, as_range(rows.rows), rows.law.onset(*rows.columns)) for rows in tables.nodal]
        friction = tables.friction
        if friction is not None:
            self._coefficients = friction.coefficients.T[:, None]
            self._fixed, self._rising = friction.fixed.T[:, None], friction.rising.T[:, None]
            self._idle = friction.active.astype(np.int8) - np.int8(1)
        if tables.trench is not None:
            self._in_trench = as_range(tables.trench.nodes)

    def run(self, speed: FloatArray | None, part: ContactResult, state: ContactState, work: Work) -> None:
        """Write the nodes of a batch."""
        tables, reaction = self._tables, part.reaction
        total = tables.line.sums(work.load)
        for rows, at, onset in self._nodal:
            z = 0.0 - taken(part.gap, at)
            force = np.where(z > onset, rows.law.reaction(z, 0.0, *rows.columns)[0], 0.0)
            total[:, at] = taken(total, at) + force
        if tables.nodal_damping is not None and speed is not None:
            total += law_module("linear").damping_force(0.0 - part.gap, speed, tables.nodal_damping)
        part.normal_force[...] = total
        if part.normal.strides[1] == 0:  # all nodes share a normal
            normal = tuple(part.normal[:1, :1, axis] for axis in range(3))
        else:
            normal = tuple(np.ascontiguousarray(part.normal[..., axis]) for axis in range(3))
        if not len(work.tangent):
            if self._flat:
                reaction[..., 1:] = 0.0
            for axis in range(1 if self._flat else 3):
                # a negative force times a zero component is -0, which is no reaction of its own
                np.add(total * normal[axis], 0.0, out=reaction[..., axis])
            return
        direction = self._sums(work.tangent, directed=True)
        along = self._turned_axes(in_plane(direction, normal), normal)
        sideward = self._tangential_reaction(part, state, work, along, self._plane.across(along, normal))
        for axis, component in enumerate(self._plane.reaction(total, normal, sideward)):
            reaction[..., axis] = component

    def _sums(self, values: FloatArray, *, directed: bool) -> Components:
        """Return sums (steps, k) of each component (c, steps, m + 2) of vectors of the elements."""
        sums = self._tables.line.sums(values.reshape(-1, values.shape[2]), directed=directed)
        return tuple(sums.reshape(*values.shape[:2], sums.shape[1]))

    def _turned_axes(self, along: Components, normal: Components) -> Components:
        """Set u1 of nodes with an angle to +Y."""
        law = self._tables.friction
        if law is None or not law.turned.size:
            return along
        there = normal if normal[0].shape[1] == 1 else tuple(axis[:, law.turned] for axis in normal)
        for axis, values in zip(along, self._plane.turned(law.cosine, law.sine, there), strict=True):
            axis[:, law.turned] = values
        return along

    def _tangential_reaction(
        self, part: ContactResult, state: ContactState, work: Work, along: Components, across: Components
    ) -> Components:
        """Return components of the tangential reaction: friction and lateral springs."""
        force: Components = tuple(np.zeros(along[0].shape) for _ in along)
        axial = sideways = np.zeros(along[0].shape)
        if state.friction is not None:
            axial, sideways = self._friction_forces(part, state, work, along, across)
            force = self._plane.blend(along, across, axial, sideways)
        if len(work.lateral):
            push = self._sums(work.lateral, directed=False)
            force = self._plane.added(force, push)
            axial, sideways = axial + self._plane.dot(along, push), sideways + self._plane.dot(across, push)
        if part.friction is not None:
            part.friction[..., 0], part.friction[..., 1] = axial, sideways
        return force

    def _friction_forces(
        self, part: ContactResult, state: ContactState, work: Work, along: Components, across: Components
    ) -> tuple[FloatArray, FloatArray]:
        """Return friction along u1 and u2 (steps, k); update the stick points from step to step."""
        history, law = cast("FrictionHistory", state.friction), cast("FrictionLaw", self._tables.friction)
        plane, places, first = self._plane, work.planes, 3 - len(along)
        pressing = np.where(law.active, np.fmax(part.normal_force, 0.0), 0.0)
        closed = pressing > 0.0
        springs, limits = self._fixed + self._rising * pressing, self._coefficients * pressing
        walls = None if work.laid is None else self._walls(places, across, pressing, work.laid)
        stick = history.stick_points.T
        held = history.states[:, 0] > 0
        softening = self._softening(state, work)
        forces, slips = np.empty(limits.shape), np.empty(limits.shape, np.bool_)
        elongation = np.empty((2, len(held)))
        for step, close in enumerate(closed):
            on, held = held & close, close
            (new,) = np.logical_not(on).nonzero()
            for point, place in zip(stick, places[:, step], strict=True):
                point[new] = place.take(new)
            u, v = tuple(axis[step] for axis in along), tuple(axis[step] for axis in across)
            away = places[first:, step] - stick[first:]
            elongation[0], elongation[1] = plane.dot(u, away), plane.dot(v, away)
            spring, limit = springs[:, step], limits[:, step]
            if softening is not None:
                softening.begin(places[:, step], on)
                softening.soften(step, (spring[1], limit[1]), places[:, step], v)
            trial = spring * elongation
            if walls is not None:
                limit[1] += self._added(trial[1], *(values[step] for values in walls))
            force, slip = self._bounded(trial, limit, law.ellipse & close)
            moved = plane.blend(u, v, *law_module("friction").slip_distance(slip, elongation, force, spring))
            for point, way in zip(stick[first:], moved, strict=True):
                np.add(point, way, out=point)
            np.subtract(0.0, force, out=forces[:, step])
            slips[:, step] = slip
        (free,) = np.logical_not(held).nonzero()
        for point in stick:
            point[free] = np.nan
        if softening is not None:
            softening.end(held)
        states = (slips.view(np.int8) + np.int8(1)) * closed.view(np.int8)
        states += self._idle
        history.states[...] = states[:, -1].T
        if part.friction_state is not None:
            part.friction_state[...] = states.transpose(1, 2, 0)
        return forces[0], forces[1]

    def _bounded(self, trial: FloatArray, limit: FloatArray, elliptic: BoolArray) -> tuple[FloatArray, BoolArray]:
        """Return forces (2, k) in the springs and whether they slip."""
        law = law_module("friction")
        force, slip = law.in_box(trial, limit)
        (curved,) = elliptic.nonzero()
        if curved.size:
            trials, limits = trial.take(curved, axis=1), limit.take(curved, axis=1)
            force[0][curved], force[1][curved], slip[0][curved], slip[1][curved] = law.in_ellipse(*trials, *limits)
        return force, slip

    def _softening(self, state: ContactState, work: Work) -> _Breakout | None:
        breakout, tables = self._tables.breakout, self._tables
        if breakout is None or state.breakout is None:
            return None
        at, deep = as_range(breakout.rows), np.zeros((len(work.load), 1))
        if tables.embeds:
            deep = taken(tables.line.sums(work.ratio), at) * tables.shares
        return _Breakout(at, breakout.columns, deep, state.breakout)

    def _walls(
        self, places: FloatArray, across: Components, pressing: FloatArray, laid: LaidCentreline
    ) -> tuple[FloatArray, BoolArray, BoolArray]:
        """Return the resistance of trenches (steps, k), and whether it acts against motion along +u2, or along -u2."""
        at, trench = self._in_trench, cast("TrenchRows", self._tables.trench)
        away = laid.away(laid.beside(trench), np.ascontiguousarray(places[..., at])).vector
        lateral = tuple(taken(axis, at) for axis in across)
        offset = self._plane.dot(lateral, away[3 - len(lateral) :])
        return law_module("trench").resistance(trench, offset, taken(pressing, at)), offset > 0.0, offset < 0.0

    def _added(self, trial: FloatArray, added: FloatArray, forward: BoolArray, back: BoolArray) -> FloatArray:
        """Return the resistance of trenches at nodes (k,) with these trial forces."""
        share = np.where(np.where((trial > 0.0)[self._in_trench], forward, back), added, 0.0)
        nodes = cast("TrenchRows", self._tables.trench).nodes
        return np.asarray(np.bincount(nodes, share, len(trial)), np.float64)
