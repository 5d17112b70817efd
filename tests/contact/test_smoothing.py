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

# z, CENTRED force and slope, ONE-SIDED force and slope
WORKED = [
    (-0.005, 0.0, 0.0, 0.0, 0.0),
    (-0.0025, 15.625, 12500.0, 0.0, 0.0),
    (0.0, 62.5, 25000.0, 0.0, 0.0),
    (0.0025, 140.625, 37500.0, 15.625, 12500.0),
    (0.005, 250.0, 50000.0, 62.5, 25000.0),
    (0.01, 500.0, 50000.0, 250.0, 50000.0),
    (0.02, 1000.0, 50000.0, 750.0, 50000.0),
    (0.05, 2500.0, 50000.0, 2250.0, 50000.0),
]

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


@pytest.mark.parametrize("one_sided", [False, True])
def test_worked_table(one_sided: bool) -> None:
    table = np.array(WORKED).T
    force, slope = law(table[0], one_sided)
    column = 3 if one_sided else 1
    assert force == pytest.approx(table[column], rel=1e-12, abs=1e-12)
    assert slope == pytest.approx(table[column + 1], rel=1e-12)
    for values in (force, slope):
        assert not np.signbit(values).any()


@pytest.mark.parametrize(("one_sided", "static"), [(False, 0.05), (True, 0.055)])
def test_static_penetration_under_half_of_the_element(one_sided: bool, static: float) -> None:
    assert law(static, one_sided)[0].item() == pytest.approx(1000.0 * 5.0 / 2.0, rel=1e-12)


@pytest.mark.parametrize(("one_sided", "z"), [(False, 0.0013245553203), (True, 0.0063245553203)])
def test_penetration_under_a_small_load(one_sided: bool, z: float) -> None:
    assert law(z, one_sided)[0].item() == pytest.approx(100.0, rel=1e-10)


@pytest.mark.parametrize(("one_sided", "work"), [(False, 62.708333333333), (True, 50.833333333333)])
def test_work_to_five_centimetres(one_sided: bool, work: float) -> None:
    z = np.linspace(-0.005, 0.05, 1101)
    force, middle = law(z, one_sided)[0], law(0.5 * (z[1:] + z[:-1]), one_sided)[0]
    simpson = np.sum((force[1:] + force[:-1] + 4.0 * middle) * np.diff(z)) / 6.0
    assert simpson == pytest.approx(work, rel=1e-12)


@pytest.mark.parametrize(("one_sided", "joints"), [(False, (-H, H)), (True, (0.0, 2 * H))])
def test_force_and_slope_are_continuous_at_the_joints(one_sided: bool, joints: tuple[float, float]) -> None:
    for joint in joints:
        near = np.array([np.nextafter(joint, -1.0), joint, np.nextafter(joint, 1.0)])
        for values, scale in zip(law(near, one_sided), (K * H, K), strict=True):
            assert np.ptp(values) <= 1e-14 * scale


def test_slope_is_that_of_the_force() -> None:
    z = np.linspace(-0.0049, 0.03, 200)
    for one_sided in (False, True):
        difference = (law(z + 1e-8, one_sided)[0] - law(z - 1e-8, one_sided)[0]) / 2e-8
        assert law(z, one_sided)[1] == pytest.approx(difference, rel=1e-5, abs=0.1)


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


def test_rows_of_different_laws_and_several_steps() -> None:
    z = np.array([[0.0, 0.0025, 0.02], [0.0025, 0.0025, -0.1]])
    stiffness, h, one_sided = np.array([K, K, 2 * K]), np.array([H, H, 0.0]), np.array([0.0, 1.0, 0.0])
    force, slope = law(z, one_sided, h, stiffness)
    assert force == pytest.approx(np.array([[62.5, 15.625, 2000.0], [140.625, 15.625, 0.0]]), rel=1e-12)
    assert slope == pytest.approx(np.array([[25000.0, 12500.0, 1e5], [37500.0, 12500.0, 0.0]]), rel=1e-12)


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
