"""What holds for every scene and every path, in any units: with suction, friction, unloading and trenches all on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.trench import wall_coefficient
from mudline.model.contact.seabed import FlatSeabed, Seabed, SlopingSeabed
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import (
    ALONG_Y,
    PULLING,
    SAND,
    alone,
    changed,
    everything,
    journey,
    on,
    rearranged,
    renumbered,
    without,
)

seeds = st.integers(0, 2**32 - 1)
lines = st.integers(1, 9)


def close(one: FloatArray, other: FloatArray, tolerance: float = 1e-9) -> bool:
    """Whether two arrays differ by no more than a share of the largest term."""
    return bool(np.allclose(one, other, rtol=0.0, atol=tolerance * max(1.0, np.abs(other).max(initial=0.0))))


def without_suction(elements: int, seed: int) -> ContactInput:
    """Everything but suction."""
    return without(everything(elements, seed), "suction", "suction spring")


@given(lines, seeds)
def test_no_force_where_there_is_no_contact(elements: int, seed: int) -> None:
    inputs = without(without_suction(elements, seed), "nodal")
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    onset = np.zeros(elements)
    if (smoothed := inputs.assigned.get("smoothed")) is not None:
        onset[smoothed.rows] = np.where(smoothed["one_sided"] > 0.0, 0.0, 0.0 - smoothed["half_width"])
    above = result.depth <= onset
    assert np.array_equal(result.contact, ~above)
    for values in (result.force, result.stiffness, result.slope):
        assert not values[above].any()
    touched = np.zeros(result.normal_force.shape, np.bool_)
    for end in inputs.element_nodes.T:
        touched[:, end] |= result.contact
    assert not result.reaction[~touched].any()
    assert not np.signbit(result.force[above]).any()


@given(lines, seeds)
def test_the_seabed_never_pulls_without_suction_where_tension_is_cut(elements: int, seed: int) -> None:
    inputs = replace(without(without_suction(elements, seed), "soil"), curves=(PULLING, SAND), tension="cut")
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    assert (result.force >= 0.0).all()
    assert (result.normal_force >= 0.0).all()
    assert not result.force[result.cut].any()


def largest_added(inputs: ContactInput, pressed: FloatArray) -> FloatArray:
    """The most that the trenches of the elements can add to the lateral limits of nodes under normal forces."""
    found = np.zeros(pressed.shape)
    half = 0.5 * inputs.length
    around = np.zeros(len(inputs.node_ids))
    coefficient = inputs.assigned["friction"].spread("lateral_coefficient", len(around), 0.0)
    for end in inputs.element_nodes.T:
        np.add.at(around, end, half)
    highest = np.array([table[:, 1].max() for table in inputs.tables])
    for name in {"trench peak", "trench table", "trench wall"} & set(inputs.assigned):
        law = inputs.assigned[name]
        for end in inputs.element_nodes[law.rows].T:
            if name == "trench peak":
                added = law["peak"] * half[law.rows] * np.ones((len(pressed), 1))
            elif name == "trench table":
                added = highest[law["table"].astype(np.intp)] * half[law.rows] * np.ones((len(pressed), 1))
            else:
                wall = wall_coefficient(law["depth"], law["bottom"], law["upper"], coefficient[end])
                added = wall * pressed[:, end] * half[law.rows] / around[end]
            found[:, end] += added
    return np.where(pressed > 0.0, found, 0.0)


@given(lines, seeds)
def test_friction_never_exceeds_its_limit(elements: int, seed: int) -> None:
    inputs = without(everything(elements, seed), "lateral")
    if not inputs.has("friction"):
        return
    law, nodes = inputs.assigned["friction"], elements + 1
    mu = np.column_stack([law.spread(f"{side}_coefficient", nodes, 0.0) for side in ("axial", "lateral")])
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    assert result.friction is not None
    pressed = np.maximum(result.normal_force, 0.0)
    limit = mu * pressed[..., None]
    limit[..., 1] += largest_added(inputs, pressed)
    share = np.divide(np.abs(result.friction), limit, out=np.zeros_like(limit), where=limit > 0.0)
    assert (share <= 1.0 + 1e-12).all()
    ellipse = law.spread("elliptic", nodes, 0.0) > 0.0
    assert (np.hypot(*np.moveaxis(share, -1, 0))[:, ellipse] <= 1.0 + 1e-12).all()
    active = np.isin(np.arange(nodes), law.rows)
    assert not result.friction[:, active][(limit == 0.0)[:, active]].any()
    assert not result.friction[:, np.setdiff1d(np.arange(nodes), law.rows)].any()


def on_fixed_axes(inputs: ContactInput) -> ContactInput:
    """The input with constant springs of friction, along directions that do not turn."""
    if not inputs.has("friction"):
        return inputs
    law = inputs.assigned["friction"]
    springs = {name: np.where(np.isnan(law[name]), 5e4, law[name]) for name in ("axial_stiffness", "lateral_stiffness")}
    return changed(inputs, "friction", angle=np.nan_to_num(law["angle"]), **springs)


def work(reaction: FloatArray, positions: FloatArray) -> float:
    """Work done on the seabed with the forces at the ends of the steps; of a spring no less than what it stores."""
    return float(-(reaction[1:] * np.diff(positions, axis=0)).sum())


@given(lines, seeds, st.booleans())
def test_closed_cycles_never_give_work(elements: int, seed: int, trenches: bool) -> None:
    inputs = without(on_fixed_axes(everything(elements, seed)), "lateral", "suction spring")
    if not trenches:
        inputs = without(inputs, "trench peak", "trench wall", "trench table")
    contact = ContactModel(inputs)
    positions, _, times = journey(elements, 20, seed)
    positions[0, :, 0] += 10.0  # begins and ends off the seabed
    closed = np.concatenate([positions, positions[:1]])
    result = contact.evaluate(closed, times=np.append(times, times[-1] + 1.0))
    assert work(result.reaction, closed) >= -1e-9
    assert work(result.normal_force[..., None] * result.normal, closed) >= -1e-9


@given(lines, seeds, seeds)
def test_the_order_and_sense_of_the_elements_do_not_matter(elements: int, seed: int, other: int) -> None:
    rng = np.random.default_rng(other)
    inputs, order = everything(elements, seed), rng.permutation(elements)
    mingled = rearranged(inputs, order, rng.random(elements) < 0.5)
    positions, velocities, _ = journey(elements, 10, seed)
    one, two = (ContactModel(each).evaluate(positions, velocities=velocities) for each in (inputs, mingled))
    for name in ("depth", "contact", "force", "stiffness", "state", "regularised"):
        here, there = getattr(one, name), getattr(two, name)
        assert (here is None) == (there is None)
        assert here is None or np.array_equal(there, here[:, order])
    assert close(two.reaction, one.reaction)


@given(lines, seeds, seeds)
def test_the_order_of_the_nodes_does_not_matter(elements: int, seed: int, other: int) -> None:
    inputs, order = everything(elements, seed), np.random.default_rng(other).permutation(elements + 1)
    positions, velocities, _ = journey(elements, 10, seed)
    one = ContactModel(inputs).evaluate(positions, velocities=velocities)
    two = ContactModel(renumbered(inputs, order)).evaluate(positions[:, order], velocities=velocities[:, order])
    assert close(two.force, one.force)
    assert close(two.reaction, one.reaction[:, order])


@given(lines, seeds)
def test_elements_do_not_know_each_other(elements: int, seed: int) -> None:
    """Without what belongs to nodes, the whole is the sum of its elements."""
    inputs = without(everything(elements, seed), "friction", "nodal", "lateral")
    positions, velocities, _ = journey(elements, 10, seed)
    whole = ContactModel(inputs).evaluate(positions, velocities=velocities)
    total = np.zeros_like(whole.reaction)
    for element in range(elements):
        one = ContactModel(alone(inputs, element)).evaluate(positions, velocities=velocities)
        assert np.array_equal(one.force[:, 0], whole.force[:, element])
        assert np.array_equal(one.stiffness[:, 0], whole.stiffness[:, element])
        total += one.reaction
    assert close(total, whole.reaction, 1e-13)


def spun(vectors: FloatArray, degrees: float) -> FloatArray:
    """Vectors turned about X, from Y to Z."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    found: FloatArray = vectors @ np.array([[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine]])
    return found


