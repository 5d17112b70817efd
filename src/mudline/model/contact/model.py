"""The evaluator: contact forces from positions, with only the laws of an input."""

from __future__ import annotations

import math
from collections.abc import Iterator
from numbers import Real
from types import NoneType
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary, WeakSet

import numpy as np
from numpy.typing import ArrayLike

from mudline.basics.arguments import as_array, expect
from mudline.basics.short_repr import counted, outline
from mudline.model.contact.arrays import (
    BoolArray,
    FloatArray,
    IdArray,
    Positions,
    RealArray,
    StepReader,
    as_times,
    as_velocities,
)
from mudline.model.contact.input import ContactInput, PositionError
from mudline.model.contact.numpy_driver import NumpyDriver
from mudline.model.contact.plan import Backend, BackendChoice, Plan, make_plan
from mudline.model.contact.result import (
    ContactResult,
    ResultPart,
    blank_absent,
    blank_result,
    is_finite,
    refuse,
    refuse_pulling,
)
from mudline.model.contact.seabed import FlatSeabed, Seabed
from mudline.model.contact.tables import ContactState, LawTables, StepBatch

if TYPE_CHECKING:
    from mudline.model.contact.compiled.driver import CompiledDriver
    from mudline.model.contact.stiffest import Stiffest
    from mudline.model.contact.tangent import Tangent


Stepped = tuple[ContactResult, ContactState]
"""A result, and the state after the step."""


