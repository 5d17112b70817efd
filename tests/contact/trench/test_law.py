"""The resistance of a trench over the offset: the share of the peak, the wall, tables, and outward motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.contact import ElementError
from mudline.contact.laws.friction import ExtraLimit
from mudline.contact.laws.trench import on_wall, peak_share, peak_slope, wall_coefficient
from mudline.contact.trenches import tabulated
from tests.builders.contact import ALONG_Y, LINEAR, chain, on

PEAK = 900.0
INNER, OUTER = 0.25, 0.85
"""Half widths of a trench of 0.5 at the bottom and 1.7 above: the middle of its walls is at 0.55."""


def limit(offset: float) -> ExtraLimit:
    """What such a trench adds at an offset."""
    y, side = np.array([abs(offset)]), np.array([np.sign(offset)])
    slope = PEAK * side * peak_slope(y, INNER, OUTER)
    return ExtraLimit(
        PEAK * np.asarray(peak_share(y, INNER, OUTER, 2.0 / (OUTER - INNER))), np.asarray(slope), np.zeros(1), side
    )


@pytest.mark.parametrize(
    ("offset", "share"),
    [(0.0, 0.0), (0.25, 0.0), (0.4, 0.5), (0.55, 1.0), (0.7, 0.5), (0.85, 0.0), (3.0, 0.0)],
)
def test_share_of_the_peak(offset: float, share: float) -> None:
    both = limit(offset), limit(-offset)
    for found in both:
        np.testing.assert_allclose(found.force, PEAK * share, atol=1e-9)
    assert both[0].outward[0] == -both[1].outward[0]


@given(st.floats(-1.0, 1.0).filter(lambda y: min(abs(abs(y) - kink) for kink in (0.0, 0.25, 0.55, 0.85)) > 1e-5))
def test_slope_of_the_limit(offset: float) -> None:
    ahead, behind = (limit(offset + step).force[0] for step in (1e-6, -1e-6))
    assert limit(offset).by_offset[0] == pytest.approx((ahead - behind) / 2.0e-6, abs=1e-3)


def test_worked_wall() -> None:
    """A depth of 0.3 over a wall 0.6 wide is tan theta = 0.5; with mu 0.4 the coefficient is (0.5 + 0.4) / 0.8."""
    found = wall_coefficient(*(np.array([value]) for value in (0.3, 0.5, 1.7, 0.4)))
    assert 0.4 + found == pytest.approx([1.125], rel=1e-15)
    assert found == pytest.approx([0.725], rel=1e-14)
    for offset, there in ((0.0, 0.0), (0.25, 0.0), (0.2500001, 1.0), (0.6, 1.0), (0.8499999, 1.0), (0.85, 0.0)):
        assert on_wall(offset, INNER, OUTER) == there


def test_a_wall_without_friction_is_as_steep_as_it_is() -> None:
    values = (np.array([0.1, 0.3, 1.2]), np.full(3, 0.5), np.full(3, 1.7), np.zeros(3))
    assert wall_coefficient(*values) == pytest.approx([1.0 / 6.0, 0.5, 2.0])


def test_a_table_is_held_below_its_first_row_and_ends_at_its_last() -> None:
    table = np.array([[0.1, 100.0], [0.3, 500.0], [0.5, 200.0]])
    offsets = np.array([0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.5000001, 9.0])
    assert tabulated(table, offsets) == pytest.approx([100.0, 100.0, 300.0, 500.0, 350.0, 200.0, 0.0, 0.0])
    single = np.array([[0.2, 250.0]])
    assert tabulated(single, np.array([0.0, 0.2, 0.21])).tolist() == [250.0, 250.0, 0.0]


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
