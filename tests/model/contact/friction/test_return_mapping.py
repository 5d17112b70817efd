"""One step of Coulomb friction with springs: limits, energy, the consistent tangent, and what the evaluator does."""

from __future__ import annotations

import math
from operator import sub

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.friction import ExtraLimit, FrictionHistory
from tests.helpers.builders.contact import chain, friction, on, walk
from tests.model.contact.single import SLIP, STICK, anchored, coulomb, move

pytestmark = pytest.mark.slow


def test_mobilisation_length_reaches_the_limit_there() -> None:
    held = coulomb((0.5, 0.5), mobilisation=0.02)
    start = anchored(held)
    for place, share in ((0.01, 0.5), (0.02, 1.0), (0.03, 1.0)):
        assert -move(held, start, (place, 0.0), 1000.0).force[0, 0] == pytest.approx(500.0 * share)
    step = move(held, start, (0.03, 0.0), 1000.0)
    assert step.history.stick_points[0, 1] == pytest.approx(0.01)
    assert step.history.states.tolist() == [[SLIP, STICK]]


@pytest.mark.parametrize("ellipse", [False, True])
def test_no_coefficient_is_no_friction(ellipse: bool) -> None:
    held = coulomb((0.0, 0.5), 1.0e5, ellipse=ellipse)
    step = move(held, anchored(held), (0.5, 0.001), 1000.0)
    assert step.force[0].tolist() == [0.0, -100.0]
    assert step.history.stick_points[0].tolist() == [0.0, 0.5, 0.0]
    assert step.history.states[0].tolist()[0] == SLIP


forces = st.floats(-500.0, 2.0e3, allow_subnormal=False).filter(lambda value: not 0.0 < value < 1e-200)
offsets = st.floats(-0.05, 0.05).filter(lambda value: abs(value) > 1e-6)
normals = st.floats(10.0, 5.0e3)
springs = st.one_of(st.none(), st.tuples(st.floats(1.0e3, 1.0e6), st.floats(1.0e3, 1.0e6)))


@given(
    st.tuples(st.floats(0.1, 1.0), st.floats(0.1, 1.0)),
    springs,
    st.tuples(offsets, offsets),
    normals,
    st.booleans(),
    st.sampled_from([-1.0, 0.0, 1.0]),
)
@settings(max_examples=60)
def test_the_tangent_is_consistent(
    coefficients: tuple[float, float],
    spring: tuple[float, float] | None,
    place: tuple[float, float],
    normal: float,
    ellipse: bool,
    outward: float,
) -> None:
    """Central differences in every state, away from the kinks between them."""
    held = coulomb(coefficients, spring or math.nan, mobilisation=0.01, ellipse=ellipse)
    start = anchored(held)

    def added(second: float, pressing: float) -> ExtraLimit:
        values = (400.0 + 3.0e3 * second + 0.3 * pressing, 3.0e3, 0.3, outward)
        return ExtraLimit(*(np.array([value]) for value in values))

    def force(first: float, second: float, pressing: float) -> FloatArray:
        step = move(held, start, (first, second), pressing, added(second, pressing))
        states.add(tuple(step.history.states[0].tolist()))
        moved: FloatArray = step.force[0]
        return moved

    states: set[tuple[int, ...]] = set()
    step = move(held, start, place, normal, added(place[1], normal))
    width, share = 1.0e-7, 1.0e-4 * normal

    def slope(ahead: tuple[float, float, float]) -> FloatArray:
        """Central differences over a step and over half of it, without the error of second order."""
        whole, half = (
            (force(*(base + part for base, part in zip(here, sizes, strict=True))) - force(*map(sub, here, sizes)))
            / (2.0 * sum(sizes))
            for sizes in (ahead, tuple(0.5 * size for size in ahead))
        )
        return (4.0 * half - whole) / 3.0

    here = (*place, normal)
    along, across, press = (slope(ahead) for ahead in ((width, 0.0, 0.0), (0.0, width, 0.0), (0.0, 0.0, share)))
    assume(len(states) == 1)
    scale = float(np.abs(step.by_position).max()) + float(np.abs(step.force).max()) / 0.05
    by_place = step.by_position[0] + np.outer(step.by_offset[0], [0.0, 1.0])
    np.testing.assert_allclose(by_place, np.column_stack([along, across]), atol=2e-5 * scale, rtol=0)
    np.testing.assert_allclose(step.by_compression[0], press, atol=1e-6, rtol=1e-6)


@given(st.lists(st.tuples(offsets, offsets, forces), min_size=1, max_size=30), st.booleans())
def test_limits_hold_and_the_evaluator_does_the_same(path: list[tuple[float, float, float]], ellipse: bool) -> None:
    held = coulomb((0.5, 0.8), 1.0e5, ellipse=ellipse)
    history = FrictionHistory.initial(held.active)
    laws = on("nodal", 1, stiffness=1.0), friction(1, (0.5, 0.8), 1.0e5, ellipse=ellipse, angle=0.0)
    evaluated = walk(ContactModel(chain([], *laws)), [[[0.0 - normal, *place]] for *place, normal in path])
    for (first, second, normal), result in zip(path, evaluated, strict=True):
        step = move(held, history, (first, second), normal)
        assert result.reaction[0, 1:] == pytest.approx(step.force[0], rel=1e-9, abs=1e-9)
        history = step.history
        limits = np.array([0.5, 0.8]) * max(normal, 0.0)
        assert (np.abs(step.force[0]) <= limits * (1.0 + 1e-12)).all()
        assert step.dissipated[0] >= 0.0
        if ellipse and normal > 1.0e-100:
            assert math.hypot(*(step.force[0] / limits)) <= 1.0 + 1e-12
