"""A mass pulled off the seabed with a constant force, against suction, from its static penetration to beyond breakout.

The suction depends on the velocity, so there is no closed form: the exact values come from an integration that stops
at the corners of the trapezoid, with an independent implementation of the law.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState, step
from mudline.study.motion import Forces, History, Motion, Trajectory
from mudline.study.precision.integration import RUNS, Case, Start, uneven
from mudline.study.precision.laws import Law
from mudline.study.precision.reference import Event, Stop, next_event
from mudline.study.report import StudyError

_MARGIN = 3.0
"""The pull over the largest suction at the usual velocity."""
_STOPS = 20


class SuctionNumbers(NamedTuple):
    """The suction law of one element, as numbers; the fields are those of `SuctionLaw`."""

    force_factor: float
    force_exponent: float
    depth_factor: float
    depth_exponent: float
    first_corner: float
    second_corner: float
    cyclic: float
    regularisation: float
    cyclic_floor: float = math.nan

    def rows(self, count: int) -> SuctionLaw:
        """The law of so many elements."""
        return SuctionLaw(*(np.full(count, value) for value in self))

    @property
    def largest(self) -> float:
        """The factor of the largest suction before an uplift cycle is completed."""
        return self.force_factor * (self.cyclic if math.isnan(self.cyclic_floor) else 1.0)

    def depth(self, v: float) -> float:
        """Uplift at breakout at a velocity that never fell."""
        return self.depth_factor * math.pow(max(v, self.regularisation, 5e-324), self.depth_exponent)

    def force(self, x: float, v: float) -> float:
        """Suction at an uplift and a velocity > 0 that never fell."""
        n, share = self.force_exponent, x / self.depth(v)
        slow = v / self.regularisation if self.regularisation > v and n < 2.0 else 1.0
        most = self.largest * math.pow(v / slow, n) * slow * (2.0 - n + (n - 1.0) * slow)
        return most * max(0.0, min(share / self.first_corner, 1.0, (1.0 - share) / (1.0 - self.second_corner)))


@dataclass(frozen=True, slots=True)
class Pull:
    """What is pulled off what: per unit length.

    Attributes:
        embedment: penetration at the start.
        velocity: a usual pull-out velocity, which scales the pull.
    """

    name: str
    law: Law
    suction: SuctionNumbers
    mass: float
    embedment: float
    velocity: float

    @property
    def pull(self) -> float:
        """Force upwards, besides what carries the weight."""
        usual = math.pow(self.velocity, self.suction.force_exponent)
        return _MARGIN * self.suction.largest * usual

    def passing(self) -> float:
        """Speed when the mass passes the mudline, from the energies."""
        stored = float(self.law.work(np.array([self.embedment]))[0])
        return math.sqrt(2.0 * (stored + self.pull * self.embedment) / self.mass)


class Breakout(NamedTuple):
    """The exact outcome: seconds from the mudline, uplift and speed at breakout, largest suction, work against it."""

    time: float
    uplift: float
    speed: float
    suction: float
    work: float


def breakout(pull: Pull) -> Breakout:
    """Integrate from the mudline to breakout, stopping at the corners of the trapezoid.

    Raises:
        StudyError: the mass slows down before breakout, or does not break out.
    """
    law, mass, force = pull.suction, pull.mass, pull.pull

    def rate(_: float, state: FloatArray) -> list[float]:
        x, v, _work = state.tolist()
        resistance = law.force(x, v) if x > 0.0 else 0.0
        return [v, (force - resistance) / mass, resistance * v]

    def corner(share: float) -> Event:
        return lambda _, state: float(state[0]) - share * law.depth(float(state[1]))

    events = [corner(share) for share in (law.first_corner, law.second_corner, 1.0)]
    stop = Stop(0.0, np.array([0.0, pull.passing(), 0.0]), -1)
    longest = 1e3 * law.depth(pull.passing()) / pull.passing()
    largest = 0.0
    for _ in range(_STOPS):
        before = float(stop.state[1])
        stop = next_event(rate, stop, events, longest)
        if stop.event < 0 or float(stop.state[1]) < before:
            raise StudyError(f"{pull.name}: the pull does not break the mass out without slowing down")
        largest = max(largest, law.force(float(stop.state[0]), float(stop.state[1])))
        if stop.event == len(events) - 1:
            x, v, work = stop.state.tolist()
            return Breakout(stop.time, x, v, largest, work)
    raise StudyError(f"{pull.name}: the mass passes the corners of its suction law repeatedly")


class _Memory(NamedTuple):
    """What suction remembers, and the largest suction so far."""

    suction: SuctionHistory
    largest: FloatArray


@dataclass(frozen=True, slots=True)
class _Rising:
    mass: FloatArray
    law: Law
    suction: SuctionLaw
    pull: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        reaction, slope = self.law.spring(-position)
        found, after = step(self.suction, history.suction, np.maximum(position, 0.0), velocity, reaction > 0.0)
        memory = _Memory(after, np.maximum(history.largest, -found.force))
        return Forces(reaction + found.force + self.pull, found.by_uplift - slope, found.by_velocity, memory)


def pull_case(pull: Pull) -> Case:
    """The case of a pull; raises StudyError as `breakout` does."""
    exact = breakout(pull)
    rise = exact.suction / (pull.suction.first_corner * exact.uplift)
    omega = math.sqrt(max(pull.law.steepest(pull.embedment), rise) / pull.mass)
    system = _Rising(np.full(RUNS, pull.mass), pull.law, pull.suction.rows(RUNS), pull.pull)
    rest = pull.passing() * pull.mass / pull.pull

    def start(dt: float) -> Start:
        memory = _Memory(SuctionHistory.initial(system.suction), np.zeros(RUNS))
        start_height = np.full(RUNS, -pull.embedment)
        return Start(Motion.start(system, start_height, np.zeros(RUNS), memory), uneven(dt))

    return Case(
        name="pull",
        title=f"pulled off {pull.name}, suction",
        quantities=("largest suction", "speed at breakout", "work against suction"),
        reference="event-located integration (DOP853, rtol 1e-12)",
        system=system,
        omega=omega,
        duration=1.05 * (rest + exact.time),
        bound=1e3 * (exact.uplift + pull.embedment),
        start=start,
        errors=lambda run: _errors(pull, exact, run),
        missing="the mass did not break out in time",
    )


def _errors(pull: Pull, exact: Breakout, run: Trajectory) -> FloatArray:
    """Behind breakout only the pull acts: the speed at the exact uplift follows from where a run ended."""
    memory: _Memory = run.end.history
    x, v = run.end.position, run.end.velocity
    squared = v * v - 2.0 * pull.pull / pull.mass * (x - exact.uplift)
    work = 0.5 * pull.mass * (pull.passing() ** 2 - squared) + pull.pull * exact.uplift
    found = np.array(
        [memory.largest / exact.suction, np.sqrt(np.maximum(squared, 0.0)) / exact.speed, work / exact.work]
    )
    # Broken out, or so far away since that the history was reset.
    out = ~memory.suction.armed & (memory.suction.state != SuctionState.COMPRESSION) & (x > 0.5 * exact.uplift)
    return np.where(out, np.abs(found - 1.0), np.nan)
