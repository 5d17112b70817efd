"""A scene in other units gives the same forces, with everything on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel
from mudline.contact.extras import ElementSuction, Extras, NodalSprings, NodeTrench, Smoothing, SuctionSprings
from mudline.contact.friction.trench import TrenchLaw
from mudline.curves import ForceCurve
from tests.contact.paths import journey
from tests.contact.scenes import everything


def in_units(inputs: ContactInput, length: float, force: float) -> ContactInput:
    """The input with its lengths divided by one unit and its forces by another; time stays in seconds."""
    line, spring, bed = force / length, force / length, force / length**2
    return replace(
        inputs,
        coordinates=inputs.coordinates / length,
        length=inputs.length / length,
        diameter=inputs.diameter / length,
        curves=tuple(ForceCurve(np.column_stack([curve.ratios, curve.forces / line])) for curve in inputs.curves),
        linear_stiffness=inputs.linear_stiffness / bed,
        extras=_extras(inputs.extras, length, line, spring, bed, force),
    )


def _extras(extras: Extras, length: float, line: float, spring: float, bed: float, force: float) -> Extras:
    smooth, own, springs = extras.smoothing, extras.nodal, extras.suction_springs
    sucking, rubbing, ditch = extras.suction, extras.friction, extras.trench
    assert smooth is not None
    assert own is not None
    assert springs is not None
    assert sucking is not None
    assert rubbing is not None
    assert ditch is not None
    assert extras.unloading is not None
    assert extras.lateral is not None
    law = sucking.law
    pull = law._replace(  # velocities are in the unit of length too
        force_factor=law.force_factor / line * length**law.force_exponent,
        depth_factor=law.depth_factor / length * length**law.depth_exponent,
        regularisation=law.regularisation / length,
    )
    kept = rubbing.law
    rub = replace(kept, stiffness=kept.stiffness / spring, mobilisation=kept.mobilisation / length)
    walls = TrenchLaw(ditch.law.bottom / length, ditch.law.upper / length, ditch.law.peak / force)
    return Extras(
        smoothing=Smoothing(smooth.half_width / length, smooth.one_sided),
        nodal=NodalSprings(own.stiffness / spring, own.half_width / length, own.one_sided),
        unloading=extras.unloading / bed,
        suction_springs=SuctionSprings(springs.stiffness / bed, springs.extent / length),
        suction=ElementSuction(sucking.elements, pull),
        friction=replace(rubbing, law=rub),
        lateral=extras.lateral / bed,
        trench=NodeTrench(walls, ditch.straight / length),
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
    assert one.state is not None
    assert two.state is not None
    assert np.array_equal(one.state, two.state)
    for here, there, unit in (
        (one.reaction, two.reaction, force),
        (one.force, two.force, force / length),
        (one.stiffness, two.stiffness, force / length**2),
        (one.ratio, two.ratio, 1.0),
    ):
        # a rounded position times a stiffness is what the terms differ by
        np.testing.assert_allclose(there * unit, here, rtol=0.0, atol=2e-12 * max(1.0, np.abs(here).max()))
