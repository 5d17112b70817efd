"""Published numbers of friction through the whole evaluator, and its work."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from tests.helpers.builders.contact import LINEAR, NONE, at_depths, chain, drawn, friction, on, trench, walk
from tests.model.contact.single import SLIP, STICK

PATH = [0.0, 0.003, 0.010, 0.006, 0.000, -0.010, -0.012, 0.000]
FORCES = [0.0, 300.0, 500.0, 100.0, -500.0, -500.0, -500.0, 500.0]
STICK_POINTS = [0.0, 0.0, 0.005, 0.005, 0.005, -0.005, -0.007, -0.005]
STATES = [STICK, STICK, SLIP, STICK, STICK, SLIP, SLIP, SLIP]


def pipe(
    coefficients: tuple[float, float] = (0.5, 0.8), *, ellipse: bool = False, angle: float = np.nan
) -> ContactModel:
    """An element of 2 m with K = 50000: at 0.02 m each node presses with 1000 N."""
    return ContactModel(chain([LINEAR], friction(2, coefficients, 1e5, ellipse=ellipse, angle=angle)))


def test_path_of_one_direction() -> None:
    contact = pipe()
    state, positions = contact.initial_state(), drawn([(u, 0.0) for u in PATH])
    for place, force, stick_point, kind in zip(positions, FORCES, STICK_POINTS, STATES, strict=True):
        result, state = contact.step(place, None, state)
        assert result.friction is not None
        assert result.friction_state is not None
        assert state.friction is not None
        assert result.friction == pytest.approx(np.array([[-force, 0.0]] * 2), rel=1e-12, abs=1e-9)
        assert result.reaction == pytest.approx(np.array([[1000.0, -force, 0.0]] * 2), rel=1e-12, abs=1e-9)
        assert state.friction.stick_points[:, 1] == pytest.approx([stick_point, 2.0 + stick_point], abs=1e-15)
        if abs(force) < 500.0 or kind == SLIP:  # on the limit itself either state is right
            assert result.friction_state.tolist() == [[kind, STICK]] * 2


def work(contact: ContactModel, corners: list[float]) -> float:
    """Work against friction of both nodes, drawn to and fro in steps of 0.1 mm."""
    places = [corners[0]]
    for one, other in pairwise(corners):
        steps = round(abs(other - one) / 1e-4)
        places.extend((one + (other - one) * np.arange(1, steps + 1) / steps).tolist())
    result = contact.evaluate(drawn([(u, 0.0) for u in places]))
    assert result.friction is not None
    force = -result.friction[:, :, 0].sum(axis=1)
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(places)))


def test_energy_of_that_path() -> None:
    stored = 0.5 * 500.0**2 / 1e5
    assert work(pipe(), PATH) == pytest.approx(2.0 * 10.75, rel=1e-10)
    assert 10.75 - stored == pytest.approx(9.5)


def test_varying_normal_force() -> None:
    result = pipe().evaluate(
        drawn([(0.0, 0.0), (0.004, 0.0), (0.004, 0.0), (0.004, 0.0), (0.006, 0.0)], [0.02, 0.02, 0.012, 0.02, 0.02])
    )
    assert result.friction is not None
    assert result.friction_state is not None
    assert -result.friction[1:, 0, 0] == pytest.approx([400.0, 300.0, 300.0, 500.0], rel=1e-12)
    assert result.friction_state[1:4, 0, 0].tolist() == [STICK, SLIP, STICK]


@pytest.mark.parametrize(
    ("coefficients", "ellipse", "trial", "force"),
    [
        ((0.5, 0.8), False, (450.0, 700.0), (450.0, 700.0)),
        ((0.5, 0.8), False, (900.0, 300.0), (500.0, 300.0)),
        ((0.5, 0.5), False, (600.0, 800.0), (500.0, 500.0)),
        ((0.5, 0.8), True, (450.0, 700.0), (358.49745941, 557.66271463)),
        ((0.5, 0.8), True, (900.0, 300.0), (489.49020987, 163.16340329)),
        ((0.5, 0.5), True, (600.0, 800.0), (300.0, 400.0)),
    ],
)
def test_box_and_ellipse(
    coefficients: tuple[float, float], ellipse: bool, trial: tuple[float, float], force: tuple[float, float]
) -> None:
    contact = pipe(coefficients, ellipse=ellipse)
    result = contact.evaluate(drawn([(0.0, 0.0), (trial[0] / 1e5, trial[1] / 1e5)]))
    assert -result.reaction[1, :, 1:] == pytest.approx(np.array([force] * 2), rel=1e-10)


def turned(points: FloatArray, degrees: float) -> FloatArray:
    """Vectors turned about X."""
    angle = np.radians(degrees)
    cosine, sine = np.cos(angle), np.sin(angle)
    rotation = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    found: FloatArray = points @ rotation.T
    return found


@pytest.mark.parametrize("ellipse", [False, True])
def test_turning_the_axes_separates_box_and_cone(ellipse: bool) -> None:
    straight, askew = pipe((0.5, 0.5), ellipse=ellipse, angle=0.0), pipe((0.5, 0.5), ellipse=ellipse, angle=45.0)
    path = drawn([(0.0, 0.0), (0.006, 0.008)])
    one, other = straight.evaluate(path).reaction[1], askew.evaluate(path).reaction[1]
    assert np.allclose(one, other, rtol=1e-12) == ellipse
    sizes = [float(np.hypot(*reaction[0, 1:])) for reaction in (one, other)]
    assert sizes == pytest.approx([500.0, 500.0] if ellipse else [707.10678119, np.hypot(500.0, 100.0 * 2**0.5)])


@pytest.mark.parametrize("ellipse", [False, True])
def test_axes_along_the_line_turn_with_it(ellipse: bool) -> None:
    contact, path = pipe(ellipse=ellipse), drawn([(0.0, 0.0), (0.006, 0.008), (0.002, 0.009)])
    straight = contact.evaluate(path).reaction
    for degrees in (30.0, 90.0, 135.0, -160.0):
        assert contact.evaluate(turned(path, degrees)).reaction == pytest.approx(turned(straight, degrees), abs=1e-8)


def test_isotropic_tangent() -> None:
    contact = ContactModel(chain([], on("nodal", 1, stiffness=5e4), friction(1, (0.5, 0.5), 1e5, ellipse=True)))
    _, state = contact.step(at_depths([0.02]), None, contact.initial_state())
    moved = at_depths([0.02]) + np.array([0.0, 0.012, 0.005])
    result, _ = contact.step(moved, None, state)
    assert result.reaction[0] == pytest.approx([1000.0, -461.5384615385, -192.3076923077], rel=1e-12)
    tangent = contact.tangent(moved, None, state).by_position.dense()
    in_plane = np.array([[5689.576695, -13654.984069], [-13654.984069, 32771.961766]])
    assert tangent[1:, 1:] == pytest.approx(-in_plane, rel=1e-9)
    assert tangent[1:, 0] == pytest.approx([23076.923077, 9615.384615], rel=1e-9)  # x falls as z grows
    assert tangent[0] == pytest.approx([-5e4, 0.0, 0.0])


def test_no_friction_without_pressure() -> None:
    contact = ContactModel(chain([NONE], friction(2), trench(1, 0.1, 0.5, 600.0)))
    assert not contact.evaluate(drawn([(0.0, 0.0), (0.1, 0.2)])).reaction.any()
    lifted = walk(
        pipe(),
        drawn([(0.0, 0.0), (0.003, 0.0), (0.003, 0.0), (0.05, 0.0), (0.052, 0.0)], [0.02, 0.02, -0.01, 0.02, 0.02]),
    )
    assert [result.friction[0, 0] for result in lifted if result.friction is not None] == pytest.approx(
        [0.0, -300.0, 0.0, 0.0, -200.0]
    )


# ----------------------------------------------------------------------------------------------------------------- work


@given(st.integers(1, 6), st.integers(0, 2**32 - 1), st.booleans(), st.booleans())
def test_no_closed_loop_gives_work_where_both_springs_are_equal(
    elements: int, seed: int, ellipse: bool, slips: bool
) -> None:
    """Whatever the directions do, with coefficients that differ; by the forces at the ends of the steps."""
    rng = np.random.default_rng(seed)
    coefficients = (0.3, 0.7) if slips else (1e6, 1e6)
    contact = ContactModel(chain([LINEAR] * elements, friction(elements + 1, coefficients, 5e4, ellipse=ellipse)))
    path = drawn(np.zeros((24, 2)), nodes=elements + 1) + rng.normal(scale=(0.0, 0.02, 0.4), size=(24, elements + 1, 3))
    path[0, :, 0] = 1.0  # begins and ends off the seabed
    path = np.concatenate([path, path[:1]])
    friction_force = contact.evaluate(path).reaction[..., 1:]
    work = -(friction_force[1:] * np.diff(path, axis=0)[..., 1:]).sum()
    assert friction_force.any()
    assert work >= -1e-9 * np.abs(friction_force).max()
