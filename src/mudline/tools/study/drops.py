"""A mass that falls on the seabed: elastic laws, the outcome of a drop in closed form, and landings of a scheme.

Depths s are counted from where contact begins. A mass m that reaches the seabed with speed v under a weight w sinks in
to where m v^2 / 2 + w s = U(s), with the stored work U of the law, and leaves with the same speed. Over a segment of
constant stiffness k it takes the time t with tan(sqrt(k / m) t / 2) = sqrt(k / m) ds / (v0 + v1), for the speeds v0 and
v1 at its ends; tanh where the force falls with the depth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray
from mudline.model.curves import ForceCurve
from mudline.tools.study.schemes import PHASES, Forces, History, Motion, Stepper, march, started

ALLOWED = 0.01
"""Of the speed: what a landing may gain or lose."""
_SETTLED = 2
"""Steps behind lift-off in which HHT averages forces of the seabed."""
_DOUBLINGS = 12
_GRID = 400
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(32)


@dataclass(frozen=True, slots=True)
class LinearLaw:
    """K s, or K s^2 / (4 h) on 0 < s < 2 h and K (s - h) beyond, per unit length; the zone has the half width h."""

    stiffness: float
    half_width: float = 0.0

    def force(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return force and stiffness at depths (k,); 0 above the seabed."""
        k, h, below = self.stiffness, self.half_width, s > 0.0
        if h == 0.0:
            return np.where(below, k * s, 0.0), np.where(below, k, 0.0)
        zone = below & (s < 2.0 * h)
        force = np.where(zone, k * s * s / (4.0 * h), np.where(below, k * (s - h), 0.0))
        return force, np.where(zone, k * s / (2.0 * h), np.where(below, k, 0.0))

    def work(self, s: FloatArray) -> FloatArray:
        """Return the work that takes a mass from the seabed to depths (k,)."""
        k, h, s = self.stiffness, self.half_width, np.maximum(s, 0.0)
        if h == 0.0:
            return 0.5 * k * s * s
        zone = np.minimum(s, 2.0 * h)
        beyond: FloatArray = k * zone**3 / (12.0 * h) + 0.5 * k * (s - zone) * (s + zone - 2.0 * h)
        return beyond

    @property
    def breaks(self) -> FloatArray:
        """Depths > 0 at which the stiffness changes its form, ascending."""
        return np.array([2.0 * self.half_width] if self.half_width else [])

    @property
    def jump(self) -> float:
        """The force with which contact begins."""
        return 0.0


