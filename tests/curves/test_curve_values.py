"""Forces and slopes against worked numbers."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.curves import ForceCurve

CLAY = [(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)]
DIAMETER = 0.3


@pytest.mark.parametrize(
    ("ratio", "force", "stiffness"),
    [
        (-0.02, -400.0, 66666.666667),
        (0.05, 1000.0, 66666.666667),
        (0.1, 2000.0, 41666.666667),
        (0.2, 3250.0, 41666.666667),
        (0.3, 4500.0, 25000.0),
        (0.4, 5250.0, 25000.0),
        (0.5, 6000.0, 25000.0),
        (0.8, 8250.0, 25000.0),
    ],
)
def test_worked_table(ratio: float, force: float, stiffness: float) -> None:
    found_force, found_slope = ForceCurve(CLAY).evaluate(ratio)
    assert found_force == pytest.approx(force, rel=1e-12)
    assert found_slope / DIAMETER == pytest.approx(stiffness, rel=1e-11)


def test_segments_and_extrapolation() -> None:
    curve = ForceCurve(CLAY)
    ratios = [-1.0, 0.0, 0.05, 0.1, 0.3, 0.5, 0.6]
    assert curve.segment(ratios).tolist() == [0, 0, 0, 1, 2, 2, 2]
    assert curve.extrapolated(ratios).tolist() == [-1, 0, 0, 0, 0, 0, 1]
    assert curve.extrapolated(ratios).dtype == np.int8
    assert curve.segment(0.2) == 1
    assert curve.extrapolated(0.7) == 1


def test_falling_forces_give_negative_slopes() -> None:
    force, slope = ForceCurve([(0.0, 10.0), (1.0, 4.0)]).evaluate([-1.0, 0.5, 2.0])
    assert force.tolist() == [16.0, 7.0, -2.0]
    assert slope.tolist() == [-6.0, -6.0, -6.0]


def test_roots_on_a_rising_curve() -> None:
    curve = ForceCurve(CLAY)
    assert curve.ratios_at_force(3250.0) == pytest.approx((0.2,), rel=1e-15)
    assert curve.ratios_at_force(2000.0) == (0.1,)
    assert curve.ratios_at_force(8250.0) == pytest.approx((0.8,), rel=1e-15)
    assert curve.ratios_at_force(-400.0) == pytest.approx((-0.02,), rel=1e-15)


def test_every_root_of_a_curve_that_turns_is_found_in_order() -> None:
    curve = ForceCurve([(0.0, 0.0), (1.0, 4.0), (2.0, 1.0), (4.0, 3.0)])
    assert curve.ratios_at_force(2.5) == (0.625, 1.5, 3.5)
    assert curve.ratios_at_force(4.0) == (1.0, 5.0)
    assert curve.ratios_at_force(1.0) == (0.25, 2.0)
    assert curve.ratios_at_force(-1.0) == (-0.25,)


def test_roots_of_a_falling_curve_lie_beyond_either_end() -> None:
    curve = ForceCurve([(0.0, 10.0), (1.0, 4.0)])
    assert curve.ratios_at_force(16.0) == (-1.0,)
    assert curve.ratios_at_force(-2.0) == (2.0,)


def test_a_flat_stretch_is_given_by_its_points() -> None:
    curve = ForceCurve([(0.0, 0.0), (1.0, 5.0), (2.0, 5.0), (3.0, 9.0)])
    assert curve.ratios_at_force(5.0) == (1.0, 2.0)
    flat = ForceCurve([(0.0, 5.0), (1.0, 5.0)])
    assert flat.ratios_at_force(5.0) == (0.0, 1.0)
    assert flat.ratios_at_force(6.0) == ()


def test_a_root_too_far_away_for_a_float64_is_left_out() -> None:
    curve = ForceCurve([(0.0, 0.0), (1e10, 1.0), (2e10, 1e300)])
    assert curve.ratios_at_force(-1e300) == ()
    assert curve.ratios_at_force(1.0) == (1e10,)


def test_roots_between_forces_whose_difference_overflows() -> None:
    curve = ForceCurve([(0.0, -1.5e308), (4.0, 1.5e308)])
    assert curve.ratios_at_force(0.75e308) == pytest.approx((3.0,), rel=1e-15)
    assert curve.ratios_at_force(0.0) == pytest.approx((2.0,), rel=1e-15)
