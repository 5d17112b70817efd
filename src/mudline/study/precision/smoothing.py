"""The quadratic zone around the mudline: what its half width h costs in error and saves, or costs, in iterations."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.newton import Newton
from mudline.study.precision.case import Case
from mudline.study.precision.drop import Drop, drop_case
from mudline.study.precision.integration import StepRow, row
from mudline.study.precision.laws import LinearLaw, smoothed_spring
from mudline.study.schemes import SCHEMES

SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-6, 7)))
"""Half widths over the static penetration of the kinked law."""
WIDTHS = (0.0, 1e-6, 1e-4, 1e-3, 1e-2)
"""Half widths of the published case, m."""
_IMPACT_SHARES = (0.0, *(10.0 ** (power / 2.0) for power in range(-8, 1)))
_IMPACT_SCHEMES = ("newmark", "generalised-alpha-0.5", "backward-euler")
_IMPACT_STEPS = (0.1, 0.5)


class Rest(NamedTuple):
    """A node at rest between a structural spring, a load and a linear seabed: k_b z + F(z) = load."""

    name: str
    stiffness: float
    spring: float
    load: float
    start: float

    @property
    def kinked(self) -> float:
        """Penetration without smoothing."""
        return self.load / (self.stiffness + self.spring)


PUBLISHED = Rest("published case", 5e7, 1e3, 500.0, 0.2)


class RestRow(NamedTuple):
    """Penetration and Newton iterations from above and from below; the error is relative to the kinked law."""

    case: str
    half_width: float
    share: float
    penetration: float
    error: float
    from_above: int
    from_below: int


class ImpactRow(NamedTuple):
    """A drop on a smoothed seabed: half width over the penetration of the kinked law, and the errors of a scheme."""

    scheme: str
    omega_dt: float
    half_width: float
    share: float
    rebound: float | None
    iterations: float
    reason: str


def at_rest(rest: Rest, widths: FloatArray) -> Iterator[RestRow]:
    """Solve for every half width, from above the seabed and from below."""
    count = len(widths)
    both = np.concatenate([widths, widths])

    def residual(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        force, slope = smoothed_spring(z, rest.stiffness, both)
        return rest.spring * z + force - rest.load, rest.spring + slope, np.abs(force) + rest.load

    start = np.concatenate([np.full(count, -rest.start), np.full(count, rest.start)])
    solution = Newton(most=200).solve(residual, start)
    above, below = solution.iterations[:count], solution.iterations[count:]
    for index, width in enumerate(widths.tolist()):
        z = float(solution.root[index])
        error = abs(z / rest.kinked - 1.0)
        yield RestRow(rest.name, width, width / rest.kinked, z, error, int(above[index]), int(below[index]))


def impacts(drop: Drop) -> Iterator[ImpactRow]:
    """The same fall on seabeds of growing zones: how fast the mass leaves, and how many iterations a step takes."""
    stiffness = drop.law.steepest(0.0)
    for share in _IMPACT_SHARES:
        width = share * drop.deepest
        case = _smoothed(drop, stiffness, width)
        for name in _IMPACT_SCHEMES:
            for omega_dt in _IMPACT_STEPS:
                found: StepRow = row(case, SCHEMES[name], omega_dt)
                yield ImpactRow(name, omega_dt, width, share, found.errors[1], found.iterations, found.reason)


def _smoothed(drop: Drop, stiffness: float, width: float) -> Case:
    law = LinearLaw(f"h = {width:g}", stiffness, width)
    return drop_case("smoothed", law.name, Drop(law, drop.mass, 0.0, drop.speed, drop.deepest))


def weightless(drop: Drop) -> Drop:
    """The same without gravity, so that nothing but the impact is seen."""
    deepest = drop.speed * math.sqrt(drop.mass / drop.law.steepest(0.0))
    return Drop(drop.law, drop.mass, 0.0, drop.speed, deepest)
