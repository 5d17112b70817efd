"""Explicit Runge-Kutta schemes from their Butcher tables.

Inside a step the force sees the history that the step began with; what a step leaves behind is that of its end.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.schemes.system import Motion, Step, System


@dataclass(frozen=True, slots=True)
class RungeKutta:
    """Coefficients.

    Attributes:
        stages: rows of the table below the first: the weights with which a stage takes the rates of those before it.
        weights: of the rates of all stages in the step.
    """

    name: str
    title: str
    stages: tuple[tuple[float, ...], ...]
    weights: tuple[float, ...]
    limit: float
    explicit: bool = True

    def step(self, system: System, motion: Motion, dt: float | FloatArray) -> Step:
        """See `Scheme`. The acceleration of the step before is the rate of the first stage."""
        speeds, accelerations = [motion.velocity], [motion.acceleration]
        for row in self.stages:
            position = motion.position + dt * _mixed(row, speeds)
            speed = motion.velocity + dt * _mixed(row, accelerations)
            forces = system.forces(position, speed, motion.history)
            speeds.append(speed)
            accelerations.append(forces.force / system.mass)
        position = motion.position + dt * _mixed(self.weights, speeds)
        velocity = motion.velocity + dt * _mixed(self.weights, accelerations)
        end = system.forces(position, velocity, motion.history)
        after = Motion(position, velocity, end.force / system.mass, end.force, end.history)
        none = np.zeros(position.shape, np.intp)
        return Step(after, len(self.stages) + 1, none, np.zeros(position.shape))


def _mixed(weights: tuple[float, ...], rates: list[FloatArray]) -> FloatArray:
    mixed = np.zeros(rates[0].shape)
    for weight, rate in zip(weights, rates, strict=True):
        if weight:
            mixed += weight * rate
    return mixed
