"""A second model of the touchdown zone, for comparison: scipy and plain numbers, nothing of the package in it.

The resting shape is found by a general root finder from forces that are integrated along the line; element matrices
come from quadrature of the shape functions; every step solves the whole banded system with a Newton method of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.linalg import solve_banded
from scipy.optimize import root
from scipy.sparse import csr_array

Floats = npt.NDArray[np.float64]
Equations = Callable[[Floats], tuple[Floats, Floats, Floats]]
"""What is left of a state, and what the soil adds to the diagonal of w and beside it."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(12)


class NotFoundError(Exception):
    """No equilibrium was found."""


@dataclass(frozen=True)
class SecondModel:
    """A line from its lower end to the upper one, its pipe and soil at the touchdown, and the motion of its top.

    Attributes:
        lengths, weights: (m,) of the elements. distance, height: of the ends, horizontal and vertical.
        own_weight, mass, bending, drag: at the touchdown; the mass with contents and water, drag at a velocity of 1.
        soils: depths and forces per length of each, linear between the points and beyond them, 0 above the mudline.
        soil_of: (m,) which of them is below each element.
        heave, surge: complex amplitudes of the top. scheme: alpha_m and alpha_f. metre: in the unit of length.
        slope: of the seabed in radians, positive where it rises to the top.
    """

    lengths: Floats
    weights: Floats
    distance: float
    height: float
    own_weight: float
    mass: float
    bending: float
    drag: float
    soils: tuple[tuple[Floats, Floats], ...]
    soil_of: npt.NDArray[np.intp]
    heave: complex
    surge: complex
    period: float
    scheme: tuple[float, float] = ((2 * 0.4 - 1) / 1.4, 0.4 / 1.4)
    metre: float = 1.0
    slope: float = 0.0

    # --------------------------------------------------------------------------------------------- the resting shape

    def _reach(self, tension: float, lying: float) -> tuple[float, float]:
        """Where the upper end stands: the line lies up to an arc length and hangs behind it."""
        ends = np.append(0.0, np.cumsum(self.lengths))
        low, high = np.maximum(ends[:-1], lying), np.maximum(ends[1:], lying)
        share = np.maximum(high - low, 0.0)
        start = tension * np.tan(self.slope) + np.append(0.0, np.cumsum(share * self.weights))[:-1]
        vertical = start[:, None] + self.weights[:, None] * share[:, None] * 0.5 * (_POINTS + 1.0)
        size = np.hypot(tension, vertical)
        along = 0.5 * share @ ((tension / size) @ _WEIGHTS)
        up = 0.5 * share @ ((vertical / size) @ _WEIGHTS)
        return lying * np.cos(self.slope) + float(along), lying * np.sin(self.slope) + float(up)

    def at_rest(self, surge: float = 0.0, heave: float = 0.0) -> tuple[float, float]:
        """Horizontal tension, and the length that lies, with the top moved."""
        whole = float(self.lengths.sum())
        scale = float(np.abs(self.weights * self.lengths).sum())
        goal = np.array([self.distance + surge, self.height + heave])

        def missing(unknown: Floats) -> Floats:
            lying = float(np.clip(unknown[1], 0.0, 1.0)) * whole
            left: Floats = np.array(self._reach(float(np.exp(unknown[0])) * scale, lying)) - goal
            return left / whole

        for first in (-1.0, -2.0, -3.0, 0.0):
            for share in (0.35, 0.5, 0.2, 0.65, 0.8):
                found = root(missing, [first, share], method="hybr", tol=1e-13)
                if float(np.abs(missing(found.x)).max()) < 1e-10 and 0.0 < found.x[1] < 1.0:
                    return float(np.exp(found.x[0])) * scale, float(found.x[1]) * whole
        raise NotFoundError("no resting shape")

    @cached_property
    def _line(self) -> tuple[float, float]:
        return self.at_rest()

    @property
    def lying(self) -> float:
        """Length that lies."""
        return self._line[1]

    @property
    def tension(self) -> float:
        """Tension along the seabed."""
        return self._line[0] / float(np.cos(self.slope))

    @cached_property
    def travel(self) -> float:
        """Amplitude of the touchdown: central differences over half a metre on each side."""
        step = 0.5 * self.metre
        by_heave = self.at_rest(0.0, step)[1] - self.at_rest(0.0, -step)[1]
        by_surge = self.at_rest(step, 0.0)[1] - self.at_rest(-step, 0.0)[1]
        return abs(by_heave * self.heave + by_surge * self.surge) / (2.0 * step)

    # ------------------------------------------------------------------------------------------------------ the beam

    @cached_property
    def zone(self) -> tuple[Floats, float]:
        """Lengths (k,) of the elements in the zone, and place of the node nearest to the touchdown in it."""
        ends = np.append(0.0, np.cumsum(self.lengths))
        node = int(np.abs(ends - self.lying).argmin())
        size = (self.bending / self.tension) ** 0.5
        x = ends[1:] - ends[node]
        first = max(int((x <= -(2.0 * self.travel + 10.0 * size)).sum()), node - 60)
        beyond = np.flatnonzero(x >= 2.0 * self.travel + 6.0 * size - 1e-9)
        last = min(int(beyond[0]) if beyond.size else len(x) - 1, node + 39)
        return self.lengths[first : last + 1], float(ends[node] - ends[first])

    @cached_property
    def _soil_below(self) -> npt.NDArray[np.intp]:
        """Which soil is below each element of the zone."""
        ends = np.append(0.0, np.cumsum(self.lengths))
        lengths, start = self.zone
        first = int(np.abs(ends - (ends[np.abs(ends - self.lying).argmin()] - start)).argmin())
        return self.soil_of[first : first + len(lengths)]

    @cached_property
    def _matrices(self) -> tuple[csr_array, csr_array, Floats]:
        """Stiffness and mass over w and theta of all nodes, and the load of the weight."""
        lengths, _ = self.zone
        size = 2 * len(lengths) + 2
        stiffness, mass, load = np.zeros((size, size)), np.zeros((size, size)), np.zeros(size)
        for at, length in enumerate(lengths.tolist()):
            s = 0.5 * (_POINTS + 1.0)
            shape = np.array([1 - 3 * s**2 + 2 * s**3, length * (s - 2 * s**2 + s**3), 3 * s**2 - 2 * s**3,
                              length * (s**3 - s**2)])  # fmt: skip
            first = np.array([-6 * s + 6 * s**2, length * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2,
                              length * (3 * s**2 - 2 * s)]) / length  # fmt: skip
            second = np.array([-6 + 12 * s, length * (-4 + 6 * s), 6 - 12 * s, length * (6 * s - 2)]) / length**2
            share = 0.5 * length * _WEIGHTS
            part = slice(2 * at, 2 * at + 4)
            stiffness[part, part] += (
                self.bending * (second * share) @ second.T + self.tension * (first * share) @ first.T
            )
            mass[part, part] += self.mass * (shape * share) @ shape.T
            load[part] -= self.own_weight * shape @ share
        load[-1] += self.bending * self.own_weight / self.tension
        return csr_array(stiffness), csr_array(mass), load

    def _soil(self, z: Floats) -> tuple[Floats, Floats]:
        """Force per length at depths, and its slope."""
        force, slope = np.zeros(z.shape), np.zeros(z.shape)
        for number, (depths, forces) in enumerate(self.soils):
            slopes = np.diff(forces) / np.diff(depths)
            at = np.clip(np.searchsorted(depths, z, side="right") - 1, 0, len(slopes) - 1)
            here = (z > 0.0) & (self._soil_below == number)
            force += np.where(here, forces[at] + slopes[at] * (z - depths[at]), 0.0)
            slope += np.where(here, slopes[at], 0.0)
        return force, slope

    def _reaction(self, w: Floats) -> tuple[Floats, Floats, Floats]:
        """Forces on the nodes, what they add to the diagonal of w, and to its neighbours."""
        lengths, _ = self.zone
        force, slope = self._soil(-0.5 * (w[:-1] + w[1:]))
        half, quarter = 0.5 * force * lengths, 0.25 * slope * lengths
        return np.append(half, 0.0) + np.append(0.0, half), np.append(quarter, 0.0) + np.append(0.0, quarter), quarter

    def _newton(self, begin: Floats, equations: Equations, banded: Floats) -> Floats:
        """The state in which the free part of the equations vanishes."""
        state, tolerance = begin, 1e-6 * self.own_weight * float(self.zone[0].min())
        free = np.r_[2 : len(begin) - 2, len(begin) - 1]
        left, diagonal, beside = equations(state)
        for _ in range(200):
            if float(np.abs(left[free]).max()) <= tolerance:
                return state
            whole = banded.copy()
            whole[3, 0::2] += diagonal
            whole[1, 2::2] += beside
            whole[5, 0:-2:2] += beside
            wanted = -left
            for at in (0, 1, len(begin) - 2):  # held: their rows say that they do not change
                for row in range(max(0, at - 3), min(len(begin), at + 4)):
                    whole[3 + at - row, row] = 1.0 if row == at else 0.0
                wanted[at] = 0.0
            change = solve_banded((3, 3), whole, wanted)
            size, share = float(np.linalg.norm(left[free])), 1.0
            for _ in range(12):
                trial = state + share * change
                left, diagonal, beside = equations(trial)
                if float(np.linalg.norm(left[free])) < size:
                    break
                share *= 0.5
            state = trial
        raise NotFoundError("no equilibrium")

    @staticmethod
    def _banded(matrix: csr_array) -> Floats:
        dense = matrix.toarray()
        found = np.zeros((7, len(dense)))
        for offset in range(-3, 4):
            values = np.diag(dense, offset)
            found[3 - offset, max(offset, 0) : len(dense) + min(offset, 0)] = values
        return found

    @cached_property
    def static(self) -> Floats:
        """State of rest: w and theta of the nodes."""
        lengths, start = self.zone
        stiffness, _, load = self._matrices
        x = np.append(0.0, np.cumsum(lengths)) - start
        w = np.where(x > 0.0, 0.5 * self.own_weight / self.tension * x**2, self._left)
        begin = np.column_stack([w, np.maximum(x, 0.0) * self.own_weight / self.tension]).ravel()
        begin[-1] = 0.0

        def equations(state: Floats) -> tuple[Floats, Floats, Floats]:
            force, diagonal, beside = self._reaction(state[::2])
            left = stiffness @ state - load
            left[::2] -= force
            return left, diagonal, beside

        return self._newton(begin, equations, self._banded(stiffness))

    @cached_property
    def _left(self) -> float:
        """Height of the left end: where the soil carries the weight."""
        depths, forces = self.soils[int(self._soil_below[0])]
        at = int(np.argmax(np.append(forces[1:-1] >= self.own_weight, True)))
        share = (self.own_weight - forces[at]) / (forces[at + 1] - forces[at])
        return -float(depths[at] + share * (depths[at + 1] - depths[at]))

    def _measured(self, times: Floats, w: Floats, turned: Floats) -> Measured:
        """What the study measures, of states (k, n)."""
        lengths, start = self.zone
        x = np.append(0.0, np.cumsum(lengths)) - start
        inside = 0.5 * (x[:-1] + x[1:]) > -(2.0 * self.travel + 5.0 * (self.bending / self.tension) ** 0.5)
        force = self._soil(-0.5 * (w[:, :-1] + w[:, 1:]))[0][:, inside]
        moment = (self.bending * np.diff(turned, axis=1) / lengths)[:, inside]
        places = []
        for row in w:
            last = int(np.flatnonzero(row < 0.0)[-1])
            places.append(float(np.interp(0.0, row[last : last + 2], x[last : last + 2])))
        ranges = moment.max(axis=0) - moment.min(axis=0)
        return Measured(float(force.max()), float(np.abs(moment).max()), float(ranges.max()), np.array(places), times)

    def rest(self) -> Measured:
        """What is measured at rest."""
        return self._measured(np.zeros(1), self.static[None, ::2], self.static[None, 1::2])

    # --------------------------------------------------------------------------------------------------- the motion

    def _end(self, time: Floats) -> tuple[Floats, Floats, Floats]:
        """Height, velocity and acceleration of the right end."""
        lengths, start = self.zone
        right, a = float(lengths.sum()) - start, self.tension / self.own_weight
        s = np.minimum(time / self.period, 1.0)
        grows = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
        moving = time < self.period
        r, r1 = grows(s), np.where(moving, grows.deriv(1)(s), 0.0) / self.period
        r2 = np.where(moving, grows.deriv(2)(s), 0.0) / self.period**2
        rate = 2.0 * np.pi / self.period
        sine, cosine = np.sin(rate * time), np.cos(rate * time)
        size = self.travel * right / a
        return (
            right**2 / (2.0 * a) + size * r * sine,
            size * (r1 * sine + r * rate * cosine),
            size * (r2 * sine + 2.0 * r1 * rate * cosine - r * rate**2 * sine),
        )

    def run(self, step: float, periods: int = 3) -> Measured:
        """What is measured in the last period of a run."""
        steps = round(periods * self.period / step)
        h = periods * self.period / steps
        stiffness, mass, load = self._matrices
        am, af = self.scheme
        gamma, beta = 0.5 - am + af, 0.25 * (1.0 - am + af) ** 2
        lengths, _ = self.zone
        carried = 0.5 * self.drag * (np.append(lengths, 0.0) + np.append(0.0, lengths))
        banded = self._banded(csr_array((1.0 - am) / (beta * h * h) * mass + (1.0 - af) * stiffness))
        state, speed, rate = self.static, np.zeros(len(self.static)), np.zeros(len(self.static))

        def resisting(x: Floats, v: Floats) -> tuple[Floats, Floats, Floats]:
            force, diagonal, beside = self._reaction(x[::2])
            found = stiffness @ x - load
            found[::2] += carried * np.abs(v[::2]) * v[::2] - force
            return found, diagonal + 2.0 * carried * np.abs(v[::2]) * gamma / (beta * h), beside

        held = resisting(state, speed)[0]
        kept = []
        for end in np.column_stack(self._end(h * np.arange(1.0, steps + 1.0))):
            guess = state + h * speed + 0.5 * h * h * rate
            fast, pushed = speed + h * rate, rate.copy()
            guess[-2], fast[-2], pushed[-2] = end

            def equations(x: Floats) -> tuple[Floats, Floats, Floats]:
                moved = x - guess  # noqa: B023 - called within the step
                found, diagonal, beside = resisting(x, fast + gamma / (beta * h) * moved)  # noqa: B023 - as above
                a = pushed + moved / (beta * h * h)  # noqa: B023 - as above
                left = mass @ ((1.0 - am) * a + am * rate) + (1.0 - af) * found + af * held  # noqa: B023 - as above
                return left, (1.0 - af) * diagonal, (1.0 - af) * beside

            found = self._newton(guess, equations, banded)
            moved = found - guess
            state, speed, rate = found, fast + gamma / (beta * h) * moved, pushed + moved / (beta * h * h)
            held = resisting(state, speed)[0]
            kept.append(state)
        last = np.array(kept[-round(steps / periods) :])
        return self._measured(h * np.arange(steps - len(last) + 1.0, steps + 1.0), last[:, ::2], last[:, 1::2])


class Measured(NamedTuple):
    """Largest force and moment, range of the moment, and touchdown points (k,) at the times (k,) of the last period."""

    force: float
    moment: float
    range: float
    touchdown: Floats
    times: Floats

    def errors(self, fine: Measured) -> tuple[float, float, float]:
        """Errors of touchdown (over its travel), range and force against a finer run."""
        missed = self.touchdown - np.interp(self.times, fine.times, fine.touchdown)
        return (
            float((missed**2).mean() ** 0.5 / np.ptp(fine.touchdown)),
            self.range / fine.range - 1.0,
            self.force / fine.force - 1.0,
        )
