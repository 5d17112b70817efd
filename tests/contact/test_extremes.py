"""The largest and the smallest numbers: finite results or a named error, and never a warning of numpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from mudline.contact import ContactModel, ContactResult, ElementError, PositionError
from mudline.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed
from mudline.contact.seabed.profile import ProfileSeabed
from tests.builders.contact import changed, everything, journey, without

pytestmark = pytest.mark.slow

LEAST = 5e-324
sizes = st.sampled_from([0.0, LEAST, 1e-300, 1e-160, 1e-12, 1e-3, 1.0, 1e3, 1e12, 1e150, 1e160, 1e300, 1.7e308])
SEABEDS: list[Seabed] = [
    FlatSeabed(),
    SlopingSeabed(30.0, 45.0),
    PlanesSeabed(
        [[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [-20.0, 20.0], bounds=[[-1e9, 3.0, -1e9, 1e9], [3.0, 1e9, -1e9, 1e9]]
    ),
    ProfileSeabed([0.0, 5.0, 9.0], [0.0, -1.0, 1.0], "CUBIC SPLINE"),
]


def sound(result: ContactResult) -> bool:
    """Whether everything that exists is finite."""
    floats = (result.force, result.stiffness, result.normal_force, result.reaction, result.friction)
    return not np.isinf(result.gap).any() and all(part is None or bool(np.isfinite(part).all()) for part in floats)


@settings(max_examples=30)
@given(st.integers(1, 4), st.integers(0, 999), st.tuples(sizes, sizes, sizes), sizes, st.sampled_from(SEABEDS))
@example(2, 1, (1e300, 0.0, 0.0), 1e6, SEABEDS[0])
@example(2, 1, (0.0, 0.0, 0.0), 0.0, SEABEDS[1])
@example(3, 2, (LEAST, LEAST, LEAST), LEAST, SEABEDS[0])
def test_places_and_velocities_of_any_size(
    elements: int, seed: int, scale: tuple[float, float, float], speed: float, seabed: Seabed
) -> None:
    contact = ContactModel(everything(elements, seed, seabed))
    positions, velocities, _ = journey(elements, 4, seed)
    signs = np.sign(positions)
    signs[-1, :, 0] *= -1.0
    with np.errstate(over="ignore"):
        path, rates = np.clip(positions * scale, -1.7e308, 1.7e308), np.clip(velocities * speed, -1.7e308, 1.7e308)
    path = np.where(np.isfinite(path), path, signs)
    state, refused = contact.initial_state(), ""
    for place, rate in zip(path, rates, strict=True):
        try:
            result, after = contact.step(place, rate, state)
            tangent = contact.tangent(place, rate, state)
        except (ElementError, PositionError) as error:
            refused = str(error)
            break
        assert sound(result)
        assert len(tangent.by_position.values) == len(tangent.by_position.rows)
        state = after
    assert not refused or " at step 0: " in refused


@settings(max_examples=35)
@given(st.integers(0, 999), st.sampled_from([1e-6, 1e-3, 1.0, 1e3]), sizes, sizes, sizes)
def test_laws_of_any_size(seed: int, diameter: float, stiffness: float, strength: float, length: float) -> None:
    inputs = everything(3, seed)
    for law, values in (
        ("suction", {"force_factor": strength, "depth_factor": max(diameter, 1e-6)}),
        ("nodal", {"stiffness": stiffness}),
        ("linear", {"stiffness": stiffness}),
        ("smoothed", {"stiffness": stiffness}),
        ("unloading", {"stiffness": max(stiffness, LEAST)}),
        ("trench peak", {"peak": strength}),
    ):
        if inputs.has(law):
            inputs = changed(inputs, law, **values)
    inputs = replace(inputs, diameter=np.full(3, diameter), length=np.full(3, length))
    positions, velocities, _ = journey(3, 6, seed)
    try:
        result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    except (ElementError, PositionError) as error:
        refused = str(error)
    else:
        refused = "" if sound(result) and np.isfinite(result.slope).all() else "not sound"
    assert not refused or "overflows" in refused


@pytest.mark.parametrize("depth", [LEAST, 1e-300, 1e-160])
def test_the_least_penetration_is_contact(depth: float) -> None:
    inputs = everything(2, 5)
    bare = without(inputs, "suction", "smoothed", "nodal")
    place = np.array([[-depth, 0.0, 0.0], [-depth, 2.0, 0.0], [-depth, 4.0, 0.0]])
    result = ContactModel(bare).evaluate(place)
    assert result.contact.tolist() == [bool(0.5 * depth + 0.5 * depth > 0.0)] * 2
    assert sound(result)
