"""Coulomb friction with springs: published paths, criteria, energy, and the consistent tangent."""

from __future__ import annotations

import math
from itertools import pairwise
from operator import sub

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.friction import ExtraLimit, FrictionHistory, FrictionLaw, FrictionState, slide
from tests.contact.single import OPEN, SLIP, STICK, U1, U2, anchored, coulomb, move, place_at

pytestmark = pytest.mark.slow

COULOMB = coulomb((0.5, 0.8), 1.0e5)
PATH = [
    (0.0, 0.0, 0.0, STICK),
    (0.003, 300.0, 0.0, STICK),
    (0.010, 500.0, 0.005, SLIP),
    (0.006, 100.0, 0.005, STICK),
    (0.000, -500.0, 0.005, STICK),
    (-0.010, -500.0, -0.005, SLIP),
    (-0.012, -500.0, -0.007, SLIP),
    (0.000, 500.0, -0.005, SLIP),
]


def test_the_path_of_one_direction() -> None:
    history = anchored(COULOMB)
    for place, force, stick_point, state in PATH:
        step = move(COULOMB, history, (place, 0.0), 1000.0)
        history = step.history
        assert -step.force[0, 0] == pytest.approx(force, rel=1e-12, abs=1e-9)
        assert history.stick_points[0, 1] == pytest.approx(stick_point, rel=1e-12, abs=1e-15)
        assert history.states[0, 0] == state


def test_the_energy_of_that_path() -> None:
    history = anchored(COULOMB)
    work = dissipated = before = force = 0.0
    corners = [place for place, *_ in PATH]
    fine = [a + (b - a) * k / 420 for a, b in pairwise(corners) for k in range(1, 421)]
    for place in fine:
        step = move(COULOMB, history, (place, 0.0), 1000.0)
        now = -float(step.force[0, 0])
        work += 0.5 * (force + now) * (place - before)
        dissipated += float(step.dissipated[0])
        history, before, force = step.history, place, now
    assert dissipated == pytest.approx(9.5, rel=1e-9)
    assert work == pytest.approx(10.75, rel=1e-5)
    assert dissipated + force**2 / 2.0e5 == pytest.approx(10.75, rel=1e-9)


def test_a_steady_cycle_dissipates_four_mu_n_times_what_slips() -> None:
    history = move(COULOMB, anchored(COULOMB), (0.01, 0.0), 1000.0).history
    lost = 0.0
    for place in (-0.01, 0.01):
        step = move(COULOMB, history, (place, 0.0), 1000.0)
        history, lost = step.history, lost + float(step.dissipated[0])
    assert lost == pytest.approx(10.0, rel=1e-12)


def test_a_varying_normal_force_makes_the_stick_point_creep() -> None:
    history = anchored(COULOMB)
    for place, normal, force, stick_point in (
        (0.004, 1000.0, 400.0, 0.0),
        (0.004, 600.0, 300.0, 0.001),
        (0.004, 1000.0, 300.0, 0.001),
        (0.006, 1000.0, 500.0, 0.001),
    ):
        step = move(COULOMB, history, (place, 0.0), normal)
        history = step.history
        assert -step.force[0, 0] == pytest.approx(force, rel=1e-12)
        assert history.stick_points[0, 1] == pytest.approx(stick_point, abs=1e-15)


@pytest.mark.parametrize(
    ("trial", "coefficients", "box", "ellipse"),
    [
        ((450.0, 700.0), (0.5, 0.8), (450.0, 700.0), (358.49745941, 557.66271463)),
        ((900.0, 300.0), (0.5, 0.8), (500.0, 300.0), (489.49020987, 163.16340329)),
        ((600.0, 800.0), (0.5, 0.5), (500.0, 500.0), (300.0, 400.0)),
    ],
)
def test_box_and_ellipse(
    trial: tuple[float, float],
    coefficients: tuple[float, float],
    box: tuple[float, float],
    ellipse: tuple[float, float],
) -> None:
    place = (trial[0] / 1.0e5, trial[1] / 1.0e5)
    for wanted, round_ in ((box, False), (ellipse, True)):
        held = coulomb(coefficients, 1.0e5, ellipse=round_)
        step = move(held, anchored(held), place, 1000.0)
        assert -step.force[0] == pytest.approx(wanted, rel=1e-10)


def test_the_isotropic_tangent() -> None:
    held = coulomb((0.5, 0.5), 1.0e5, ellipse=True)
    step = move(held, anchored(held), (0.012, 0.005), 1000.0)
    assert -step.force[0] == pytest.approx((461.5384615385, 192.3076923077), rel=1e-12)
    expected = [[5689.576695, -13654.984069], [-13654.984069, 32771.961766]]
    np.testing.assert_allclose(-step.by_position[0], expected, rtol=1e-9)
    assert -step.by_compression[0] * 5.0e4 == pytest.approx((23076.923077, 9615.384615), rel=1e-9)


