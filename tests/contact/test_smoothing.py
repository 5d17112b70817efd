"""Smoothing of a linear law: worked table, joints, work, half widths, extremes."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.linear import automatic_half_width, smoothed_reaction, zone_onset

K, H = 50000.0, 0.005

TINY, HUGE = 5e-324, 1.7e308


def law(
    z: ArrayLike, one_sided: ArrayLike, h: ArrayLike = H, stiffness: ArrayLike = K
) -> tuple[FloatArray, FloatArray]:
    """Force and slope where the law counts, 0 elsewhere."""
    depths, sides = np.atleast_1d(np.asarray(z, np.float64)), np.asarray(one_sided, np.float64)
    with np.errstate(all="ignore"):
        force, slope = smoothed_reaction(depths, 0.3, np.asarray(stiffness), np.asarray(h), sides)
    touches = depths > zone_onset(stiffness, np.asarray(h), sides)
    return np.where(touches, force, 0.0), np.where(touches, slope, 0.0)


def exact_force(z: float, stiffness: float, h: float, one_sided: bool) -> Fraction:
    depth, k, half = Fraction(z), Fraction(stiffness), Fraction(h)
    if one_sided:
        if depth <= 0:
            return Fraction(0)
        return k * depth**2 / (4 * half) if depth < 2 * half else k * (depth - half)
    if depth <= -half:
        return Fraction(0)
    return k * (depth + half) ** 2 / (4 * half) if depth < half else k * depth


@pytest.mark.parametrize(("one_sided", "joints"), [(False, (-H, H)), (True, (0.0, 2 * H))])
def test_force_and_slope_are_continuous_at_the_joints(one_sided: bool, joints: tuple[float, float]) -> None:
    for joint in joints:
        near = np.array([np.nextafter(joint, -1.0), joint, np.nextafter(joint, 1.0)])
        for values, scale in zip(law(near, one_sided), (K * H, K), strict=True):
            assert np.ptp(values) <= 1e-14 * scale


@pytest.mark.parametrize("one_sided", [False, True])
def test_without_a_zone_the_law_is_kinked(one_sided: bool) -> None:
    z = [-1.0, -TINY, -0.0, 0.0, TINY, 0.5]
    force, slope = law(z, one_sided, h=0.0)
    assert force.tolist() == [0.0, 0.0, 0.0, 0.0, K * TINY, 25000.0]
    assert slope.tolist() == [0.0, 0.0, 0.0, 0.0, K, K]
    assert not np.signbit(force).any()


def test_beyond_the_zone_the_centred_law_is_the_linear_one_exactly() -> None:
    z = np.array([H, 0.0123, 0.1, 3.0])
    assert np.array_equal(law(z, one_sided=False)[0], K * z)


def test_where_contact_begins() -> None:
    starts = zone_onset(K, np.array([H, H, 0.0]), np.array([0.0, 1.0, 0.0]))
    assert starts.tolist() == [-H, 0.0, 0.0]
    assert not np.signbit(starts[1:]).any()
    force = law(np.nextafter(-H, 1.0), one_sided=False)[0]
    assert 0.0 < force.item() < 1e-25


sizes = st.one_of(st.sampled_from([TINY, 1e-320, 1e-308, 1.0, 1e300, HUGE]), st.floats(1e-300, HUGE))


@example(stiffness=1e300, h=1e300, share=2.225073858507203e-309, one_sided=True)
@given(stiffness=sizes, h=sizes, share=st.floats(-1.5, 3.0), one_sided=st.booleans())
def test_extreme_laws_are_right_wherever_the_force_is_finite(
    stiffness: float, h: float, share: float, one_sided: bool
) -> None:
    z = float(max(-Fraction(HUGE), min(Fraction(share) * Fraction(h), Fraction(HUGE))))
    force, slope = (values.item() for values in law(z, one_sided, h, stiffness))
    expected = exact_force(z, stiffness, h, one_sided)
    if expected < Fraction(HUGE):
        assert abs(Fraction(force) - expected) <= expected * Fraction(1e-15) + Fraction(TINY)
    else:
        assert force >= HUGE
    assert 0.0 <= slope <= stiffness


def test_automatic_half_width() -> None:
    z = np.array([0.01, 0.05, 0.05, 0.0, -0.1, np.nan, 0.05, np.inf])
    diameter = np.array([0.3, 0.3, 1.0, 0.3, 0.3, 0.3, np.nan, 0.3])
    width = automatic_half_width(z, diameter)
    assert width == pytest.approx([0.001, 0.003, 0.005, 0.0, 0.0, 0.0, 0.0, 0.003], rel=1e-15)
    assert not np.signbit(width).any()
