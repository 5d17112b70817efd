"""Every way of searching finds the same number of points at or below a ratio, whatever the points."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.curves.points import FloatArray
from mudline.curves.search import Bisection, Bucketing, Counting, Knots, Search, Workspace, bucket_table, search_for
from tests.curves.plain import POINTS, near, steps

ANY_FINITE = st.floats(allow_nan=False, allow_infinity=False)


def knots_at(points: FloatArray) -> Knots:
    return Knots(points, np.zeros(len(points)), np.zeros(len(points) - 1))


@given(POINTS, st.lists(ANY_FINITE, max_size=20))
def test_the_right_segment(points: FloatArray, more: list[float]) -> None:
    query = near(points, more)
    expected = np.searchsorted(points[1:], query, side="right")
    searches: list[Search] = [Bisection(points[1:]), Bucketing(bucket_table(points), Workspace())]
    if len(points) < 200:
        searches.append(Counting(points[1:], Workspace()))
    with np.errstate(all="ignore"):
        for search in searches:
            assert np.array_equal(search.passed(query), expected)
            # Again, for a search that has learnt, and fewer than there is room for.
            assert np.array_equal(search.passed(query[:-1]), expected[:-1])


@given(POINTS)
def test_a_table_keeps_its_promises(points: FloatArray) -> None:
    table = bucket_table(points)
    inner = len(points) - 1
    assert len(table.below) <= 16 * inner + 4
    assert table.knots.tolist() == [*points[1:].tolist(), math.inf]
    assert 0 <= table.crowded <= inner
    single = table.below[table.below <= inner].astype(np.int64)
    assert (np.diff(single) >= 0).all()
    assert table.crowded > 0 or (np.diff(single) <= 1).all()
    assert not table.below.flags.writeable
    assert not table.knots.flags.writeable


@pytest.mark.parametrize(
    "points",
    [
        np.linspace(0.0, 1.0, 10_000),
        np.linspace(-7.0, -3.0, 1000),
        np.linspace(1e6, 1e6 + 1e-6, 500),
        np.geomspace(1e-6, 1.0, 10_000),
        np.append(0.0, np.geomspace(1e-9, 1e3, 1000)),
        np.append(0.3, 0.3 + np.geomspace(1e-6, 1.0, 300)),
        np.array(steps(1.0, 300)),
    ],
)
def test_points_with_a_rule_have_a_bucket_each(points: FloatArray) -> None:
    assert bucket_table(points).crowded == 0


def test_a_table_of_very_many_points_has_wider_numbers() -> None:
    points = np.arange(70_000.0)
    query = near(points, [-1e300, 1e300])[::-20]
    table = bucket_table(points)
    assert table.below.dtype == np.uint32
    found = Bucketing(table, Workspace()).passed(query)
    assert np.array_equal(found, np.searchsorted(points[1:], query, side="right"))


def test_after_a_block_in_crowded_buckets_only_the_binary_search_is_used() -> None:
    points = np.array([0.0, 1.0, *steps(2.0, 50), 5.0])
    search = Bucketing(bucket_table(points), Workspace())
    for ratio in (0.5, 2.0, math.nextafter(2.0, 3.0), 0.5):
        query = np.full(1000, ratio)
        assert np.array_equal(search.passed(query), np.searchsorted(points[1:], query, side="right"))


def test_which_search_is_used() -> None:
    few, many, work = knots_at(np.arange(16.0)), knots_at(np.arange(5000.0)), Workspace()
    assert isinstance(search_for(few, 1, work), Bisection)
    assert isinstance(search_for(few, 10**7, work), Counting)
    assert isinstance(search_for(many, 2000, work), Bisection)
    assert isinstance(search_for(many, 5000, work), Bucketing)
    # The table is there now.
    assert isinstance(search_for(many, 2000, work), Bucketing)
    assert isinstance(search_for(many, 100, work), Bisection)
