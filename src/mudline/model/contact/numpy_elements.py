"""The laws of elements driven by numpy: depth, normal laws, unloading, suction, directions, lateral springs."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.model.contact import vectors
from mudline.model.contact.arrays import (
    BoolArray,
    FloatArray,
    IndexArray,
    Picked,
    StateArray,
    as_range,
    taken,
)
from mudline.model.contact.directions import mean_normal
from mudline.model.contact.input import AssignedLaw
from mudline.model.contact.laws import PathLaw, law_module
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import ContactState, LawTables, NormalRows, arrays_of
from mudline.model.contact.vectors import in_plane, units

if TYPE_CHECKING:
    from mudline.model.contact.laws.suction import SuctionHistory
    from mudline.model.contact.laws.unloading import UnloadingHistory
    from mudline.model.contact.tables import StepBatch
    from mudline.model.contact.trenches import LaidCentreline

Values = tuple[FloatArray, FloatArray, FloatArray]
"""Force, slope and stiffness (steps, k)."""


class Work(NamedTuple):
    """Values of elements for the nodes (steps, m + 2), between two columns of zeros.

    Attributes:
        planes: (3, steps, n) coordinates; empty if nothing moves sideways.
        load: half of the force of each element.
        tangent: (c, steps, m + 2) components of the unit direction of each element; over a horizontal seabed only those
            in its plane.
        lateral: components of the lateral force of each element on each of its nodes.
        ratio: z/D of each element; empty if no node needs it.
        laid: the line as it was laid; None without trenches.
    """

    planes: FloatArray
    load: FloatArray
    tangent: FloatArray
    lateral: FloatArray
    ratio: FloatArray
    laid: LaidCentreline | None


class _Subset(NamedTuple):
    """Elements with a law next to their normal law: columns among all elements, parameters and diameters (k,)."""

    at: Picked
    elements: IndexArray
    columns: tuple[FloatArray, ...]
    diameter: FloatArray
    onset: FloatArray | float


_Trench = tuple[FloatArray, BoolArray]
"""Uplift of elements with an unloading law from their trench bottom, and whether they are below it."""
_INNER = slice(1, -1)
"""Columns of `Work` with values."""


class ElementLaws:
    """The laws of all elements, over the steps of a batch."""

    def __init__(self, tables: LawTables) -> None:
        self._tables = tables
        self._unsized = np.flatnonzero(np.isnan(tables.diameter))
        self._onset: FloatArray | float = 0.0 if tables.onset is None else tables.onset
        self._normal = [(rows, as_range(rows.rows), tables.diameter[rows.rows]) for rows in tables.normal]
        self._unloading, self._springs = self._subset(tables.unloading), self._subset(tables.springs)
        self._suction, self._lateral = self._subset(tables.suction), self._subset(tables.lateral)
        if self._suction is not None:
            from mudline.model.contact.laws.suction import SuctionLaw  # noqa: PLC0415 - only now is it needed

            self._law = SuctionLaw(*self._suction.columns)
            self._least, self._counts = self._law.least_depth, bool(self._law.counts_cycles.any())
        self._in_trench: tuple[IndexArray, IndexArray] | None = None
        if self._suction is not None and self._unloading is not None:
            both = self._suction.elements, self._unloading.elements
            _, of_suction, of_unloading = np.intersect1d(*both, assume_unique=True, return_indices=True)
            self._in_trench = of_suction, of_unloading

    def _subset(self, assigned: AssignedLaw | None) -> _Subset | None:
        if assigned is None:
            return None
        rows = assigned.rows
        onset = self._onset[rows] if isinstance(self._onset, np.ndarray) else self._onset
        return _Subset(as_range(rows), rows, assigned.columns, self._tables.diameter[rows], onset)

    def run(self, batch: StepBatch, part: ContactResult, state: ContactState, work: Work) -> None:
        """Write the elements of a batch, and their values for the nodes."""
        depth, contact = self._write_depths(part)
        values = part.force, part.slope, part.stiffness
        trench = None
        if self._unloading is not None and state.unloading is not None:
            trench = self._apply_unloading(self._unloading, depth, values, part, state.unloading, state.paths)
        else:
            self._apply_normal_laws(depth, contact, values, part, state.paths)
        if self._unsized.size:
            part.slope[:, self._unsized] = np.nan
        if self._springs is not None:
            self._apply_springs(self._springs, depth, values)
        if self._tables.damping is not None and batch.speed is not None:
            v = self._of_elements(batch.speed)
            part.force[...] += law_module("linear").damping_force(depth, v, self._tables.damping)
        if self._suction is not None and batch.speed is not None and state.suction is not None:
            self._apply_suction(self._suction, batch.speed, (depth, contact, trench), values, part, state.suction)
        np.multiply(part.force, self._tables.half, out=work.load[:, _INNER])
        if len(work.ratio):
            work.ratio[:, _INNER] = part.ratio
        if not len(work.tangent):
            return
        along = self._write_directions(work)
        if self._lateral is not None and state.touchdown is not None:
            self._apply_lateral(self._lateral, along, contact, part, state.touchdown, work)

    def _of_elements(self, values: FloatArray) -> FloatArray:
        """Return the means (steps, m) of values (steps, n) at both ends; halves first: their sum cannot overflow."""
        first, second = self._tables.line.at(values)
        mean: FloatArray = 0.5 * first
        mean += 0.5 * second
        return mean

    def _write_depths(self, part: ContactResult) -> tuple[FloatArray, BoolArray]:
        """Write depth, ratio and contact from the gaps of the nodes; NaN where there is no seabed."""
        depth, contact = part.depth, part.contact
        np.subtract(0.0, self._of_elements(part.gap), out=depth)
        np.divide(depth, self._tables.diameter, out=part.ratio)
        np.greater(depth, self._onset, out=contact)
        return depth, contact

    def _apply_normal_laws(
        self, depth: FloatArray, touches: BoolArray, values: Values, part: ContactResult, paths: FloatArray | None
    ) -> None:
        """Write the values of the normal laws at a depth, 0 where an element does not touch."""
        if sum(len(rows.rows) for rows, _, _ in self._normal) < depth.shape[1]:
            for target in values:
                target[...] = 0.0
        for rows, at, diameter in self._normal:
            own, on = self._reaction(rows, taken(depth, at), diameter, paths), taken(touches, at)
            if self._tables.cuts and rows.curve is not None:
                pulls = on & (own[0] < 0.0)
                part.cut[:, at], on = pulls, on & ~pulls
            np.copyto(own, 0.0, where=~on)
            for target, value in zip(values, own, strict=True):
                target[:, at] = value

    def _reaction(self, rows: NormalRows, z: FloatArray, diameter: FloatArray, paths: FloatArray | None) -> FloatArray:
        """Return force, slope and stiffness (3, steps, k) of the elements with one normal law."""
        force, slope, stiffness = values = np.empty((3, *z.shape))
        if paths is not None and isinstance(rows.law, PathLaw):
            memory = paths[rows.path : rows.path + len(rows.rows)]
            rows.law.follow(z, memory, diameter, rows.columns, (force, stiffness))
            np.multiply(stiffness, diameter, out=slope)
        else:
            rows.write_reaction(z, diameter, values)
        return values

    def _apply_unloading(
        self,
        some: _Subset,
        depth: FloatArray,
        values: Values,
        part: ContactResult,
        history: UnloadingHistory,
        paths: FloatArray | None,
    ) -> _Trench:
        """Write the virgin path at new largest penetrations, and the unloading line elsewhere."""
        law = law_module("unloading")
        z = np.fmax(taken(depth, some.at), 0.0)
        so_far = np.concatenate([history.z_max[None], z])
        for before, now in itertools.pairwise(so_far):  # np.maximum.accumulate is slow for few steps
            np.maximum(before, now, out=now)
        fresh, deepest = so_far[1:] > so_far[:-1], so_far[1:]
        reached = depth.copy()
        reached[:, some.at] = deepest
        self._apply_normal_laws(reached, reached > self._onset, values, part, paths)
        force, slope, stiffness = (taken(each, some.at) for each in values)
        force_max, steepest = np.maximum(force, 0.0), some.columns[0]
        if self._tables.steepens:
            steepest = np.maximum(steepest, taken(self._steepest(reached), some.at))
        line = law.line_stiffness(steepest, deepest, force_max)
        never = deepest == 0.0
        if never.any():  # a smoothed law has a force at the mudline, its line has none
            force_max[never] = 0.0
            np.copyto(line, some.columns[0], where=never)
        bottom = law.trench_bottom(line, deepest, force_max)
        back, rise = law.on_line(z, deepest, force_max, line, bottom)
        if part.cut.flags.writeable:
            part.cut[:, some.at] &= fresh
        values[0][:, some.at] = np.where(fresh, force, back)
        values[1][:, some.at] = np.where(fresh, slope, rise * some.diameter)
        values[2][:, some.at] = np.where(fresh, stiffness, rise)
        for kept, moved in zip(arrays_of(history), (deepest, force_max, line, bottom), strict=True):
            kept[...] = moved[-1]
        return bottom - taken(depth, some.at), z > bottom

    def _steepest(self, z: FloatArray) -> FloatArray:
        """Return the steepest slopes of the normal laws between the mudline and penetrations (steps, m)."""
        slopes = np.zeros(z.shape)
        for rows, at, diameter in self._normal:
            slopes[:, at] = rows.steepest(taken(z, at), diameter)
        return slopes

    def _apply_springs(self, some: _Subset, depth: FloatArray, values: Values) -> None:
        """Add springs against uplift."""
        force, stiffness = law_module("linear").spring_suction(some.onset - taken(depth, some.at), *some.columns)
        for target, more in zip(values, (force, stiffness * some.diameter, stiffness), strict=True):
            target[:, some.at] = taken(target, some.at) + more

    def _apply_suction(
        self,
        some: _Subset,
        speed: FloatArray,
        where: tuple[FloatArray, BoolArray, _Trench | None],
        values: Values,
        part: ContactResult,
        history: SuctionHistory,
    ) -> None:
        """Add suction with a history."""
        depth, contact, trench = where
        uplift, pressed = some.onset - taken(depth, some.at), taken(contact, some.at)
        if trench is not None and self._in_trench is not None:
            here, there = self._in_trench
            pressed = pressed.copy()
            uplift[:, here], pressed[:, here] = trench[0][:, there], trench[1][:, there]
        v = taken(self._of_elements(speed), some.at)
        states, reach, factor = self._suction_states((uplift, v, pressed), history)
        if part.state is not None:
            part.state[:, some.at] = states
        pulls = states == law_module("suction").SUCTION
        (held,) = pulls.any(axis=0).nonzero()
        if not held.size:
            return
        law, at = type(self._law)(*(column[held] for column in self._law)), some.elements[held]
        pulls, uplift, v, reach, factor = (each.take(held, axis=1) for each in (pulls, uplift, v, reach, factor))
        shape = law.force_factor * factor, law.force_exponent, law.regularisation, law.first_corner, law.second_corner
        force, stiffness = law_module("suction").suction_force(uplift, v, reach, shape)
        for target, more in zip(values, (force, stiffness * some.diameter[held], stiffness), strict=True):
            before = target.take(at, axis=1)
            target[:, at] = np.where(pulls, before + more, before)
        if part.regularised is not None:
            part.regularised[:, at] = pulls & (v < law.regularisation) & (law.force_exponent < 2.0)

    def _suction_states(
        self, motion: tuple[FloatArray, FloatArray, BoolArray], history: SuctionHistory
    ) -> tuple[StateArray, FloatArray, FloatArray]:
        """Return states, uplifts at breakout and cyclic factors (steps, k) by uplift, velocity and compression."""
        suction, law = law_module("suction"), self._law
        states, reaches, factors = (np.empty(motion[0].shape, kind) for kind in (np.int8, np.float64, np.float64))
        armed, state, v_max, factor, depth = arrays_of(history)
        for step, (uplift, v, pressed) in enumerate(zip(*motion, strict=True)):
            loose = (armed | (state == suction.BROKEN)) & ~pressed & (uplift > -np.inf)  # False for NaN
            largest, reach = np.where(armed, np.maximum(v_max, v), v_max), depth.copy()
            (grown,) = (loose & (largest > v_max)).nonzero()
            reach[grown] = suction.breakout_uplift(
                largest[grown], law.depth_factor[grown], law.depth_exponent[grown], law.regularisation[grown]
            )
            holds, largest, after = suction.next_state(armed, largest, state, reach, uplift, v)
            factors[step] = factor
            if self._counts:
                completed = armed & np.where(pressed, v_max > 0.0, loose & (after == suction.BROKEN))
                cycled = suction.after_cycle(factor, law.factor_per_cycle, np.nan_to_num(law.cyclic_floor))
                factor = np.where(completed, cycled, factor)
            armed, v_max = pressed | (loose & holds), np.where(loose, largest, 0.0)
            states[step] = state = np.where(loose, after, pressed)
            reaches[step] = depth = np.where(loose & (after > 0), reach, self._least)
        for kept, moved in zip(arrays_of(history), (armed, state, v_max, factor, depth), strict=True):
            kept[...] = moved
        return states, reaches, factors

    def _ends(self, work: Work) -> tuple[FloatArray, FloatArray]:
        """Return coordinates (3, steps, m) of both ends of the elements."""
        first, second = self._tables.line.at(work.planes.reshape(-1, work.planes.shape[2]))
        shape = *work.planes.shape[:2], first.shape[1]
        return first.reshape(shape), second.reshape(shape)

    def _write_directions(self, work: Work) -> FloatArray:
        """Write the unit directions of the elements; return the components that `work` has."""
        first, second = self._ends(work)
        directions = units(second - first)[3 - len(work.tangent) :]
        work.tangent[..., _INNER] = directions
        return directions

    def _apply_lateral(
        self,
        some: _Subset,
        along: FloatArray,
        contact: BoolArray,
        part: ContactResult,
        touchdown: FloatArray,
        work: Work,
    ) -> None:
        """Write the forces of lateral springs; update their touchdown points from step to step."""
        plane = vectors.PLANES[len(along)]
        normal = mean_normal(self._tables, some.elements, part.normal)
        across = plane.across(in_plane(tuple(taken(axis, some.at) for axis in along), normal), normal)
        touches = taken(contact, some.at)
        start, end = self._ends(work)
        middle = 0.5 * start[..., some.at] + 0.5 * end[..., some.at]
        held, kept = np.empty(middle.shape), touchdown.T
        down = ~np.isnan(kept[0])
        for step, touch in enumerate(touches):
            new, down = touch & ~down, touch
            held[:, step] = kept = np.where(new, middle[:, step], kept)
        touchdown[...] = np.where(down, kept, np.nan).T
        first = 3 - len(along)
        force = law_module("linear").lateral_force(some.columns[0], plane.dot(across, middle[first:] - held[first:]))
        force = np.where(touches, force, 0.0)
        for target, axis in zip(work.lateral, across, strict=True):
            target[:, _INNER][:, some.at] = axis * force
