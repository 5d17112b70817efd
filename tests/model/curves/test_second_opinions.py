"""Ratios at a force in exact rationals."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from mudline.model.curves import ForceCurve

SEEDS = range(60)


def drawn(seed: int) -> tuple[ForceCurve, np.random.Generator]:
    """A curve of 2 to 12 points, which may fall, and what drew it."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 13))
    ratios = np.cumsum(rng.uniform(0.01, 0.5, count)) - rng.uniform(0.0, 0.6)
    return ForceCurve(np.column_stack([ratios, rng.uniform(-1e3, 1e4, count)])), rng


@pytest.mark.parametrize("seed", SEEDS)
def test_ratios_at_a_force_in_exact_rationals(seed: int) -> None:
    curve, rng = drawn(seed)
    points = [(Fraction(ratio), Fraction(force)) for ratio, force in zip(curve.ratios, curve.forces, strict=True)]
    ends = [(points[0][0] - 100, points[1][0]), (points[-2][0], points[-1][0] + 100)]
    for wanted in map(float, rng.uniform(-2e3, 1.2e4, 5)):
        exact = set()
        for number, ((low, low_force), (high, high_force)) in enumerate(pairwise(points)):
            slope = (high_force - low_force) / (high - low)
            ratio = low + (Fraction(wanted) - low_force) / slope
            first, last = number == 0, number == len(points) - 2
            if (first or ratio >= low) and (last or ratio <= high):
                exact.add(ratio)
        found = [one for one in curve.ratios_at_force(wanted) if ends[0][0] <= one <= ends[1][1]]
        near = sorted(one for one in exact if ends[0][0] <= one <= ends[1][1])
        assert len(found) == len(near)
        assert all(
            abs(Fraction(one) - other) <= Fraction(1, 10**12) * (1 + abs(other))
            for one, other in zip(found, near, strict=True)
        )
