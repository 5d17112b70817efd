"""The two directions of friction: along the line or at an angle, in the plane of the bed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray
from mudline.contact.friction.directions import at_angle, axial, in_plane

UP = np.array([[1.0, 0.0, 0.0]])


def test_along_a_bent_line() -> None:
    points = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 2.0, 1.0]])
    first, second = axial(points, np.array([[0, 1], [1, 2]]), np.repeat(UP, 3, axis=0))
    half = np.sqrt(0.5)
    np.testing.assert_allclose(first, [[0.0, 1.0, 0.0], [0.0, half, half], [0.0, 0.0, 1.0]], atol=1e-15)
    np.testing.assert_allclose(second, np.cross(UP, first), atol=1e-15)


def test_a_vertical_line_takes_y() -> None:
    points = np.array([[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]])
    first, _ = axial(points, np.array([[0, 1]]), np.repeat(UP, 2, axis=0))
    assert first.tolist() == [[0.0, 1.0, 0.0]] * 2


def test_a_wall_across_y_takes_z() -> None:
    first, _ = in_plane(np.array([[0.0, 1.0, 0.0]]), np.array([[0.0, 1.0, 0.0]]))
    assert first.tolist() == [[0.0, 0.0, 1.0]]


def test_elements_without_length_say_nothing() -> None:
    points = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 3.0]])
    first, _ = axial(points, np.array([[0, 1], [1, 2]]), np.repeat(UP, 3, axis=0))
    assert first.tolist() == [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]


@pytest.mark.parametrize(("degrees", "expected"), [(0.0, (0.0, 1.0, 0.0)), (90.0, (0.0, 0.0, 1.0))])
def test_an_angle_turns_from_y(degrees: float, expected: tuple[float, float, float]) -> None:
    first, _ = at_angle(np.array([degrees]), UP)
    assert first[0] == pytest.approx(expected, abs=1e-15)


components = st.floats(-1.0, 1.0)


@given(st.lists(st.tuples(*[components] * 6), min_size=1, max_size=20))
def test_they_are_orthonormal_in_the_plane(rows: list[tuple[float, ...]]) -> None:
    given_: FloatArray = np.array(rows)
    normals = given_[:, 3:] + np.array([2.0, 0.0, 0.0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    first, second = in_plane(given_[:, :3], normals)
    for one, other, product in ((first, first, 1.0), (second, second, 1.0), (first, second, 0.0)):
        np.testing.assert_allclose(np.einsum("ij,ij->i", one, other), product, atol=1e-9)
    np.testing.assert_allclose(np.einsum("ij,ij->i", first, normals), 0.0, atol=1e-6)
