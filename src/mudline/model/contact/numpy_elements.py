"""A range of elements driven by numpy: depth, normal laws, unloading, suction, directions, lateral springs."""

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
    add_at,
    add_each,
    as_range,
    each_at,
    put_at,
    taken,
    zero_outside,
)
from mudline.model.contact.directions import mean_normal
from mudline.model.contact.input import AssignedLaw
from mudline.model.contact.laws import PathLaw, law_module
from mudline.model.contact.result import ContactResult
from mudline.model.contact.tables import ContactState, LawTables, NormalRows, arrays_of, rows_within
from mudline.model.contact.vectors import in_plane, units

if TYPE_CHECKING:
    from mudline.model.contact.laws.suction import SuctionHistory
    from mudline.model.contact.laws.unloading import UnloadingHistory
    from mudline.model.contact.tables import StepBatch

Values = tuple[FloatArray, FloatArray, FloatArray]
"""Force, slope and stiffness (steps, k)."""

_Pulled = tuple[IndexArray, IndexArray, FloatArray, FloatArray]
"""Steps, columns, uplifts at breakout and cyclic factors of elements in suction."""


class Work(NamedTuple):
    """Values of elements for the nodes (steps, m + 2), between two columns of zeros.

    Attributes:
        planes: (3, steps, n) coordinates; empty if nothing moves sideways.
        load: half of the force of each element.
        tangent: (c, steps, m + 2) components of the unit direction of each element; over a horizontal seabed only those
            in its plane.
        lateral: components of the lateral force of each element on each of its nodes.
        ratio: z/D of each element; empty if no node needs it.
    """

    planes: FloatArray
    load: FloatArray
    tangent: FloatArray
    lateral: FloatArray
    ratio: FloatArray


class _LawGroup(NamedTuple):
    """Elements of a range with one normal law.

    Attributes:
        rows: the law and all its rows.
        at: columns of the elements in the range.
        columns, diameter: parameters and diameters, each (1, k).
        held: rows in the memory of elements on a path.
    """

    rows: NormalRows
    at: IndexArray
    columns: tuple[FloatArray, ...]
    diameter: FloatArray
    held: slice


class _Subset(NamedTuple):
    """Elements of a range with another law: rows in the law's arrays, columns in the range, parameters (1, k)."""

    rows: slice
    at: Picked
    elements: IndexArray
    columns: tuple[FloatArray, ...]
    diameter: FloatArray
    onset: FloatArray | float


_Trench = tuple[FloatArray, BoolArray]
"""Uplift of elements with an unloading law from their trench bottom, and whether they are below it."""


