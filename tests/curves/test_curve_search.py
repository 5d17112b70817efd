"""Tables of buckets, and the memory that queries work in."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.curves import ForceCurve
from mudline.curves.points import FloatArray
from mudline.curves.search import Bisection, Bucketing, Counting, Knots, Workspace, bucket_table, search_for, workspace

EVEN = np.linspace(3.0, 11.0, 300)
SPACINGS = {
    # even: the sums lie in one power of two
    "even": (EVEN, 8.0 - EVEN[1]),
    "from zero": (np.geomspace(1e-9, 1.0, 300), 0.0),
    "from the first point": (np.concatenate(([5.0], 5.0 + np.geomspace(1e-6, 1.0, 300))), -5.0),
    "below zero": (np.concatenate(([-5.0], -5.0 + np.geomspace(1e-6, 1.0, 300))), 5.0),
}


@pytest.mark.parametrize("name", SPACINGS)
def test_every_point_has_a_bucket_of_its_own(name: str) -> None:
    ratios, addend = SPACINGS[name]
    table = bucket_table(ratios)
    assert table.addend == addend
    assert table.crowded == 0
    used = len(table.below) / (len(ratios) - 1)
    assert 8.0 <= used <= 17.0
    assert table.below[-1] == len(ratios) - 1


def test_points_that_share_a_bucket_are_counted() -> None:
    close = 0.5 + np.arange(4.0) * 2.0**-52
    table = bucket_table(np.concatenate(([0.0], np.linspace(0.1, 0.4, 40), close, np.linspace(0.6, 1.0, 40))))
    assert table.crowded == 4
    assert np.count_nonzero(table.below == 85) == 1


@pytest.mark.parametrize(("points", "bits"), [(65_535, 16), (65_536, 32)])
def test_a_table_is_as_narrow_as_its_number_of_points_allows(points: int, bits: int) -> None:
    """Numbers up to that of the points but the first, and one more, are held."""
    below = bucket_table(np.arange(float(points))).below
    assert below.dtype == np.dtype(f"uint{bits}")
    assert below.max() == points - 1


@pytest.mark.parametrize(
    ("points", "total", "kind"),
    [
        (2, 1023, Bisection),
        (2, 1024, Counting),
        (21, 1024, Counting),
        (22, 1024, Bucketing),
        (1025, 1024, Bucketing),
        (1026, 1024, Bisection),
        (1026, 1023, Bisection),
    ],
)
def test_each_query_has_the_search_that_is_fastest(points: int, total: int, kind: type) -> None:
    ratios = np.arange(float(points))
    knots = Knots(ratios, ratios, np.ones(points - 1))
    assert type(search_for(knots, total, Workspace())) is kind
    knots.prepare()
    # a table that is there already is used
    assert type(search_for(knots, total, Workspace())) is (Bucketing if points == 1026 and total == 1024 else kind)


def test_a_query_that_mostly_meets_crowded_buckets_is_bisected_from_then_on() -> None:
    close = 0.5 + np.arange(40.0) * 2.0**-52
    ratios = np.concatenate(([0.0], close, [1.0]))
    table = bucket_table(ratios)
    expected = np.searchsorted(ratios[1:], close, side="right")
    for share, crowded in ((1.0, True), (0.6, True), (0.4, False)):
        search = Bucketing(table, Workspace())
        query = np.where(np.arange(40) < share * 40, close, 0.1)
        found = search.passed(query).copy()
        assert found.tolist() == np.where(query > 0.1, expected, 0).tolist()
        assert search._crowded is crowded
        assert search.passed(query).tolist() == found.tolist()


def test_memory_of_a_query_serves_the_next() -> None:
    with workspace() as one, workspace() as two:
        assert one is not two
    with workspace() as again:
        assert again is two or again is one


@pytest.mark.parametrize("layout", [np.ascontiguousarray, np.asfortranarray])
def test_the_first_bad_ratio_is_the_first_in_the_order_of_rows(layout: type[FloatArray]) -> None:
    query = np.zeros((3, 4))
    query[1, 0] = query[0, 2] = np.nan
    curve = ForceCurve([(0.0, 0.0), (1.0, 1.0)])
    for ask in (curve.evaluate, curve.segment, curve.extrapolated):
        with pytest.raises(ValueError, match=r"at ratio nan \(index 2\)"):
            ask(layout(query))
    with pytest.raises(ValueError, match=r"at ratio nan \(index 2\)"):
        curve.evaluate(layout(query), out=(layout(np.zeros((3, 4))), layout(np.zeros((3, 4)))))
