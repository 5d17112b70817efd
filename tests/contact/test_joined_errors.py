"""What suction, friction, springs and steps refuse, each with the node or element named."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mudline.contact import ContactModel, ElementError, PositionError
from mudline.contact.extras import Extras, SuctionSprings
from mudline.contact.floors import SlopingFloor
from tests.contact.chains import LINEAR, NONE, at_depths, chain
from tests.contact.joined import drawn, friction, heave, model, nodal, smoothing, suction, trench, walk
from tests.contact.suction.pulls import bridge_law


def sucking() -> ContactModel:
    return model(chain([LINEAR]), Extras(suction=suction(bridge_law())))


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


def test_velocities_of_one_step_do_not_stand_for_those_of_several() -> None:
    with pytest.raises(ValueError, match=r"shape of the positions, \(3, 2, 3\), not \(2, 3\)"):
        sucking().evaluate(np.zeros((3, 2, 3)), velocities=np.zeros((2, 3)))


@pytest.mark.parametrize("dt", [None, 0.0, -1.0, np.nan])
def test_a_step_without_velocities_needs_the_time_it_took(dt: float | None) -> None:
    contact = sucking()
    _, state = contact.step(at_depths([0.1, 0.1]), None, contact.initial_state(), dt)
    with pytest.raises(ValueError, match="a step without velocities needs dt > 0"):
        contact.step(at_depths([0.1, 0.1]), None, state, dt)


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


SLIDE = drawn([(0.0, 0.0), (0.0, 1e10)])


@pytest.mark.parametrize(
    "extras",
    [
        Extras(nodal=nodal([1e300, np.nan])),
        Extras(lateral=np.full(1, 1e300)),
        Extras(friction=friction(2, (1e306, 1e306), 1e300)),
        Extras(friction=friction(2, (1e306, 1e306), np.nan, mobilisation=1e-5)),
    ],
    ids=["nodal", "lateral", "spring", "mobilisation"],
)
def test_a_reaction_that_overflows_at_a_node_is_named(extras: Extras) -> None:
    positions = SLIDE.copy()
    positions[1, 0, 0] = -1e10
    with pytest.raises(PositionError, match=r"node 101 at step [01]: the reaction there overflows"):
        model(chain([LINEAR]), extras).evaluate(positions)


@pytest.mark.parametrize(
    ("extras", "step"),
    [
        (Extras(suction_springs=SuctionSprings(np.array([1e300]), np.array([1e20]))), 2),
        (Extras(unloading=np.array([1e300])), 1),
    ],
    ids=["suction spring", "unloading"],
)
def test_a_slope_that_overflows_is_named(extras: Extras, step: int) -> None:
    contact = model(chain([LINEAR], diameter=1e20), extras)
    with pytest.raises(ElementError, match=f"element 11 at step {step}: its slope overflows"):
        contact.evaluate(at_depths([[1e-9, 1e-9], [1e-9, 1e-9], [-1e-9, -1e-9]]))


def test_infinite_distances_of_either_sign_do_not_make_a_hole_in_the_bed() -> None:
    contact = ContactModel(replace(chain([LINEAR]), floor=SlopingFloor(45.0)))
    with pytest.raises(PositionError, match="node 101 at step 0: its distance to the bed overflows"):
        contact.evaluate(np.array([[-1.7e308, 1.7e308, 0.0], [1.7e308, -1.7e308, 0.0]]))


def test_the_state_does_not_follow_the_array_of_the_caller() -> None:
    contact = model(chain([LINEAR]), Extras(suction=suction(bridge_law())))
    place, states, forces = at_depths([0.01, 0.01]), [], []
    state = contact.initial_state()
    for depth in (0.01, -0.01):
        place[:, 0] = -depth
        result, state = contact.step(place, None, state, 0.2)
        states.append(result.state)
        forces.append(result.force.item())
    assert states == [np.array([1]), np.array([2])]
    assert forces[1] == pytest.approx(-426.62876092, rel=1e-10)


def test_the_centreline_that_was_laid_does_not_follow_it_either() -> None:
    contact = model(
        chain([LINEAR]),
        Extras(friction=friction(2), trench=replace(trench(2, 0.02, 0.42, 500.0), straight=np.full((2, 4), np.nan))),
    )
    separate = walk(contact, drawn([(0.0, 0.0), (0.0, 0.11)]))
    place, state = drawn([(0.0, 0.0)])[0], contact.initial_state()
    _, state = contact.step(place, None, state)
    place[:, 2] += 0.11
    result, _ = contact.step(place, None, state)
    assert result.reaction[:, 2].tolist() == separate[1].reaction[:, 2].tolist() == pytest.approx([-1300.0] * 2)


WRONG: dict[str, Callable[[], Extras]] = {
    r"smoothing.half_width must be floats of shape \(2,\)": lambda: Extras(smoothing=smoothing(3, 0.1)),
    r"nodal.stiffness must be floats of shape \(3,\)": lambda: Extras(nodal=nodal([1.0])),
    r"suction_springs.stiffness must be": lambda: Extras(suction_springs=SuctionSprings(np.ones(1), np.ones(1))),
    r"suction.law.force_factor must be": lambda: Extras(suction=suction(bridge_law(), [0, 1])),
    "suction.elements must be indices": lambda: Extras(suction=suction(bridge_law(), [2])),
    "element 12 has two suction laws": lambda: Extras(suction=suction(bridge_law(2), [1, 1])),
    r"friction.law.coefficients must be floats of shape \(3, 2\)": lambda: Extras(friction=friction(2)),
    r"trench.law.bottom must be": lambda: Extras(friction=friction(3), trench=trench(2, 1.0, 2.0, 3.0)),
    r"unloading must be floats of shape \(2,\)": lambda: Extras(unloading=np.ones(3)),
    r"lateral must be floats of shape \(2,\)": lambda: Extras(lateral=np.ones(3)),
    "unloading must be floats": lambda: Extras(unloading=np.array(["soft", "stiff"], dtype=object)),
    "smoothing.half_width must be finite and not negative": lambda: Extras(smoothing=smoothing(2, -0.1)),
    "nodal.stiffness must be finite and not negative": lambda: Extras(nodal=nodal([1.0, -1.0, np.nan])),
    "unloading must be finite and not negative": lambda: Extras(unloading=np.array([np.nan, np.inf])),
    "friction.law.coefficients must be finite": lambda: Extras(friction=friction(3, (-0.5, 0.5))),
    "friction.angle must be finite$": lambda: Extras(friction=friction(3, angle=np.inf)),
}


@pytest.mark.parametrize("message", WRONG)
def test_arrays_of_extras_that_do_not_fit(message: str) -> None:
    with pytest.raises(ValueError, match=message):
        model(chain([LINEAR, NONE]), WRONG[message]())
