"""What a scheme does to an undamped linear oscillator: its amplification matrix and the spectral radius of that."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.schemes.system import Forces, History, Motion, Scheme


@dataclass(frozen=True, slots=True)
class Oscillators:
    """Undamped oscillators m a = -k x.

    Attributes:
        mass: (k,).
        stiffness: (k,) force per length.
    """

    mass: FloatArray
    stiffness: FloatArray

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        return Forces(-self.stiffness * position, -self.stiffness, np.zeros(velocity.shape), history)


def amplification(scheme: Scheme, omega_dt: float) -> FloatArray:
    """The matrix (3, 3) that takes (x, dt v, dt^2 a) over one step of omega dt."""
    system = Oscillators(np.ones(3), np.full(3, omega_dt * omega_dt))
    unit = np.eye(3)
    after = scheme.step(system, Motion(unit[0], unit[1], unit[2], -system.stiffness * unit[0], None), 1.0).motion
    return np.array([after.position, after.velocity, after.acceleration])


def spectral_radius(scheme: Scheme, omega_dt: float) -> float:
    """Factor by which the largest part of an undamped oscillation grows in a step: above 1, the scheme is unstable."""
    return float(np.abs(np.linalg.eigvals(amplification(scheme, omega_dt))).max())
