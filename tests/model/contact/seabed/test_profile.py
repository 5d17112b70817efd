"""Seabeds of a 2D profile."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.seabed.profile import Interpolation, ProfileSeabed
from tests.model.contact.seabed.shapes import PROFILE_X, PROFILE_Y, level, located

KINDS: tuple[Interpolation, ...] = ("LINEAR", "CUBIC SPLINE", "CUBIC BESSEL")
every_kind = pytest.mark.parametrize("kind", KINDS)
PROFILES = st.lists(
    st.tuples(st.integers(-1000, 1000).map(lambda n: 0.1 * n), st.floats(-50.0, 50.0)),
    min_size=2,
    max_size=20,
    unique_by=lambda point: point[0],
)


def slope(seabed: ProfileSeabed, y: FloatArray) -> FloatArray:
    """Slope of a profile along Y, from its normals."""
    points = np.column_stack([np.zeros_like(y), y, np.zeros_like(y)])
    normal = located(seabed, points)[1]
    return np.asarray(-normal[:, 1] / normal[:, 0])


@every_kind
@given(PROFILES)
def test_a_profile_goes_through_its_points_in_any_order(kind: Interpolation, points: list[tuple[float, float]]) -> None:
    y, x = np.array(points).T
    assert np.array_equal(level(ProfileSeabed(y, x, kind), y), x + 0.0)


@given(PROFILES)
def test_linear_is_the_polyline(points: list[tuple[float, float]]) -> None:
    y, x = np.array(sorted(points)).T
    places = np.linspace(y[0] - 5.0, y[-1] + 5.0, 301)
    assert level(ProfileSeabed(y, x), places) == pytest.approx(np.interp(places, y, x), abs=1e-9)


@given(PROFILES)
def test_the_spline_is_scipys_clamped_one(points: list[tuple[float, float]]) -> None:
    y, x = np.array(sorted(points)).T
    reference = CubicSpline(y, x, bc_type="clamped")
    places = np.linspace(y[0], y[-1], 301)
    seabed = ProfileSeabed(y, x, "CUBIC SPLINE")
    scale = 1.0 + np.abs(reference(places)).max()
    assert np.abs(level(seabed, places) - reference(places)).max() < 1e-9 * scale
    steepest = 1.0 + np.abs(reference(places, 1)).max()
    assert np.abs(slope(seabed, places) - reference(places, 1)).max() < 1e-8 * steepest * scale


@pytest.mark.parametrize("kind", ["CUBIC SPLINE", "CUBIC BESSEL"])
def test_cubics_have_a_continuous_slope(kind: Interpolation) -> None:
    knots = np.array(PROFILE_Y)
    seabed = ProfileSeabed(PROFILE_Y, PROFILE_X, kind)
    assert slope(seabed, knots - 1e-9) == pytest.approx(slope(seabed, knots), abs=1e-8)
    assert slope(seabed, knots[[0, -1]]) == pytest.approx([0.0, 0.0], abs=1e-15)


def test_bessel_reproduces_a_parabola_between_inner_points() -> None:
    y = np.array([-7.0, -4.0, -1.0, 0.5, 3.0, 9.0])
    seabed = ProfileSeabed(y, 0.3 * y**2 - y + 2.0, "CUBIC BESSEL")
    places = np.linspace(-4.0, 3.0, 100)
    assert level(seabed, places) == pytest.approx(0.3 * places**2 - places + 2.0, rel=1e-13)
    assert slope(seabed, places) == pytest.approx(0.6 * places - 1.0, abs=1e-13)


@every_kind
def test_beyond_the_ends_the_seabed_is_flat(kind: Interpolation) -> None:
    seabed = ProfileSeabed(PROFILE_Y, PROFILE_X, kind)
    gap, normal = located(seabed, [[5.0, -61.0, 9.0], [5.0, 70.0, 9.0], [5.0, 1e300, 9.0]])
    assert gap.tolist() == [3.0, 6.0, 6.0]
    assert (normal == (1.0, 0.0, 0.0)).all()


def test_a_place_on_a_break_belongs_to_the_side_of_larger_y() -> None:
    seabed = ProfileSeabed([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    assert slope(seabed, np.array([0.0, 1.0, np.nextafter(1.0, 0.0), 2.0])) == pytest.approx([1.0, -1.0, 1.0, 0.0])


@every_kind
@pytest.mark.parametrize("turn", [30.0, 90.0, -135.0])
def test_the_direction_turns_the_profile(kind: Interpolation, turn: float) -> None:
    along = np.linspace(-70.0, 80.0, 40)
    cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    turned = ProfileSeabed(PROFILE_Y, PROFILE_X, kind, turn)
    plain = level(ProfileSeabed(PROFILE_Y, PROFILE_X, kind), along)
    assert level(turned, along * cosine - 9.0 * sine, along * sine + 9.0 * cosine) == pytest.approx(plain)


def test_points_given_twice_count_once() -> None:
    seabed = ProfileSeabed([0.0, 1.0, 0.0, -0.0], [0.0, 1.0, 0.0, 0.0])
    assert seabed.describe() == "straight lines through 2 points, Y = 0 to 1, flat beyond, direction 0 deg"


@pytest.mark.parametrize(
    ("y", "x", "message"),
    [
        ([], [], "0 different points; expected two or more"),
        ([1.0, 1.0], [2.0, 2.0], "1 different points; expected two or more"),
        ([1.0, 0.0, 1.0], [2.0, 0.0, 3.0], r"elevations 2 and 3 at Y = 1.0; expected one for each Y"),
        ([0.0, math.nan], [0.0, 0.0], "Y of the profile of point 2 is nan"),
        ([0.0, 1.0], [0.0, -math.inf], "elevation of the profile of point 2 is -inf"),
        ([0.0, 1.0], [0.0], r"elevation of the profile has shape \(1,\); expected \(2\)"),
        ([[0.0, 1.0]], [0.0], r"Y of the profile has shape \(1, 2\); expected \(n\)"),
        ([0.0, 5e-324], [0.0, 1.0], "too steep from Y = 0.0 to 5e-324"),
    ],
)
@every_kind
def test_what_is_no_profile_is_refused(kind: Interpolation, y: list[float], x: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ProfileSeabed(y, x, kind)
