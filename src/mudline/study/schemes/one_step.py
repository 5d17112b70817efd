"""Implicit linear one-step schemes, solved by Newton's method for the acceleration at the end of the step.

    x1 = x0 + dt v0 + dt^2 (p0 a0 + p1 a1)
    v1 = v0 + dt (q0 a0 + q1 a1)
    m (i0 a0 + i1 a1) = g1 f(x1, v1) + g0 f(x0, v0)

The force is averaged, not evaluated at an averaged position: for contact that opens or closes within the step the two
differ. The unknown is the acceleration: so the residual has no difference of positions over dt^2, which would be
round-off at small steps.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.schemes.newton import Newton
from mudline.study.schemes.system import Forces, Motion, Step, System

Pair = tuple[float, float]
"""Shares of the old and of the new value."""


@dataclass(frozen=True, slots=True)
class OneStep:
    """Coefficients.

    Attributes:
        position: p0, p1.
        velocity: q0, q1.
        inertia: i0, i1.
        load: g0, g1.
        newton: how a step is solved.
    """

    name: str
    title: str
    position: Pair
    velocity: Pair
    inertia: Pair = (0.0, 1.0)
    load: Pair = (0.0, 1.0)
    newton: Newton = field(default_factory=lambda: Newton(least=1))
    limit: float = float("inf")
    explicit: bool = False

    def solved_by(self, newton: Newton) -> OneStep:
        """The same scheme with another way to iterate."""
        return replace(self, newton=newton)

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Step:
        """See `Scheme`. Newton's method starts from the acceleration of the step before."""
        balance = _Balance(self, system, motion, dt)
        solution = self.newton.solve(balance, motion.acceleration)
        end = Motion(*balance.at(solution.root), solution.root, balance.forces.force, balance.forces.history)
        return Step(end, solution.evaluations, solution.iterations, solution.residual)


class _Balance:
    """The balance of forces at the end of a step, over the acceleration there; keeps the forces it saw last."""

    forces: Forces

    def __init__(self, scheme: OneStep, system: System, motion: Motion, dt: float | FloatArray) -> None:
        self._scheme, self._system, self._history = scheme, system, motion.history
        old, mass = motion.acceleration, system.mass
        self._position = motion.position + dt * motion.velocity + scheme.position[0] * dt * dt * old
        self._velocity = motion.velocity + scheme.velocity[0] * dt * old
        self._by_position, self._by_velocity = scheme.position[1] * dt * dt, scheme.velocity[1] * dt
        self._inertia = scheme.inertia[1] * mass
        self._known = scheme.inertia[0] * mass * old - scheme.load[0] * motion.force

    def at(self, new: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Position and velocity that go with an acceleration at the end."""
        return self._position + self._by_position * new, self._velocity + self._by_velocity * new

    def __call__(self, new: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """See `Residual`."""
        self.forces = found = self._system.forces(*self.at(new), self._history)
        share = self._scheme.load[1]
        inertia, load = self._inertia * new, share * found.force
        tangent = found.by_position * self._by_position + found.by_velocity * self._by_velocity
        size = np.maximum(np.abs(inertia), np.maximum(np.abs(load), np.abs(self._known)))
        return inertia + self._known - load, self._inertia - share * tangent, size
