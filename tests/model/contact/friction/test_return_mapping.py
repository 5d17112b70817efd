"""One step of Coulomb friction with springs: limits, energy, the consistent tangent, and what the evaluator does."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from mudline.model.contact.laws.friction import FrictionHistory
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


forces = st.floats(-500.0, 2.0e3, allow_subnormal=False).filter(lambda value: not 0.0 < value < 1e-200)
offsets = st.floats(-0.05, 0.05).filter(lambda value: abs(value) > 1e-6)


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