class ContactModel:
    """Contact of the elements of an input with the seabed. Holds no state; may be shared by threads.

    Laws per unit length act on an element at the mean depth of its two nodes; each node takes half of the force.
    (A line whose nodes lie alternately the same distance above and below their mean therefore feels no change.)
    Nodal springs, friction and trenches act at the node's own position.

    Attributes:
        input: the input of the model.
        plan: stages of the evaluation, active or not, with reasons.
    """

    def __init__(self, given: ContactInput, *, backend: Backend = "auto", threads: int | None = None) -> None:
        """Prepare the laws of an input.

        Args:
            given: the input.
            backend: "numpy", "fast" (compiled loops) or "auto": "fast" for long series if the extra `mudline[fast]` is
                installed. Both give the same bits. Laws without compiled loops run with numpy, and the plan says so.
            threads: largest number of threads of compiled loops; None: one for each processor.

        Raises:
            ImportError: `backend` is "fast", but the extra is not installed.
            ValueError, TypeError: the backend does not exist, or `given` is not a ContactInput.
        """
        expect(given, "given", ContactInput, "a ContactInput")
        self.input = given
        self._seabed: Seabed = given.seabed or FlatSeabed()
        with np.errstate(all="ignore"):  # an overflow is refused at the step where it occurs
            self._tables = LawTables(given)
            self._choice = BackendChoice(backend, threads, self._tables)
            self.plan: Plan = make_plan(given, self._tables, self._choice)
            self._numpy = NumpyDriver(self._tables, self._seabed)
        self._compiled: CompiledDriver | None = None
        # for the result of a step: the series of one step that it is a view of, and the state
        self._made: WeakKeyDictionary[ContactResult, Stepped] = WeakKeyDictionary()
        self._everywhere = np.ones(len(given.node_ids), np.bool_)
        self._everywhere.flags.writeable = False
        self._own: WeakSet[ContactState] = WeakSet()
        self._nodes, self._shapes = len(given.node_ids), self._tables.initial_state().shapes

    def __getstate__(self) -> dict[str, object]:
        """Return the state for a copy or another process, without the results whose arrays this model may reuse."""
        return {name: value for name, value in vars(self).items() if name not in ("_made", "_own")}

    def __setstate__(self, state: dict[str, object]) -> None:
        vars(self).update(state, _made=WeakKeyDictionary(), _own=WeakSet())

    def __repr__(self) -> str:
        size = f"{counted(self._nodes, 'node')}, {counted(len(self.input.element_ids), 'element')}"
        stages = ", ".join(stage.stage for stage in self.plan if stage.active)
        return outline("ContactModel", size, stages, self.plan.steps)

    def _repr_html_(self) -> str:
        """Return size and plan as HTML, for notebooks."""
        nodes, elements = len(self.input.node_ids), len(self.input.element_ids)
        return self.plan.html("ContactModel", f"{counted(nodes, 'node')}, {counted(elements, 'element')}")

    def evaluate(
        self,
        positions: ArrayLike | StepReader | Positions | None = None,
        *,
        present: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        times: ArrayLike | None = None,
    ) -> ContactResult:
        """Evaluate positions (n, 3), or a series (steps, n, 3), by default the input's coordinates.

        Args:
            positions: real numbers of any type, in the input's length unit, X up; a memory-mapped series is read a few
                steps at a time. `Positions` read from a file also bring `present`, `velocities` and `times`.
            present: (n,) nodes that have a position. Values of absent nodes are ignored, and their elements are not
                evaluated; the reaction of a node is that of its evaluated elements.
            velocities: of the shape of the positions, used only by suction and damping. By default they are differences
                of positions over `times`, 0 at the first step.
            times: (steps,) times of the steps. A scene with history starts at the first step.

        Raises:
            PositionError: a position is NaN or infinite.
            ElementError: a value of an element overflows.
            ValueError: an argument has the wrong shape or type, or a series with suction or damping has neither
                velocities nor times.
        """
        series = self.input.coordinates if positions is None else positions
        if isinstance(series, Positions):
            present = series.present if present is None else present
            velocities = series.velocities if velocities is None else velocities
            times = series.time if times is None and series.timed else times
            series = series.values if len(series.values) > 1 or series.time is not None else series.values[0]
        single = False
        if not isinstance(series, StepReader):
            series = as_array(series, "positions")
            single = series.ndim == 2
            series = series.copy() if single else series  # the result keeps the array, which the caller may overwrite
        part = next(self.stream(series, present=present, velocities=velocities, times=times, together=True))
        return part.result.step(0) if single else part.result

    def stream(
        self,
        positions: ArrayLike | StepReader,
        *,
        present: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        times: ArrayLike | None = None,
        together: bool = False,
    ) -> Iterator[ResultPart]:
        """Evaluate a series a few steps at a time, in bounded memory; with `together` all steps in one result.

        Arguments and exceptions are those of `evaluate`.
        """
        expect(together, "together", (bool, np.bool_), "True or False")
        series = _as_series(positions, self._nodes)
        mask = self._everywhere if present is None else _as_mask(present, self._nodes)
        partly = None if mask.all() else mask
        motion = as_velocities(velocities, series.shape)
        clock = as_times(times, len(series))
        if self.input.needs_velocities and motion is None and clock is None and len(series) > 1:
            law = self.input.needs_velocities[0]
            raise ValueError(f"a series with {law} needs velocities, or the times of its steps")
        driver, state, spare = self._driver(len(series)), self._tables.initial_state(), None
        rows = self._numpy.steps if driver is None else driver.steps
        whole = self._blank(series[:], mask, clock) if together else None
        for start in range(0, len(series), rows):
            stop = min(start + rows, len(series))
            with np.errstate(all="ignore"):  # everything that can overflow is checked
                points = _read_steps(series, range(start, stop), self.input.node_ids, partly)
                when = None if clock is None else clock[start:stop]
                part = self._blank(points, mask, when) if whole is None else whole.steps(start, stop)
                rates = None if motion is None else np.asarray(motion[start:stop], np.float64)
                spans = None if clock is None else np.diff(clock[max(start - 1, 0) : stop])
                before = state
                state = self._advance(driver, points, rates, spans, part, state, start, spare if driver else state)
                spare = before
            if whole is None:
                yield ResultPart(start, part)
        if whole is not None:
            yield ResultPart(0, whole)

    def initial_state(self) -> ContactState:
        """Return the state before the first step, without any contact yet."""
        return self._tables.initial_state()

    def step(
        self,
        positions: ArrayLike,
        velocities: ArrayLike | None,
        state: ContactState,
        dt: float | None = None,
        *,
        out: Stepped | None = None,
    ) -> Stepped:
        """Evaluate one step (n, 3) after `state`; return its result and the new state.

        Args:
            positions: (n, 3) positions of the step.
            velocities: (n, 3); None: differences to the positions in `state` over `dt`, 0 at the first step.
            state: state after the step before, or `initial_state()`.
            dt: time since the step before.
            out: return value of an earlier step of this model that is no longer needed. Its arrays are reused, which is
                faster. It must not hold `state`; if the step raises, its contents are lost.

        Raises:
            PositionError, ElementError: as `evaluate`.
            ValueError: as `evaluate`; `dt` is not finite and above 0, or missing; `state` belongs to another model; or
                `out` was not returned by a step of this model, or holds `state`.
        """
        expect(state, "state", ContactState, "a ContactState")
        if state not in self._own and (
            state.shapes != self._shapes or (state.positions is not None and len(state.positions) != self._nodes)
        ):
            raise ValueError("state must be one of this model: it is that of other nodes, elements or laws")
        expect(dt, "dt", (Real, NoneType), "a number")
        if dt is not None and not 0.0 < dt < np.inf:
            raise ValueError(f"dt must be finite and above 0, not {dt!r}")
        series = _as_series(positions, self._nodes)
        if len(series) != 1:
            raise ValueError("a step takes the positions of one step")
        motion = as_velocities(velocities, series.shape)
        if self._tables.velocities and motion is None and state.positions is not None and dt is None:
            raise ValueError("a step without velocities needs dt > 0")
        with np.errstate(all="ignore"):
            places = _read_steps(series, range(1), self.input.node_ids, None)
            if out is None:
                part, spare = self._blank(np.empty(places.shape), self._everywhere, None), None
            else:
                part, spare = self._again(out, state)
            # a copy, which state and result keep: the caller may write the next positions into the same array
            points = np.asarray(part.positions)
            points.flags.writeable = True
            points[...] = places
            points.flags.writeable = False
            rates = None if motion is None else np.asarray(motion, np.float64)
            spans = None if dt is None or state.positions is None else np.array([dt])
            after = self._advance(self._driver(1), points, rates, spans, part, state, 0, spare)
        if out is not None:
            return out[0], after
        result = part.step(0)
        self._made[result] = part, after
        self._own.add(after)
        return result, after

    def tangent(
        self,
        positions: ArrayLike,
        velocities: ArrayLike | None,
        state: ContactState,
        dt: float | None = None,
        *,
        back: bool = False,
    ) -> Tangent:
        """Return d reactions / d positions and d reactions / d velocities of one step after `state`, as triples.

        For a force that follows a path (the law "soil") it is the tangent of continued motion, with `back` that of a
        reversal. Over curved seabeds the normal is held. Raises the exceptions of `step`.
        """
        from mudline.model.contact.tangent import assemble  # noqa: PLC0415 - forces alone do without it

        expect(back, "back", (bool, np.bool_), "True or False")
        result, after = self.step(positions, velocities, state, dt)
        with np.errstate(all="ignore"):
            points = np.array(positions, np.float64).reshape(1, -1, 3)
            rates = None if velocities is None else np.asarray(velocities, np.float64).reshape(1, -1, 3)
            spans = None if dt is None or state.positions is None else np.array([dt])
            speed = self._speed(points, rates, spans, result.normal[None], state, points[..., 0])
            return assemble(
                self._tables, points[0], None if speed is None else speed[0], result, (state, after), back=back
            )

    def stiffest(self, positions: ArrayLike | None = None, velocities: ArrayLike | None = None) -> Stiffest:
        """Return the largest stiffness and damping of each law on each element, which a time step must resolve.

        Without positions they are the largest that the laws can reach under the static normal force (`input.weight`)
        and at the worst velocity. With positions and velocities, each (n, 3) or (steps, n, 3), they are the largest
        there. See `mudline.model.contact.stiffest`.
        """
        from mudline.model.contact.stiffest import stiffest  # noqa: PLC0415 - forces alone do without it

        if positions is None and velocities is not None:
            raise ValueError("velocities need positions")
        result = None if positions is None else self.evaluate(positions, velocities=velocities)
        speed = None
        if result is not None and velocities is not None:
            speed = (np.asarray(velocities, np.float64) * result.normal).sum(axis=-1)
        return stiffest(self._tables, result, speed)

    def _driver(self, steps: int) -> CompiledDriver | None:
        """Return the compiled loops if they are to evaluate so many steps, else None."""
        if not self._choice.compiles(steps):
            return None
        if self._compiled is None:
            from mudline.model.contact.compiled.driver import CompiledDriver  # noqa: PLC0415 - loads numba

            self._compiled = CompiledDriver(self._tables, self._seabed, self._choice.threads)
        return None if self._compiled.broken else self._compiled

    def _blank(self, positions: RealArray, mask: BoolArray, times: FloatArray | None) -> ContactResult:
        return blank_result(positions, mask, self._tables, self._seabed.same_normal, times)

    def _advance(  # noqa: PLR0913, PLR0917 - what a batch is made of
        self,
        driver: CompiledDriver | None,
        points: FloatArray,
        rates: FloatArray | None,
        spans: FloatArray | None,
        part: ContactResult,
        state: ContactState,
        first_step: int,
        spare: ContactState | None,
    ) -> ContactState:
        """Evaluate a batch into `part`; return the new state, in the arrays of `spare` if given."""
        laid = state.laid
        if laid is None:  # a copy: the positions of a step may be written again
            laid = points[0].copy() if self.plan.history else points[0]
        self._numpy.locate(points, part)
        complete = part.present is self._everywhere or bool(part.present.all())
        batch = StepBatch(points, self._speed(points, rates, spans, part.normal, state, part.gap), laid, complete)
        if self._tables.level is not None:
            from mudline.model.contact.directions import lower  # noqa: PLC0415 - few trenches do

            lower(self._tables, points, laid, part.normal, part.gap)
        after = state.following(spare, points[-1], laid) if self.plan.history else state
        if driver is None or not driver.run(batch, part, state, after):
            after.remember(state)
            self._numpy.run(batch, part, after)
            if not is_finite(part, batch.speed):
                refuse(part, batch.speed, first_step, self._tables)
        refuse_pulling(part, first_step, self._tables)
        if not complete:
            blank_absent(part)
        return after

    def _again(self, out: Stepped, state: ContactState) -> Stepped:
        """Return the series of one step and the state whose arrays are to be reused."""
        expect(out, "out", tuple, "a result and a state")
        made = self._made.get(out[0])
        if made is None or made[1] not in out[1:]:
            raise ValueError("out must be the result and the state that a step of this model returned")
        part, after = made
        if after is state and self.plan.history:
            raise ValueError("out holds the state that the step begins with: its arrays cannot be written yet")
        for marks in (part.cut, part.regularised):  # steps set marks, and never clear them
            if marks is not None and marks.flags.writeable:
                marks[...] = False
        return made

    def _speed(
        self,
        points: FloatArray,
        rates: FloatArray | None,
        spans: FloatArray | None,
        normal: FloatArray,
        state: ContactState,
        heights: FloatArray,
    ) -> FloatArray | None:
        """Return velocities (steps, n) along the normals; None if no law needs them.

        Without given velocities they are differences over `spans`, the times since the steps before: 0 at the first
        step of a series. `heights` (steps, n) are heights above X = 0, sufficient over a horizontal seabed.
        """
        if not self._tables.velocities:
            return None
        flat, before = isinstance(self._seabed, FlatSeabed), state.positions
        if rates is None and flat:
            return _differences(heights, spans, None if before is None else before[:, 0])
        if rates is None:
            rates = _differences(points, spans, before)
        speed: FloatArray
        if flat:
            speed = np.ascontiguousarray(rates[..., 0])
        else:
            speed = rates[..., 0] * normal[..., 0] + rates[..., 1] * normal[..., 1] + rates[..., 2] * normal[..., 2]
        if not math.isfinite(rates.sum()):
            speed = np.where(np.isfinite(rates).all(axis=-1), speed, np.nan)
        return speed


