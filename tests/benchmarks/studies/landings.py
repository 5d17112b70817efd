"""Energy at touchdown: a mass lands on an elastic seabed at every phase of a step, and should rebound as fast.

The seabed is elastic, without gravity or damping. On a linear one the outcome of a scheme depends on omega dt and on
the landing phase alone: the share of a step that is left when the seabed is reached. HHT and generalised-alpha average
the forces of both ends of a step.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import BoolArray, FloatArray
from tests.benchmarks.studies import schemes
from tests.benchmarks.studies.laws import CLAY, DIAMETER, JUMPING, MASS, CurveLaw, Falling, Law, LinearLaw
from tests.benchmarks.studies.motion import Motion, Scheme, march
from tests.benchmarks.tables import digits, load, save, table

LIMITS = "stability-landing-limits"
SCHEMES = [scheme for scheme in schemes.SCHEMES.values() if scheme.limit > 0.0 and scheme.name != "central-difference"]
"""Those that are stable on an oscillator at some step; on springs the central difference is velocity Verlet."""
ALLOWED = 0.01
"""Gain, or gain and loss, that a limit allows."""
TRIED: FloatArray = np.unique(
    [
        *np.geomspace(0.02, 0.1, 120),
        *np.pi / np.arange(31.4, 5.2, -0.1),
        *np.geomspace(0.6, 100.0, 60),
        *(0.0316, 0.0567, 1.99, 1.9999),
    ]
)
"""omega dt at which the landings of a scheme are tried, up to its critical one.

The outcome depends on pi / (omega dt) too, the steps of a landing: the values are dense where limits are expected.
"""
PHASES: FloatArray = (np.arange(64) + 0.5) / 64
_SETTLING = 64
"""Steps after those of the contact: backward Euler creeps out of the seabed at large steps, and the acceleration of the
generalised-alpha scheme is halved in each."""


class Fall(NamedTuple):
    """A mass that lands at a speed on an elastic seabed; `depth` is its approximate penetration."""

    law: Law
    mass: float
    speed: float
    depth: float

    @property
    def omega(self) -> float:
        """By the steepest slope of the law."""
        return math.sqrt(self.law.steepest / self.mass)


LINEAR = Fall(LinearLaw(1.0), 1.0, 1.0, 1.0)
SEABEDS = {
    "linear": LINEAR,
    "soft clay": Fall(CurveLaw(CLAY, DIAMETER), MASS, 0.35, 0.06),
    "soft clay with a jump": Fall(CurveLaw(JUMPING, DIAMETER), MASS, 0.35, 0.06),
}


def rebounds(scheme: Scheme, fall: Fall, omega_dt: FloatArray, phases: FloatArray) -> FloatArray:
    """Speed after over speed before contact (k, p) for steps (k,) and landing phases (p,) in (0, 1).

    NaN where the mass never left again, or where the scheme is unstable in contact. The speed after is that of the free
    flight, when the acceleration that a scheme carries along has died away.
    """
    dt = np.repeat(omega_dt / fall.omega, len(phases))
    system = Falling(np.full(len(dt), fall.mass), fall.law)
    high = np.tile(phases, len(omega_dt)) * dt * fall.speed
    start = Motion.start(system, high, np.full(len(dt), -fall.speed))
    steps = math.ceil(2.0 * math.pi * fall.depth / fall.speed * fall.omega / float(omega_dt.min())) + _SETTLING
    end = march(scheme, system, start, dt, steps)
    left = (end.position > 0.0) & (end.velocity > 0.0) & np.repeat(omega_dt <= scheme.limit, len(phases))
    return np.where(left, end.velocity / fall.speed, np.nan).reshape(len(omega_dt), -1)


class Envelope(NamedTuple):
    """Landings of a scheme over omega dt: least and largest speed after over before, of some landing phases."""

    omega_dt: FloatArray
    least: FloatArray
    largest: FloatArray

    @classmethod
    def of(cls, scheme: Scheme, fall: Fall) -> Envelope:
        """At all of `TRIED` below the critical step of a scheme; few of them at a time have about as many steps."""
        omega_dt = TRIED[scheme.limit > TRIED]
        speeds = np.concatenate([rebounds(scheme, fall, part, PHASES) for part in np.array_split(omega_dt, 16)])
        return cls(omega_dt, np.nanmin(speeds, axis=1), np.nanmax(speeds, axis=1))

    def up_to(self, good: BoolArray) -> float | None:
        """Largest omega dt tried up to which all are good; None where the first is not."""
        count = len(good) if good.all() else int(np.argmin(good))
        return float(self.omega_dt[count - 1]) if count else None


def run(progress: Callable[[str], None]) -> None:
    """Write the table."""
    progress("landings")
    limits = []
    for seabed, fall in SEABEDS.items():
        for scheme in SCHEMES:
            progress(f"landings on {seabed}: {scheme.title}")
            found = Envelope.of(scheme, fall)
            low, high = found.largest <= 1.0 + ALLOWED, found.least >= 1.0 - ALLOWED
            best = int(np.argmax(found.largest))
            extreme = [float(found.largest[best]), float(found.omega_dt[best]), float(found.least.min())]
            limits.append([seabed, scheme.title, found.up_to(low), found.up_to(low & high), *extreme])
    heads = ("seabed", "scheme", "below 1.01 up to [-]", "within 1 % up to [-]", "largest [-]", "at omega dt [-]",
             "least [-]")  # fmt: skip
    save(LIMITS, heads, limits)


def _limits() -> str:
    last = digits(TRIED[-1])

    def limit(cell: str) -> str:
        return "none" if not cell else "all tried" if digits(cell) == last else digits(cell)

    head = ["scheme", "below 1.01 up to", "within 1 % up to", "largest", "at omega dt", "least"]
    rows = [row for row in load(LIMITS) if row["seabed"] == "linear"]
    return table(
        head,
        [
            [
                row["scheme"],
                *(limit(row[key]) for key in ("below 1.01 up to [-]", "within 1 % up to [-]")),
                f"{float(row['largest [-]']):.5f}",
                digits(row["at omega dt [-]"]),
                f"{float(row['least [-]']):.4f}",
            ]
            for row in rows
        ],
    )


TABLES = {"landing-limits": _limits}
