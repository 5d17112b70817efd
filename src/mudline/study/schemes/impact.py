"""A mass that hits an elastic seabed, without gravity or damping: how fast it leaves, over how fast it came.

Exactly it is 1. What a scheme makes of it depends on omega dt and on the landing phase alone: the share of a step that
is left when the seabed is reached.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.schemes.marching import march
from mudline.study.schemes.system import Forces, History, Motion, Scheme

_SETTLING = 64
"""Steps besides those of the contact: backward Euler creeps out of the seabed at large steps, and the acceleration that
the generalised-alpha scheme carries along dies away by the half in each."""


@dataclass(frozen=True, slots=True)
class ElasticBed:
    """m a = k max(-x, 0): a seabed below x = 0."""

    mass: FloatArray
    stiffness: FloatArray

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        below = position < 0.0
        force = np.where(below, -self.stiffness * position, 0.0)
        return Forces(force, np.where(below, -self.stiffness, 0.0), np.zeros(velocity.shape), history)


def restitution(scheme: Scheme, omega_dt: float, phases: FloatArray) -> FloatArray:
    """Speed after over speed before contact for landing phases (k,) in (0, 1); NaN where the mass never left again.

    The speed after is that of the free flight, when the acceleration that a scheme carries along has died away.
    """
    system = ElasticBed(np.ones(len(phases)), np.full(len(phases), omega_dt * omega_dt))
    start = Motion.start(system, np.asarray(phases, np.float64), np.full(len(phases), -1.0))
    run = march(scheme, system, start, 1.0, int(np.ceil(2.0 * np.pi / omega_dt)) + _SETTLING)
    left = (run.position[-1] > 0.0) & (run.velocity[-1] > 0.0)
    return np.where(left, run.velocity[-1], np.nan)
