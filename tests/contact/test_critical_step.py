"""Frequencies, critical steps and the stiffness at suction release against closed numbers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.contact.stiffest import (
    critical_step,
    omega,
    release_stiffness,
    rounded_down,
    steepest_slope,
)
from tests.builders.contact import bridge_law


@pytest.mark.parametrize(
    ("stiffness", "frequency", "step", "twentieth"),
    [
        (1e4, 4.472135955, 0.4472135955, 0.07024814731),
        (1e6, 44.72135955, 0.04472135955, 0.007024814731),
        (1e9, 1414.213562, 0.001414213562, 0.0002221441469),
    ],
)
def test_published_frequencies_of_500_kg(stiffness: float, frequency: float, step: float, twentieth: float) -> None:
    found = omega(np.array([stiffness]), np.array([500.0]))
    assert found[0] == pytest.approx(frequency, rel=1e-9)
    assert critical_step("central-difference", found[0]) == pytest.approx(step, rel=1e-9)
    assert critical_step("velocity-verlet", found[0]) == pytest.approx(step, rel=1e-9)
    assert 2.0 * math.pi / 20.0 / found[0] == pytest.approx(twentieth, rel=1e-9)


def test_what_does_not_swing_has_no_frequency_and_any_step() -> None:
    bad = np.array([0.0, -1.0, np.nan, np.inf, 1.0, 1.0, 1.0])
    mass = np.array([1.0, 1.0, 1.0, 1.0, 0.0, np.nan, np.inf])
    assert np.isnan(omega(bad, mass)).all()
    assert all(critical_step("central-difference", frequency) == np.inf for frequency in omega(bad, mass))
    assert critical_step("newmark", 2.0) == np.inf


def test_frequencies_of_huge_and_tiny_numbers() -> None:
    found = omega(np.array([1e300, 1e-300, 4e-300]), np.array([1e-300, 1e300, 1e-300]))
    assert found == pytest.approx([1e300, 1e-300, 2.0], rel=1e-14)


def test_steps_have_three_digits_that_are_not_above_them() -> None:
    assert [rounded_down(step) for step in (0.0042481, 0.021356, 1.0, 9.999, 1e-300)] == [
        0.00424,
        0.0213,
        1.0,
        9.99,
        1e-300,
    ]


def test_the_steepest_slope_below_the_mudline() -> None:
    assert steepest_slope(np.array([-1.0, 0.0, 1.0, 2.0]), np.array([9.0, 3.0, 5.0])) == 5.0
    assert steepest_slope(np.array([-2.0, -1.0]), np.array([9.0])) == 9.0
    assert steepest_slope(np.array([0.0, 1.0, 2.0]), np.array([-1.0, -2.0])) == -1.0


def test_published_release_of_suction() -> None:
    found = release_stiffness(bridge_law(3), np.array([0.1, 1e-3, 1.0]))
    assert found == pytest.approx([42662.876092, 61666.617838, 35485.434704], rel=1e-10)
    assert 2.0 * found[0] == pytest.approx(85325.752184, rel=1e-10)
