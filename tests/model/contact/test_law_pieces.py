"""Trenches, suction and unloading as functions of single numbers: worked values within, between and at their pieces."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact.laws import suction, trench, unloading
from mudline.model.contact.laws.suction import SuctionState
from tests.helpers.builders.contact import bridge_law
from tests.helpers.suction import step as suction_step

INNER, OUTER = 0.25, 0.85
"""Half widths of a trench; the middle of its walls is at 0.55."""


@pytest.mark.parametrize(
    ("distance", "share", "slope"),
    [
        (0.0, 0.0, 0.0),
        (0.25, 0.0, 0.0),
        (0.4, 0.5, 1.0 / 0.3),
        (0.55, 1.0, 1.0 / 0.3),
        (0.7, 0.5, -1.0 / 0.3),
        (0.85, 0.0, 0.0),
        (2.0, 0.0, 0.0),
    ],
)
def test_the_share_of_a_peak(distance: float, share: float, slope: float) -> None:
    assert float(trench.peak_share(distance, INNER, OUTER, 1.0 / 0.3)) == pytest.approx(share, abs=1e-12)
    assert float(trench.peak_slope(distance, INNER, OUTER)) == pytest.approx(slope, rel=1e-12)


@pytest.mark.parametrize(
    ("distance", "part", "slope"),
    [(0.0, 1.0, 0.0), (0.25, 1.0, 0.0), (0.4, 0.75, -1.0 / 0.6), (0.85, 0.0, 0.0), (2.0, 0.0, 0.0)],
)
def test_how_much_of_its_depth_a_seabed_is_lowered(distance: float, part: float, slope: float) -> None:
    assert tuple(map(float, trench.lowered(distance, INNER, OUTER))) == pytest.approx((part, slope), abs=1e-12)


def test_diagrams_of_a_peak() -> None:
    assert trench.diagram(0.2, 0.8, 9.0, None).tolist() == [[0.2, 0.0], [0.5, 9.0], [0.8, 0.0]]
    held = trench.diagram(0.2, 0.8, 9.0, (4.0, 0.7))
    assert held.tolist() == [[0.2, 0.0], [0.5, 9.0], [0.7, 4.0], [np.inf, 4.0]]


@pytest.mark.parametrize(
    ("points", "side"),
    [
        ([(0.2, 0.0), (0.5, 9.0), (0.9, 0.0)], 0.3),
        ([(0.1, 0.0), (0.5, 9.0), (0.9, 0.0)], 0.2),  # across the centreline
        ([(0.0, 0.0), (0.5, 9.0), (0.9, 0.0)], 0.4),
        ([(0.2, 0.0), (0.5, 9.0), (0.9, 1.0)], 0.0),  # falls to nothing at once
        ([(0.2, 0.0), (0.5, 9.0), (np.inf, 9.0)], 0.3),
        ([(0.0, 9.0), (np.inf, 9.0)], np.inf),
    ],
)
def test_the_shortest_side_of_a_diagram(points: list[tuple[float, float]], side: float) -> None:
    assert trench.shortest_side(np.array(points)) == pytest.approx(side)


def test_rounded_corners_meet_both_sides() -> None:
    """At 0.5 a slope of 30 turns into one of -20: the parabola begins and ends 0.05 beside it."""
    points = np.array([(0.2, 0.0), (0.5, 9.0), (0.8, 3.0), (1.0, 3.0)])
    assert trench.rounded(points, 0.0).tolist() == [[*row, 0.0] for row in points.tolist()]
    rows = trench.rounded(points, 0.05)
    assert rows[:, 0] == pytest.approx([0.15, 0.25, 0.45, 0.55, 0.75, 0.85, 1.0])
    assert rows[:, 1] == pytest.approx([0.0, 1.5, 7.5, 8.0, 4.0, 3.0, 3.0])
    assert rows[:, 2] == pytest.approx([150.0, 0.0, -250.0, 0.0, 100.0, 0.0, 0.0])
    table = trench.table_rows(rows)
    for distance, resistance in ((0.0, 0.0), (0.2, 0.375), (0.35, 4.5), (0.5, 8.375), (0.65, 6.0), (0.9, 3.0)):
        row = trench.table_row(table, np.array([distance]))
        at = np.clip(distance, rows[0, 0], rows[-1, 0])
        found = trench.in_table(at, *(values[row] for values in table))
        assert found == pytest.approx([resistance], abs=1e-12)


def test_a_corner_on_the_centreline_is_not_rounded() -> None:
    points = np.array([(0.0, 4.0), (1.0, 8.0)])
    assert trench.rounded(points, 0.1)[0].tolist() == [0.0, 4.0, 0.0]


def test_the_row_of_a_table_at_its_ends() -> None:
    table = trench.table_rows(np.array([(0.2, 1.0), (0.5, 7.0), (0.9, 3.0)]))
    rows = trench.table_row(table, np.array([0.0, 0.2, 0.49, 0.5, 0.9, np.nextafter(0.9, 1.0)]))
    assert rows.tolist() == [0, 0, 0, 1, 2, 3]
    assert [values[3] for values in table[1:]] == [0.0, 0.0, 0.0]
    assert table[2].tolist() == pytest.approx([20.0, -10.0, 0.0, 0.0])


# ------------------------------------------------------------------------------------------------------------- uplifts


@pytest.mark.parametrize(
    ("share", "part", "slope"),
    [
        (-0.1, 0.0, 0.0),
        (0.0, 0.0, 0.0),
        (0.1, 0.5, 5.0),
        (0.2, 1.0, 0.0),
        (0.5, 1.0, 0.0),
        (0.6, 1.0, 0.0),
        (0.7, 0.75, -2.5),
        (1.0, 0.0, 0.0),
        (1.1, 0.0, 0.0),
    ],
)
def test_the_trapezoid(share: float, part: float, slope: float) -> None:
    assert tuple(map(float, suction.trapezoid(share, 0.2, 0.6))) == pytest.approx((part, slope), abs=1e-12)


@pytest.mark.parametrize(
    ("armed", "state", "uplift", "v", "after"),
    [
        (True, 1, 0.05, 0.1, (True, 0.3, SuctionState.SUCTION)),
        (True, 2, 0.1, 0.1, (False, 0.3, SuctionState.BROKEN)),
        (True, 2, 0.05, 0.0, (True, 0.3, SuctionState.HOLD)),
        (True, 2, 0.05, -0.1, (True, 0.3, SuctionState.HOLD)),
        (True, 3, 0.2, 0.0, (True, 0.3, SuctionState.HOLD)),
        (False, 4, 0.2, 0.1, (False, 0.3, SuctionState.BROKEN)),
        (False, 4, 0.1, -0.1, (False, 0.3, SuctionState.BROKEN)),
        (False, 4, 0.05, 0.1, (False, 0.0, SuctionState.FREE)),
        (False, 0, 0.2, 0.1, (False, 0.0, SuctionState.FREE)),
        (False, 0, 0.05, 0.1, (False, 0.0, SuctionState.FREE)),
    ],
)
def test_the_next_state_of_an_element_that_is_not_compressed(
    armed: bool, state: int, uplift: float, v: float, after: tuple[bool, float, int]
) -> None:
    """Breakout is at an uplift of 0.1, and 0.3 m/s is the largest velocity so far."""
    given = (np.bool_(armed), 0.3, np.int8(state), 0.1, uplift, v)
    assert tuple(value.item() for value in map(np.asarray, suction.next_state(*given))) == after


def test_the_largest_suction_below_and_above_the_regularisation() -> None:
    """2000 v^0.5 from 0.04 m/s on, below it the parabola with its value 400, its slope 5000 and 0 at rest."""
    for v, force, slope in (
        (0.04, 400.0, 5000.0),
        (0.09, 600.0, 1e4 / 3.0),
        (0.02, 250.0, 10000.0),
        (0.0, 0.0, 15000.0),
    ):
        assert tuple(map(float, suction.maximum_force(v, 2000.0, 0.5, 0.04))) == pytest.approx(
            (force, slope), rel=1e-12
        )


def test_the_force_while_it_pulls() -> None:
    """A tenth of the uplift at breakout is half-way up the trapezoid, which rises over 0.02 m here."""
    law = (2000.0, 0.5, 0.04, 0.2, 0.6)
    for uplift, force, stiffness in ((0.01, -300.0, 600.0 / 0.02), (0.05, -600.0, 0.0), (0.08, -300.0, -600.0 / 0.04)):
        found = tuple(map(float, suction.suction_force(uplift, 0.09, 0.1, law)))
        assert found == pytest.approx((force, stiffness), rel=1e-12)
    assert tuple(map(float, suction.suction_force(-0.01, 0.09, 0.1, law))) == (0.0, 0.0)


def test_an_element_that_is_pressed_has_the_uplift_at_breakout_of_rest() -> None:
    law = bridge_law(2)
    history = suction.SuctionHistory.initial(law)
    pressed, free = np.array([True, False]), np.array([-0.01, 0.01])
    step, after = suction_step(law, history, free, np.full(2, 0.1), pressed)
    assert step.depth[0] == law.least_depth[0]
    assert step.force.tolist() == [0.0, 0.0]
    assert after.armed.tolist() == [True, False]
    assert after.v_max.tolist() == [0.0, 0.0]


def test_a_cycle_lowers_the_factor_to_its_floor() -> None:
    assert suction.after_cycle(0.8, 0.5, 0.3) == 0.4
    assert suction.after_cycle(0.4, 0.5, 0.3) == 0.3


@pytest.mark.parametrize(
    ("z", "force", "stiffness"),
    [(0.03, 0.0, 0.0), (0.04, 0.0, 0.0), (0.07, 300.0, 1e4), (0.1, 600.0, 1e4)],
)
def test_the_unloading_line(z: float, force: float, stiffness: float) -> None:
    bottom = float(unloading.trench_bottom(1e4, 0.1, 600.0))
    assert bottom == pytest.approx(0.04)
    assert tuple(map(float, unloading.on_line(z, 0.1, 600.0, 1e4, 0.04))) == pytest.approx((force, stiffness))


def test_an_unloading_line_is_no_softer_than_the_secant() -> None:
    assert unloading.line_stiffness(1e4, 0.1, 600.0) == 1e4
    assert unloading.line_stiffness(1e3, 0.1, 600.0) == pytest.approx(6e3)
    assert unloading.line_stiffness(1e3, 0.0, 600.0) == 1e3
    with np.errstate(over="ignore"):
        assert unloading.line_stiffness(1e3, 5e-324, 600.0) == np.finfo(np.float64).max
    assert unloading.trench_bottom(6e3, 0.1, 600.0) == 0.0
    assert unloading.trench_bottom(1e300, 0.1, 600.0) == np.nextafter(0.1, 0.0)
    assert unloading.trench_bottom(1e4, 0.1, 0.0) == 0.1
