"""Rise, plateau and release over the uplift: worked table, work, corners, net force with a linear seabed."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.laws.linear import spring_suction
from mudline.contact.laws.suction import step, trapezoid
from tests.builders.contact import bridge_law, floats
from tests.contact.single import BROKEN, FORCE, SUCTION, lifted, pull


def test_corners_exactly() -> None:
    first, second = np.array([0.25, 0.5]), np.array([0.75, 0.5])
    part, slope = trapezoid(first, first, second)
    assert part.tolist() == [1.0, 1.0]
    assert slope.tolist() == [0.0, 0.0]
    assert trapezoid(second, first, second)[0].tolist() == [1.0, 1.0]
    for end in (0.0, 1.0):
        ends = trapezoid(np.full(2, end), first, second)
        assert [values.tolist() for values in ends] == [[0.0, 0.0], [0.0, 0.0]]


@pytest.mark.parametrize("share", [-np.inf, -1.0, 1.0 + 1e-15, 2.0, 1e300, np.inf])
def test_nothing_outside(share: float) -> None:
    values = trapezoid(floats(share), floats(0.01), floats(0.99))
    assert [array.item() for array in values] == [0.0, 0.0]


@pytest.mark.parametrize("corner", [0.2, 0.8])
def test_on_a_corner_the_whole_force_acts_and_the_slope_is_that_of_the_plateau(corner: float) -> None:
    law = bridge_law(corners=(corner, corner))._replace(depth_exponent=floats(0.0), depth_factor=floats(1.0))
    suction = pull(law, corner, 0.1)
    assert suction.force.item() == pytest.approx(-FORCE, rel=1e-10)
    assert suction.by_uplift.item() == 0.0
    assert not np.signbit(suction.by_uplift.item())


def test_breakout_exactly_at_the_end() -> None:
    law = bridge_law(2)._replace(depth_exponent=floats(0.0, 2), depth_factor=floats(1.0, 2))
    uplift = np.array([np.nextafter(1.0, 0.0), 1.0])
    suction, after = step(law, lifted(law), uplift, floats(0.1, 2), np.zeros(2, np.bool_))
    assert after.state.tolist() == [SUCTION, BROKEN]
    assert after.armed.tolist() == [True, False]
    assert suction.force[0] < 0.0
    assert suction.force[1] == 0.0


def test_a_spring_against_uplift_has_an_extent_and_no_history() -> None:
    uplift = np.array([-0.1, 0.0, 1e-3, 0.05, np.nextafter(0.05, 1.0), 1e308])
    with np.errstate(over="ignore"):  # as the drivers ask
        force, stiffness = spring_suction(uplift, floats(15000.0, 6), floats(0.05, 6))
        twice, _ = spring_suction(np.stack([uplift, uplift]), floats(15000.0, 6), floats(0.05, 6))
    assert force == pytest.approx([0.0, 0.0, -15.0, -750.0, 0.0, 0.0], rel=1e-15)
    assert stiffness.tolist() == [0.0, 0.0, 15000.0, 15000.0, 0.0, 0.0]
    assert not np.signbit(force[[0, 1, 4, 5]]).any()
    assert np.array_equal(twice[1], force)


def test_no_spring_against_uplift_without_a_stiffness() -> None:
    for values in spring_suction(floats(0.01), floats(0.0), floats(0.05)):
        assert values.item() == 0.0
        assert not np.signbit(values.item())
