"""A scene in other units gives the same forces, with everything on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel
from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from tests.builders.contact import everything, journey, on

POWERS = {"F": (1, 0), "F/L": (1, -1), "F/L2": (1, -2), "L": (0, 1), "L/T": (0, 1), "1": (0, 0), "deg": (0, 0)}
"""Powers of force and length in the units of parameters; time stays in seconds."""


def in_units(inputs: ContactInput, length: float, force: float) -> ContactInput:
    """The input with its lengths divided by one unit and its forces by another, as the laws declare them."""
    laws = []
    for name, given_law in inputs.assigned.items():
        scaled: dict[str, FloatArray] = {}
        for parameter in given_law.law.parameters:
            values = given_law[parameter.name]
            if parameter.unit.endswith("(T/L)^n"):  # velocities are in the unit of length too
                values = values * length ** given_law[f"{parameter.name.removesuffix('factor')}exponent"]
            powers = POWERS[parameter.unit.removesuffix(" (T/L)^n")]
            scaled[parameter.name] = values / (force ** powers[0] * length ** powers[1])
        laws.append(on(name, given_law.rows, **scaled))
    per_length = force / length
    return replace(
        inputs,
        coordinates=inputs.coordinates / length,
        length=inputs.length / length,
        diameter=inputs.diameter / length,
        curves=tuple(ForceCurve(np.column_stack([curve.ratios, curve.forces / per_length])) for curve in inputs.curves),
        tables=tuple(table / [length, per_length] for table in inputs.tables),
        laws=tuple(laws),
    )


@settings(max_examples=30)
@given(
    st.integers(1, 9),
    st.integers(0, 2**32 - 1),
    st.sampled_from([(0.3048, 4.4482216152605), (0.001, 1.0), (1.0, 1000.0)]),
)
def test_units_do_not_matter(elements: int, seed: int, units: tuple[float, float]) -> None:
    """In feet and pounds, in millimetres and newtons, in metres and kilonewtons."""
    length, force = units
    inputs = everything(elements, seed)
    positions, velocities, _ = journey(elements, 10, seed)
    one = ContactModel(inputs).evaluate(positions, velocities=velocities)
    two = ContactModel(in_units(inputs, length, force)).evaluate(positions / length, velocities=velocities / length)
    assert np.array_equal(one.contact, two.contact)
    for name in ("state", "regularised", "friction_state", "rigid"):
        here, there = getattr(one, name), getattr(two, name)
        assert (here is None) == (there is None)
        assert here is None or np.array_equal(here, there)
    for here, there, unit in (
        (one.reaction, two.reaction, force),
        (one.force, two.force, force / length),
        (one.stiffness, two.stiffness, force / length**2),
        (one.ratio, two.ratio, 1.0),
    ):
        # a rounded position times a stiffness is what the terms differ by
        np.testing.assert_allclose(there * unit, here, rtol=0.0, atol=2e-12 * max(1.0, np.abs(here).max()))
