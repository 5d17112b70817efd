"""Explicit schemes of second order that kick (velocity) and drift (position) in turn: one force a step.

v* = v0 + before dt a0                        kick
x1 = x0 + dt v*                               drift
a1 = f(x1, v* + ahead dt a0) / m
v1 = v* + after dt a1                         kick
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.schemes.system import Motion, Step, System


@dataclass(frozen=True, slots=True)
class KickDrift:
    """Coefficients.

    Attributes:
        before: share of the step of the first kick.
        after: share of the step of the second kick.
        ahead: share of the step by which the velocity that the force sees is ahead of the first kick.
    """

    name: str
    title: str
    before: float
    after: float
    ahead: float
    limit: float
    explicit: bool = True

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Step:
        """See `Scheme`."""
        kicked = motion.velocity + self.before * dt * motion.acceleration
        position = motion.position + dt * kicked
        forces = system.forces(position, kicked + self.ahead * dt * motion.acceleration, motion.history)
        acceleration = forces.force / system.mass
        velocity = kicked + self.after * dt * acceleration
        none = np.zeros(position.shape, np.intp)
        after = Motion(position, velocity, acceleration, forces.force, forces.history)
        return Step(after, 1, none, np.zeros(position.shape))
