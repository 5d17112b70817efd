"""The beam: its balance, its soil, its end; the second model has its shape and its motion."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactInput
from mudline.model.contact.input import LawAssignment
from mudline.model.scene.load_case import generalised_alpha, hilber_hughes
from mudline.tools.touchdown_study.beam import Beam, at_rest
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


def test_the_end_moves_as_it_says() -> None:
    given, step = beam(), 1e-4
    for time in (0.3, 7.0, 12.0):
        before, now, after = (given.end(time + sign * step) for sign in (-1.0, 0.0, 1.0))
        assert now[1] == pytest.approx((after[0] - before[0]) / (2.0 * step), rel=1e-5, abs=1e-6)
        assert now[2] == pytest.approx((after[1] - before[1]) / (2.0 * step), rel=1e-5, abs=1e-6)
