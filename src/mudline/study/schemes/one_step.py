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
        mass, old = system.mass, motion.acceleration
        position0 = motion.position + dt * motion.velocity + self.position[0] * dt * dt * old
        velocity0 = motion.velocity + self.velocity[0] * dt * old
        by_position, by_velocity = self.position[1] * dt * dt, self.velocity[1] * dt
        known = self.inertia[0] * mass * old
        more = 0
        if self.load[0]:
            known = known - self.load[0] * system.forces(motion.position, motion.velocity, motion.history).force
            more = 1

        def forces_at(new: FloatArray) -> Forces:
            return system.forces(position0 + by_position * new, velocity0 + by_velocity * new, motion.history)

        def residual(new: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            found = forces_at(new)
            inertia, load = self.inertia[1] * mass * new, self.load[1] * found.force
            tangent = found.by_position * by_position + found.by_velocity * by_velocity
            size = np.maximum(np.abs(inertia), np.maximum(np.abs(load), np.abs(known)))
            return inertia + known - load, self.inertia[1] * mass - self.load[1] * tangent, size

        solution = self.newton.solve(residual, old)
        new = solution.root
        end = Motion(position0 + by_position * new, velocity0 + by_velocity * new, new, forces_at(new).history)
        return Step(end, solution.evaluations + more + 1, solution.iterations, solution.residual)
