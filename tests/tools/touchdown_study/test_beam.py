"""The beam against the closed form on a linear soil, its balance, and its time integration."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mudline.model.contact import ContactInput
from mudline.model.contact.input import LawAssignment
from mudline.model.scene.load_case import Scheme, generalised_alpha, hilber_hughes
from mudline.tools.touchdown_study.beam import Beam, at_rest, march
from mudline.tools.touchdown_study.soil import ElasticSoil, SteppedSoil

EI, TENSION, WEIGHT, SOIL = 3.0e7, 250.0e3, 900.0, 20.0e3
LEFT, RIGHT, SIZE = 120.0, 60.0, 0.5


def beam(size: float = SIZE) -> Beam:
    count = round((LEFT + RIGHT) / size)
    end = WEIGHT / TENSION
    moment = EI * end
    return Beam(np.full(count, size), EI, TENSION, WEIGHT, 215.0, 140.0, -WEIGHT / SOIL, 8.0, moment, 0.5, 10.0)


def soil(given: Beam) -> ContactInput:
    count = len(given.lengths)
    return ContactInput(
        node_ids=np.arange(count + 1),
        coordinates=np.column_stack([np.zeros(count + 1), given.places, np.zeros(count + 1)]),
        element_ids=np.arange(count),
        element_nodes=np.column_stack([np.arange(count), np.arange(1, count + 1)]),
        length=given.lengths,
        diameter=np.full(count, 0.3),
        laws=(LawAssignment("linear", np.arange(count), {"stiffness": SOIL}),),
    )


def closed_form(x: np.ndarray, right: float) -> tuple[np.ndarray, float]:
    """Heights by EI w'''' - T w'' + k w = -q where w < 0, EI w'''' - T w'' = -q above it, and the touchdown.

    The two solutions meet with w = 0 and equal slope, moment and shear; the right end has a height and the moment
    EI q / T.
    """
    roots = np.roots([EI, 0.0, -TENSION, 0.0, SOIL])
    decaying = roots[roots.real > 0.0]
    root = np.sqrt(TENSION / EI)

    def pieces(at: float) -> tuple[np.ndarray, np.ndarray]:
        # unknowns: real and imaginary part of the amplitude below; C0, C1, C2, C3 above, with s = x - touchdown
        span = LEFT + RIGHT - at
        rows, values = [], []

        def below(order: int) -> list[float]:
            term = decaying[0] ** order
            return [2.0 * term.real, -2.0 * term.imag]

        def above(order: int, s: float) -> list[float]:
            plus, minus = np.exp(root * (s - span)), np.exp(-root * s)
            polynomial = {0: [1.0, s], 1: [0.0, 1.0]}.get(order, [0.0, 0.0])
            return [*polynomial, root**order * plus, (-root) ** order * minus]

        curvature = {2: WEIGHT / TENSION}
        rows.append([*below(0), 0.0, 0.0, 0.0, 0.0])
        values.append(WEIGHT / SOIL)
        for order in range(4):
            rows.append([*below(order), *(-part for part in above(order, 0.0))])
            values.append(curvature.get(order, 0.0) + (WEIGHT / SOIL if order == 0 else 0.0))
        rows.append([0.0, 0.0, *above(2, span)])
        values.append(0.0)
        return np.linalg.solve(np.array(rows), np.array(values)), np.array([0.0, 0.0, *above(0, span)])

    low, high = LEFT - 40.0, LEFT + 40.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        unknowns, end = pieces(middle)
        span = LEFT + RIGHT - middle
        reached = float(end @ unknowns) + 0.5 * WEIGHT / TENSION * span * span
        low, high = (middle, high) if reached > right else (low, middle)
    unknowns, _ = pieces(low)
    s, span = x - low, LEFT + RIGHT - low
    amplitude = unknowns[0] + 1j * unknowns[1]
    lying = 2.0 * (amplitude * np.exp(decaying[0] * np.minimum(s, 0.0))).real - WEIGHT / SOIL
    up = np.maximum(s, 0.0)
    hanging = unknowns[2] + unknowns[3] * up + unknowns[4] * np.exp(root * (up - span))
    hanging = hanging + unknowns[5] * np.exp(-root * up) + 0.5 * WEIGHT / TENSION * up * up
    return np.where(s < 0.0, lying, hanging), low


def test_at_rest_the_beam_is_the_closed_form() -> None:
    given = beam()
    found = at_rest(given, ElasticSoil(soil(given)))
    heights, touchdown = closed_form(given.places, given.right)
    assert found.state[::2] == pytest.approx(heights, abs=0.002)
    assert float(given.touchdown(found.state[::2])) == pytest.approx(touchdown, abs=0.05)
    curvature = np.gradient(np.gradient(heights, SIZE), SIZE)
    moments = given.moments(found.state[1::2])
    assert moments.max() == pytest.approx(EI * curvature[5:-5].max(), rel=0.01)
    assert found.reaction.per_length.max() == pytest.approx(SOIL * -heights.min(), rel=0.01)


def test_forces_on_the_beam_balance() -> None:
    given = beam()
    found = at_rest(given, ElasticSoil(soil(given)))
    held = given.stiffness @ found.state - given.load
    held[::2] -= found.reaction.nodal
    weight = WEIGHT * (LEFT + RIGHT)
    assert found.reaction.nodal.sum() + held[0] + held[-2] == pytest.approx(weight, rel=1e-9)
    assert np.abs(held[2:-2:2]).max() <= 1e-6 * WEIGHT * SIZE


@pytest.mark.parametrize("matrix", ["mean", "consistent"])
def test_the_soil_of_the_beam_is_that_of_the_evaluator(matrix: str) -> None:
    given = beam(2.0)
    heights = 0.2 * np.sin(given.places)
    own = ElasticSoil(soil(given), "mean" if matrix == "mean" else "consistent").react(heights, heights, 0.0)
    other = SteppedSoil(soil(given)).react(heights, heights, 0.0)
    if matrix == "mean":
        assert own.nodal == pytest.approx(other.nodal)
        assert own.diagonal == pytest.approx(other.diagonal)
        assert own.beside == pytest.approx(other.beside)
    away = 1e-7
    for at in (3, 40):
        moved = heights.copy()
        moved[at] += away
        changed = ElasticSoil(soil(given), "mean" if matrix == "mean" else "consistent").react(moved, heights, 0.0)
        assert (changed.nodal[at] - own.nodal[at]) / away == pytest.approx(own.diagonal[at], rel=1e-4, abs=1e-3)


def test_schemes_have_the_published_parameters() -> None:
    assert generalised_alpha(0.4)[1:3] == pytest.approx((-0.2 / 1.4, 0.4 / 1.4))
    assert generalised_alpha(0.4).radius == pytest.approx(0.4)
    assert hilber_hughes(-0.25)[1:3] == (0.0, 0.25)
    assert (hilber_hughes(-0.25).gamma, hilber_hughes(-0.25).beta) == pytest.approx((0.75, 1.25**2 / 4.0))
    assert hilber_hughes(0.0).radius == 1.0


def by_runge_kutta(given: Beam, begin: np.ndarray, steps: int) -> np.ndarray:
    """The state after a period on a linear soil that never lets go: RK4 on the free heights and rotations."""
    reaction = ElasticSoil(soil(given)).react(begin[::2], begin[::2], 0.0)
    stiffness, inertia = given.stiffness.copy(), given.inertia
    w = np.arange(0, len(begin), 2)
    stiffness[w, w] -= reaction.diagonal
    stiffness[w[:-1], w[1:]] -= reaction.beside
    stiffness[w[1:], w[:-1]] -= reaction.beside
    free = np.setdiff1d(np.arange(2, len(begin)), [len(begin) - 2])
    inverse = np.linalg.inv(inertia[np.ix_(free, free)])
    held = np.array([0, 1, len(begin) - 2])

    def acceleration(time: float, state: np.ndarray) -> np.ndarray:
        height, _, above = given.end(time)
        fixed = np.array([begin[0], begin[1], height])
        force = given.load[free] - stiffness[np.ix_(free, held)] @ fixed - inertia[free, held[-1]] * above
        found: np.ndarray = inverse @ (force - stiffness[np.ix_(free, free)] @ state)
        return found

    x, v, step = begin[free], np.zeros(len(free)), given.period / steps
    for number in range(steps):
        t = number * step
        k1, l1 = v, acceleration(t, x)
        k2, l2 = v + 0.5 * step * l1, acceleration(t + 0.5 * step, x + 0.5 * step * k1)
        k3, l3 = v + 0.5 * step * l2, acceleration(t + 0.5 * step, x + 0.5 * step * k2)
        k4, l4 = v + step * l3, acceleration(t + step, x + step * k3)
        x, v = x + step / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4), v + step / 6.0 * (l1 + 2 * l2 + 2 * l3 + l4)
    found = begin.copy()
    found[free], found[-2] = x, given.end(given.period)[0]
    return found


@pytest.mark.parametrize(
    "scheme", [generalised_alpha(0.4), hilber_hughes(-0.25), Scheme("generalised-alpha", 0.0, 0.0)]
)
def test_the_integration_comes_near_to_another_one(scheme: Scheme) -> None:
    given = replace(beam(6.0), right=-0.02, end_moment=0.0, amplitude=0.01, drag=0.0, period=1.0)
    begin = at_rest(given, ElasticSoil(soil(given)))
    exact = by_runge_kutta(given, begin.state, 1500)[::2]
    moved = np.abs(exact - begin.state[::2]).max()
    errors = [
        np.abs(march(given, ElasticSoil(soil(given)), scheme, begin, steps, periods=1).heights[-1] - exact).max()
        / moved
        for steps in (200, 800)
    ]
    assert errors[0] < 0.01
    assert errors[1] < 0.4 * errors[0]


def test_the_end_moves_as_it_says() -> None:
    given, step = beam(), 1e-4
    for time in (0.3, 7.0, 12.0):
        before, now, after = (given.end(time + sign * step) for sign in (-1.0, 0.0, 1.0))
        assert now[1] == pytest.approx((after[0] - before[0]) / (2.0 * step), rel=1e-5, abs=1e-6)
        assert now[2] == pytest.approx((after[1] - before[1]) / (2.0 * step), rel=1e-5, abs=1e-6)