@dataclass(frozen=True, slots=True)
class CurveLaw:
    """A force-embedment curve on a pipe of a diameter."""

    curve: ForceCurve
    diameter: float

    def force(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `LinearLaw`."""
        below = s > 0.0
        force, slope = self.curve.evaluate(np.where(below & (s < np.inf), s, 0.0) / self.diameter)
        return np.where(below, force, 0.0), np.where(below, slope / self.diameter, 0.0)

    def work(self, s: FloatArray) -> FloatArray:
        """See `LinearLaw`: sums of trapezoids, which are exact between points."""
        at, knots = np.maximum(s, 0.0), np.concatenate([[0.0], self.breaks])
        forces = self.curve.evaluate(knots / self.diameter)[0]
        sums = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(knots) * (forces[1:] + forces[:-1]))])
        left = np.searchsorted(knots[1:], at, side="right")
        rest = 0.5 * (at - knots[left]) * (forces[left] + self.curve.evaluate(at / self.diameter)[0])
        work: FloatArray = sums[left] + rest
        return work

    @property
    def breaks(self) -> FloatArray:
        """See `LinearLaw`."""
        return self.curve.ratios[self.curve.ratios > 0.0] * self.diameter

    @property
    def jump(self) -> float:
        """See `LinearLaw`."""
        return float(self.curve.evaluate(0.0)[0])

    def without_jump(self) -> CurveLaw:
        """Return the law with no force at the mudline."""
        below = self.curve.ratios > 0.0
        points = np.column_stack([self.curve.ratios[below], self.curve.forces[below]])
        return CurveLaw(ForceCurve([(0.0, 0.0), *points.tolist()]), self.diameter)


Law = LinearLaw | CurveLaw


@dataclass(frozen=True, slots=True)
class Drop:
    """A mass per unit length that reaches the seabed of a law with a speed, and its largest depth; deck units."""

    law: Law
    mass: float
    weight: float
    speed: float
    deepest: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`; positions are heights above where contact begins."""
        force, stiffness = self.law.force(-position)
        return Forces(force - self.weight, -stiffness, np.zeros(velocity.shape), history)

    @property
    def omega(self) -> float:
        """The root of the largest stiffness over mass on the way to the largest depth."""
        breaks = self.law.breaks
        inside = np.append(breaks[breaks < self.deepest], self.deepest)
        middle = 0.5 * inside + 0.5 * np.append(0.0, inside[:-1])
        return math.sqrt(float(np.abs(self.law.force(np.append(middle, inside))[1]).max()) / self.mass)

    @property
    def duration(self) -> float:
        """The exact time from touching the seabed to leaving it."""
        stops = [0.0, *self.law.breaks[self.law.breaks < self.deepest].tolist(), self.deepest]
        return 2.0 * sum(self._passing(start, end) for start, end in pairwise(stops))

    def _passing(self, start: float, end: float) -> float:
        """The time from one depth to a deeper one between breaks."""
        if isinstance(self.law, LinearLaw) and end <= 2.0 * self.law.half_width:
            s = start + 0.5 * (end - start) * (_NODES + 1.0)
            return float((0.5 * (end - start) * _WEIGHTS / self._speed(s)).sum())
        v0, v1 = map(float, self._speed(np.array([start, end])))
        rate = float(self.law.force(np.array([0.5 * (start + end)]))[1][0]) / self.mass
        if rate == 0.0:
            return 2.0 * (end - start) / (v0 + v1)
        omega = math.sqrt(abs(rate))
        share = omega * (end - start) / (v0 + v1)
        return 2.0 / omega * (math.atan(share) if rate > 0.0 else math.atanh(share))

    def _speed(self, s: FloatArray) -> FloatArray:
        """The speed at depths (k,), 0 at the deepest."""
        left = self.law.work(np.array([self.deepest]))[0] - self.law.work(s) - self.weight * (self.deepest - s)
        speed: FloatArray = np.sqrt(np.maximum(2.0 / self.mass * left, 0.0))
        return speed

    def largest_force(self, depth: FloatArray) -> FloatArray:
        """The largest force on the way to depths (k,)."""
        knots = self.law.breaks
        passed = self.law.force(knots)[0]
        before = np.concatenate([[self.law.jump], np.maximum.accumulate(np.append(self.law.jump, passed))[1:]])
        found: FloatArray = np.maximum(before[np.searchsorted(knots, depth)], self.law.force(depth)[0])
        return found

    def start(self, dt: FloatArray) -> Motion:
        """Return masses that begin to fall, with steps (k,)."""
        return _Flight(self, dt).begun

    def errors(self, step: Stepper, dt: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the largest relative error of drops at all `PHASES` of each step (k,), and their evaluations per step.

        The errors are of the speed that the mass leaves with, of the time in contact and of the largest force; NaN
        where a mass did not leave the seabed in time.
        """
        flight = _Flight(self, every := np.repeat(dt, len(PHASES)))
        evaluations = march(step, self, flight.begun, every, flight.observe)
        exact = float(self.largest_force(np.array([self.deepest]))[0])
        speed, time = flight.left()
        found = np.array(
            [speed / self.speed, time / self.duration, self.largest_force(np.maximum(flight.deepest, 0.0)) / exact]
        )
        worst = np.abs(found - 1.0).max(axis=0).reshape(len(dt), -1).max(axis=1)
        return worst, evaluations.reshape(len(dt), -1).mean(axis=1)


class _Flight:
    """Masses (k,) that fall with steps dt (k,), and touch the seabed at `PHASES` of a step, one after the other."""

    def __init__(self, drop: Drop, dt: FloatArray) -> None:
        self._dt, self._fall = dt, drop.weight / drop.mass
        longest = 0.9 * drop.speed / self._fall if self._fall > 0.0 else math.inf
        self._before = np.resize(PHASES, len(dt)) * np.minimum(dt, longest)
        height = drop.speed * self._before - 0.5 * self._fall * self._before**2
        self.begun = started(drop, height, self._fall * self._before - drop.speed)
        self._last = self.begun
        self.deepest: FloatArray = -height
        self._steps = np.ceil((self._before + 2.0 * drop.duration) / dt) + 8.0
        self._touched: BoolArray = np.zeros(dt.shape, np.bool_)
        self._off: FloatArray = np.full(dt.shape, np.inf)
        self._end = np.full((3, *dt.shape), np.nan)

    def observe(self, number: int, motion: Motion) -> bool:
        """Note how deep the masses are and how they leave; see `march`."""
        open_ = np.isinf(self._off)
        self.deepest = np.where(open_, np.maximum(self.deepest, -self._lowest(motion)), self.deepest)
        self._touched |= motion.position < 0.0
        self._off = np.where(open_ & self._touched & (motion.position >= 0.0), number, self._off)
        left = (number == self._off + _SETTLED) & (motion.position > 0.0)
        self._end = np.where(left, (motion.position, motion.velocity, number * self._dt), self._end)
        self._last = motion
        return bool(((number >= self._steps) | (number >= self._off + _SETTLED)).all())

    def _lowest(self, motion: Motion) -> FloatArray:
        """The lowest point of the cubic that joins positions and velocities of the last step."""
        x0, x1 = self._last.position, motion.position
        v0, v1 = self._dt * self._last.velocity, self._dt * motion.velocity
        square, linear = 3.0 * (2.0 * (x0 - x1) + v0 + v1), 2.0 * (3.0 * (x1 - x0) - 2.0 * v0 - v1)
        root = np.sqrt(np.maximum(linear**2 - 4.0 * square * v0, 0.0))
        share = np.clip(np.nan_to_num(-2.0 * v0 / (linear + root)), 0.0, 1.0)
        low = x0 + share * (v0 + share * (0.5 * linear + share * square / 3.0))
        return np.where((v0 <= 0.0) & (v1 >= 0.0), np.minimum(low, x1), x1)

    def left(self) -> tuple[FloatArray, FloatArray]:
        """The speeds with which the masses left and the times in contact; NaN where one did not leave."""
        x, v, time = self._end
        squared = v * v + 2.0 * self._fall * x
        speed = np.sqrt(np.where(squared > 0.0, squared, np.nan))
        return speed, time - 2.0 * x / (speed + v) - self._before


def drop_to(law: Law, mass: float, weight: float, depth: float) -> Drop | None:
    """Return the drop that reaches a depth, or a multiple of it where the weight alone does; None without any."""
    for doubling in range(_DOUBLINGS):
        deepest = depth * 2.0**doubling
        grid = np.concatenate([np.linspace(0.0, deepest, _GRID), law.breaks[law.breaks < deepest]])
        left = law.work(grid) - weight * grid
        end = float(law.work(np.array([deepest]))[0]) - weight * deepest
        if end > 0.0 and (left < end)[grid < deepest].all() and law.force(np.array([deepest]))[0][0] > 1.2 * weight:
            return Drop(law, mass, weight, math.sqrt(2.0 * end / mass), deepest)
    return None


class Landing(NamedTuple):
    """Speed after a landing over that before: least and largest of `PHASES`, for steps (k,); NaN: it did not leave."""

    least: FloatArray
    largest: FloatArray

    @property
    def kept(self) -> BoolArray:
        """Where no landing gains or loses more than `ALLOWED`."""
        kept: BoolArray = (self.least >= 1.0 - ALLOWED) & (self.largest <= 1.0 + ALLOWED)
        return kept


def landings(drop: Drop, step: Stepper, dt: FloatArray) -> Landing:
    """Land with steps (k,) at `PHASES` each; `drop` has no weight."""
    flight = _Flight(drop, every := np.repeat(dt, len(PHASES)))
    march(step, drop, flight.begun, every, flight.observe)
    speeds = (flight.left()[0] / drop.speed).reshape(len(dt), -1)
    return Landing(speeds.min(axis=1), speeds.max(axis=1))
