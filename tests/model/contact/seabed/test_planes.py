"""Sloping seabeds and seabeds of planes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact.seabed import PlanesSeabed, SlopingSeabed
from tests.model.contact.seabed.shapes import cloud, level, located

ANGLES = st.floats(-89.9, 89.9)
TURNS = st.floats(-720.0, 720.0)


@pytest.mark.parametrize(("turn", "y", "z"), [(0, 1, 0), (90, 0, 1), (180, -1, 0), (-90, 0, -1), (450, 0, 1)])
def test_the_direction_turns_y_to_z(turn: float, y: float, z: float) -> None:
    seabed = SlopingSeabed(45.0, turn)
    assert level(seabed, y, z) == pytest.approx(1.0, rel=1e-15)
    assert level(seabed, z, -y) == 0.0


@given(ANGLES, TURNS)
def test_one_plane_through_the_origin_is_a_slope(angle: float, turn: float) -> None:
    plane, slope = PlanesSeabed([[0.0, 0.0, 0.0]], [angle], [turn]), SlopingSeabed(angle, turn)
    gap, normal = located(plane, cloud(20))
    assert gap == pytest.approx(located(slope, cloud(20))[0], rel=1e-10, abs=1e-10)
    assert normal == pytest.approx(located(slope, cloud(20))[1], abs=1e-14)


@given(st.lists(st.tuples(st.floats(-9, 9), st.floats(-99, 99), ANGLES, TURNS), min_size=1, max_size=6))
def test_the_highest_plane_is_the_seabed(planes: list[tuple[float, float, float, float]]) -> None:
    points = [[x, y, -y] for x, y, _, _ in planes]
    slopes, turns = [plane[2] for plane in planes], [plane[3] for plane in planes]
    _, y, z = cloud(30).T
    single = [level(PlanesSeabed([p], [s], [t]), y, z) for p, s, t in zip(points, slopes, turns, strict=True)]
    assert np.array_equal(level(PlanesSeabed(points, slopes, turns), y, z), np.max(single, axis=0))


def test_of_equal_planes_the_later_wins() -> None:
    seabed = PlanesSeabed(np.zeros((2, 3)), [10.0, -10.0])
    assert located(seabed, [0.0, 0.0, 0.0])[1][1] > 0.0
    assert located(PlanesSeabed(np.zeros((2, 3)), [-10.0, 10.0]), [0.0, 0.0, 0.0])[1][1] < 0.0


def test_bounds_are_closed_and_outside_is_no_seabed() -> None:
    seabed = PlanesSeabed([[1.0, 0.0, 0.0]], [0.0], bounds=[[-1.0, 2.0, -3.0, np.inf]])
    edges = level(seabed, [-1.0, 2.0, 0.0, 0.0], [0.0, 0.0, -3.0, 1e200])
    assert (edges == 1.0).all()
    assert np.isnan(
        level(seabed, [np.nextafter(-1, -2), np.nextafter(2, 3), 0.0], [0.0, 0.0, np.nextafter(-3, -4)])
    ).all()


def test_huge_coordinates_keep_their_digits() -> None:
    seabed = PlanesSeabed([[-1000.0, 6.5e6, 4.5e5]], [89.9])
    gap, _ = located(seabed, [[-999.0, 6.5e6, 4.5e5]])
    assert gap[0] == pytest.approx(math.cos(math.radians(89.9)), rel=1e-12)


def described(seabed: PlanesSeabed) -> str:
    return seabed.describe().replace(" bed", " seabed")


def test_descriptions_say_what_holds_outside() -> None:
    box = [-1.0, 1.0, -1.0, 1.0]
    two = PlanesSeabed(np.zeros((2, 3)), [1.0, 2.0], bounds=[box, box])
    assert described(two) == (
        "2 planes, the highest is the seabed, no seabed outside of all bounds; depth and normal jump where two meet"
    )
    assert "1 without end" in PlanesSeabed(np.zeros((2, 3)), [1.0, 2.0], bounds=[box, [-np.inf, np.inf] * 2]).describe()
    assert (
        PlanesSeabed(np.zeros((1, 3)), [1.0], bounds=[box]).describe() == "one plane, no seabed outside of its bounds"
    )
    assert PlanesSeabed(np.zeros((1, 3)), [1.0]).describe() == "one plane, without end"


@pytest.mark.parametrize("angle", [90.0, -90.0, 135.0])
def test_a_wall_is_refused(angle: float) -> None:
    with pytest.raises(ValueError, match=r"slope of the (?:sea)?bed is .* degrees; expected more than -90"):
        SlopingSeabed(angle)
    with pytest.raises(ValueError, match="slope of plane 2 is"):
        PlanesSeabed(np.zeros((2, 3)), [0.0, angle])


@pytest.mark.parametrize("value", [math.nan, math.inf, 1e200])
def test_numbers_must_be_finite(value: float) -> None:
    with pytest.raises(ValueError, match=r"direction of the slope is .*; expected a finite number"):
        SlopingSeabed(1.0, value)
    with pytest.raises(ValueError, match="the planes' points of point 1 is"):
        PlanesSeabed([[0.0, value, 0.0]], [0.0])


@pytest.mark.parametrize(
    "bounds", [[2.0, 1.0, 0.0, 1.0], [0.0, 1.0, 2.0, 1.0], [math.nan, 1.0, 0.0, 1.0], [math.inf, math.inf, 0.0, 1.0]]
)
def test_bounds_must_hold_something(bounds: list[float]) -> None:
    with pytest.raises(ValueError, match=r"plane 2 has [YZ] from .*; expected the smallest, then the largest"):
        PlanesSeabed(np.zeros((2, 3)), [0.0, 0.0], bounds=[[0.0, 1.0, 0.0, 1.0], bounds])


def test_lengths_must_agree() -> None:
    with pytest.raises(ValueError, match="no plane"):
        PlanesSeabed(np.zeros((0, 3)), [])
    with pytest.raises(ValueError, match=r"slopes has shape \(1,\); expected \(2\)"):
        PlanesSeabed(np.zeros((2, 3)), [0.0])
    with pytest.raises(ValueError, match=r"bounds have shape \(1, 4\); expected \(2, 4\)"):
        PlanesSeabed(np.zeros((2, 3)), [0.0, 0.0], bounds=[[0.0, 1.0, 0.0, 1.0]])
