"""Motions against laws with a history whose exact outcome is known: a mass dragged by hand, and one pulled off.

A mass is dragged with some speed, slides against Coulomb friction, and returns. Below the limit mu N friction is a
spring Kt. With omega = sqrt(Kt / m) and the threshold displacement Th = mu N / Kt it sticks up to Th, where the speed
is v1 = sqrt(v^2 - omega^2 Th^2), slips for the time v1 m / (mu N), and comes back to its last stick point a quarter of
a period later with the speed omega Th.

A mass is pulled off with a constant force, from its static penetration to beyond breakout. The suction depends on the
velocity, so there is no closed form: the exact values are those of an integration with an implementation of the law of
its own, which stops at the corners of the trapezoid.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.friction import FrictionHistory, FrictionLaw, slide
from mudline.model.contact.laws.suction import SuctionHistory, SuctionLaw, SuctionState, step
from mudline.tools.study.drops import Law
from mudline.tools.study.schemes import PHASES, Forces, History, Motion, Stepper, march, started

_UNEVEN = 1.0 - 0.175 * (PHASES - PHASES[0])
"""Steps of masses side by side that start alike are a little shorter, so that events fall at different phases."""
_SLIDING_SPEED = 3.0
"""Of omega Th: most of the displacement is slip."""
_MARGIN = 3.0
"""The pull over the largest suction at the usual velocity."""
_PARTS = 400
"""Steps of the exact integration in the time that the mass takes for the uplift at breakout at its first speed."""
_MOST_PARTS = 100_000
_BISECTIONS = 60


@dataclass(frozen=True, slots=True)
class Drag:
    """A mass per unit length, its friction limit mu N, and the stiffness Kt of the friction spring."""

    mass: float
    limit: float
    stiffness: float

    @property
    def omega(self) -> float:
        """The root of stiffness over mass."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def returned(self) -> float:
        """The exact speed with which the mass comes back."""
        return self.omega * self.limit / self.stiffness

    @property
    def duration(self) -> float:
        """The exact time until then."""
        slipping = self.returned * math.sqrt(_SLIDING_SPEED**2 - 1.0)
        sticks = math.asin(1.0 / _SLIDING_SPEED) / self.omega
        return sticks + slipping * self.mass / self.limit + 0.5 * math.pi / self.omega

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`; the friction is that of the evaluator."""
        count = len(position)
        law, axes = _friction(count, self.stiffness)
        points = np.zeros((count, 3))
        points[:, 1] = position
        found = slide(law, history, points, axes, np.full(count, self.limit))
        return Forces(found.force[:, 0], found.by_position[:, 0, 0], np.zeros(velocity.shape), found.history)

    def start(self, dt: FloatArray) -> Motion:
        """Return masses that begin to slide, with steps (k,)."""
        at_rest = np.zeros(len(dt))
        history = FrictionHistory.initial(np.ones(len(dt), np.bool_))
        return started(self, at_rest, at_rest + _SLIDING_SPEED * self.returned, history)

    def errors(self, step_: Stepper, dt: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the largest relative error for each step (k,), and the evaluations per step.

        The errors are of the speed of the return, the time until then and the largest force.
        """
        every = (dt[:, None] * _UNEVEN).ravel()
        last, end = np.rint(self.duration / every), np.full((3, len(every)), np.nan)
        largest = np.zeros(len(every))

        def observe(number: int, motion: Motion) -> bool:
            np.fmax(largest, np.abs(motion.force), out=largest, where=number <= last)
            ahead = motion.position - motion.history.stick_points[:, 1]
            end[...] = np.where(number == last, (ahead, motion.velocity, number * every), end)
            return bool(number >= last.max())

        evaluations = march(step_, self, self.start(every), every, observe)
        ahead, velocity, time = end
        # close to the stick point the mass oscillates about it: its phase says when it passes, and how fast
        time = time + np.arctan2(self.omega * ahead, -velocity) / self.omega
        speed = np.hypot(velocity, self.omega * ahead)
        found = np.array([speed / self.returned, time / self.duration, largest / self.limit])
        worst = np.abs(found - 1.0).max(axis=0).reshape(len(dt), -1).max(axis=1)
        return worst, evaluations.reshape(len(dt), -1).mean(axis=1)


def _friction(count: int, stiffness: float) -> tuple[FrictionLaw, tuple[FloatArray, FloatArray]]:
    """A law with the coefficient 1 in both directions, and the directions Y and Z."""
    ones, along, across = np.ones((count, 2)), np.zeros((count, 3)), np.zeros((count, 3))
    along[:, 1], across[:, 2] = 1.0, 1.0
    active = np.ones(count, np.bool_)
    return FrictionLaw(ones, np.full((count, 2), stiffness), ones, ~active, active), (along, across)


class SuctionNumbers(NamedTuple):
    """The suction law of one element, as numbers; the fields are those of `SuctionLaw`.

    An implementation of its own, to compare the evaluator with.
    """

    force_factor: float
    force_exponent: float
    depth_factor: float
    depth_exponent: float
    first_corner: float
    second_corner: float
    cyclic: float
    regularisation: float
    cyclic_floor: float = math.nan

    @property
    def largest(self) -> float:
        """The factor of the largest suction before an uplift cycle is completed."""
        return self.force_factor * (self.cyclic if math.isnan(self.cyclic_floor) else 1.0)

    def depth(self, v: float) -> float:
        """Return the uplift at breakout at a velocity that never fell."""
        return self.depth_factor * math.pow(max(v, self.regularisation, 5e-324), self.depth_exponent)

    def force(self, x: float, v: float) -> float:
        """Return the suction at an uplift and a velocity > 0 that never fell."""
        n, share = self.force_exponent, x / self.depth(v)
        slow = v / self.regularisation if self.regularisation > v and n < 2.0 else 1.0
        most = self.largest * math.pow(v / slow, n) * slow * (2.0 - n + (n - 1.0) * slow)
        return most * max(0.0, min(share / self.first_corner, 1.0, (1.0 - share) / (1.0 - self.second_corner)))


class Breakout(NamedTuple):
    """The exact outcome: time from the mudline, uplift and speed at breakout, and the largest suction."""

    time: float
    uplift: float
    speed: float
    suction: float


@dataclass(frozen=True)
class Pull:
    """A mass per unit length on an elastic law and under suction, in deck units.

    Attributes:
        embedment: penetration at the start.
        velocity: a usual pull-out velocity, which scales the pull.
    """

    law: Law
    suction: SuctionNumbers
    mass: float
    embedment: float
    velocity: float

    @property
    def omega(self) -> float:
        """The root of the largest stiffness over mass, of the law or of the rise of the suction; raises ValueError."""
        exact = self.exact
        rise = exact.suction / (self.suction.first_corner * exact.uplift)
        stiffest = float(np.abs(self.law.force(np.append(self.law.breaks, 0.0) + 1e-300)[1]).max())
        return math.sqrt(max(stiffest, rise) / self.mass)

    @property
    def duration(self) -> float:
        """The exact time until breakout; raises ValueError."""
        return self.passing()[1] + self.exact.time

    @property
    def pull(self) -> float:
        """Force upwards, in addition to the force that carries the weight."""
        return _MARGIN * self.suction.largest * math.pow(self.velocity, self.suction.force_exponent)

    def passing(self) -> tuple[float, float]:
        """Return the speed when the mass passes the mudline, and the time until then, from the energies."""
        stops = np.array([0.0, *self.law.breaks[self.law.breaks < self.embedment], self.embedment])
        stored = self.law.work(stops[-1:]) - self.law.work(stops) + self.pull * (self.embedment - stops)
        speeds, time = np.sqrt(2.0 / self.mass * stored), 0.0
        stiffness = self.law.force(0.5 * stops[1:] + 0.5 * stops[:-1])[1]
        for start, end, v0, v1, k in zip(stops[:-1], stops[1:], speeds[:-1], speeds[1:], stiffness, strict=True):
            omega = math.sqrt(abs(k) / self.mass)
            share = float((end - start) / (v0 + v1))
            angle = math.atan(omega * share) if k > 0.0 else math.atanh(omega * share)
            time += 2.0 * (angle / omega if omega else share)
        return float(speeds[0]), time

    @cached_property
    def exact(self) -> Breakout:
        """The outcome of an integration from the mudline to breakout.

        Raises ValueError where the mass slows down before, or does not break out.
        """
        law, mass, force = self.suction, self.mass, self.pull

        def rate(x: float, v: float) -> tuple[float, float]:
            return v, (force - (law.force(x, v) if x > 0.0 else 0.0)) / mass

        speed, _ = self.passing()
        part, state, largest, parts = law.depth(speed) / speed / _PARTS, (0.0, speed), 0.0, 0.0
        for corner in (law.first_corner, law.second_corner, 1.0):
            state, taken = _to_event(rate, state, part, lambda x, v, at=corner: x - at * law.depth(v))  # type: ignore[misc]
            if math.isnan(taken):
                raise ValueError("the pull does not break the mass out without slowing it down")
            parts += taken
            largest = max(largest, law.force(*state))
        return Breakout(parts * part, *state, largest)

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`; the suction is that of the evaluator."""
        reaction, slope = self.law.force(-position)
        found, after = step(self._law(len(position)), history, np.maximum(position, 0.0), velocity, reaction > 0.0)
        return Forces(reaction + found.force + self.pull, found.by_uplift - slope, found.by_velocity, after)

    def start(self, dt: FloatArray) -> Motion:
        """Return masses that begin to rise, with steps (k,)."""
        at_rest, history = np.zeros(len(dt)), SuctionHistory.initial(self._law(len(dt)))
        return started(self, at_rest - self.embedment, at_rest, history)

    def _law(self, count: int) -> SuctionLaw:
        return SuctionLaw(*(np.full(count, value) for value in self.suction))

    def errors(self, step_: Stepper, dt: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the largest relative error for each step (k,), and the evaluations per step.

        The errors are of the speed and the time when the mass is as high as breakout is, and of the largest suction.
        Raises ValueError where the mass does not break out.
        """
        exact, duration = self.exact, self.duration
        every = (dt[:, None] * _UNEVEN).ravel()
        last, end = np.ceil(1.05 * duration / every) + 4.0, np.full((4, len(every)), np.nan)
        largest = np.zeros(len(every))

        def observe(number: int, motion: Motion) -> bool:
            above = motion.position > 0.0
            np.fmax(largest, np.where(above, self.pull - motion.force, 0.0), out=largest)
            out = ~motion.history.armed & (motion.history.state != SuctionState.COMPRESSION) & above
            found = (motion.position, motion.velocity, number * every, out)
            end[...] = np.where(number == last, found, end)
            return bool(number >= last.max())

        evaluations = march(step_, self, self.start(every), every, observe)
        x, v, time, out = end
        gain = self.pull / self.mass
        squared = v * v - 2.0 * gain * (x - exact.uplift)
        speed = np.sqrt(np.where((out > 0.0) & (squared > 0.0), squared, np.nan))
        found = np.array([speed / exact.speed, (time - (v - speed) / gain) / duration, largest / exact.suction])
        worst = np.abs(found - 1.0).max(axis=0).reshape(len(dt), -1).max(axis=1)
        return worst, evaluations.reshape(len(dt), -1).mean(axis=1)


