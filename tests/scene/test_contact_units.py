"""A deck and the same deck in feet and pounds give the same numbers."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from mudline.contact import ContactModel
from tests.builders.decks import FOOT, IMPERIAL, METRIC, POUND, Units, full_bed, line_deck
from tests.builders.scenes import scene_of


def model(units: Units) -> ContactModel:
    return scene_of(line_deck(units, full_bed(units), span=5.0), f"deck.{units.suffix}").contact()


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
    one, other = ours.assigned, theirs.assigned
    factors = {
        "nodal": {"stiffness": POUND / FOOT, "half_width": FOOT},
        "suction": {"regularisation": FOOT},
        "unloading": {"stiffness": POUND / FOOT**2},
        "lateral": {"stiffness": POUND / FOOT**2},
        "friction": {
            "axial_coefficient": 1.0,
            "lateral_coefficient": 1.0,
            "axial_stiffness": POUND / FOOT,
            "lateral_stiffness": POUND / FOOT,
            "axial_mobilisation": FOOT,
            "lateral_mobilisation": FOOT,
        },
        "trench peak": {"peak": POUND / FOOT, "upper": FOOT},
    }
    assert set(factors) <= set(one) == set(other)
    pairs: list[tuple[NDArray[np.float64], NDArray[np.float64], float]] = [
        (ours.length, theirs.length, FOOT),
        (ours.diameter, theirs.diameter, FOOT),
        (ours.curves[0].forces, theirs.curves[0].forces, POUND / FOOT),
        *(
            (one[law][name], other[law][name], factor)
            for law, names in factors.items()
            for name, factor in names.items()
        ),
    ]
    law, foreign = one["suction"], other["suction"]
    for name, factor in (("force", POUND / FOOT), ("depth", FOOT)):
        mine = law[f"{name}_factor"] * 0.1 ** law[f"{name}_exponent"]
        yours = foreign[f"{name}_factor"] * (0.1 / FOOT) ** foreign[f"{name}_exponent"]
        pairs.append((mine, yours, factor))
    for mine, yours, factor in pairs:
        np.testing.assert_allclose(yours * factor, mine, rtol=1e-12)
