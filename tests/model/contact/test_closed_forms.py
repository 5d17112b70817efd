"""Problems with closed solutions: masses that fall and slide on the seabed, a block on a slope, a beam on springs."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.friction import FrictionState
from mudline.model.contact.seabed import SlopingSeabed
from tests.helpers.builders.contact import LINEAR, NONE, at_depths, chain, friction, on

pytestmark = pytest.mark.slow

MASS, G, K = 500.0, 9.81, 5e4


def fall(speed: float, gravity: float, dt: float) -> tuple[FloatArray, FloatArray]:
    """Depths and forces of a mass that meets the seabed at a speed, until it has left it."""
    contact = ContactModel(chain([], on("nodal", 1, stiffness=K)))
    z, v, force = 0.0, speed, 0.0
    depths, forces = [], []
    while z >= 0.0:
        v += 0.5 * dt * (gravity - force / MASS)
        z += dt * v
        force = float(contact.evaluate(at_depths([z])).reaction[0, 0])
        v += 0.5 * dt * (gravity - force / MASS)
        depths.append(z)
        forces.append(force)
    return np.array(depths), np.array(forces)


def test_a_mass_that_falls_on_the_seabed() -> None:
    depths, forces = fall(0.5, G, 5e-4)
    still = MASS * G / K
    assert depths.max() == pytest.approx(still + math.sqrt(still**2 + MASS * 0.5**2 / K), rel=1e-5)
    assert depths.max() == pytest.approx(0.20820726588, rel=1e-5)
    assert forces.max() == pytest.approx(10410.363294, rel=1e-5)


def test_a_mass_without_weight_that_bounces() -> None:
    depths, _ = fall(0.5, 0.0, 5e-4)
    assert depths.max() == pytest.approx(0.05, rel=1e-5)
    assert len(depths) * 5e-4 == pytest.approx(0.31415926536, abs=6e-4)


def test_a_sliding_block_stops() -> None:
    """A stiff spring, so that the elastic slip is small beside the way."""
    contact = ContactModel(chain([], on("nodal", 1, stiffness=K), friction(1, (0.5, 0.5), 1e8)))
    place, state = np.array([[-MASS * G / K, 0.0, 0.0]]), contact.initial_state()
    _, state = contact.step(place, None, state)
    v, dt, time = 1.0, 1e-4, 0.0
    while v > 0.0:
        place[0, 1] += dt * v
        result, state = contact.step(place, None, state)
        v += dt * float(result.reaction[0, 1]) / MASS
        time += dt
    assert place[0, 1] == pytest.approx(0.10193679918, rel=1e-3)
    assert time == pytest.approx(0.20387359837, rel=1e-3)


def block_on_slope(degrees: float) -> tuple[ContactModel, FloatArray, FloatArray, float]:
    """A block pressed on a slope by its weight: model, place, unit vector downhill, and its weight along that."""
    angle = math.radians(degrees)
    laws = on("nodal", 1, stiffness=K), friction(1, (0.5, 0.5), 1e5)
    contact = ContactModel(chain([], *laws, seabed=SlopingSeabed(degrees)))
    normal = np.array([math.cos(angle), -math.sin(angle), 0.0])
    place = (-MASS * G * math.cos(angle) / K * normal)[None]
    return contact, place, np.array([-math.sin(angle), -math.cos(angle), 0.0]), MASS * G * math.sin(angle)


def test_a_block_sticks_on_a_slope() -> None:
    contact, place, downhill, pull = block_on_slope(20.0)
    assert pull == pytest.approx(1677.608803, rel=1e-9)
    _, state = contact.step(place, None, contact.initial_state())
    result, state = contact.step(place + 0.01677608803 * downhill, None, state)
    assert result.reaction[0] == pytest.approx([MASS * G, 0.0, 0.0], abs=1e-5)
    assert result.friction_state is not None
    assert result.friction_state[0, 0] == FrictionState.STICK
    result, _ = contact.step(place + downhill, None, state)
    assert result.reaction[0] @ downhill == pytest.approx(-2304.5961525, rel=1e-9)


@pytest.mark.parametrize(("degrees", "slides"), [(26.565, False), (26.5652, True)])
def test_a_block_slides_from_the_angle_of_friction_on(degrees: float, slides: bool) -> None:
    contact, place, downhill, pull = block_on_slope(degrees)
    _, state = contact.step(place, None, contact.initial_state())
    result, _ = contact.step(place + 1.0 * downhill, None, state)
    assert (pull + float(result.reaction[0] @ downhill) > 0.0) == slides


EI, SPRING, LOAD = 2e7, 1e5, 1e4


def beam(elements: int, size: float) -> FloatArray:
    """Stiffness of a beam for deflections and rotations of its nodes, in turns."""
    own = np.array(
        [
            [12.0, 6.0 * size, -12.0, 6.0 * size],
            [6.0 * size, 4.0 * size**2, -6.0 * size, 2.0 * size**2],
            [-12.0, -6.0 * size, 12.0, -6.0 * size],
            [6.0 * size, 2.0 * size**2, -6.0 * size, 4.0 * size**2],
        ]
    )
    whole = np.zeros((2 * elements + 2, 2 * elements + 2))
    for first in range(0, 2 * elements, 2):
        whole[first : first + 4, first : first + 4] += EI / size**3 * own
    return whole


@pytest.mark.parametrize("kind", ["elements", "nodes"])
def test_a_beam_on_springs(kind: str) -> None:
    """Laid 0.02 m deep, so that no part of it leaves the seabed under the load in its middle."""
    elements, size, laid = 320, 0.3, 0.02
    share = np.full(elements + 1, SPRING * size)
    share[[0, -1]] *= 0.5
    springs = on("nodal", elements + 1 if kind == "nodes" else [], stiffness=share if kind == "nodes" else 0.0)
    laws = [LINEAR if kind == "elements" else NONE] * elements
    contact = ContactModel(chain(laws, springs, length=size, stiffness=SPRING))
    points = at_depths(np.full(elements + 1, laid))
    points[:, 1] = size * np.arange(elements + 1)
    tangent = contact.tangent(points, None, contact.initial_state()).by_position.dense()[::3, ::3]
    whole = beam(elements, size)
    whole[::2, ::2] -= tangent
    load = np.zeros(len(whole))
    load[elements] = LOAD
    sunk = np.linalg.solve(whole, load)
    middle = elements // 2
    assert sunk[elements] == pytest.approx(0.0094015077327, rel=1e-3)
    curved = 6.0 * (sunk[elements + 2] - sunk[elements]) / size**2 - 2.0 * sunk[elements + 3] / size
    assert -EI * curved == pytest.approx(13295.739742, rel=1e-2)
    # and the seabed gives the load back, and what it had to carry before
    points[:, 0] -= sunk[::2]
    given = contact.evaluate(points).normal_force
    assert given.min() > 0.0
    assert given.sum() == pytest.approx(LOAD + SPRING * laid * size * elements, rel=1e-9)
    assert int(given[1:-1].argmax()) + 1 == middle