def _differences(places: FloatArray, spans: FloatArray | None, before: FloatArray | None) -> FloatArray:
    """Return velocities of places (steps, ...) over the times since the steps before: 0 at the first step of a series.

    `before` (...) are the places at the step before the first.
    """
    first = 1
    if before is not None and spans is not None and len(spans) == len(places):
        if len(places) == 1:  # the usual call of time-domain programs
            return (places - before) / spans
        first = 0
    rates = np.empty(places.shape)
    rates[0] = 0.0 if before is None or first else places[0] - before
    if len(places) > 1:
        np.subtract(places[1:], places[:-1], out=rates[1:])
    if spans is None:
        rates[1:] = 0.0
    elif first < len(places):
        rates[first:] /= spans[len(spans) - len(places) + first :].reshape(-1, *[1] * (places.ndim - 1))
    return rates


def _as_series(positions: ArrayLike | StepReader, nodes: int) -> RealArray | StepReader:
    """Return positions (nodes, 3) or (steps, nodes, 3) as (steps, nodes, 3), neither copied nor converted.

    Raises:
        ValueError: the positions have another shape, or are not real numbers.
    """
    array: RealArray | StepReader = positions if isinstance(positions, StepReader) else as_array(positions, "positions")
    if array.dtype.kind not in "iuf":
        raise ValueError(f"positions must be real numbers, not {array.dtype}")
    if array.ndim not in {2, 3} or array.shape[-2:] != (nodes, 3):
        expected = f"({nodes}, 3) or (steps, {nodes}, 3)"
        raise ValueError(f"positions must have the shape {expected}, not {array.shape}")
    return array if isinstance(array, StepReader) or array.ndim == 3 else array[np.newaxis]


