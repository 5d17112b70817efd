"""The evaluator: from positions to contact forces, with only the stages that an input needs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.compiled.choice import Backend, checked, compiles
from mudline.contact.ends import Ends
from mudline.contact.errors import refuse_elements, refuse_nodes
from mudline.contact.inputs import ContactInput, LawKind
from mudline.contact.plan import Plan, make_plan
from mudline.contact.positions import RealArray, as_mask, as_series, as_times, as_velocities, read_steps
from mudline.contact.result import ContactResult, blank_result
from mudline.contact.stages import Stages, StepDetail
from mudline.contact.state import ContactState

if TYPE_CHECKING:
    from mudline.contact.compiled.runner import Runner
    from mudline.contact.compiled.tables import Tables
    from mudline.contact.tangent import Tangent

_CHUNK = 16384
"""Elements or nodes, times steps, evaluated at a time: the work arrays stay in the second-level cache."""


class Stepped(NamedTuple):
    """Steps `start` and on of a series, with their results."""

    start: int
    result: ContactResult


class ContactModel:
    """Contact of the elements of an input with the sea floor. Holds no state; may be shared by threads.

    Laws per unit length act on an element: depth is the mean of its two nodes' depths, and each node takes half of the
    force. (So a line whose nodes lie alternately by the same distance above and below their mean feels no change.)
    Nodal springs, friction and trenches act on the node's own position.

    Attributes:
        input: what the model was made from.
        plan: the stages, active or not, and why.
    """

    def __init__(self, inputs: ContactInput, *, backend: Backend = "auto") -> None:
        """Make the stages that an input needs.

        `backend` says how a scene with history goes through its steps: "numpy", "fast" (compiled loops; equal to
        rounding) or "auto": "fast" for long series if the extra `mudline[fast]` is installed. Tangents and scenes
        without history are always reckoned with numpy.

        Raises:
            ImportError: `backend` is "fast", but the extra is not installed.
            ValueError: there is no such backend.
        """
        self._backend = checked(backend)
        self._tables: Tables | None = None
        self.input = inputs
        self.plan: Plan = make_plan(inputs)
        self._stages = Stages(inputs)
        self._ends = Ends(inputs.element_nodes, len(inputs.node_ids))
        self._first, self._second = inputs.element_nodes.T
        self._no_diameter = np.isnan(inputs.diameter)
        self._rigid = _rigid_nodes(inputs)

    def evaluate(
        self,
        positions: ArrayLike | None = None,
        *,
        present: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        times: ArrayLike | None = None,
    ) -> ContactResult:
        """Evaluate positions (n, 3), or a series (steps, n, 3); None stands for the input's coordinates.

        Positions are real numbers of any type, in the input's length unit, X up; a memory-mapped series is read a few
        steps at a time. `present` (n,) says which nodes have a position: what stands at the others is not looked at,
        elements with one of them are left out, and a node's reaction is that of the elements that are evaluated.

        A scene with history begins it at the first step. `velocities` are of the shape of the positions; without them
        they are differences over `times` (steps,), 0 at the first step. Only suction asks for them.

        Raises:
            PositionError: a position is NaN or infinite.
            ElementError: a value of an element overflows.
            ValueError: an argument does not have the shape or type it should, or a series with suction has neither
                velocities nor times.
        """
        given = self.input.coordinates if positions is None else positions
        parts = list(self.stream(given, present=present, velocities=velocities, times=times, together=True))
        result = parts[0].result
        return result if np.ndim(given) == 3 else result.step(0)

    def stream(
        self,
        positions: ArrayLike,
        *,
        present: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        times: ArrayLike | None = None,
        together: bool = False,
    ) -> Iterator[Stepped]:
        """Evaluate a series a few steps at a time, with memory for those; `together`: all steps in one result.

        Takes and raises what `evaluate` does.
        """
        nodes = len(self.input.node_ids)
        series, mask = as_series(positions, nodes), as_mask(present, nodes)
        motion = as_velocities(velocities, series.shape)
        clock = as_times(times, len(series))
        if self._stages.suction is not None and motion is None and clock is None and len(series) > 1:
            raise ValueError("a series with suction needs velocities, or the times of its steps")
        evaluated = mask[self._first] & mask[self._second]
        rows = max(1, _CHUNK // max(nodes, len(self.input.element_ids), 1))
        whole = self._blank(len(series), evaluated, mask) if together else None
        state = self.initial_state()
        runner = self._runner(len(series), mask)
        for start in range(0, len(series), rows):
            steps = range(start, min(start + rows, len(series)))
            count = len(steps)
            part = self._blank(count, evaluated, mask) if whole is None else whole.steps(steps.start, steps.stop)
            state = self._evaluate_steps(series, motion, clock, steps, part, state, runner)
            if whole is None:
                yield Stepped(start, part)
        if whole is not None:
            yield Stepped(0, whole)

    def initial_state(self) -> ContactState:
        """Return the state before the first step: nothing has touched the bed."""
        return self._stages.initial_state()

    def step(
        self,
        positions: ArrayLike,
        velocities: ArrayLike | None,
        state: ContactState,
        dt: float | None = None,
    ) -> tuple[ContactResult, ContactState]:
        """Evaluate one step (n, 3) behind `state`; return its result and the state behind it.

        Without velocities (n, 3) they are differences to the step before over `dt`, 0 at the first step.
        """
        result, after, _ = self._step(positions, velocities, state, dt, detailed=False)
        return result, after

    def step_in_detail(
        self,
        positions: ArrayLike,
        velocities: ArrayLike | None,
        state: ContactState,
        dt: float | None = None,
    ) -> tuple[ContactResult, ContactState, StepDetail]:
        """The same with the derivatives of its parts, which `tangent` assembles."""
        return self._step(positions, velocities, state, dt, detailed=True)

    def _step(
        self,
        positions: ArrayLike,
        velocities: ArrayLike | None,
        state: ContactState,
        dt: float | None,
        *,
        detailed: bool,
    ) -> tuple[ContactResult, ContactState, StepDetail]:
        nodes = len(self.input.node_ids)
        series = as_series(positions, nodes)
        if len(series) != 1:
            raise ValueError("a step takes the positions of one step")
        mask = as_mask(None, nodes)
        part = self._blank(1, mask[self._first], mask)
        with np.errstate(all="ignore"):
            # a copy: the state keeps it, and whoever steps may write the next positions into the same array
            points = read_steps(series, range(1), self.input.node_ids, mask).copy()
            motion = as_velocities(velocities, series.shape)
            moving = points[0] * 0.0 if motion is None else np.asarray(motion[0], np.float64)
            if motion is None and state.positions is not None and self._stages.suction is not None:
                if dt is None or not dt > 0.0:
                    raise ValueError("a step without velocities needs dt > 0")
                moving = (points[0] - state.positions) / dt
            runner = None if detailed else self._runner(1, mask)
            after = None if runner is None else runner.advance(points, moving[None], np.zeros(1), part, state)
            if after is not None:
                return part.step(0), after, StepDetail()
            detail, after = self._one_step(points, moving, part, state, 0, detailed=detailed)
        return part.step(0), after, detail

    def tangent(
        self, positions: ArrayLike, velocities: ArrayLike | None, state: ContactState, dt: float | None = None
    ) -> Tangent:
        """Return d reactions / d positions and d reactions / d velocities of one step behind `state`, as triples.

        Over curved beds the normal is held.
        """
        from mudline.contact.tangent import assemble  # noqa: PLC0415 - forces alone do without it

        result, _, detail = self.step_in_detail(positions, velocities, state, dt)
        with np.errstate(all="ignore"):
            points = np.asarray(positions, np.float64).reshape(-1, 3)
            return assemble(self.input, points, result, detail)

    def _blank(self, steps: int, evaluated: BoolArray, mask: BoolArray) -> ContactResult:
        return blank_result(steps, evaluated, mask, self.input.extras, self._stages.floor.same_normal, self._rigid)

    def _evaluate_steps(  # noqa: PLR0913, PLR0917 - what a few steps of a series are made of
        self,
        series: RealArray,
        motion: RealArray | None,
        clock: FloatArray | None,
        steps: range,
        part: ContactResult,
        state: ContactState,
        runner: Runner | None,
    ) -> ContactState:
        """Evaluate some steps into `part`: at once where nothing looks back, else one after the other."""
        with np.errstate(all="ignore"):  # everything that can overflow is checked
            points = read_steps(series, steps, self.input.node_ids, part.present)
            if not self.plan.history:
                self._locate(points, part)
                self._embed(part, steps.start)
                self._stages.press(part, steps.start)
                self._stages.gather(part, steps.start)
                self._stages.check(part, steps.start)
                self._blank_absent(part)
                return state
            if runner is not None:
                rates, since = _rates(points, motion, clock, steps)
                after = runner.advance(points, rates, since, part, state)
                if after is not None:
                    self._blank_absent(part)
                    return after
            for index, number in enumerate(steps):
                moving = _velocity(points[index], motion, clock, number, state)
                _, state = self._one_step(
                    points[index : index + 1], moving, part.steps(index, index + 1), state, number
                )
        return state

    def _one_step(
        self,
        points: FloatArray,
        moving: FloatArray,
        part: ContactResult,
        state: ContactState,
        number: int,
        *,
        detailed: bool = False,
    ) -> tuple[StepDetail, ContactState]:
        self._locate(points, part)
        self._embed(part, number)
        self._stages.press(part, number)
        detail, after = self._stages.look_back(part, points[0], moving, state, number)
        stiffness = self._stages.gather(part, number)
        detail, after = self._stages.slide(part, points[0], detail._replace(nodal=stiffness), after, detailed=detailed)
        self._stages.check(part, number)
        self._blank_absent(part)
        return detail, after

    def _runner(self, steps: int, mask: BoolArray) -> Runner | None:
        """The compiled loops, if they are to go through so many steps."""
        if not self.plan.history or not compiles(self._backend, steps * len(mask)):
            return None
        from mudline.contact.compiled.runner import Runner  # noqa: PLC0415 - loads numba
        from mudline.contact.compiled.tables import tables  # noqa: PLC0415 - loads suction and friction

        if self._tables is None:
            self._tables = tables(self.input, self._stages.onset)
        return Runner(self._tables, self._stages.floor, mask)

    def _locate(self, points: FloatArray, part: ContactResult) -> None:
        """Gaps and normals of the nodes."""
        floor = self._stages.floor
        if floor.same_normal is None:
            floor.locate(points, part.gap, part.normal)
        else:
            floor.gaps(points, part.gap)

    def _embed(self, part: ContactResult, first_step: int) -> None:
        """Depth, ratio and contact of the elements from the gaps of the nodes; NaN where there is no seabed."""
        first, second = self._ends.at(part.gap)
        np.multiply(0.5, first, out=part.depth)  # halves first: their sum cannot overflow
        part.depth[...] += 0.5 * second
        np.subtract(0.0, part.depth, out=part.depth)
        np.divide(part.depth, self.input.diameter, out=part.ratio)
        np.greater(part.depth, self._stages.onset, out=part.contact)
        part.slope[:, self._no_diameter] = np.nan
        refuse_nodes(np.isinf(part.gap), self.input.node_ids, first_step, "its distance to the bed overflows")
        infinite = np.isinf(part.ratio) | np.isinf(part.depth)
        refuse_elements(infinite, self.input.element_ids, first_step, "its embedment ratio overflows")

    @staticmethod
    def _blank_absent(part: ContactResult) -> None:
        """Leave no number where there was no position; depth, ratio and gap are NaN already."""
        if part.present.all():
            return
        for on_elements in (part.force, part.slope, part.stiffness):
            on_elements[:, ~part.evaluated] = np.nan
        part.normal_force[:, ~part.present] = np.nan
        part.reaction[:, ~part.present] = np.nan
        if part.friction is not None:
            part.friction[:, ~part.present] = np.nan


def _rigid_nodes(inputs: ContactInput) -> BoolArray | None:
    elements = inputs.with_law(LawKind.RIGID)
    if not elements.size:
        return None
    found = np.zeros(len(inputs.node_ids), np.bool_)
    found[inputs.element_nodes[elements]] = True
    return found


def _velocity(
    points: FloatArray, motion: RealArray | None, clock: FloatArray | None, number: int, state: ContactState
) -> FloatArray:
    """Velocities (n, 3) of a step: those given, else the difference to the step before, else none."""
    if motion is not None:
        return np.asarray(motion[number], np.float64)
    if clock is None or state.positions is None:
        return np.zeros_like(points)
    velocity: FloatArray = (points - state.positions) / (clock[number] - clock[number - 1])
    return velocity


def _rates(
    points: FloatArray, motion: RealArray | None, clock: FloatArray | None, steps: range
) -> tuple[FloatArray, FloatArray]:
    """Velocities (steps, n, 3) and zeros, or the points and the times (steps,) over which their differences count."""
    since = np.zeros(len(steps))
    if motion is not None:
        return np.asarray(motion[steps.start : steps.stop], np.float64), since
    if clock is None:
        return np.zeros_like(points), since
    first = max(steps.start, 1)
    since[first - steps.start :] = np.diff(clock[first - 1 : steps.stop])
    return points, since