def test_lift_off_forgets_and_touchdown_begins_anew() -> None:
    history = move(COULOMB, anchored(COULOMB), (0.003, 0.0), 1000.0).history
    up = move(COULOMB, history, (0.004, 0.0), 0.0)
    assert up.history.states.tolist() == [[OPEN, OPEN]]
    assert np.isnan(up.history.stick_points).all()
    assert (up.force == 0.0).all()
    assert not np.signbit(up.force).any()
    down = move(COULOMB, up.history, (0.2, 0.1), 500.0)
    assert (down.force == 0.0).all()
    assert down.history.stick_points.tolist() == [[0.0, 0.2, 0.1]]
    assert down.history.states.tolist() == [[STICK, STICK]]


def test_tension_is_no_normal_force() -> None:
    assert (move(COULOMB, anchored(COULOMB), (1.0, 1.0), -1000.0).force == 0.0).all()


def test_the_history_given_is_not_changed() -> None:
    history = anchored(COULOMB)
    kept = history.stick_points.copy(), history.states.copy()
    move(COULOMB, history, (1.0, 1.0), 1000.0)
    assert np.array_equal(history.stick_points, kept[0])
    assert np.array_equal(history.states, kept[1])


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


def test_nodes_without_a_law_have_no_state() -> None:
    half, no = np.full((1, 2), 0.5), np.array([False])
    held = FrictionLaw(half, half, half, no, no)
    step = slide(held, FrictionHistory.initial(held.active), place_at(1.0, 1.0), (U1, U2), np.array([5.0]))
    assert step.history.states.tolist() == [[FrictionState.NONE, FrictionState.NONE]]
    assert (step.force == 0.0).all()


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
@settings(max_examples=100)
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
def test_limits_hold_and_slipping_costs_energy(path: list[tuple[float, float, float]], ellipse: bool) -> None:
    held = coulomb((0.5, 0.8), 1.0e5, ellipse=ellipse)
    history = FrictionHistory.initial(held.active)
    for first, second, normal in path:
        step = move(held, history, (first, second), normal)
        history = step.history
        limits = np.array([0.5, 0.8]) * max(normal, 0.0)
        assert (np.abs(step.force[0]) <= limits * (1.0 + 1e-12)).all()
        assert step.dissipated[0] >= 0.0
        if ellipse and normal > 1.0e-100:
            assert math.hypot(*(step.force[0] / limits)) <= 1.0 + 1e-12


@given(st.lists(st.tuples(offsets, offsets), min_size=2, max_size=10), st.integers(0, 359))
def test_turning_the_axes_turns_the_ellipse_of_equal_coefficients_and_not_the_box(
    path: list[tuple[float, float]], degrees: int
) -> None:
    turn = math.radians(degrees)
    turned = (math.cos(turn) * U1 + math.sin(turn) * U2, math.cos(turn) * U2 - math.sin(turn) * U1)
    held = coulomb((0.5, 0.5), 1.0e5, ellipse=True)
    one = other = FrictionHistory.initial(held.active)
    for place in [(0.0, 0.0), *path]:
        straight = slide(held, one, place_at(*place), (U1, U2), np.array([1000.0]))
        across = slide(held, other, place_at(*place), turned, np.array([1000.0]))
        one, other = straight.history, across.history
        forces = [
            sum(force * axis[0] for force, axis in zip(step.force[0], axes, strict=True))
            for step, axes in ((straight, (U1, U2)), (across, turned))
        ]
        np.testing.assert_allclose(forces[0], forces[1], atol=1e-6)


def test_the_box_depends_on_its_axes() -> None:
    held = coulomb((0.5, 0.5), 1.0e5)
    corner = move(held, anchored(held), (0.1, 0.1), 1000.0).force[0]
    assert math.hypot(*corner) == pytest.approx(707.10678119)
    straight = move(held, anchored(held), (math.hypot(0.1, 0.1), 0.0), 1000.0).force[0]
    assert math.hypot(*straight) == pytest.approx(500.0)


def test_extremes_stay_finite() -> None:
    held = coulomb((2.0, 2.0), 1.0e300)
    with np.errstate(all="ignore"):
        step = move(held, anchored(held), (1.0e300, 1.0e-300), 1.0e300)
    assert step.force[0].tolist() == [-2.0e300, -1.0]
    assert np.isfinite(step.history.stick_points).all()
