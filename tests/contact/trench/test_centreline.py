"""The nearest points of the centrelines of trenches: straight ones, and the line as it was laid."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.line import Line
from mudline.contact.tables import Tables
from mudline.contact.trenches import LaidCentreline
from tests.builders.contact import ALONG_Y, NONE, chain, friction, trench


def nearest(
    laid: FloatArray, ends: IndexArray, points: FloatArray, straight: tuple[float, float, float, float] | None = None
) -> FloatArray:
    """The points of the centreline nearest to `points` (n, 3), each sought by the node of its own."""
    along = {} if straight is None else dict(zip(ALONG_Y, straight, strict=True))
    rows = Tables(chain([NONE], friction(2), trench(1, 0.1, 0.2, 1.0, along))).trench
    assert rows is not None
    each = rows.some(np.zeros(len(laid), np.intp))._replace(nodes=np.arange(len(laid)))
    centreline = LaidCentreline(laid, Line(ends, len(laid)))
    away = centreline.away(centreline.pieces_beside(each), [axis[None] for axis in points.T])
    found: FloatArray = points - np.stack([axis[0] for axis in away.vector], axis=1)
    return found


def test_straight_centreline() -> None:
    points = np.array([[-3.0, 4.0, 3.5], [0.5, -20.0, 0.0]])
    found = nearest(points, np.array([[0, 1]]), points, (0.0, 1.0, 10.0, 1.0))
    assert found.tolist() == [[-3.0, 4.0, 1.0], [0.5, -20.0, 1.0]]


def bent() -> tuple[FloatArray, IndexArray]:
    """A line of six nodes along Y that turns into Z in its middle."""
    places = [(0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 2.0, 0.0), (0.0, 3.0, 0.0), (0.0, 3.0, 1.0), (0.0, 3.0, 2.0)]
    return np.array(places), np.array([[k, k + 1] for k in range(5)])


def test_laid_centreline() -> None:
    laid, ends = bent()
    np.testing.assert_array_equal(nearest(laid, ends, laid), laid)
    moved = laid + np.array([0.0, 0.0, 0.2])
    expected = laid.copy()
    expected[3:, 2] = [0.2, 1.2, 2.0]
    np.testing.assert_allclose(nearest(laid, ends, moved), expected, atol=1e-15)


def test_a_node_finds_its_place_far_along_the_line() -> None:
    laid, ends = bent()
    points = np.broadcast_to(np.array([0.0, 2.6, 0.1]), laid.shape).copy()
    np.testing.assert_allclose(nearest(laid, ends, points)[:4], [[0.0, 2.6, 0.0]] * 4, atol=1e-15)


def test_a_node_without_elements_is_its_own_centreline() -> None:
    laid = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0, 5.0, 5.0]])
    points = laid + 1.0
    found = nearest(laid, np.array([[0, 1]]), points)
    assert found[2].tolist() == points[2].tolist()
    assert found[0].tolist() == [0.0, 1.0, 0.0]


def test_nodes_of_a_line_without_elements_are_their_own_centrelines() -> None:
    points = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]])
    found = nearest(np.zeros((2, 3)), np.zeros((0, 2), np.intp), points)
    assert found.tolist() == points.tolist()


@given(st.integers(2, 40), st.integers(0, 10_000))
def test_nearest_point_of_a_gentle_line(count: int, seed: int) -> None:
    """As the search over all elements finds it."""
    random = np.random.default_rng(seed)
    y = np.arange(float(count))
    laid = np.column_stack([np.zeros(count), y, 0.3 * np.sin(0.3 * y)])
    ends = np.array([[k, k + 1] for k in range(count - 1)])
    points = laid + random.uniform(-0.3, 0.3, laid.shape)
    found = nearest(laid, ends, points)
    shares = np.linspace(0.0, 1.0, 201)
    dense = (laid[:-1, None] + shares[:, None] * (laid[1:, None] - laid[:-1, None])).reshape(-1, 3)
    best = np.sqrt(((points[:, None] - dense) ** 2).sum(axis=2)).min(axis=1)
    assert (np.sqrt(((points - found) ** 2).sum(axis=1)) <= best + 1e-9).all()
