"""The hysteretic soil: worked numbers, an independent program, what holds on any path, tangents, the critical step."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from mudline.model.contact import ContactInput, ContactModel, ElementError
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.soil import SOIL, Numbers
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import NONE, at_depths, chain, each_backend, law_of, on
from tests.model.contact.soil_program import Clay, Walker

D = 0.3
CLAY = Clay()
NO_DECAY = replace(CLAY, lambda_suc=1e12)
TURNING = 4084665.7828
"""K_max P_u / D at z/D = 0.2, N/m2."""


def given_soil(clay: Clay) -> ContactInput:
    numbers = dict(zip((parameter.name for parameter in SOIL.parameters), astuple(clay)[1:], strict=True))
    return chain([NONE], on("soil", 1, **numbers), diameter=clay.diameter)


def forces(clay: Clay, path: Sequence[float] | FloatArray, backend: Backend = "numpy") -> FloatArray:
    """Force per unit length at each depth of a path."""
    depths = np.asarray(path, np.float64)
    found: FloatArray = (
        ContactModel(given_soil(clay), backend=backend).evaluate(at_depths(depths[:, None] + [0.0, 0.0])).force[:, 0]
    )
    return found


soils = st.builds(
    Clay,
    diameter=st.just(D),
    su0=st.floats(1e3, 2e4),
    gradient=st.sampled_from([0.0, 1500.0, 8000.0]),
    a=st.floats(5.0, 7.0),
    b=st.floats(0.2, 0.3),
    k_max=st.floats(50.0, 500.0),
    f_suc=st.floats(0.0, 1.0),
    lambda_suc=st.floats(0.2, 2.0),
    lambda_rep=st.floats(0.0, 1.5),
    buoyancy=st.sampled_from([0.0, 9000.0]),
)
depths = st.one_of(
    st.floats(-0.05, 0.3),
    st.floats(0.0, 0.03),
    st.sampled_from([-0.01, 0.0, 0.1]),
).map(lambda depth: round(depth, 9))  # the steps of the other program underflow on a way to 1e-303 m
paths = st.lists(depths, min_size=1, max_size=9)

# -------------------------------------------------------------------------------------------------------------- numbers


@each_backend
def test_initial_penetration(backend: Backend) -> None:
    ratios = np.array([0.01, 0.05, 0.1, 0.2, 0.5, 1.0])
    expected = [1067.9279169, 3268.0204652, 4863.4491181, 5977.5596821, 7830.3275104, 9761.1940299]
    assert_allclose(forces(CLAY, D * ratios, backend), expected, rtol=1e-9)
    slopes = [296966.73388, 129716.21422, 29097.960813, 15815.340064, 10982.772704]
    result = ContactModel(given_soil(CLAY), backend=backend).evaluate(at_depths(D * ratios[:, None] + [0.0, 0.0]))
    assert_allclose(np.delete(result.stiffness[:, 0], 2), slopes, rtol=1e-9)


@each_backend
def test_uplift_without_decay(backend: Backend) -> None:
    rise = np.array([0.0, 0.0005, 0.001, 0.005, 0.01, 0.02, 0.05, 0.1])
    expected = [
        5977.5596821, 5401.4343717, 4890.2482986, 2233.1604502, 593.47087384, -895.54478842,
        -2159.7357255, -2442.6902532,
    ]  # fmt: skip
    assert_allclose(forces(NO_DECAY, D * (0.2 - rise), backend), expected, rtol=1e-9)
    assert forces(NO_DECAY, [0.2 * D, D * (0.2 - 0.012952972694)], backend)[1] == pytest.approx(0.0, abs=1e-5)


def test_static_embedment() -> None:
    assert forces(CLAY, [0.0027749876668])[0] == pytest.approx(1000.0, rel=1e-9)
    assert forces(CLAY, [0.021212524049])[0] == pytest.approx(4000.0, rel=1e-9)


def test_weight_of_the_displaced_soil() -> None:
    """Of a half circle and of a whole one; nothing above the mudline."""
    heavy = replace(CLAY, buoyancy=9000.0)
    path = [-0.01, D / 2.0, D, 2.0 * D]
    half = np.pi * D**2 / 8.0
    lift = forces(heavy, path) - forces(CLAY, path)
    assert_allclose(lift, 9000.0 * np.array([0.0, half, 2.0 * half, 2.0 * half]), rtol=1e-12)


def test_loss_of_contact_and_the_way_back() -> None:
    """z_P is 0 where an uplift never fell through zero: here without suction."""
    bare = replace(CLAY, f_suc=0.0)
    path = [0.06, 0.0, 0.03, 0.06]
    force = forces(bare, path)
    assert force[1] == 0.0
    assert force[2] == pytest.approx(CLAY.initial(0.03) * np.exp(-0.3 + 0.5), rel=1e-12) or force[2] == pytest.approx(
        CLAY.initial(0.03), rel=1e-12
    )
    assert force[3] == pytest.approx(CLAY.initial(0.06), rel=1e-12)


# ----------------------------------------------------------------------------------------------------------- properties


@given(clay=soils, path=paths)
def test_an_independent_program_gives_the_same_in_small_steps(clay: Clay, path: list[float]) -> None:
    walker = Walker(clay)
    walked = [walker.go(depth, 300) for depth in path]
    scale = clay.ultimate(0.3) + clay.lift(0.3)
    assert_allclose(forces(clay, path), walked, atol=5e-3 * scale, rtol=0.0)


@given(clay=soils, path=paths)
def test_the_force_depends_on_the_path_and_not_on_its_steps(clay: Clay, path: list[float]) -> None:
    fine = [0.0]
    for one, other in pairwise([0.0, *path]):
        fine += [one + (other - one) * piece / 10.0 for piece in range(1, 10)] + [other]
    assert_allclose(
        forces(clay, fine)[10::10], forces(clay, path), rtol=0.0, atol=1e-12 * (clay.ultimate(0.3) + clay.lift(0.3))
    )


@given(clay=soils, path=paths)
def test_the_force_is_bounded_and_continuous(clay: Clay, path: list[float]) -> None:
    """A step of 1e-9 D either way, before or behind a reversal, changes the force by as little."""
    bare = replace(clay, buoyancy=0.0)
    force = forces(bare, path)
    most = np.array([bare.ultimate(max(depth, 0.0)) for depth in path])
    largest = bare.ultimate(0.3)
    assert (force <= most + 1e-12 * largest).all()
    assert (force >= -clay.f_suc * most - 1e-12 * largest).all()
    for way in (-1e-9, 1e-9):
        nudged = forces(bare, [*path, path[-1] + way * D])[-1]
        assert abs(nudged - force[-1]) < 1e-4 * largest


def leg(z: FloatArray, memory: tuple[float, ...], soil: Numbers) -> tuple[FloatArray, tuple[float, ...]]:
    """Forces on a straight way behind a memory, and the memory at its end."""
    memory = tuple(map(float, SOIL.begin(z[-1], memory)))
    if kind := int(SOIL.pending(z[-1], memory)):
        memory = (*memory[:-1], float(SOIL.locate[kind - 1](D, memory, soil)))
    force, _, after = SOIL.advance(z, D, memory, soil)
    return force, tuple(float(np.broadcast_to(number, len(z))[-1]) for number in after)


@settings(max_examples=settings().max_examples // 4)  # an example takes hundreds of cycles
@given(clay=soils, low=st.floats(1.05, 60.0), share=st.floats(0.02, 0.95))
def test_a_settled_cycle_takes_no_energy_out_of_the_soil(clay: Clay, low: float, share: float) -> None:
    """Between two depths below D/K_max, repeated until force and work repeat."""
    deep = min(low * D / clay.k_max, 0.3)
    high = D / clay.k_max + share * (deep - D / clay.k_max)
    soil: Numbers = astuple(clay)[1:]
    memory = tuple(map(float, SOIL.start))
    angle = np.linspace(0.0, np.pi, 4001)
    down = high + (deep - high) * 0.5 * (1.0 - np.cos(angle))  # denser where it turns
    with np.errstate(all="ignore"):
        _, memory = leg(np.array([deep]), memory, soil)
        force, before = np.zeros(1), np.full(1, np.inf)
        for _ in range(1500):  # the force depends on the path alone: one step for each way
            _, memory = leg(np.array([high]), memory, soil)
            before, (force, memory) = force, leg(np.array([deep]), memory, soil)
            if np.allclose(force, before, rtol=1e-12, atol=0.0):
                break
        assume(np.allclose(force, before, rtol=1e-9, atol=0.0))
        lifted, memory = leg(down[::-1], memory, soil)
        pushed, memory = leg(down, memory, soil)
    mean = 0.5 * ((pushed[1:] + pushed[:-1]) - (lifted[::-1][1:] + lifted[::-1][:-1]))
    work = float((mean * np.diff(down)).sum())
    scale = clay.ultimate(deep) * (deep - high)
    assert work >= -1e-9 * scale


# ------------------------------------------------------------------------------------------------------------- tangents


@example(clay=Clay(D, 1000.0, 0.0, 5.0, 0.267578125, 50.0, 1.0, 1.0, 0.0, 0.0), path=[0.005000000000000001])
@given(clay=soils, path=st.lists(st.floats(0.005, 0.29), min_size=1, max_size=6))
def test_tangents_of_going_on_and_of_turning_round(clay: Clay, path: list[float]) -> None:
    """Against differences, but at corners of the law, where a tangent is that of one side."""
    path = [0.004, *path]
    assume(path[-1] not in path[:-1])  # back at an earlier depth the law has a corner
    model = ContactModel(given_soil(clay))
    state = model.initial_state()
    for depth in path[:-1]:
        _, state = model.step(at_depths([depth, depth]), None, state)
    last = at_depths([path[-1]] * 2)
    result, after = model.step(last, None, state)
    way = 1.0 if path[-1] > path[-2] else -1.0
    size = 1e-7 * D
    for sign, back in ((way, False), (-way, True)):
        ends = [model.step(at_depths([path[-1] + sign * k * size] * 2), None, after)[0].force[0] for k in (1, 2)]
        slope = sign * (4.0 * ends[0] - ends[1] - 3.0 * result.force[0]) / (2.0 * size)
        stiffness = -model.tangent(last, None, state, back=back).by_position.dense()[0, 0]
        scale = clay.k_max * clay.ultimate(path[-1]) / D
        corner = abs(ends[1] - 2.0 * ends[0] + result.force[0]) > 1e-5 * scale * size
        assert corner or 4.0 * stiffness / 2.0 == pytest.approx(slope, rel=1e-3, abs=1e-3 * scale)


def test_the_stiffness_behind_a_reversal() -> None:
    model = ContactModel(given_soil(CLAY))
    state = model.initial_state()
    tangents = [
        model.tangent(at_depths([0.06, 0.06]), None, state, back=back).by_position.dense() for back in (False, True)
    ]
    # half of the length, 1 m, and half of the depth
    assert -2.0 * tangents[0][0, 0] == pytest.approx(29097.960813, rel=1e-9)
    assert -2.0 * tangents[1][0, 0] == pytest.approx(TURNING, rel=1e-9)


def test_the_largest_stiffness_is_that_of_turning_round() -> None:
    model = ContactModel(given_soil(CLAY))
    assert law_of(model.stiffest(at_depths([0.06, 0.06])), "soil").stiffness == pytest.approx([TURNING], rel=1e-9)
    deepest = CLAY.k_max / D * CLAY.ultimate(D)
    assert law_of(model.stiffest(), "soil").stiffness == pytest.approx([deepest], rel=1e-12)


# ------------------------------------------------------------------------------------------------------------ evaluator


@settings(max_examples=5)
@given(seed=st.integers(0, 1000))
def test_both_backends_give_the_same_bits_and_a_series_is_its_steps(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = 4
    numbers = {
        "strength": rng.uniform(1e3, 1e4, count), "gradient": rng.uniform(0.0, 3e3, count),
        "stiffness": rng.uniform(50.0, 500.0, count), "suction": rng.uniform(0.0, 1.0, count),
        "suction_decay": rng.uniform(0.2, 2.0, count), "repenetration": rng.uniform(0.0, 1.5, count),
        "buoyancy": rng.choice([0.0, 9000.0], count),
    }  # fmt: skip
    inputs = chain([NONE] * count, on("soil", count, **numbers))
    path = at_depths(rng.uniform(-0.1, 0.3, (40, count + 1)) * rng.choice([0.1, 1.0], (40, 1)))
    results = [ContactModel(inputs, backend=backend).evaluate(path) for backend in ("numpy", "fast")]
    for name in ("force", "stiffness", "slope", "reaction"):
        np.testing.assert_array_equal(*(getattr(result, name).view(np.int64) for result in results))
    model = ContactModel(inputs)
    state = model.initial_state()
    for index, points in enumerate(path):
        step, state = model.step(points, None, state)
        np.testing.assert_array_equal(step.force, results[0].force[index])


@pytest.mark.parametrize("beside", ["unloading", "suction"])
def test_it_has_its_own_unloading_and_suction(beside: str) -> None:
    numbers = {"stiffness": 1e6} if beside == "unloading" else dict.fromkeys(
        ("force_factor", "force_exponent", "depth_factor", "depth_exponent"), 0.5
    )  # fmt: skip
    with pytest.raises(ElementError, match=f"has a soil law, which has its own {beside}"):
        chain([NONE], on("soil", 1, strength=5000.0), on(beside, 1, **numbers))
