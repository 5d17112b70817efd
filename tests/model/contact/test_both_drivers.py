"""numpy and the loops give the same bits: results and states, at once, in parts, step by step, on threads."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.plan import Backend
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import (
    CURVE,
    all_laws,
    at_depths,
    chain,
    each_backend,
    journey,
    on,
)
from tests.model.contact.comparison import Scene, Sizes, arrays_of, compare, equal_bits
from tests.model.contact.random_scenes import SUBSETS, random_scene

pytestmark = pytest.mark.slow

BACKENDS: tuple[Backend, ...] = ("numpy", "fast")
USUAL = Sizes(16384, 16, 2)
seeds = st.integers(0, 2**32 - 1)


def scene(inputs: ContactInput, positions: FloatArray, velocities: FloatArray | None = None) -> Scene:
    """An input and a motion; without velocities they are differences over steps of 0.1."""
    times = None if velocities is not None else 0.1 * np.arange(float(len(positions)))
    return Scene(inputs, positions, velocities, times, None, USUAL)


# -------------------------------------------------------------------------------------------------------- random scenes


@pytest.mark.compiled
@pytest.mark.untraced
@pytest.mark.parametrize("number", range(len(SUBSETS)))
def test_scenes_with_some_laws(number: int) -> None:
    names, flat = SUBSETS[number]
    assert compare(random_scene(1000 * number, names, flat=flat)) == []


@given(seeds)
@example(282788)  # the stiffness of its soil overflows
def test_any_scene_through_loops_that_are_not_compiled(seed: int) -> None:
    assert compare(random_scene(seed), plain=True) == []


# ------------------------------------------------------------------------------------------------ everything, and parts


@pytest.mark.covered
def test_a_force_that_overflows_only_on_the_way_is_mended() -> None:
    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    inputs = chain([CURVE], on("lateral", 1, stiffness=1.0), curves=(curve,), diameter=1.0, length=1e-3)
    positions = at_depths([[2.0, 2.0], [2.1, 2.1]])
    assert compare(scene(inputs, positions), plain=True) == []
    result = ContactModel(inputs, backend="fast").evaluate(positions)
    assert result.force.ravel() == pytest.approx([1.02e308, 1.156e308])


def test_a_step_is_mended_amid_others_with_what_came_before() -> None:
    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    inputs = chain([CURVE], on("lateral", 1, stiffness=1.0), curves=(curve,), diameter=1.0, length=1e-3)
    positions = at_depths([[0.1, 0.1], [2.0, 2.0], [0.2, 0.2], [2.1, 2.1], [0.3, 0.3]])
    positions[..., 2] += 0.01 * np.arange(5.0)[:, None]
    one_by_one = scene(inputs, positions)._replace(sizes=USUAL._replace(batch=1))
    assert compare(one_by_one, plain=True) == []
    result = ContactModel(inputs, backend="numpy").evaluate(positions)
    assert result.friction is not None
    assert np.abs(result.friction[1:]).max(axis=(1, 2)) == pytest.approx(0.01 * np.arange(1.0, 5.0) * 0.5e-3)


@each_backend
def test_a_state_is_never_written_to(backend: Backend) -> None:
    contact = ContactModel(all_laws(60, 3), backend=backend)
    positions, velocities, _ = journey(60, 8, 3)
    state, kept = contact.initial_state(), []
    for place, rate in zip(positions, velocities, strict=True):
        _, state = contact.step(place, rate, state)
        kept.append((state, {name: array.copy() for name, array in arrays_of(state) if array is not None}))
    for old, copies in kept:
        for name, array in arrays_of(old):
            if name.endswith("breakout"):  # none in this scene; see test_breakout
                continue
            assert array is not None
            assert equal_bits(array, copies[name]).all()


@pytest.mark.covered
def test_tangents_are_the_same() -> None:
    inputs = all_laws(60, 2)
    positions, velocities, _ = journey(60, 2, 2)
    one, other = (
        contact.tangent(positions[0], velocities[0], contact.initial_state())
        for contact in (ContactModel(inputs, backend=backend) for backend in BACKENDS)
    )
    assert one.by_position.values.tobytes() == other.by_position.values.tobytes()
    assert one.by_velocity.values.tobytes() == other.by_velocity.values.tobytes()
