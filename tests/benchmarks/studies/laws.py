"""Elastic normal laws of a mass on the seabed, with the work that they store."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.curves import ForceCurve
from tests.benchmarks.studies.motion import Forces, History

CLAY = ForceCurve(
    [(0.0, 0.0), (0.01, 450.0), (0.02, 640.0), (0.05, 1030.0), (0.1, 1480.0), (0.2, 1800.0), (0.5, 2450.0)],
    name="soft clay",
)
"""N/m over the embedment ratio: made up for these studies, as steep at the mudline as measured ones."""
DIAMETER, MASS, WEIGHT = 0.3, 169.5, 953.0
"""Of the pipe on it: m, kg/m, and N/m in water."""


@dataclass(frozen=True, slots=True)
class LinearLaw:
    """k z. A law gives the force per unit length over the penetration z > 0; above the mudline there is none."""

    stiffness: float

    def spring(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Force and d force / d z at penetrations (k,)."""
        below = z > 0.0
        return np.where(below, self.stiffness * z, 0.0), np.where(below, self.stiffness, 0.0)

    def work(self, z: FloatArray) -> FloatArray:
        """Work from the mudline to z, exactly; 0 above it."""
        return 0.5 * self.stiffness * np.maximum(z, 0.0) ** 2

    @property
    def steepest(self) -> float:
        """The largest slope."""
        return self.stiffness


@dataclass(frozen=True, slots=True)
class CurveLaw:
    """A force-embedment curve on a pipe of a diameter."""

    curve: ForceCurve
    diameter: float

    def spring(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See `LinearLaw`."""
        below = z > 0.0
        force, slope = self.curve.evaluate(np.where(below, z, 0.0) / self.diameter)
        return np.where(below, force, 0.0), np.where(below, slope / self.diameter, 0.0)

    def work(self, z: FloatArray) -> FloatArray:
        """See `LinearLaw`: sums of trapezoids, which are exact between points."""
        at = np.maximum(z, 0.0) / self.diameter
        knots = np.concatenate([[0.0], self.curve.ratios[self.curve.ratios > 0.0]])
        forces = self.curve.evaluate(knots)[0]
        sums = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(knots) * (forces[1:] + forces[:-1]))])
        left = np.searchsorted(knots[1:], at, side="right")
        rest = 0.5 * (at - knots[left]) * (forces[left] + self.curve.evaluate(at)[0])
        work: FloatArray = (sums[left] + rest) * self.diameter
        return work

    @property
    def steepest(self) -> float:
        """See `LinearLaw`."""
        return float(np.abs(self.curve.slopes).max() / self.diameter)


Law = LinearLaw | CurveLaw


@dataclass(frozen=True, slots=True)
class Falling:
    """Masses (k,) on the seabed of a law, under a weight in water."""

    mass: FloatArray
    law: Law
    weight: float

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        force, slope = self.law.spring(-position)
        return Forces(force - self.weight, -slope, np.zeros(velocity.shape), history)