_Rate = Callable[[float, float], tuple[float, float]]
_Event = Callable[[float, float], float]


def _to_event(rate: _Rate, state: tuple[float, float], part: float, event: _Event) -> tuple[tuple[float, float], float]:
    """Integrate to where an event rises above 0: the state there, and the time in parts; NaN where it does not."""
    for number in range(_MOST_PARTS):
        after = _stepped(rate, state, part)
        if after[1] < state[1]:
            break
        if event(*after) >= 0.0:
            low, high = 0.0, 1.0
            for _ in range(_BISECTIONS):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if event(*_stepped(rate, state, middle * part)) >= 0.0 else (middle, high)
            return _stepped(rate, state, high * part), number + high
        state = after
    return state, math.nan


def _stepped(rate: _Rate, state: tuple[float, float], part: float) -> tuple[float, float]:
    """A step of the classical Runge-Kutta scheme."""
    (x, v), half = state, 0.5 * part
    a = rate(x, v)
    b = rate(x + half * a[0], v + half * a[1])
    c = rate(x + half * b[0], v + half * b[1])
    d = rate(x + part * c[0], v + part * c[1])
    moved, faster = (part / 6.0 * (p + 2.0 * (q + r) + s) for p, q, r, s in zip(a, b, c, d, strict=True))
    return x + moved, v + faster
