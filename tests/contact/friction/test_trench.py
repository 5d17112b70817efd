"""Trenches: the share of the peak over the offset, outward motion, and the centreline."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.friction.trench import LaidCentreline, StraightCentreline, TrenchLaw
from tests.contact.friction.laws import SLIP, anchored, law, move

PEAK = 900.0


def trench(count: int) -> TrenchLaw:
    """A trench of 0.5 at the bottom and 1.7 above: walls from 0.25 to 0.85, their middle at 0.55."""
    return TrenchLaw(*(np.full(count, value) for value in (0.5, 1.7, PEAK)))


@pytest.mark.parametrize(
    ("offset", "share"),
    [(0.0, 0.0), (0.25, 0.0), (0.4, 0.5), (0.55, 1.0), (0.7, 0.5), (0.85, 0.0), (3.0, 0.0)],
)
def test_share_of_the_peak(offset: float, share: float) -> None:
    both = trench(2).limit(np.array([offset, -offset]))
    np.testing.assert_allclose(both.force, PEAK * share, atol=1e-9)
    assert both.outward[0] == -both.outward[1]


@given(st.floats(-1.0, 1.0).filter(lambda y: min(abs(abs(y) - kink) for kink in (0.0, 0.25, 0.55, 0.85)) > 1e-5))
def test_slope_of_the_limit(offset: float) -> None:
    ahead, behind = (trench(1).limit(np.array([offset + step])).force[0] for step in (1e-6, -1e-6))
    slope = trench(1).limit(np.array([offset])).slope[0]
    assert slope == pytest.approx((ahead - behind) / 2.0e-6, abs=1e-3)


def test_no_trench_no_limit() -> None:
    none = TrenchLaw(*(np.full(1, np.nan) for _ in range(3))).limit(np.array([0.55]))
    assert [part.tolist() for part in (none.force, none.slope, none.outward)] == [[0.0]] * 3


def test_it_acts_against_outward_motion_only() -> None:
    held = law((0.5, 0.5), 1.0e5)
    history = anchored(held)
    limit = trench(1).limit(np.array([0.55]))
    out = move(held, history, (0.0, 0.55), 1000.0, limit)
    assert -out.force[0, 1] == pytest.approx(500.0 + PEAK)
    assert out.history.states[0, 1] == SLIP
    back = move(held, out.history, (0.0, 0.45), 1000.0, trench(1).limit(np.array([0.45])))
    assert -back.force[0, 1] == pytest.approx(-500.0)


def test_straight_centreline() -> None:
    found = StraightCentreline((0.0, 1.0), (10.0, 1.0)).nearest(np.array([[-3.0, 4.0, 3.5], [0.5, -20.0, 0.0]]))[0]
    assert found.tolist() == [[-3.0, 4.0, 1.0], [0.5, -20.0, 1.0]]


def bent() -> tuple[FloatArray, IndexArray]:
    """A line of six nodes along Y that turns into Z in its middle."""
    places = [(0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 2.0, 0.0), (0.0, 3.0, 0.0), (0.0, 3.0, 1.0), (0.0, 3.0, 2.0)]
    return np.array(places), np.array([[k, k + 1] for k in range(5)])


def test_laid_centreline() -> None:
    laid, ends = bent()
    line = LaidCentreline(laid, ends)
    np.testing.assert_array_equal(line.nearest(laid)[0], laid)
    moved = laid + np.array([0.0, 0.0, 0.2])
    expected = laid.copy()
    expected[3:, 2] = [0.2, 1.2, 2.0]
    np.testing.assert_allclose(line.nearest(moved)[0], expected, atol=1e-15)


def test_a_node_finds_its_place_far_along_the_line() -> None:
    laid, ends = bent()
    points = np.broadcast_to(np.array([0.0, 2.6, 0.1]), laid.shape).copy()
    np.testing.assert_allclose(LaidCentreline(laid, ends).nearest(points)[0][:4], [[0.0, 2.6, 0.0]] * 4, atol=1e-15)


def test_a_node_without_elements_is_its_own_centreline() -> None:
    laid = np.array([[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [5.0, 5.0, 5.0]])
    points = laid + 1.0
    found = LaidCentreline(laid, np.array([[0, 1]])).nearest(points)[0]
    assert found[2].tolist() == points[2].tolist()
    assert found[0].tolist() == [0.0, 1.0, 0.0]


def test_nodes_of_a_line_without_elements_are_their_own_centrelines() -> None:
    points = np.array([[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]])
    found, across = LaidCentreline(np.zeros((2, 3)), np.zeros((0, 2), np.intp)).nearest(points)
    assert found.tolist() == points.tolist()
    assert not across.any()


@given(st.integers(2, 40), st.integers(0, 10_000))
def test_nearest_point_of_a_gentle_line(count: int, seed: int) -> None:
    """As the search over all elements finds it."""
    random = np.random.default_rng(seed)
    y = np.arange(float(count))
    laid = np.column_stack([np.zeros(count), y, 0.3 * np.sin(0.3 * y)])
    ends = np.array([[k, k + 1] for k in range(count - 1)])
    points = laid + random.uniform(-0.3, 0.3, laid.shape)
    found = LaidCentreline(laid, ends).nearest(points)[0]
    shares = np.linspace(0.0, 1.0, 201)
    dense = (laid[:-1, None] + shares[:, None] * (laid[1:, None] - laid[:-1, None])).reshape(-1, 3)
    best = np.sqrt(((points[:, None] - dense) ** 2).sum(axis=2)).min(axis=1)
    assert (np.sqrt(((points - found) ** 2).sum(axis=1)) <= best + 1e-9).all()