def _as_mask(present: ArrayLike, nodes: int) -> BoolArray:
    """Return which nodes have a position; raise ValueError if `present` is not an array (nodes,) of booleans."""
    mask = as_array(present, "present").copy()
    if mask.dtype != np.bool_ or mask.shape != (nodes,):
        raise ValueError(f"present must be booleans of shape ({nodes},), not {mask.dtype} of shape {mask.shape}")
    return mask


def _read_steps(
    series: RealArray | StepReader, steps: range, node_ids: IdArray, present: BoolArray | None
) -> FloatArray:
    """Return the positions (steps, nodes, 3) of a few steps as float64, NaN for absent nodes.

    Raises:
        PositionError: a position of a present node is NaN, infinite or too large for a float64.
    """
    points = np.asarray(series[steps.start : steps.stop], dtype=np.float64)
    # a finite sum has only finite terms, and is faster than a check of each term
    checked = True if present is None else present
    if not math.isfinite(points.sum()) and (bad := np.argwhere(~np.isfinite(points).all(axis=2) & checked)).size:
        row, column = bad[0].tolist()
        step, node = steps.start + row, int(node_ids[column])
        place = tuple(points[row, column].tolist())
        raise PositionError(f"node {node} at step {step}: its position {place} is not finite", node, step)
    return points if present is None else np.where(present[:, np.newaxis], points, np.nan)
