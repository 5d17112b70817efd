"""Critical steps: each scheme steps an oscillator with a spring and a damper just below and above the predicted one."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from tests.benchmarks.studies.limits import critical_step
from tests.benchmarks.studies.motion import Forces, History, Motion, Scheme, march
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.tables import Cell, save

NAME = "stability-critical-steps"
SHARES = (0.99, 1.01)
"""Of the predicted step."""
GROWTH, STEPS, FAR = 100.0, 6000, 100.0
"""A motion that exceeds its first amplitude by this factor grows; steps, of implicit schemes a few; their omega dt."""
CONTACTS = {"spring": (1.0, 0.0), "damper": (0.0, 1.0), "both": (1.0, 1.0), "half the damping": (1.0, 0.5)}
"""omega and c / m, 1/s."""


class Oscillator(NamedTuple):
    """x'' = -omega^2 x - gamma x', so many side by side."""

    omega: float
    gamma: float
    mass: FloatArray

    def forces(self, position: FloatArray, velocity: FloatArray, history: History) -> Forces:
        """See `System`."""
        ones = np.ones(position.shape)
        force = -(self.omega**2) * position - self.gamma * velocity
        return Forces(force, -(self.omega**2) * ones, -self.gamma * ones, history)


def grows(scheme: Scheme, omega: float, gamma: float, dt: FloatArray) -> list[bool]:
    """Whether a motion grows at each of the steps (k,)."""
    system = Oscillator(omega, gamma, np.ones(len(dt)))
    # without the acceleration of the force: at the critical step it would take all of the speed
    start = Motion.start(system, 0.0 * dt, np.ones(len(dt)))._replace(acceleration=0.0 * dt)
    run = march(scheme, system, start, dt, STEPS if scheme.explicit else STEPS // 30)
    largest = np.nanmax(np.abs(np.stack([run.velocity, run.position / dt])), axis=(0, 1))
    grown: list[bool] = (run.failed | (largest > GROWTH * max(1.0, float(dt.max() * omega)))).tolist()
    return grown


def run(progress: Callable[[str], None]) -> None:
    """Write the table."""
    progress("critical steps")
    rows: list[list[Cell]] = []
    for scheme in SCHEMES.values():
        for name, (omega, gamma) in CONTACTS.items():
            limit = critical_step(scheme.name, omega, gamma)
            tried = np.array([FAR]) if limit == np.inf else np.array(SHARES) * limit if limit else np.array([1.0])
            rows.append([scheme.title, name, limit, *(str(one) for one in grows(scheme, omega, gamma, tried))])
    save(NAME, ("scheme", "contact", "critical step [s]", "grows below", "grows above"), rows)
