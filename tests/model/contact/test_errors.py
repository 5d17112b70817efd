"""Inputs and positions that cannot be evaluated, each named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from mudline.model.contact import ContactInput, ContactModel, ElementError, LawAssignment, PositionError
from mudline.model.contact.laws import known_laws
from mudline.model.contact.seabed import SlopingSeabed
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    RIGID,
    at_depths,
    bridge_law,
    chain,
    drawn,
    floats,
    friction,
    heave,
    on,
    suction,
)

GOOD = chain([CURVE, LINEAR, NONE])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_position_that_is_not_finite_is_named(value: float, axis: int) -> None:
    positions = np.zeros((9000, 4, 3))
    positions[8000, 2, axis] = positions[8500, 0, 0] = value
    with pytest.raises(PositionError, match="node 103 at step 8000: its position") as caught:
        ContactModel(GOOD).evaluate(positions)
    assert (caught.value.node, caught.value.step) == (103, 8000)
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize("shape", [(3,), (4, 2), (5, 3), (2, 5, 3), (2, 4, 2), (1, 2, 4, 3), ()])
def test_positions_of_another_shape(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match=r"the shape \(4, 3\) or \(steps, 4, 3\), not \("):
        ContactModel(GOOD).evaluate(np.zeros(shape))


# ------------------------------------------------------------------------------------------ velocities, times and steps


@pytest.mark.parametrize("present", [[True] * 3, [1, 1, 1, 1], True])
def test_a_mask_that_does_not_fit(present: ArrayLike) -> None:
    with pytest.raises(ValueError, match=r"present must be booleans of shape \(4,\)"):
        ContactModel(GOOD).evaluate(np.zeros((4, 3)), present=present)


def sucking() -> ContactModel:
    return ContactModel(chain([LINEAR], suction(bridge_law())))


@pytest.mark.parametrize("rate", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("axis", [0, 1])
def test_a_velocity_that_is_not_finite_is_named(rate: float, axis: int) -> None:
    positions, velocities = heave([0.1, 0.1, -0.01], [0.0, 0.1, 0.1])
    velocities[2, 1, axis] = rate
    with pytest.raises(PositionError, match="node 102 at step 2: its velocity is not finite") as caught:
        sucking().evaluate(positions, velocities=velocities)
    assert (caught.value.node, caught.value.step) == (102, 2)


def test_steps_too_close_in_time_for_a_velocity() -> None:
    with pytest.raises(PositionError, match="node 101 at step 1: its velocity is not finite"):
        sucking().evaluate(at_depths([[0.1, 0.1], [-0.1, -0.1]]), times=[0.0, 1e-320])


def test_a_step_without_velocities_needs_the_time_it_took() -> None:
    contact = sucking()
    _, state = contact.step(at_depths([0.1, 0.1]), None, contact.initial_state())
    with pytest.raises(ValueError, match="a step without velocities needs dt > 0"):
        contact.step(at_depths([0.1, 0.1]), None, state)


@pytest.mark.parametrize("dt", [0.0, -1.0, np.nan, np.inf])
@pytest.mark.parametrize("laws", ["linear", "suction"])
@pytest.mark.parametrize("moving", [False, True])
def test_a_time_step_that_is_none_is_refused(dt: float, laws: str, moving: bool) -> None:
    """At the first step and at others, whether something asks for it or not."""
    models = {"linear": ContactModel(chain([LINEAR])), "suction": sucking()}
    contact, places = models[laws], at_depths([0.1, 0.1])
    rates = np.zeros((2, 3)) if moving else None
    _, state = contact.step(places, rates, contact.initial_state(), 0.1)
    for before in (contact.initial_state(), state):
        with pytest.raises(ValueError, match="dt must be finite and above 0, not "):
            contact.step(places, rates, before, dt)
        with pytest.raises(ValueError, match="dt must be finite and above 0, not "):
            contact.tangent(places, rates, before, dt)


def test_a_step_is_one_step() -> None:
    contact = sucking()
    with pytest.raises(ValueError, match="a step takes the positions of one step"):
        contact.step(np.zeros((2, 2, 3)), None, contact.initial_state())


def test_a_series_with_suction_needs_velocities_or_times() -> None:
    with pytest.raises(ValueError, match="needs velocities, or the times of its steps"):
        sucking().evaluate(np.zeros((2, 2, 3)))


@pytest.mark.parametrize("times", [[0.0, np.nan], [0.0, 0.0], [1.0, 0.0], [0.0], [0.0, np.inf]])
def test_times_that_do_not_go_on(times: list[float]) -> None:
    with pytest.raises(ValueError, match="times must be 2 finite numbers, each later"):
        sucking().evaluate(np.zeros((2, 2, 3)), times=times)


# ------------------------------------------------------------------------------------------------- values that overflow


STEEP = ForceCurve([(0.0, 0.0), (1.0, 1e308)])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"diameter": np.full(3, 1e-300)}, "its embedment ratio overflows"),
        ({"curves": (STEEP,)}, "no force at ratio .*: the force there overflows"),
        ({"curves": (STEEP,), "diameter": np.full(3, 1e-4)}, "no force at ratio"),
        ({"length": np.full(3, 1e308)}, "the reaction at its nodes overflows"),
    ],
)
def test_an_overflow_names_element_and_step(changes: dict[str, Any], message: str) -> None:
    contact = ContactModel(replace(GOOD, **changes))
    positions = np.zeros((9000, 4, 3))
    positions[8123, :2, 0] = -1e9
    with pytest.raises(ElementError, match=f"element 11 at step 8123: .*{message}") as caught:
        contact.evaluate(positions)
    assert (caught.value.element, caught.value.step) == (11, 8123)


SLIDE = drawn([(0.0, 0.0), (0.0, 1e10)])


@pytest.mark.parametrize(
    "law",
    [
        on("nodal", [0], stiffness=1e300),
        on("lateral", 1, stiffness=1e300),
        friction(2, (1e306, 1e306), 1e300),
        friction(2, (1e306, 1e306), np.nan, mobilisation=1e-5),
    ],
    ids=["nodal", "lateral", "spring", "mobilisation"],
)
def test_a_reaction_that_overflows_at_a_node_is_named(law: LawAssignment) -> None:
    positions = SLIDE.copy()
    positions[1, 0, 0] = -1e10
    with pytest.raises(PositionError, match=r"node 101 at step [01]: the reaction there overflows"):
        ContactModel(chain([LINEAR], law)).evaluate(positions)


def test_infinite_distances_of_either_sign_do_not_make_a_hole_in_the_seabed() -> None:
    contact = ContactModel(chain([LINEAR], seabed=SlopingSeabed(45.0)))
    with pytest.raises(PositionError, match="node 101 at step 0: its distance to the seabed overflows"):
        contact.evaluate(np.array([[-1.7e308, 1.7e308, 0.0], [1.7e308, -1.7e308, 0.0]]))


def test_the_state_does_not_follow_the_array_of_the_caller() -> None:
    contact = sucking()
    place, states, forces = at_depths([0.01, 0.01]), [], []
    state = contact.initial_state()
    for depth in (0.01, -0.01):
        place[:, 0] = -depth
        result, state = contact.step(place, None, state, 0.2)
        states.append(result.state)
        forces.append(result.force.item())
    assert states == [np.array([1]), np.array([2])]
    assert forces[1] == pytest.approx(-426.62876092, rel=1e-10)


# --------------------------------------------------------------------------------------------------------------- inputs


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"element_nodes": np.array([[0, 1], [1, 4], [2, 3]])}, "element 12 has a node that does not exist"),
        ({"element_nodes": np.array([[0, 1], [1, 2], [-1, 3]])}, "element 13 has a node that does not exist"),
        ({"length": np.array([1.0, np.nan, 1.0])}, "element 12 has no usable length"),
        ({"length": np.array([-1.0, 1.0, 1.0])}, "element 11 has no usable length"),
        ({"diameter": np.array([1.0, 1.0, 0.0])}, "element 13 has a diameter that is not positive"),
        ({"diameter": np.array([1.0, np.inf, 1.0])}, "element 12 has a diameter that is not positive"),
        ({"diameter": np.array([np.nan, 1.0, 1.0])}, "element 11 has a curve law and no diameter"),
        ({"laws": (on("curve", [0], curve=1),)}, "element 11 has a curve that does not exist"),
        ({"laws": (on("curve", [0], curve=0.5),)}, "element 11 has a curve that does not exist"),
        ({"laws": (on("curve", [0], curve=-1),)}, "element 11 has a curve law whose curve is -1.0; expected >= 0"),
        ({"laws": (on("linear", [1], stiffness=np.nan),)}, "element 12 has a linear law whose stiffness is nan; expe"),
        ({"laws": (on("linear", 3, stiffness=[1.0, 2.0, -1.0]),)}, "element 13 has a linear law whose stiffness is -1"),
        ({"laws": (on("linear", 2, stiffness=1.0), on("curve", [1], curve=0))}, "element 12 has two normal laws"),
        ({"laws": (on("rigid", 2), on("smoothed", [0], stiffness=1.0))}, "element 11 has two normal laws"),
        (
            {"laws": (on("linear", 2, stiffness=1.0), on("linear", [1], stiffness=2.0))},
            "element 12 has two linear laws",
        ),
    ],
)
def test_an_element_that_cannot_be_evaluated_is_named(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ElementError, match=message) as caught:
        replace(GOOD, **changes)
    assert f"element {caught.value.element} " in message
    assert caught.value.step is None


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"coordinates": np.zeros((3, 3))}, r"coordinates must be floats of shape \(4, 3\)"),
        ({"coordinates": np.zeros((4, 3), int)}, r"coordinates must be floats of shape \(4, 3\), not int64"),
        ({"node_ids": np.zeros(4)}, "node_ids must be integers"),
        ({"element_nodes": np.zeros((3, 3), int)}, r"element_nodes must be integers of shape \(3, 2\)"),
        ({"weight": np.ones(4)}, r"weight must be floats of shape \(3,\)"),
        ({"diameter": np.ones(4)}, r"diameter must be floats of shape \(3,\)"),
        ({"tension": "pull"}, "tension must be 'keep' or 'cut', not 'pull'"),
    ],
)
def test_arrays_that_do_not_fit(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(GOOD, **changes)


def test_an_unknown_law_is_refused_with_those_that_are_known() -> None:
    known = ", ".join(known_laws())
    assert known.startswith("linear, smoothed, nodal, curve, rigid, unloading, suction, suction spring, friction, lat")
    with pytest.raises(ValueError, match=f"unknown contact law 'springs'; known are {known}"):
        chain([NONE], on("springs", 1, stiffness=1.0))


WRONG: dict[str, Callable[[], LawAssignment]] = {
    r"half_width of the law 'smoothed' must be numbers of shape \(1,\), not \(3,\)": lambda: on(
        "smoothed", [1], stiffness=1.0, half_width=np.ones(3)
    ),
    "the rows of the law 'unloading' must be indices from 0 to 1": lambda: on("unloading", [-1], stiffness=1.0),
    "element 12 has two suction laws": lambda: suction(bridge_law(2), [1, 1]),
    "node 103 has two friction laws": lambda: friction([2, 0, 2]),
    "stiffness of the law 'unloading' must be numbers of shape": lambda: on(
        "unloading", 2, stiffness=np.array(["soft", "stiff"], dtype=object)
    ),
    "element 12 has a smoothed law whose half width is -0.1; expected >= 0": lambda: on(
        "smoothed", [1], stiffness=1.0, half_width=-0.1
    ),
    "node 102 has a nodal law whose stiffness is -1.0; expected >= 0": lambda: on("nodal", 2, stiffness=[1.0, -1.0]),
    "element 11 has an? unloading law whose stiffness is 0.0; expected > 0": lambda: on("unloading", 1, stiffness=0.0),
    "element 11 has a lateral law whose stiffness is nan; expected >= 0": lambda: on("lateral", 1, stiffness=np.nan),
    "node 101 has a friction law whose lateral stiffness is 0.0; expected > 0": lambda: friction(
        3, stiffness=(1.0, 0.0)
    ),
    "node 101 has a friction law whose angle is inf; expected a finite number": lambda: friction(3, angle=np.inf),
    "the law 'linear' has no parameter 'stifness'; it has stiffness": lambda: on("linear", [1], stifness=1.0),
    "the law 'rigid' has no parameter 'stiffness'; it has none": lambda: on("rigid", [1], stiffness=1.0),
    "the law 'linear' needs the parameter 'stiffness'": lambda: on("linear", [1]),
}


@pytest.mark.parametrize("message", WRONG)
def test_a_law_that_does_not_fit_is_refused(message: str) -> None:
    with pytest.raises(ValueError, match=message):
        chain([LINEAR, NONE], WRONG[message]())


def test_laws_of_no_rows_are_as_if_they_were_not_there() -> None:
    inputs = chain([LINEAR], on("suction", [], **{key: floats(1.0, 0) for key in bridge_law()._fields}), friction([]))
    assert list(inputs.assigned) == ["linear"]
    assert not inputs.has("suction", "friction")
    assert not ContactModel(inputs).plan.history


def test_rows_are_kept_in_ascending_order_with_their_parameters() -> None:
    laws = on("unloading", [3, 0], stiffness=[3.0, 1.0]), on("unloading", [1], stiffness=2.0)
    given: ContactInput = chain([LINEAR] * 4, *laws)
    assert given.assigned["unloading"].rows.tolist() == [0, 1, 3]
    assert given.assigned["unloading"]["stiffness"].tolist() == [1.0, 2.0, 3.0]
    spread = given.assigned["unloading"].spread("stiffness", 4, -1.0)
    assert spread.tolist() == [1.0, 2.0, -1.0, 3.0]
    assert chain([RIGID] * 2).assigned["rigid"].columns == ()
