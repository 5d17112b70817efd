"""The resistance of a trench over the offset: the share of the peak, the wall, tables, and outward motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ElementError
from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.laws.trench import on_wall, wall_coefficient
from mudline.model.contact.line import Incidence
from mudline.model.contact.tables import LawTables
from mudline.model.contact.trenches import LaidCentreline
from tests.helpers.builders.contact import ALONG_Y, LINEAR, NONE, chain, friction, on, trench

INNER, OUTER = 0.25, 0.85
"""Half widths of a trench of 0.5 at the bottom and 1.7 above: the middle of its walls is at 0.55."""


def test_worked_wall() -> None:
    """A depth of 0.3 over a wall 0.6 wide is tan theta = 0.5; with mu 0.4 the coefficient is (0.5 + 0.4) / 0.8."""
    found = wall_coefficient(*(np.array([value]) for value in (0.3, 0.5, 1.7, 0.4)))
    assert 0.4 + found == pytest.approx([1.125], rel=1e-15)
    assert found == pytest.approx([0.725], rel=1e-14)
    for offset, there in ((0.0, 0.0), (0.25, 0.0), (0.2500001, 1.0), (0.6, 1.0), (0.8499999, 1.0), (0.85, 0.0)):
        assert on_wall(offset, INNER, OUTER) == there


WRONG = {
    "element 12 has a trench peak law: the upper width of its trench is not above": on(
        "trench peak", [1], bottom=0.5, upper=0.5, peak=1.0, **ALONG_Y
    ),
    "element 11 has a trench wall law whose depth is 0.0; expected > 0": on(
        "trench wall", 1, bottom=0.5, upper=0.7, depth=0.0
    ),
    "element 11 has a trench peak law whose peak is -1.0; expected >= 0": on(
        "trench peak", 1, bottom=0.5, upper=0.7, peak=-1.0
    ),
    "element 11 has a trench peak law whose bottom is 0.0; expected > 0": on(
        "trench peak", 1, bottom=0.0, upper=0.7, peak=1.0
    ),
    "element 12 has a table that does not exist": on("trench table", [1], bottom=0.5, upper=0.7, table=2),
}


@pytest.mark.parametrize("message", WRONG)
def test_a_trench_that_is_none_is_refused_and_the_element_named(message: str) -> None:
    with pytest.raises(ElementError, match=message) as caught:
        chain([LINEAR] * 2, WRONG[message])
    assert f"element {caught.value.element} " in message


def nearest(
    laid: FloatArray, ends: IndexArray, points: FloatArray, straight: tuple[float, float, float, float] | None = None
) -> FloatArray:
    """The points of the centreline nearest to `points` (n, 3), each sought by the node of its own."""
    along = {} if straight is None else dict(zip(ALONG_Y, straight, strict=True))
    rows = LawTables(chain([NONE], friction(2), trench(1, 0.1, 0.2, 1.0, along))).trench
    assert rows is not None
    each = rows._replace(nodes=np.arange(len(laid)), line=np.repeat(rows.line[:1], len(laid)))
    centreline = LaidCentreline(laid, Incidence(ends, len(laid)))
    away = centreline.away(centreline.beside(each), points.T[:, None])
    found: FloatArray = points - away.vector[:, 0].T
    return found


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
