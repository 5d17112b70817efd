"""Elastic normal laws of a mass on the seabed."""

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
JUMPING = ForceCurve([(0.0, 300.0), *zip(CLAY.ratios.tolist()[1:], CLAY.forces.tolist()[1:], strict=True)])
"""The same with a force at ratio 0, where it begins."""
DIAMETER, MASS = 0.3, 169.5
"""Of the pipe on it: m, kg/m."""


@dataclass(frozen=True, slots=True)
class LinearLaw:
    """k z. A law gives the force per unit length over the penetration z > 0; above the mudline there is none."""

    stiffness: float

    def spring(self, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Force and d force / d z at penetrations (k,)."""
        below = z > 0.0
        return np.where(below, self.stiffness * z, 0.0), np.where(below, self.stiffness, 0.0)

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

    @property
    def steepest(self) -> float:
        """See `LinearLaw`."""
        return float(np.abs(self.curve.slopes).max() / self.diameter)


Law = LinearLaw | CurveLaw


@dataclass(frozen=True, slots=True)
class Falling:
    """Masses (k,) on the seabed of a law, without weight."""

    mass: FloatArray
    law: Law

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        force, slope = self.law.spring(-position)
        return Forces(force, -slope, np.zeros(velocity.shape), history)
