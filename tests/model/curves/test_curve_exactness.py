"""Forces and slopes against exact rational arithmetic, over the whole range of a float64."""

from __future__ import annotations

import math
import sys
from bisect import bisect_right
from fractions import Fraction
from itertools import pairwise
from random import Random

import numpy as np
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from mudline.model.curves import CurveError, ForceCurve

EPS = Fraction(1, 2**52)
LARGEST = Fraction(sys.float_info.max)
SMALLEST_NORMAL = Fraction(sys.float_info.min)
LEAST = Fraction(1, 2**1074)

Point = tuple[float, float]


def scaled(largest_exponent: int) -> st.SearchStrategy[float]:
    """Numbers of either sign with every power of ten equally likely, and zero."""
    magnitudes = st.builds(
        lambda digits, exponent: float(f"{digits}e{exponent}"),
        st.floats(1.0, 9.999),
        st.integers(-largest_exponent, largest_exponent),
    )
    return st.one_of(st.just(0.0), magnitudes, magnitudes.map(lambda number: -number))


def with_neighbours(ratios: list[float]) -> list[float]:
    return sorted({near for ratio in ratios for near in (ratio, math.nextafter(ratio, math.inf))})


RATIOS = st.lists(scaled(300), min_size=2, max_size=24, unique=True).flatmap(
    lambda ratios: st.sampled_from([ratios, with_neighbours(ratios)])
)
ANY_FLOAT = st.floats(allow_nan=False, allow_infinity=False)


@st.composite
def curve_points(draw: st.DrawFn) -> list[Point]:
    ratios = draw(RATIOS)
    forces = st.one_of(scaled(300), scaled(5), ANY_FLOAT)
    return [(ratio, draw(forces)) for ratio in ratios]


@st.composite
def evaluable(draw: st.DrawFn) -> ForceCurve:
    """A curve that is not refused: forces of the order of the ratios, or any forces over moderate ratios."""
    if draw(st.booleans()):
        points = [(ratio, ratio * draw(scaled(5))) for ratio in draw(RATIOS)]
    else:
        ratios = draw(st.lists(st.floats(-2.0, 5.0).map(lambda ratio: ratio + 0.0), min_size=2, unique=True))
        points = [(ratio, draw(scaled(200))) for ratio in ratios]
    try:
        return ForceCurve(points)
    except CurveError:
        reject()


def exact_slope(left: Point, right: Point) -> Fraction:
    return (Fraction(right[1]) - Fraction(left[1])) / (Fraction(right[0]) - Fraction(left[0]))


def exact_parts(points: list[Point], ratio: float) -> tuple[Fraction, Fraction, Fraction]:
    """F_i, s_i (r - r_i) and s_i, with i as the definition of a curve has it; points are sorted."""
    index = max(bisect_right([point[0] for point in points], ratio) - 1, 0)
    segment = min(index, len(points) - 2)
    slope = exact_slope(points[segment], points[segment + 1])
    return Fraction(points[index][1]), slope * (Fraction(ratio) - Fraction(points[index][0])), slope


def queries(points: list[Point], more: list[float]) -> list[float]:
    ratios = [point[0] for point in points]
    near = [math.nextafter(ratio, side) for ratio in ratios for side in (-math.inf, math.inf)]
    middles = [0.5 * left + 0.5 * right for left, right in pairwise(ratios)]
    return [*ratios, *near, *middles, *more]


def assert_force_and_slope(points: list[Point], curve: ForceCurve, ratio: float) -> None:
    start, product, slope = exact_parts(points, ratio)
    exact = start + product
    try:
        found_force, found_slope = (Fraction(values.item()) for values in curve.evaluate(ratio))
    except ValueError:
        assert abs(exact) > LARGEST * (1 - 8 * EPS)
        return
    tolerance = 4 * EPS * (abs(start) + abs(product))
    if 0 < abs(product) < SMALLEST_NORMAL:
        tolerance += LEAST
    assert abs(found_force - exact) <= tolerance
    assert abs(found_slope - slope) <= 3 * Fraction(math.ulp(float(slope)))


@given(evaluable(), st.lists(st.one_of(scaled(307), ANY_FLOAT), max_size=20))
def test_force_and_slope_are_exact_to_rounding(curve: ForceCurve, more: list[float]) -> None:
    points = list(zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True))
    for ratio in queries(points, more):
        assert_force_and_slope(points, curve, ratio)


def refusal(points: list[Point]) -> str | None:
    try:
        ForceCurve(points)
    except CurveError as error:
        return error.code
    return None


@given(st.one_of(curve_points(), st.lists(st.tuples(ANY_FLOAT, ANY_FLOAT), min_size=2, max_size=6)))
def test_a_curve_is_refused_only_for_what_a_float64_cannot_hold(points: list[Point]) -> None:
    ordered = sorted({(ratio + 0.0, force + 0.0) for ratio, force in points})
    refused = refusal(points)
    if len({ratio for ratio, _ in ordered}) < len(ordered):
        assert refused == "CRV003"
    elif len(ordered) < 2:
        assert refused == "CRV001"
    elif refused is None:
        for ratio in queries(ordered, []):
            if math.isfinite(ratio):
                assert_force_and_slope(ordered, ForceCurve(points), ratio)
    else:
        edge = 1 + 4 * EPS
        widths = [Fraction(right[0]) - Fraction(left[0]) for left, right in pairwise(ordered)]
        slopes = [abs(exact_slope(left, right)) for left, right in pairwise(ordered)]
        assert refused == "CRV011"
        assert max(*widths, *slopes) * edge > LARGEST or any(0 < slope < SMALLEST_NORMAL * edge for slope in slopes)


@given(evaluable(), st.randoms(use_true_random=False))
def test_the_order_of_the_points_does_not_matter(curve: ForceCurve, random: Random) -> None:
    points = list(zip(curve.ratios.tolist(), curve.forces.tolist(), strict=True))
    points.append(points[0])
    random.shuffle(points)
    assert ForceCurve(points) == curve


@given(evaluable())
def test_points_are_exact_bit_for_bit(curve: ForceCurve) -> None:
    force, slope = curve.evaluate(curve.ratios)
    assert force.tobytes() == curve.forces.tobytes()
    assert np.array_equal(slope[:-1], curve.slopes)
    assert slope[-1] == curve.slopes[-1]


@pytest.mark.parametrize(
    ("points", "ratio", "force"),
    [
        # the product overflows, the force does not
        ([(0.0, -1.7e308), (2.5, 1.7e308)], 2.0, 1.02e308),
        # the distance to the first point overflows under a slope of zero
        ([(1e308, 5e-324), (1.7e308, 5e-324)], -1.7e308, 5e-324),
        # the distance overflows under a small slope
        ([(1e308, 1e10), (1.5e308, 1.5e10)], -1.5e308, -1.5e10),
    ],
)
def test_an_intermediate_overflow_is_no_overflow(points: list[Point], ratio: float, force: float) -> None:
    curve = ForceCurve(points)
    assert curve.evaluate(ratio)[0] == pytest.approx(force, rel=1e-15, abs=0.0)
    assert_force_and_slope(points, curve, ratio)
    filled, slope = np.empty(2), np.empty(2)
    with np.errstate(all="ignore"):
        curve.fill(np.array([ratio, math.inf]), filled, slope)
    assert (filled[0], slope[0]) == curve.evaluate(ratio)
    assert not math.isfinite(filled[1])
