"""Seabeds through scattered points."""

from __future__ import annotations

import math
from typing import Literal
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CloughTocher2DInterpolator, LinearNDInterpolator
from scipy.spatial import Delaunay

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.seabed import scattered
from mudline.model.contact.seabed.scattered import ScatteredSeabed
from tests.model.contact.seabed.shapes import CLOUD, cloud, level, located

Kind = Literal["LINEAR", "CUBIC"]
every_kind = pytest.mark.parametrize("kind", ["LINEAR", "CUBIC"])


@every_kind
def test_the_surface_is_scipys(kind: Kind) -> None:
    make = LinearNDInterpolator if kind == "LINEAR" else CloughTocher2DInterpolator
    _, y, z = cloud(500, 49.0).T
    reference = make(CLOUD[:, 1:], CLOUD[:, 0])(y, z)
    assert level(ScatteredSeabed(CLOUD, kind), y, z) == pytest.approx(reference, abs=1e-6)


_made: dict[bytes, Delaunay] = {}
_triangulated = scattered._triangulated


def triangulated_once(places: FloatArray) -> Delaunay:
    """The triangles of places, made once for any elevations.

    The first search among new triangles makes scipy solve a small system for each of them on all processors, which
    takes up to 0.5 s where these are busy: minutes for a hundred seabeds.
    """
    key = places.tobytes()
    if key not in _made:
        _made[key] = _triangulated(places)
    return _made[key]


@every_kind
@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_a_plane_is_reproduced_with_its_normal(kind: Kind, along_y: float, along_z: float) -> None:
    points = CLOUD.copy()
    points[:, 0] = 5.0 + along_y * points[:, 1] + along_z * points[:, 2]
    places = np.vstack([cloud(40, 49.0), points])  # corners and hull too
    with patch.object(scattered, "_triangulated", triangulated_once):
        _, normal = located(ScatteredSeabed(points, kind), places)
    expected = np.array([1.0, -along_y, -along_z]) / math.sqrt(1.0 + along_y**2 + along_z**2)
    assert np.abs(normal - expected).max() < 1e-7


def test_across_an_edge_the_cubic_normal_is_continuous_and_the_linear_is_not() -> None:
    linear, cubic = ScatteredSeabed(CLOUD), ScatteredSeabed(CLOUD, "CUBIC")

    def normals(seabed: ScatteredSeabed, y: FloatArray) -> FloatArray:
        return located(seabed, np.column_stack([np.zeros_like(y), y, 0.3 * y]))[1]

    y = np.linspace(-49.0, 49.0, 2001)
    changes = np.flatnonzero((np.diff(normals(linear, y), axis=0) != 0.0).any(axis=1))
    low, high = y[changes], y[changes + 1]
    for _ in range(25):
        middle = 0.5 * (low + high)
        before = (normals(linear, low) == normals(linear, middle)).all(axis=1)
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    assert len(low) > 5
    assert (np.abs(normals(linear, high) - normals(linear, low)).max(axis=1) > 1e-4).all()
    assert np.abs(normals(cubic, high) - normals(cubic, low)).max() < 1e-6


@every_kind
def test_outside_of_the_hull_is_no_seabed_and_its_edge_is_seabed(kind: Kind) -> None:
    seabed = ScatteredSeabed(CLOUD, kind)
    gap, normal = located(seabed, [[0.0, 50.0, 0.0], [0.0, 0.0, -50.0], [0.0, 50.001, 0.0], [0.0, 1e308, -1e308]])
    assert np.isfinite(gap).tolist() == [True, True, False, False]
    assert (normal[2:] == (1.0, 0.0, 0.0)).all()
    assert np.linalg.norm(normal, axis=1) == pytest.approx(1.0, rel=1e-14)


def test_points_given_twice_count_once() -> None:
    seabed = ScatteredSeabed(np.vstack([CLOUD[:4], CLOUD[:2]]))
    assert seabed.describe() == ("2 plane triangles through 4 scattered points, no seabed outside of their convex hull")
    assert "cubic triangles" in ScatteredSeabed(CLOUD, "CUBIC").describe()


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "2 different points; expected three or more"),
        ([[0.0, n, 2.0 * n] for n in range(5)], "lie on a line"),
        ([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], r"elevations 0 and 1 at Y = 0.0, Z = 0.0"),
        ([[0.0, 0.0, math.nan]], "the surface's points of point 1 is nan"),
        ([[0.0, 0.0]], r"shape \(1, 2\); expected \(n, 3\)"),
        ([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1e-18, 0.0]], "too close"),
        ([[0.0, 0.0, 0.0], [1e150, 1e-20, 0.0], [0.0, 0.0, 1e-20]], "too steep"),
    ],
)
def test_what_is_no_surface_is_refused(points: list[list[float]], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ScatteredSeabed(points)


def test_an_unknown_interpolation_is_refused() -> None:
    kind: Kind = "SPLINE"  # type: ignore[assignment]  # what a caller without types may pass
    with pytest.raises(ValueError, match="'SPLINE'; expected LINEAR or CUBIC"):
        ScatteredSeabed(CLOUD, kind)


CORNERS = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


def turned(places: FloatArray, degrees: float) -> FloatArray:
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    found: FloatArray = places @ np.array([[cosine, sine], [-sine, cosine]])
    return found


@pytest.mark.parametrize("degrees", [0.0, 17.0, 31.0, 45.0, 88.0])
@pytest.mark.parametrize("interpolation", ["LINEAR", "CUBIC"])
@pytest.mark.parametrize("size", [1e-3, 1.0, 1e5])
def test_places_on_the_edge(degrees: float, interpolation: Literal["LINEAR", "CUBIC"], size: float) -> None:
    inside = np.random.default_rng(7).uniform(0.0, 10.0, (30, 2))
    places = size * turned(np.vstack([CORNERS, inside]), degrees)
    slope = np.array([0.02, -0.03])
    seabed = ScatteredSeabed(np.column_stack([size + places @ slope, places]), interpolation)
    shares = np.linspace(0.0, 1.0, 50)[:, None]
    on_edge = np.vstack(
        [one + (other - one) * shares for one, other in zip(places[:4], places[[1, 2, 3, 0]], strict=True)]
    )
    gaps, normals = np.empty(len(on_edge)), np.empty((len(on_edge), 3))
    seabed.locate(np.column_stack([np.zeros(len(on_edge)), on_edge]), gaps, normals)
    upward = 1.0 / np.sqrt(1.0 + slope @ slope)
    assert gaps == pytest.approx(-upward * (size + on_edge @ slope), rel=0.0, abs=1e-8 * size)
    assert normals == pytest.approx(np.tile(upward * np.array([1.0, -0.02, 0.03]), (len(on_edge), 1)), abs=1e-7)
    middle = places[:4].mean(axis=0)
    outside = middle + (on_edge - middle) * (1.0 + 1e-6)
    assert np.isnan(seabed.elevation(*outside.T)).all()
