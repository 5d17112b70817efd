"""What holds for every scene and every path: with suction, friction, unloading and trenches all on."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact import ContactInput, ContactModel, model
from mudline.contact.arrays import FloatArray
from mudline.contact.extras import Extras, NodeFriction
from mudline.contact.floors import FlatFloor, Floor, SlopingFloor
from tests.contact.chains import CLAY, PULLING
from tests.contact.paths import alone, journey, rearranged, renumbered, same_bits, stepped
from tests.contact.scenes import everything, friction

seeds = st.integers(0, 2**32 - 1)
lines = st.integers(1, 9)


def close(one: FloatArray, other: FloatArray, tolerance: float = 1e-9) -> bool:
    """Whether two arrays differ by no more than a share of the largest term."""
    return bool(np.allclose(one, other, rtol=0.0, atol=tolerance * max(1.0, np.abs(other).max(initial=0.0))))


def without_suction(elements: int, seed: int) -> ContactInput:
    """Everything but suction."""
    inputs = everything(elements, seed)
    return replace(inputs, extras=replace(inputs.extras, suction=None, suction_springs=None))


@settings(max_examples=40)
@given(lines, seeds)
def test_no_force_where_there_is_no_contact(elements: int, seed: int) -> None:
    inputs = without_suction(elements, seed)
    inputs = replace(inputs, extras=replace(inputs.extras, nodal=None))
    smoothing = inputs.extras.smoothing
    assert smoothing is not None
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    centred = ~smoothing.one_sided & np.isfinite(inputs.linear_stiffness)
    above = result.depth <= np.where(centred, 0.0 - smoothing.half_width, 0.0)
    assert np.array_equal(result.contact, ~above)
    for values in (result.force, result.stiffness, result.slope):
        assert not values[above].any()
    touched = np.zeros(result.normal_force.shape, np.bool_)
    for end in inputs.element_nodes.T:
        touched[:, end] |= result.contact
    assert not result.reaction[~touched].any()
    assert not np.signbit(result.force[above]).any()


@settings(max_examples=40)
@given(lines, seeds)
def test_the_bed_never_pulls_without_suction_where_tension_is_cut(elements: int, seed: int) -> None:
    inputs = replace(without_suction(elements, seed), curves=(PULLING,), tension="cut")
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    assert (result.force >= 0.0).all()
    assert (result.normal_force >= 0.0).all()
    assert not result.force[result.cut].any()


@settings(max_examples=40)
@given(lines, seeds)
def test_friction_never_exceeds_its_limit(elements: int, seed: int) -> None:
    inputs = everything(elements, seed)
    rubbing = inputs.extras.friction
    assert rubbing is not None
    peak = np.zeros(elements + 1)
    if inputs.extras.trench is not None:
        peak = np.nan_to_num(inputs.extras.trench.law.peak)
    inputs = replace(inputs, extras=replace(inputs.extras, lateral=None))
    positions, velocities, _ = journey(elements, 12, seed)
    result = ContactModel(inputs).evaluate(positions, velocities=velocities)
    assert result.friction is not None
    pressed = np.maximum(result.normal_force, 0.0)
    limit = rubbing.law.coefficients * pressed[..., None]
    limit[..., 1] += np.where(pressed > 0.0, peak, 0.0)
    share = np.divide(np.abs(result.friction), limit, out=np.zeros_like(limit), where=limit > 0.0)
    assert (share <= 1.0 + 1e-12).all()
    assert (np.hypot(*np.moveaxis(share, -1, 0))[:, rubbing.law.ellipse] <= 1.0 + 1e-12).all()
    assert not result.friction[limit == 0.0].any()
    assert not result.friction[:, ~rubbing.law.active].any()


def on_fixed_axes(elements: int, seed: int) -> NodeFriction:
    """Friction with constant springs, along directions that do not turn."""
    rubbing = friction(elements + 1, np.random.default_rng(seed))
    law = replace(rubbing.law, stiffness=np.where(np.isnan(rubbing.law.stiffness), 5e4, rubbing.law.stiffness))
    return NodeFriction(law, np.nan_to_num(rubbing.angle))


def work(reaction: FloatArray, positions: FloatArray) -> float:
    """Work done on the bed with the forces at the ends of the steps; of a spring no less than what it stores."""
    return float(-(reaction[1:] * np.diff(positions, axis=0)).sum())


@settings(max_examples=40)
@given(lines, seeds, st.booleans())
def test_closed_cycles_never_give_work(elements: int, seed: int, trenches: bool) -> None:
    whole = everything(elements, seed)
    extras = replace(
        whole.extras,
        friction=on_fixed_axes(elements, seed),
        trench=whole.extras.trench if trenches else None,
        suction_springs=None,
        lateral=None,
    )
    contact = ContactModel(replace(whole, curves=(CLAY,), extras=extras))
    positions, _, times = journey(elements, 20, seed)
    positions[0, :, 0] += 10.0  # begins and ends off the bed
    closed = np.concatenate([positions, positions[:1]])
    result = contact.evaluate(closed, times=np.append(times, times[-1] + 1.0))
    assert work(result.reaction, closed) >= -1e-9
    assert work(result.normal_force[..., None] * result.normal, closed) >= -1e-9


@settings(max_examples=25)
@given(lines, seeds, seeds)
def test_the_order_and_sense_of_the_elements_do_not_matter(elements: int, seed: int, other: int) -> None:
    rng = np.random.default_rng(other)
    inputs, order = everything(elements, seed), rng.permutation(elements)
    mingled = rearranged(inputs, order, rng.random(elements) < 0.5)
    positions, velocities, _ = journey(elements, 10, seed)
    one, two = (ContactModel(each).evaluate(positions, velocities=velocities) for each in (inputs, mingled))
    for name in ("depth", "contact", "force", "stiffness", "state"):
        assert np.array_equal(getattr(two, name), getattr(one, name)[:, order])
    assert close(two.reaction, one.reaction)


@settings(max_examples=25)
@given(lines, seeds, seeds)
def test_the_order_of_the_nodes_does_not_matter(elements: int, seed: int, other: int) -> None:
    inputs, order = everything(elements, seed), np.random.default_rng(other).permutation(elements + 1)
    positions, velocities, _ = journey(elements, 10, seed)
    one = ContactModel(inputs).evaluate(positions, velocities=velocities)
    two = ContactModel(renumbered(inputs, order)).evaluate(positions[:, order], velocities=velocities[:, order])
    assert close(two.force, one.force)
    assert close(two.reaction, one.reaction[:, order])


@settings(max_examples=20)
@given(lines, st.integers(1, 12), seeds, st.integers(1, 60), st.booleans())
def test_chunks_and_steps_do_not_change_a_bit(elements: int, steps: int, seed: int, chunk: int, timed: bool) -> None:
    contact = ContactModel(everything(elements, seed))
    positions, velocities, times = journey(elements, steps, seed)
    rates, clock = (None, times) if timed else (velocities, None)
    whole = contact.evaluate(positions, velocities=rates, times=clock)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(model, "_CHUNK", chunk)
        assert same_bits(contact.evaluate(positions, velocities=rates, times=clock), whole)
        parts = list(contact.stream(positions, velocities=rates, times=clock))
    assert sum(len(part.result.depth) for part in parts) == steps
    for start, part in parts:
        assert same_bits(part, whole.steps(start, start + len(part.depth)))
    if not timed:
        for number, result in enumerate(stepped(contact, positions, velocities)):
            assert same_bits(result, whole.step(number))


@settings(max_examples=15)
@given(lines, seeds)
def test_elements_do_not_know_each_other(elements: int, seed: int) -> None:
    """Without what belongs to nodes, the whole is the sum of its elements."""
    inputs = everything(elements, seed)
    inputs = replace(inputs, extras=replace(inputs.extras, friction=None, nodal=None, trench=None, lateral=None))
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


def carried(inputs: ContactInput, floor: Floor, degrees: float, shift: FloatArray) -> ContactInput:
    """The input on another floor, with the directions and trenches of its nodes turned and shifted."""
    rubbing, ditch = inputs.extras.friction, inputs.extras.trench
    assert rubbing is not None
    assert ditch is not None
    plan = np.zeros((2, len(ditch.straight), 3))
    plan[:, :, 1:] = ditch.straight.reshape(-1, 2, 2).swapaxes(0, 1)
    straight = (spun(plan, degrees) + shift)[:, :, 1:].swapaxes(0, 1).reshape(-1, 4)
    extras = replace(
        inputs.extras,
        friction=NodeFriction(rubbing.law, rubbing.angle + degrees),
        trench=replace(ditch, straight=straight),
    )
    return replace(inputs, floor=floor, extras=extras)


@settings(max_examples=40)
@given(lines, seeds, st.floats(-180.0, 180.0), st.floats(-50.0, 50.0), st.floats(-50.0, 50.0), st.booleans())
def test_a_scene_may_be_turned_and_shifted(
    elements: int, seed: int, degrees: float, y: float, z: float, slopes: bool
) -> None:
    """A slope goes through the origin, so there only turning leaves it alone; friction at an angle needs a flat bed."""
    shift = np.zeros(3) if slopes else np.array([0.0, y, z])
    before, after = (
        (SlopingFloor(7.0, 20.0), SlopingFloor(7.0, 20.0 + degrees)) if slopes else (FlatFloor(), FlatFloor())
    )
    inputs = everything(elements, seed)
    if slopes and inputs.extras.friction is not None:
        free = NodeFriction(inputs.extras.friction.law, np.full(elements + 1, np.nan))
        inputs = replace(inputs, extras=replace(inputs.extras, friction=free))
    positions, velocities, _ = journey(elements, 10, seed)
    positions[..., 0] += before.elevation(positions[..., 1], positions[..., 2])
    here = ContactModel(replace(inputs, floor=before))
    there = ContactModel(carried(inputs, after, degrees, shift))
    one = here.evaluate(positions, velocities=velocities)
    two = there.evaluate(spun(positions, degrees) + shift, velocities=spun(velocities, degrees))
    assert close(two.force, one.force, 1e-8)
    assert close(two.reaction, spun(one.reaction, degrees), 1e-8)


def test_no_extras_at_all() -> None:
    inputs = replace(everything(4, 3), extras=Extras())
    positions, velocities, _ = journey(4, 5, 3)
    contact = ContactModel(inputs)
    whole = contact.evaluate(positions)
    assert whole.force.any()
    for number, result in enumerate(stepped(contact, positions, velocities)):
        for name in ("force", "reaction", "depth"):
            assert np.array_equal(getattr(result, name), getattr(whole, name)[number])