class ElementRange:
    """Range of elements begin <= e < end."""

    def __init__(self, tables: LawTables, begin: int, end: int, *, flat: bool) -> None:
        self._tables, self.begin, self.end, self._flat = tables, begin, end, flat
        here = slice(begin, end)
        self._here, self._inner = here, slice(begin + 1, end + 1)
        # a single row: arrays of one step combine with it faster than with a flat array
        self._diameter, self._half = tables.diameter[None, here], tables.half[None, here]
        self._unsized = np.flatnonzero(np.isnan(self._diameter))
        self._onset: FloatArray | float = 0.0 if tables.onset is None else tables.onset[None, here]
        self._groups = [group for rows in tables.normal if (group := self._group(rows)) is not None]
        held = [np.empty(0, np.intp), *(group.at for group in self._groups)]
        bare = np.setdiff1d(np.arange(end - begin), np.concatenate(held))
        self._order, self._bare = np.concatenate([*held, bare]), len(bare)
        self._back = np.argsort(self._order) if (np.diff(self._order) != 1).any() else None
        self._damping = None if tables.damping is None else tables.damping[None, here]
        self._unloading = self._subset(tables.unloading)
        self._steeper = [] if self._unloading is None else self._may_steepen(self._unloading)
        self._springs, self._suction = self._subset(tables.springs), self._subset(tables.suction)
        self._lateral = self._subset(tables.lateral)
        if self._suction is not None:
            from mudline.model.contact.laws.suction import SuctionLaw  # noqa: PLC0415 - only now is it needed

            self._laws = np.concatenate(self._suction.columns)
            self._law = SuctionLaw(*self._laws)
            self._least, self._counts = self._law.least_depth, bool(self._law.counts_cycles.any())
        self._in_trench: tuple[IndexArray, IndexArray] | None = None
        if self._suction is not None and self._unloading is not None:
            pulls, unloads = (np.arange(end - begin)[some.at] for some in (self._suction, self._unloading))
            _, of_suction, of_unloading = np.intersect1d(pulls, unloads, assume_unique=True, return_indices=True)
            self._in_trench = of_suction, of_unloading

    def _group(self, rows: NormalRows) -> _LawGroup | None:
        cut = rows_within(rows.rows, self.begin, self.end)
        at = rows.rows[cut]
        columns = tuple(column[None, cut] for column in rows.columns)
        held = slice(rows.path + cut.start, rows.path + cut.stop)
        return _LawGroup(rows, at - self.begin, columns, self._tables.diameter[None, at], held) if len(at) else None

    def _subset(self, assigned: AssignedLaw | None) -> _Subset | None:
        if assigned is None:
            return None
        rows = rows_within(assigned.rows, self.begin, self.end)
        if rows.start == rows.stop:
            return None
        at = as_range(assigned.rows[rows] - self.begin)
        onset = self._onset[:, at] if isinstance(self._onset, np.ndarray) else self._onset
        columns = tuple(column[None, rows] for column in assigned.columns)
        return _Subset(rows, at, assigned.rows[rows], columns, self._diameter[:, at], onset)

    def run(self, batch: StepBatch, part: ContactResult, state: ContactState, work: Work) -> None:
        """Write the elements of a batch, and their values for the nodes."""
        depth, contact = self._write_depths(part)
        values = part.force[:, self._here], part.slope[:, self._here], part.stiffness[:, self._here]
        trench = None
        if self._unloading is not None and state.unloading is not None:
            trench = self._apply_unloading(self._unloading, depth, values, part, state.unloading, state.paths)
        else:
            self._apply_normal_laws(depth, part.ratio[:, self._here], contact, values, part, state.paths)
        if self._unsized.size:
            values[1][:, self._unsized] = np.nan
        if self._springs is not None:
            self._apply_springs(self._springs, depth, values)
        if self._damping is not None and batch.speed is not None:
            first, second = self._tables.line.at(batch.speed, self.begin, self.end)
            values[0][...] += law_module("linear").damping_force(depth, 0.5 * first + 0.5 * second, self._damping)
        if self._suction is not None and batch.speed is not None and state.suction is not None:
            self._apply_suction(self._suction, batch.speed, (depth, contact, trench), values, part, state.suction)
        np.multiply(values[0], self._half, out=work.load[:, self._inner])
        if len(work.ratio):
            work.ratio[:, self._inner] = part.ratio[:, self._here]
        if not len(work.tangent):
            return
        along = self._write_directions(work)
        if self._lateral is not None and state.touchdown is not None:
            self._apply_lateral(self._lateral, along, contact, part, state.touchdown, work)

    def _write_depths(self, part: ContactResult) -> tuple[FloatArray, BoolArray]:
        """Write depth, ratio and contact from the gaps of the nodes; NaN where there is no seabed."""
        depth, contact = part.depth[:, self._here], part.contact[:, self._here]
        first, second = self._tables.line.at(part.gap, self.begin, self.end)
        np.multiply(first, 0.5, out=depth)  # halves first: their sum cannot overflow
        np.add(depth, 0.5 * second, out=depth)
        np.subtract(0.0, depth, out=depth)
        np.divide(depth, self._diameter, out=part.ratio[:, self._here])
        np.greater(depth, self._onset, out=contact)
        return depth, contact

    def _apply_normal_laws(
        self,
        depth: FloatArray,
        ratio: FloatArray | None,
        touches: BoolArray,
        values: Values,
        part: ContactResult,
        paths: FloatArray | None,
    ) -> None:
        """Write the values of the normal laws at a depth, 0 where an element does not touch.

        Elements are sorted by law and back, so that each law works on contiguous columns. `ratio` is depth / diameter
        if already known.
        """
        if self._back is None and len(self._groups) == 1 and not self._bare:
            self._apply_normal_law(self._groups[0], depth, ratio, touches, values, part, paths)
            zero_outside(touches, *values)
            return
        z, on = depth.take(self._order, axis=1), touches.take(self._order, axis=1)
        sorted_values, start = np.empty((3, *depth.shape)), 0
        for group in self._groups:
            columns = slice(start, start + len(group.at))
            own = sorted_values[0][:, columns], sorted_values[1][:, columns], sorted_values[2][:, columns]
            self._apply_normal_law(group, z[:, columns], None, on[:, columns], own, part, paths)
            start = columns.stop
        sorted_values[..., start:] = 0.0
        zero_outside(on, sorted_values)
        for target, source in zip(values, sorted_values, strict=True):
            if self._back is None:
                target[...] = source
            else:
                source.take(self._back, axis=1, out=target, mode="clip")

    def _apply_normal_law(  # noqa: PLR0913, PLR0917 - as above, for a group
        self,
        group: _LawGroup,
        depth: FloatArray,
        ratio: FloatArray | None,
        touches: BoolArray,
        values: Values,
        part: ContactResult,
        paths: FloatArray | None,
    ) -> None:
        """Write the values of one law on its elements, touching or not."""
        force, slope, stiffness = values
        if group.rows.curve >= 0:
            curve = self._tables.given.curves[group.rows.curve]
            at = depth / group.diameter if ratio is None else ratio
            if all(array.flags.c_contiguous for array in (at, force, slope)):
                curve.fill(at.reshape(-1), force.reshape(-1), slope.reshape(-1))
            else:
                curve_values = np.empty((2, at.size))
                curve.fill(np.ascontiguousarray(at).reshape(-1), curve_values[0], curve_values[1])
                force[...], slope[...] = curve_values.reshape(2, *at.shape)
            np.divide(slope, group.diameter, out=stiffness)
        else:
            if paths is not None and isinstance(group.rows.law, PathLaw):
                memory = paths[group.held], group.diameter[0], tuple(column[0] for column in group.columns)
                group.rows.law.follow(depth, *memory, (force, stiffness))
            else:
                force[...], stiffness[...] = group.rows.law.reaction(depth, group.diameter, *group.columns)
            np.multiply(stiffness, group.diameter, out=slope)
        if self._tables.cuts and group.rows.curve >= 0:
            pulls = touches & (force < 0.0)
            if pulls.any():
                zero_outside(~pulls, *values)
                part.cut[:, self.begin + group.at] = pulls

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
        so_far = np.concatenate([history.z_max[None, some.rows], z])
        if len(z) > z.shape[1]:
            np.maximum.accumulate(so_far, axis=0, out=so_far)
        else:  # np.maximum.accumulate is slow over the steps of each element in turn
            for before, now in itertools.pairwise(so_far):
                np.maximum(before, now, out=now)
        fresh, deepest = so_far[1:] > so_far[:-1], so_far[1:]
        reached = depth.copy()
        put_at(reached, some.at, deepest)
        self._apply_normal_laws(reached, None, reached > self._onset, values, part, paths)
        force, slope, stiffness = (taken(each, some.at) for each in values)
        force_max, steepest = np.maximum(force, 0.0), some.columns[0]
        if self._steeper:
            steepest = np.broadcast_to(steepest, deepest.shape).copy()
            for group, mine, theirs in self._steeper:
                steepest[:, mine] = np.maximum(steepest[:, mine], self._slope(group, deepest[:, mine], theirs))
        line = law.line_stiffness(steepest, deepest, force_max)
        never = deepest == 0.0
        if never.any():  # a smoothed law has a force at the mudline, its line has none
            force_max[never] = 0.0
            np.copyto(line, some.columns[0], where=never)
        bottom = law.trench_bottom(line, deepest, force_max)
        back, rise = law.on_line(z, deepest, force_max, line, bottom)
        if part.cut.flags.writeable:
            part.cut[:, self._here][:, some.at] &= fresh
        put_at(values[0], some.at, np.where(fresh, force, back))
        put_at(values[1], some.at, np.where(fresh, slope, rise * some.diameter))
        put_at(values[2], some.at, np.where(fresh, stiffness, rise))
        for kept, moved in zip(arrays_of(history), (deepest, force_max, line, bottom), strict=True):
            kept[some.rows] = moved[-1]
        return bottom - taken(depth, some.at), z > bottom

    def _may_steepen(self, some: _Subset) -> list[tuple[_LawGroup, IndexArray, IndexArray]]:
        """Return elements whose normal law may be steeper than their line: group, places in subset and group."""
        at = np.arange(self.end - self.begin)[some.at]
        groups = []
        for group in self._groups:
            _, mine, theirs = np.intersect1d(at, group.at, assume_unique=True, return_indices=True)
            steepest = self._slope(group, np.full((1, len(theirs)), np.inf), theirs)
            (steeper,) = (steepest[0] > some.columns[0][0, mine]).nonzero()
            if steeper.size:
                groups.append((group, mine[steeper], theirs[steeper]))
        return groups

    def _slope(self, group: _LawGroup, z: FloatArray, rows: IndexArray) -> FloatArray:
        """Return the steepest slope of a normal law between the mudline and penetrations (steps, k) of elements."""
        diameter = group.diameter[:, rows]
        if group.rows.curve >= 0:
            from mudline.model.contact.laws.curve import steepest_slope  # noqa: PLC0415 - only now is it needed

            return steepest_slope(self._tables.given.curves[group.rows.curve], z / diameter) / diameter
        columns = [column[:, rows] for column in group.columns]
        return np.broadcast_to(group.rows.law.steepest(z, diameter, *columns), z.shape)

    def _apply_springs(self, some: _Subset, depth: FloatArray, values: Values) -> None:
        """Add springs against uplift."""
        force, stiffness = law_module("linear").spring_suction(some.onset - taken(depth, some.at), *some.columns)
        add_at(values[0], some.at, force)
        add_at(values[1], some.at, stiffness * some.diameter)
        add_at(values[2], some.at, stiffness)

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
            put_at(uplift, here, taken(trench[0], there))
            put_at(pressed, here, taken(trench[1], there))
        first, second = self._tables.line.at(speed, self.begin, self.end)
        v = 0.5 * taken(first, some.at) + 0.5 * taken(second, some.at)
        states, pulls = self._suction_states(some.rows, (uplift, v, pressed), history)
        if part.state is not None:
            put_at(part.state[:, self._here], some.at, states)
        if pulls is None:
            return
        steps, held, reach, factor = pulls
        uplift, v = each_at(uplift, steps, held), each_at(v, steps, held)
        rise, exponent, _, _, first_corner, second_corner, _, slow, _ = self._laws.take(held, axis=1)
        force, stiffness = law_module("suction").suction_force(
            uplift, v, reach, (rise * factor, exponent, slow, first_corner, second_corner)
        )
        at = held + some.at.start if isinstance(some.at, slice) else some.at[held]
        for target, more in zip(values, (force, stiffness * some.diameter[0].take(held), stiffness), strict=True):
            add_each(target, steps, at, more)
        if part.regularised is not None:
            part.regularised[steps, self.begin + at] = (v < slow) & (exponent < 2.0)

    def _suction_states(
        self, rows: slice, motion: tuple[FloatArray, FloatArray, BoolArray], history: SuctionHistory
    ) -> tuple[StateArray, _Pulled | None]:
        """Return states (steps, k) by uplift, velocity and compression, step by step, and the elements in suction.

        Most elements are on the seabed or at rest, and take the short way.
        """
        suction, law, least, counts = law_module("suction"), self._law, self._least, self._counts
        uplift, v, pressed = motion
        armed, v_max, depth = history.armed[rows], history.v_max[rows], history.depth[rows]
        states, factor = history.state[rows], history.factor[rows]
        off = uplift > -np.inf  # False for NaN
        off &= ~pressed
        every = pressed.view(np.int8).copy()
        pulled: list[_Pulled] = []
        for step, down in enumerate(pressed):
            (loose,) = ((armed | (states == suction.BROKEN)) & off[step]).nonzero()
            completed = armed & down & (v_max > 0.0) if counts else down
            after_armed, after_max, after_depth, before, states = down, np.zeros(len(down)), least, states, every[step]
            if loose.size:
                was, rates, known, reach = armed[loose], v[step][loose], v_max[loose], depth[loose]
                largest = np.where(was, np.maximum(known, rates), known)
                (grown,) = (largest > known).nonzero()
                if grown.size:
                    at = loose[grown]
                    reach[grown] = suction.breakout_uplift(
                        largest[grown], law.depth_factor[at], law.depth_exponent[at], law.regularisation[at]
                    )
                now, largest, after = suction.next_state(was, largest, before[loose], reach, uplift[step][loose], rates)
                if counts:
                    completed[loose] = was & (after == suction.BROKEN)
                (pulls,) = (after == suction.SUCTION).nonzero()
                if pulls.size:
                    held = loose[pulls]
                    pulled.append((np.full(len(held), step), held, reach[pulls], factor[held]))
                after_armed, after_depth = down.copy(), least.copy()
                after_armed[loose], after_max[loose], states[loose] = now, largest, after
                after_depth[loose] = np.where(after > 0, reach, least[loose])
            if counts and completed.any():
                cycled = suction.after_cycle(factor, law.factor_per_cycle, np.nan_to_num(law.cyclic_floor))
                factor = np.where(completed, cycled, factor)
            armed, v_max, depth = after_armed, after_max, after_depth
        history.armed[rows], history.v_max[rows], history.factor[rows] = armed, v_max, factor
        history.depth[rows], history.state[rows] = depth, states
        if len(pulled) < 2:
            return every, pulled[0] if pulled else None
        steps, columns, reaches, factors = (np.concatenate(parts) for parts in zip(*pulled, strict=True))
        return every, (steps, columns, reaches, factors)

    def _ends(self, work: Work) -> tuple[FloatArray, FloatArray]:
        """Return coordinates (3 steps, k) of both ends of the elements."""
        return self._tables.line.at(work.planes.reshape(-1, work.planes.shape[2]), self.begin, self.end)

    def _write_directions(self, work: Work) -> FloatArray:
        """Write the unit directions of the elements; return the components that `work` has."""
        first, second = self._ends(work)
        directions = units((second - first).reshape(3, -1, self.end - self.begin))[3 - len(work.tangent) :]
        work.tangent[..., self._inner] = directions
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
        middle = (0.5 * taken(start, some.at) + 0.5 * taken(end, some.at)).reshape(3, *touches.shape)
        held, kept = np.empty(middle.shape), touchdown[some.rows].T
        down = ~np.isnan(kept[0])
        for step, touch in enumerate(touches):
            new, down = touch & ~down, touch
            held[:, step] = kept = np.where(new, middle[:, step], kept)
        touchdown[some.rows] = np.where(down, kept, np.nan).T
        first = 3 - len(along)
        force = law_module("linear").lateral_force(some.columns[0], plane.dot(across, middle[first:] - held[first:]))
        force = np.where(touches, force, 0.0)
        for target, axis in zip(work.lateral, across, strict=True):
            put_at(target[:, self._inner], some.at, axis * force)
