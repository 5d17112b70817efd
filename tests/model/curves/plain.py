"""The curve law written down as plainly as numpy allows, and curves that are hard on a search."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import strategies as st

from mudline.model.curves import ForceCurve
from mudline.model.curves.points import FloatArray

LARGEST = 1e300


def plain_values(curve: ForceCurve, ratios: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Force and slope, one binary search for all."""
    point = np.searchsorted(curve.ratios[1:], ratios, side="right")
    slope = np.append(curve.slopes, curve.slopes[-1])[point]
    return curve.forces[point] + slope * (ratios - curve.ratios[point]), slope


def steps(start: float, count: int) -> list[float]:
    """Numbers one ulp apart."""
    found = [start]
    while len(found) < count:
        found.append(math.nextafter(found[-1], math.inf))
    return found


def _geometric(first: float, factor: float, count: int) -> list[float]:
    found = [first]
    while len(found) < count and found[-1] < LARGEST / factor:
        found.append(found[-1] * factor)
    return found


FINITE = st.floats(-LARGEST, LARGEST)
COUNTS = st.integers(1, 60)
CLUSTERS = st.one_of(
    st.builds(steps, st.one_of(FINITE, st.floats(-1.0, 1.0), st.floats(-1e-310, 1e-310)), COUNTS),
    st.builds(lambda first, width, count: np.linspace(first, first + width, count).tolist(), FINITE, FINITE, COUNTS),
    st.builds(_geometric, st.floats(5e-324, 1.0), st.floats(1.001, 1e6), COUNTS),
    st.builds(
        lambda numbers: [-number for number in numbers],
        st.builds(_geometric, st.just(1e-9), st.floats(1.001, 1e6), COUNTS),
    ),
    st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=40),
    st.lists(st.floats(-1e-320, 1e-320), min_size=1, max_size=40),
    st.lists(FINITE, min_size=1, max_size=10),
)


def _joined(clusters: list[list[float]]) -> FloatArray:
    return np.unique(np.array([number + 0.0 for cluster in clusters for number in cluster]))


POINTS = st.lists(CLUSTERS, min_size=1, max_size=4).map(_joined).filter(lambda points: len(points) >= 3)
"""Ascending ratios: evenly and geometrically spaced, next to each other, subnormal, huge, and all of these together."""


def near(points: FloatArray, more: list[float]) -> FloatArray:
    """Ratios at the points, next to them, between them, and more."""
    middles = 0.5 * points[:-1] + 0.5 * points[1:]
    sides = [np.nextafter(points, side) for side in (-math.inf, math.inf)]
    return np.concatenate([points, *sides, middles, np.array([0.0, -0.0, *more])])
