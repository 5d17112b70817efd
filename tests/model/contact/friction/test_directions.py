"""The two directions of friction: along the line or at an angle, in the plane of the seabed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import vectors
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.directions import directions_of
from mudline.model.contact.tables import LawTables
from mudline.model.contact.vectors import in_plane
from tests.helpers.builders.contact import LINEAR, chain, friction

UP = np.array([[1.0, 0.0, 0.0]])


def axes(
    points: FloatArray, normals: FloatArray, ends: list[list[int]] | None = None, angle: float = np.nan
) -> tuple[FloatArray, FloatArray]:
    """Directions u1 and u2 at the nodes of a line through points (n, 3)."""
    inputs = chain([LINEAR] * (len(points) - 1), friction(len(points), angle=angle))
    if ends is not None:
        inputs = replace(inputs, element_nodes=np.array(ends, np.intp))
    return directions_of(LawTables(inputs), points, normals).axes


def projected(wanted: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The unit projections (n, 3) on planes of unit normals, or what stands in for them, and n x these."""
    first = in_plane(tuple(wanted.T), tuple(normals.T))
    return np.stack(first, axis=1), np.stack(vectors.across_3(first, tuple(normals.T)), axis=1)


def test_along_a_bent_line() -> None:
    points = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 2.0, 1.0]])
    first, second = axes(points, np.repeat(UP, 3, axis=0))
    half = np.sqrt(0.5)
    np.testing.assert_allclose(first, [[0.0, 1.0, 0.0], [0.0, half, half], [0.0, 0.0, 1.0]], atol=1e-15)
    np.testing.assert_allclose(second, np.cross(UP, first), atol=1e-15)


@pytest.mark.parametrize("size", [5e-324, 1e-320, 1e-200, 1e-150, 1e-100, 1.0, 1e100, 1e150, 1e200, 1e300])
def test_directions_of_elements_whose_squares_under_or_overflow(size: float) -> None:
    """A line of 3 along Y and 4 along Z, at any size: not the directions of elements without length."""
    points = np.array([[0.0, 0.0, 0.0], [0.0, 3.0 * size, 4.0 * size]])
    first, second = axes(points, np.repeat(UP, 2, axis=0))
    assert first == pytest.approx(np.array([[0.0, 0.6, 0.8]] * 2), rel=1e-15)
    assert second == pytest.approx(np.array([[0.0, -0.8, 0.6]] * 2), rel=1e-15)


components = st.floats(-1.0, 1.0)


@given(st.lists(st.tuples(*[components] * 6), min_size=1, max_size=20))
def test_they_are_orthonormal_in_the_plane(rows: list[tuple[float, ...]]) -> None:
    given_: FloatArray = np.array(rows)
    normals = given_[:, 3:] + np.array([2.0, 0.0, 0.0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    first, second = projected(given_[:, :3], normals)
    for one, other, product in ((first, first, 1.0), (second, second, 1.0), (first, second, 0.0)):
        np.testing.assert_allclose(np.einsum("ij,ij->i", one, other), product, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", first, normals), 0.0, atol=1e-6)
