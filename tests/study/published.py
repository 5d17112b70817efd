"""What the published pages are about, written down once more without the code of the studies.

The built-in pipe, one-sided seabeds, and the schemes as their definitions have them, for many masses side by side.
"""

from __future__ import annotations

import csv
from math import pi
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

DOCS = Path(__file__).parents[2] / "docs" / "studies"

DIAMETER = 0.3
MASS = 7850.0 * 0.25 * pi * (0.3**2 - 0.25**2)
WEIGHT = 9.81 * (MASS - 1025.0 * 0.25 * pi * DIAMETER**2)
RATIOS = np.array([0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5])
FORCES = np.array([0.0, 450.0, 640.0, 1030.0, 1480.0, 1800.0, 2450.0])

AVERAGED = {
    "Newmark": (0.0, 0.0, 0.25, 0.5),
    "HHT (-0.3)": (0.0, 0.3, 1.3**2 / 4.0, 0.8),
    "generalised-alpha (1)": (0.5, 0.5, 0.25, 0.5),
    "generalised-alpha (0.5)": (0.0, 1.0 / 3.0, (4.0 / 3.0) ** 2 / 4.0, 5.0 / 6.0),
    "generalised-alpha (0)": (-1.0, 0.0, 1.0, 1.5),
    "backward Euler": (0.0, 0.0, 1.0, 1.0),
}
"""Shares of the old acceleration and of the old force; beta and gamma. Backward Euler takes no old acceleration."""


def read(name: str) -> list[dict[str, str]]:
    """The rows of a table of the documentation."""
    with (DOCS / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Bed:
    """A one-sided seabed of straight segments, force over depth, the last one continued."""

    def __init__(self, depths: Floats, forces: Floats) -> None:
        self.depths, self.forces = depths, forces
        slopes = np.diff(forces) / np.diff(depths)
        self.slopes = np.append(slopes, slopes[-1])
        self.works = np.append(0.0, np.cumsum(np.diff(depths) * 0.5 * (forces[1:] + forces[:-1])))

    def _segment(self, depth: Floats) -> NDArray[np.intp]:
        return np.clip(np.searchsorted(self.depths, depth, side="right") - 1, 0, len(self.depths) - 1)

    def force(self, height: Floats) -> Floats:
        """Upwards, at heights above the seabed."""
        at = self._segment(-height)
        return np.where(height < 0.0, self.forces[at] + self.slopes[at] * (-height - self.depths[at]), 0.0)

    def work(self, height: Floats) -> Floats:
        """Stored on the way down to a height."""
        at, depth = self._segment(-height), -height
        into = depth - self.depths[at]
        stored = self.works[at] + self.forces[at] * into + 0.5 * self.slopes[at] * into**2
        return np.where(height < 0.0, stored, 0.0)

    def balanced(self, free: Floats, by: float, inertia: float, load: Floats, share: float) -> Floats:
        """The acceleration a with inertia a = load + share force(free + by a): the one segment that it lies on."""
        new = load / inertia
        found = free + by * new >= 0.0
        ends = np.append(self.depths[1:], np.inf)
        for at, (start, end) in enumerate(zip(self.depths, ends, strict=True)):
            slope = self.slopes[at]
            constant = self.forces[at] - slope * (start + free)
            tried = (load + share * constant) / (inertia + share * slope * by)
            depth = -(free + by * tried)
            mine = ~found & (depth >= start) & (depth < end)
            new, found = np.where(mine, tried, new), found | mine
        return new


def linear(stiffness: float) -> Bed:
    """A seabed of one stiffness."""
    return Bed(np.array([0.0, 1.0]), np.array([0.0, stiffness]))


def soft_clay() -> Bed:
    """The curve of the built-in deck."""
    return Bed(RATIOS * DIAMETER, FORCES)


class Falling(NamedTuple):
    """What falls on what."""

    bed: Bed
    mass: float
    weight: float


def fall(scheme: str, what: Falling, height: Floats, speed: Floats, dt: float, steps: int) -> tuple[Floats, Floats]:
    """Heights and velocities (steps + 1, k) of masses that start at heights with upward speeds."""
    (bed, mass, weight), x, v = what, height, speed
    force = bed.force(x) - weight
    a = force / mass
    heights, speeds = [x], [v]

    def rate(at: Floats) -> Floats:
        return (bed.force(at) - weight) / mass

    for _ in range(steps):
        if scheme == "velocity Verlet":
            half = v + 0.5 * dt * a
            x = x + dt * half
            a = rate(x)
            v = half + 0.5 * dt * a
        elif scheme == "RK4":
            k1 = v, rate(x)
            k2 = v + 0.5 * dt * k1[1], rate(x + 0.5 * dt * k1[0])
            k3 = v + 0.5 * dt * k2[1], rate(x + 0.5 * dt * k2[0])
            k4 = v + dt * k3[1], rate(x + dt * k3[0])
            x = x + dt / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0])
            v = v + dt / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1])
        else:
            of_mass, of_force, beta, gamma = AVERAGED[scheme]
            old = 0.0 if scheme == "backward Euler" else 0.5 - beta
            free = x + dt * v + dt * dt * old * a
            load = of_force * force - of_mass * mass * a - (1.0 - of_force) * weight
            new = bed.balanced(free, beta * dt * dt, (1.0 - of_mass) * mass, load, 1.0 - of_force)
            x = free + beta * dt * dt * new
            v = v + dt * ((1.0 - gamma) * a + gamma * new)
            a, force = new, bed.force(x) - weight
        heights.append(x)
        speeds.append(v)
    return np.array(heights), np.array(speeds)


def oscillation(scheme: str, omega: float, rate: float, dt: float) -> Floats:
    """The matrix that takes a small motion x'' = -omega^2 x - rate x' over a step."""
    if scheme in {"RK4", "RK2 (midpoint)", "forward Euler"}:
        order = {"RK4": 4, "RK2 (midpoint)": 2, "forward Euler": 1}[scheme]
        step = dt * np.array([[0.0, 1.0], [-omega * omega, -rate]])
        total, term = np.eye(2), np.eye(2)
        for power in range(1, order + 1):
            term = term @ step / power
            total = total + term
        return total
    ahead = {"central difference": 0.0, "velocity Verlet": 0.5}[scheme]
    columns = []
    for x, v, a in np.eye(3):
        half = v + 0.5 * dt * a
        place = x + dt * half
        new = -omega * omega * place - rate * (half + ahead * dt * a)
        columns.append([place, half + 0.5 * dt * new, new])
    return np.array(columns).T


def growth(scheme: str, omega: float, rate: float, dt: float) -> float:
    """By how much the largest part of a small motion grows in a step."""
    scale = max(omega, rate)
    return float(np.abs(np.linalg.eigvals(oscillation(scheme, omega / scale, rate / scale, dt * scale))).max())
