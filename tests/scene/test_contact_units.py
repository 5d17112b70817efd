"""A deck and the same deck in feet and pounds give the same numbers."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from mudline.contact import ContactModel
from tests.scene.contact_decks import FOOT, IMPERIAL, METRIC, POUND, Units, deck, everything
from tests.scene.decks import scene_of


def model(units: Units) -> ContactModel:
    return scene_of(deck(units, everything(units), span=5.0), f"deck.{units.suffix}").contact()


METRES, FEET = model(METRIC), model(IMPERIAL)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(*(st.floats(-0.3, 0.3),) * 3), min_size=2, max_size=5))
def test_every_feature_is_the_same_in_feet_and_pounds(moves: list[tuple[float, float, float]]) -> None:
    start = METRES.input.coordinates
    series = np.array([start + np.array([0.2 * up, along, across]) for up, along, across in moves])
    times = np.arange(len(moves), dtype=np.float64)
    metric = METRES.evaluate(series, times=times)
    imperial = FEET.evaluate(series / FOOT, times=times)

    def same(ours: NDArray[np.float64], theirs: NDArray[np.float64], factor: float, least: float = 1.0) -> None:
        # relative to the largest value; forces at least to the weight of the line:
        # round-off of positions times a stiffness is a force
        scale = max(float(np.nanmax(np.abs(ours))), least)
        assert np.allclose(theirs * factor / scale, ours / scale, rtol=0.0, atol=1e-12, equal_nan=True)

    same(metric.depth, imperial.depth, FOOT)
    same(metric.ratio, imperial.ratio, 1.0)
    same(metric.force, imperial.force, POUND / FOOT, 1000.0)
    same(metric.normal_force, imperial.normal_force, POUND, 1000.0)
    assert metric.friction is not None
    assert imperial.friction is not None
    same(metric.friction, imperial.friction, POUND, 1000.0)


def test_the_laws_themselves_are_the_same_to_rounding() -> None:
    ours, theirs = METRES.input, FEET.input
    pairs: list[tuple[NDArray[np.float64], NDArray[np.float64], float]] = [
        (ours.length, theirs.length, FOOT),
        (ours.diameter, theirs.diameter, FOOT),
        (ours.linear_stiffness, theirs.linear_stiffness, POUND / FOOT**2),
    ]
    one, other = ours.extras, theirs.extras
    assert one.nodal is not None
    assert other.nodal is not None
    pairs.append((one.nodal.stiffness, other.nodal.stiffness, POUND / FOOT))
    pairs.append((one.nodal.half_width, other.nodal.half_width, FOOT))
    assert one.suction is not None
    assert other.suction is not None
    law, foreign = one.suction.law, other.suction.law
    pairs.append((law.regularisation, foreign.regularisation, FOOT))
    speeds = np.full(law.cyclic.shape, 0.1)
    pairs.append(
        (
            law.force_factor * speeds**law.force_exponent,
            foreign.force_factor * (speeds / FOOT) ** foreign.force_exponent,
            POUND / FOOT,
        )
    )
    pairs.append(
        (
            law.depth_factor * speeds**law.depth_exponent,
            foreign.depth_factor * (speeds / FOOT) ** foreign.depth_exponent,
            FOOT,
        )
    )
    assert one.unloading is not None
    assert other.unloading is not None
    pairs.append((one.unloading, other.unloading, POUND / FOOT**2))
    assert one.lateral is not None
    assert other.lateral is not None
    pairs.append((one.lateral, other.lateral, POUND / FOOT**2))
    assert one.friction is not None
    assert other.friction is not None
    pairs.append((one.friction.law.coefficients, other.friction.law.coefficients, 1.0))
    pairs.append((one.friction.law.stiffness, other.friction.law.stiffness, POUND / FOOT))
    pairs.append((one.friction.law.mobilisation, other.friction.law.mobilisation, FOOT))
    assert one.trench is not None
    assert other.trench is not None
    pairs.append((one.trench.law.peak, other.trench.law.peak, POUND))
    pairs.append((one.trench.law.upper, other.trench.law.upper, FOOT))
    for mine, yours, factor in pairs:
        np.testing.assert_allclose(yours * factor, mine, rtol=1e-12)
