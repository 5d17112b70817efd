"""numpy and the loops give the same bits: results and states, at once, in parts, step by step, on several threads."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.plan import Backend
from mudline.model.contact.seabed import PlanesSeabed, SlopingSeabed
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    all_laws,
    at_depths,
    bridge_law,
    chain,
    each_backend,
    friction,
    journey,
    on,
    suction,
    trench,
)
from tests.model.contact.comparison import Scene, Sizes, arrays_of, compare, differences, equal_bits, plain_loops
from tests.model.contact.random_scenes import LARGEST, SUBSETS, random_scene

pytestmark = pytest.mark.slow

BACKENDS: tuple[Backend, ...] = ("numpy", "fast")
USUAL = Sizes(16384, 4096, 16, 2)
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


def odd_lines() -> dict[str, Scene]:
    """Upright lines, nodes in one place, walls, and laws at the ends of their ranges."""
    upright = np.zeros((3, 3, 3))
    upright[:, :, 0] = [-0.1, -0.2, -0.3]
    upright[1:, :, 2] = 0.2
    crowd = upright.copy()
    crowd[:, 1] = crowd[:, 0]
    beside = friction(3, (0.0, 0.8), ellipse=True), on("lateral", 2, stiffness=900.0), trench(2, 0.1, 0.5, 1e3)
    steep = PlanesSeabed([[0.0, 0.0, 0.0]], [89.99999999999])
    wide = on("smoothed", 2, stiffness=5e4, half_width=[LARGEST, 5e-324], one_sided=[0.0, 1.0])
    sucks = suction(bridge_law())
    return {
        "upright": scene(chain([LINEAR, NONE], *beside), upright),
        "upright at a wall": scene(chain([LINEAR, NONE], *beside, seabed=steep), upright),
        "crowded": scene(chain([LINEAR, NONE], *beside), crowd),
        "crowded at a wall": scene(chain([LINEAR, NONE], *beside, seabed=steep), crowd),
        "zones of any width": scene(chain([NONE, NONE], *beside, wide), upright),
        "one step": scene(chain([LINEAR], sucks), at_depths([[0.1, 0.1]])),
        "overflow": scene(
            chain([LINEAR], on("nodal", 2, stiffness=[1e300, 1.0]), on("lateral", 1, stiffness=1.0)),
            np.full((1, 2, 3), -1e10),
        ),
        "a lateral spring beside a zone": scene(
            chain([CURVE, LINEAR], on("lateral", 2, stiffness=1.0)),
            at_depths([[0.005, 0.005, -0.005], [-0.001, 0.002, 0.1]]),
        ),
    }


@pytest.mark.parametrize("name", odd_lines())
def test_odd_lines(name: str) -> None:
    given_scene = odd_lines()[name]
    assert compare(given_scene, plain=True) == []
    if name == "overflow":
        with plain_loops(), pytest.raises(ValueError, match="overflows"):
            ContactModel(given_scene.inputs, backend="fast").evaluate(given_scene.positions)


@pytest.mark.covered
def test_a_force_that_overflows_only_on_the_way_is_mended() -> None:
    curve = ForceCurve([(0.0, -1.7e308), (2.5, 1.7e308)])
    inputs = chain([CURVE], on("lateral", 1, stiffness=1.0), curves=(curve,), diameter=1.0, length=1e-3)
    positions = at_depths([[2.0, 2.0], [2.1, 2.1]])
    assert compare(scene(inputs, positions)) == []
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


@pytest.mark.compiled
@pytest.mark.untraced
def test_a_long_line_on_several_threads() -> None:
    """Several ranges of elements and of nodes, as they are divided by default."""
    elements = 2600
    inputs = all_laws(elements, 5, SlopingSeabed(0.001, 30.0))
    positions, velocities, _ = journey(elements, 30, 5)
    one = ContactModel(inputs, backend="numpy").evaluate(positions, velocities=velocities)
    for threads in (1, 2, 3):
        contact = ContactModel(inputs, backend="fast", threads=threads)
        assert differences(one, contact.evaluate(positions, velocities=velocities)) == []


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
