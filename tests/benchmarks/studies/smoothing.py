"""The quadratic zone around the mudline: penetration, Newton iterations and landings against its half width h."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from mudline.contact.arrays import FloatArray
from tests.benchmarks.studies.laws import LinearLaw, smoothed_spring
from tests.benchmarks.studies.motions import PUBLISHED
from tests.benchmarks.studies.newton import Newton
from tests.benchmarks.studies.schemes import SCHEMES
from tests.benchmarks.studies.steps import tried
from tests.benchmarks.tables import digits, load, save, table

REST, IMPACTS = "precision-smoothing", "precision-impacts"
WIDTHS: FloatArray = np.array([0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2])
"""m."""
STIFFNESS, SPRING, LOAD, START = 5e7, 1e3, 500.0, 0.2
"""The published case: a seabed (N/m), a structural spring (N/m), a load (N), and where Newton's method starts (m)."""
SHARES = (0.0, 0.03, 0.1, 0.3, 1.0)
"""Half widths over the deepest penetration of an impact."""


def at_rest(widths: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Penetrations, and Newton iterations from above the seabed and from below, for each half width."""
    both = np.concatenate([widths, widths])

    def residual(z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        force, slope = smoothed_spring(z, STIFFNESS, both)
        return SPRING * z + force - LOAD, SPRING + slope, np.abs(force) + LOAD

    start = np.repeat([-START, START], len(widths))
    found = Newton(most=200).solve(residual, start)
    above, below = np.split(found.iterations, 2)
    return found.root[: len(widths)], above, below


def run(progress: Callable[[str], None]) -> None:
    """Write tables."""
    progress("smoothing")
    heads = ("half width [m]", "penetration [m]", "iterations from above", "from below")
    save(REST, heads, zip(WIDTHS.tolist(), *(part.tolist() for part in at_rest(WIDTHS)), strict=True))
    stiffness = PUBLISHED.law.steepest
    deepest = PUBLISHED.speed * math.sqrt(PUBLISHED.mass / stiffness)
    rows = []
    for share in SHARES:
        drop = replace(PUBLISHED, weight=0.0, law=LinearLaw(stiffness, share * deepest))
        found = tried(drop.case("impact"), SCHEMES["newmark"], 0.5)
        rows.append([share, found.speed, found.work])
    save(IMPACTS, ("half width / penetration", "error of the rebound speed", "evaluations a period"), rows)


def _all(name: str) -> str:
    rows = load(name)
    return table(list(rows[0]), [[digits(cell, 5) for cell in row.values()] for row in rows])


TABLES = {"smoothing": lambda: _all(REST), "impacts": lambda: _all(IMPACTS)}
