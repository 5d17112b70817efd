"""The curve as an object, and the arrays it takes and gives."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.curves import ForceCurve

POINTS = [(0.3, 4500.0), (0.0, 0.0), (0.1, 2000.0)]


def test_points_are_sorted_and_repeats_merged() -> None:
    curve = ForceCurve([*POINTS, (0.1, 2000.0), (0.0, -0.0)], name="clay")
    assert curve.name == "clay"
    assert curve.ratios.tolist() == [0.0, 0.1, 0.3]
    assert curve.forces.tolist() == [0.0, 2000.0, 4500.0]
    assert curve.slopes == pytest.approx([20000.0, 12500.0], rel=1e-15)
    assert not np.signbit(curve.forces).any()


def test_a_curve_does_not_change() -> None:
    given = np.array(POINTS)
    curve = ForceCurve(given)
    given[:] = 7.0
    assert curve == ForceCurve(POINTS)
    for array in (curve.ratios, curve.forces, curve.slopes):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0
    with pytest.raises(AttributeError, match="cannot set name"):
        curve.name = "mud"
    with pytest.raises(AttributeError, match="cannot delete name"):
        del curve.name


def test_equality_and_hash_are_those_of_name_and_points() -> None:
    curve = ForceCurve(POINTS, name="clay")
    same = ForceCurve(sorted(POINTS), name="clay")
    assert curve == same
    assert hash(curve) == hash(same)
    assert curve != ForceCurve(POINTS, name="sand")
    assert curve != ForceCurve(POINTS[:2], name="clay")
    assert curve != ForceCurve([(ratio, 2.0 * force) for ratio, force in POINTS], name="clay")
    assert curve != ForceCurve([(2.0 * ratio, force) for ratio, force in POINTS], name="clay")
    assert curve != "clay"
    assert len({curve, same, ForceCurve(POINTS)}) == 2


def test_repr() -> None:
    assert repr(ForceCurve([(1, 2), (0, 1)], name="a")) == "ForceCurve([(0.0, 1.0), (1.0, 2.0)], name='a')"
    eight = [(float(ratio), float(ratio)) for ratio in range(8)]
    assert repr(ForceCurve(eight)) == f"ForceCurve({eight}, name=None)"
    assert repr(ForceCurve([*eight, (8, 8)])) == "ForceCurve(<9 points from (0.0, 0.0) to (8.0, 8.0)>, name=None)"


def test_a_notebook_shows_the_points_with_their_slopes() -> None:
    shown = ForceCurve(POINTS, name="clay <1>")._repr_html_()
    assert "clay &lt;1&gt; 3 points" in shown
    assert all(f">{number}<" in shown for number in ("0.1", "2000", "12500"))


@pytest.mark.parametrize("shape", [(), (0,), (1,), (0, 3), (2, 3, 4), (3, 7000)])
def test_results_have_the_shape_of_the_query(shape: tuple[int, ...]) -> None:
    curve = ForceCurve(POINTS)
    query = np.random.default_rng(1).uniform(-1.0, 1.0, shape)
    force, slope = curve.evaluate(query)
    assert force.shape == slope.shape == shape
    assert curve.segment(query).shape == curve.extrapolated(query).shape == shape
    assert np.array_equal(force.ravel(), curve.evaluate(np.ravel(query))[0])


def test_out_is_written_in_place_and_returned() -> None:
    curve = ForceCurve(POINTS)
    query = np.random.default_rng(3).uniform(-1.0, 1.0, (40, 1000))
    expected = curve.evaluate(query)
    both = np.empty((40, 1000, 2))
    out = (both[..., 0], both[..., 1])
    returned = curve.evaluate(query, out=out)
    assert returned[0] is out[0]
    assert returned[1] is out[1]
    assert np.array_equal(both, np.stack(expected, axis=-1))


CLAY = [(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)]
DIAMETER = 0.3


@pytest.mark.parametrize(
    ("ratio", "force", "stiffness"),
    [
        (-0.02, -400.0, 66666.666667),
        (0.05, 1000.0, 66666.666667),
        (0.1, 2000.0, 41666.666667),
        (0.2, 3250.0, 41666.666667),
        (0.3, 4500.0, 25000.0),
        (0.4, 5250.0, 25000.0),
        (0.5, 6000.0, 25000.0),
        (0.8, 8250.0, 25000.0),
    ],
)
def test_worked_table(ratio: float, force: float, stiffness: float) -> None:
    found_force, found_slope = ForceCurve(CLAY).evaluate(ratio)
    assert found_force == pytest.approx(force, rel=1e-12)
    assert found_slope / DIAMETER == pytest.approx(stiffness, rel=1e-11)


def test_every_root_of_a_curve_that_turns_is_found_in_order() -> None:
    curve = ForceCurve([(0.0, 0.0), (1.0, 4.0), (2.0, 1.0), (4.0, 3.0)])
    assert curve.ratios_at_force(2.5) == (0.625, 1.5, 3.5)
    assert curve.ratios_at_force(4.0) == (1.0, 5.0)
    assert curve.ratios_at_force(1.0) == (0.25, 2.0)
    assert curve.ratios_at_force(-1.0) == (-0.25,)


def test_a_flat_stretch_is_given_by_its_points() -> None:
    curve = ForceCurve([(0.0, 0.0), (1.0, 5.0), (2.0, 5.0), (3.0, 9.0)])
    assert curve.ratios_at_force(5.0) == (1.0, 2.0)
    flat = ForceCurve([(0.0, 5.0), (1.0, 5.0)])
    assert flat.ratios_at_force(5.0) == (0.0, 1.0)
    assert flat.ratios_at_force(6.0) == ()
