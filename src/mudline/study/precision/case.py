"""A motion of a mass per unit length on the seabed, whose outcome is known: what the schemes are tried on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.study.motion import Motion, System, Trajectory

RUNS = 8
"""Runs side by side, which land at other phases of a step; the worst of them counts."""


class Start(NamedTuple):
    """Where the runs begin, and the step of each (k,)."""

    motion: Motion
    dt: FloatArray


@dataclass(frozen=True, slots=True)
class Case:
    """A motion.

    Attributes:
        name: a word for tables.
        title: for people.
        quantities: names of the three errors that are measured, each relative to the exact value.
        reference: where the exact values come from.
        system: `RUNS` copies of the mass.
        omega: square root of the steepest stiffness over the mass, 1/s.
        duration: seconds that the motion takes.
        bound: positions beyond this have run away.
        start: the start of the runs for a nominal step.
        errors: (3, k) amounts of the errors; NaN where the motion did not get so far.
        missing: what NaN means.
    """

    name: str
    title: str
    quantities: tuple[str, str, str]
    reference: str
    system: System
    omega: float
    duration: float
    bound: float
    start: Callable[[float], Start]
    errors: Callable[[Trajectory], FloatArray]
    missing: str


def uneven(dt: float) -> FloatArray:
    """Steps (k,) up to 18 % shorter than dt: events of a motion that always begins alike fall at other phases."""
    return dt * (1.0 - np.arange(RUNS) / 40.0)
