"""The two power laws: worked numbers, scaling, cap, units, refusals."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ElementError
from mudline.model.contact.laws.suction import from_cohesion
from tests.helpers.builders.contact import LINEAR, bridge_law, chain, floats, suction
from tests.model.contact.single import DEPTH, FORCE, breakout, largest
from tests.model.contact.suction.test_scenes import TABLE

FOOT, POUND = 0.3048, 4.4482216152605


@pytest.mark.parametrize("exponent", [0.0, 0.18, 1.0, 1.5, 2.0, 3.0])
def test_capped_force_never_falls_below_zero(exponent: float) -> None:
    law = bridge_law(41)._replace(force_exponent=floats(exponent, 41), force_factor=floats(1.0, 41))
    force, slope = largest(law, np.linspace(0.0, 2e-3, 41))
    assert (force >= 0.0).all()
    assert (np.diff(force) >= -1e-15).all()
    assert (slope >= -1e-12).all()


def test_millimetres_would_be_wrong_without_conversion() -> None:
    naive = bridge_law(cohesion=0.005, diameter=300.0, regularisation=1.0)
    assert largest(naive, floats(100.0))[0].item() == pytest.approx(1.3785656595, rel=1e-10)
    assert breakout(naive, floats(100.0)).item() == pytest.approx(973.52549716, rel=1e-10)
    assert breakout(naive, floats(100.0)).item() / (1000.0 * DEPTH) == pytest.approx(6.0255958607, rel=1e-10)
    right = naive._replace(**from_cohesion(floats(0.005), floats(300.0), 1e-3, 1.0)._asdict())
    assert largest(right, floats(100.0))[0].item() == pytest.approx(FORCE / 1000.0, rel=1e-10)
    assert breakout(right, floats(100.0)).item() == pytest.approx(DEPTH * 1000.0, rel=1e-10)


@pytest.mark.parametrize(("length", "force"), [(FOOT, POUND), (1e-3, 1.0), (1.0, 1000.0), (1.0, 1.0)])
def test_a_deck_in_other_units_describes_the_same_soil(length: float, force: float) -> None:
    diameter, cohesion, v = (np.array(column) for column in list(zip(*TABLE, strict=True))[:3])
    si = bridge_law(len(v), cohesion, diameter)
    factors = from_cohesion(cohesion / (force / length**2), diameter / length, length, force)
    own = si._replace(**factors._asdict(), regularisation=si.regularisation / length)
    for speed in (v, 0.3 * si.regularisation):
        expected, got = largest(si, speed), largest(own, speed / length)
        assert got[0] * (force / length) == pytest.approx(expected[0], rel=1e-13)
        assert got[1] * (force / length**2) == pytest.approx(expected[1], rel=1e-13)
        assert breakout(own, speed / length) * length == pytest.approx(breakout(si, speed), rel=1e-13)


@pytest.mark.parametrize(
    ("field", "value", "what"),
    [
        ("force_factor", -1.0, "force factor is -1.0; expected >= 0"),
        ("force_factor", np.inf, "force factor is inf; expected >= 0"),
        ("force_exponent", -0.1, "force exponent is -0.1; expected >= 0"),
        ("depth_factor", 0.0, "depth factor is 0.0; expected > 0"),
        ("depth_exponent", np.nan, "depth exponent is nan; expected >= 0"),
        ("cyclic", -1.0, "cyclic is -1.0; expected >= 0"),
        ("cyclic_floor", -0.5, "cyclic floor is -0.5; expected >= 0"),
        ("regularisation", -1e-3, "regularisation is -0.001; expected >= 0"),
        ("first_corner", 0.0, "first corner is 0.0; expected > 0 and < 1"),
        ("first_corner", 0.9, "its first corner is above its second"),
        ("second_corner", 1.0, "second corner is 1.0; expected > 0 and < 1"),
    ],
)
def test_a_value_out_of_range_is_refused_and_the_element_named(field: str, value: float, what: str) -> None:
    law = bridge_law(3)
    getattr(law, field)[1] = value
    with pytest.raises(ElementError, match=f"element 12 has a suction law.*{what}") as caught:
        chain([LINEAR] * 3, suction(law))
    assert caught.value.element == 12