def carried(inputs: ContactInput, seabed: Seabed, degrees: float, shift: FloatArray) -> ContactInput:
    """The input on another seabed, with the directions and trenches turned and shifted."""
    for name in ("trench peak", "trench wall", "trench table"):
        if inputs.has(name):
            ends = np.column_stack([inputs.assigned[name][end] for end in ALONG_Y]).reshape(-1, 2, 2)
            plan = np.concatenate([np.zeros((len(ends), 2, 1)), ends], axis=2)
            straight = (spun(plan, degrees) + shift)[:, :, 1:].reshape(-1, 4)
            inputs = changed(inputs, name, **dict(zip(ALONG_Y, straight.T, strict=True)))
    if inputs.has("friction"):
        inputs = changed(inputs, "friction", angle=inputs.assigned["friction"]["angle"] + degrees)
    return replace(inputs, seabed=seabed)


@given(lines, seeds, st.floats(-180.0, 180.0), st.floats(-50.0, 50.0), st.floats(-50.0, 50.0), st.booleans())
def test_a_scene_may_be_turned_and_shifted(
    elements: int, seed: int, degrees: float, y: float, z: float, slopes: bool
) -> None:
    """A slope goes through the origin, so there only turning leaves it alone; an angle needs a flat seabed."""
    shift = np.zeros(3) if slopes else np.array([0.0, y, z])
    before, after = (
        (SlopingSeabed(7.0, 20.0), SlopingSeabed(7.0, 20.0 + degrees)) if slopes else (FlatSeabed(), FlatSeabed())
    )
    inputs = everything(elements, seed)
    if slopes and inputs.has("friction"):
        inputs = changed(inputs, "friction", angle=np.nan)
    positions, velocities, _ = journey(elements, 10, seed)
    positions[..., 0] += before.elevation(positions[..., 1], positions[..., 2])
    here = ContactModel(replace(inputs, seabed=before))
    there = ContactModel(carried(inputs, after, degrees, shift))
    one = here.evaluate(positions, velocities=velocities)
    two = there.evaluate(spun(positions, degrees) + shift, velocities=spun(velocities, degrees))
    assert close(two.force, one.force, 1e-8)
    assert close(two.reaction, spun(one.reaction, degrees), 1e-8)


POWERS = {"F": (1, 0), "F/L": (1, -1), "F/L2": (1, -2), "F/L3": (1, -3), "L": (0, 1), "L/T": (0, 1)}
POWERS |= {"1": (0, 0), "deg": (0, 0)}
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
