"""The study against a second model: samples, and decks of other kinds whose numbers are worked out here from theirs."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import mudline
from mudline.model.scene.load_case import hilber_hughes
from mudline.model.scene.weights import pipe_of
from mudline.tools.touchdown_study.study import study
from mudline.tools.touchdown_study.zone import Zone, touchdown_zone
from tests.helpers.samples import SAMPLES
from tests.tools.touchdown_study.decks import FLEXIBLE, IMPERIAL, Riser

pytest.importorskip("scipy", reason="scipy is not installed")

from tests.tools.touchdown_study.second_model import Floats, Measured, SecondModel

TRENCH = (0, 265, 376, 602, 859, 968, 1058, 1210, 1343, 1466)
FLOWLINE = (0, 530, 751, 1195, 1696, 1898, 2062, 2331, 2559, 2762)
SOFT = (0, 265, 376, 602, 859, 968, 1058, 1210, 1338, 1466)
RATIOS = (0.0, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5)


def soil(diameter: float, forces: tuple[float, ...], ratios: tuple[float, ...] = RATIOS) -> tuple[Floats, Floats]:
    return np.array(ratios) * diameter, np.array(forces, np.float64)


CLAY = (0.0, 700.0, 1000.0, 1900.0), (0.0, 0.05, 0.1, 0.5)


def of_sample(name: str, *curves: tuple[float, ...], **given: Any) -> SecondModel:  # noqa: ANN401 - fields of several kinds
    """With the lengths and weights of a sample; curves of its touchdown and of its flowline."""
    scene, diameter = mudline.read(SAMPLES / name).scene()._resolved, 0.27305
    flowline = np.array([len(curves) > 1 and "Flowline" in law for law in scene.law_names], np.intp)
    soils = tuple(soil(diameter, forces) for forces in curves)
    drag, weights = 0.5 * 1025.0 * diameter, pipe_of(scene).weight
    return SecondModel(scene.length, weights, drag=drag, soils=soils, soil_of=flowline, **given)


def of_riser(riser: Riser, weights: Floats, own: int, diameter: float, water: float, **given: Any) -> SecondModel:  # noqa: ANN401 - fields of several kinds
    """With the lengths of a riser that is written here."""
    points = riser.points()
    lengths = np.array([math.dist(*pair) for pair in pairwise(points)])
    drag, nothing = 0.5 * water * diameter, np.zeros(len(weights), np.intp)
    upright = float(weights[own]) * math.cos(given.get("slope", 0.0))
    return SecondModel(
        lengths, weights, riser.far, riser.height, upright, drag=drag, soil_of=nothing, surge=0.0, period=11.0, **given
    )


def steel(young: float, outer: float, inner: float, density: float, water: float, g: float) -> dict[str, float]:
    """Weight, mass with added mass, and bending stiffness of a pipe with a drag coefficient of 1."""
    metal, displaced = math.pi / 4.0 * (outer**2 - inner**2) * density, math.pi / 4.0 * outer**2 * water
    return {
        "weight": (metal - displaced) * g,
        "mass": metal + displaced,
        "bending": young * math.pi / 64.0 * (outer**4 - inner**4),
    }


# elements of 0.5 m: the line bends within 1.9 m
LAZY = Riser(
    280.0, 700.0, 900.0, 400.0, elements=1800, section=FLEXIBLE.format(buoyancy=0.62).replace("290.0", "230.0"),
    sets="*ELEMENT SETS\n SET=Bare\n GEN=1, 1150\n GEN=1351, 1800\n SET=Buoy\n GEN=1151, 1350\n",
)  # fmt: skip
SLOPE = Riser(slope=5.0, top_first=True, model="*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=5.0\n DIRECTION=0.0\n")


def dynamic() -> SecondModel:
    pipe = steel(207.0e9, 0.27305, 0.22225, 7850.0, 1025.0, 9.81)
    return of_sample(
        "scr-dynamic.keyxm", TRENCH, FLOWLINE, distance=904.6, height=990.009, own_weight=pipe["weight"],
        mass=pipe["mass"], bending=pipe["bending"], heave=1.5, surge=0.0, period=12.0,
    )  # fmt: skip


def vessel() -> SecondModel:
    inside, displaced = math.pi / 4.0 * 0.22225**2 * 820.0, math.pi / 4.0 * 0.27305**2 * 1025.0
    return of_sample(
        "scr-vessel.keyxm", SOFT, distance=961.292, height=789.286, own_weight=(155.1 + inside - displaced) * 9.81,
        mass=155.1 + inside + displaced, bending=4.0e5 / 0.0126, heave=cmath.rect(4.031, math.radians(2.2)),
        surge=-4.034j, period=14.2,
    )  # fmt: skip


def lazy_wave() -> SecondModel:
    floats = np.repeat([False, True, False], [1150, 200, 450])
    weights = np.where(floats, 230.0 - 1025.0 * math.pi / 4.0 * 0.62**2, 118.0 - 1025.0 * math.pi / 4.0 * 0.302**2)
    mass = 118.0 + 1025.0 * math.pi / 4.0 * 0.302**2
    soils = (soil(0.302, *CLAY),)
    return of_riser(LAZY, 9.81 * weights, 0, 0.302, 1025.0, mass=mass, bending=50.0e3, soils=soils, heave=1.0)


def imperial() -> SecondModel:
    pipe = steel(4.323e9, 1.0627, 0.9275, 15.23, 1.9888, 32.185)
    weights = np.full(250, pipe.pop("weight"))
    soils = (soil(1.0627, (0.0, 48.0, 68.5, 130.2), CLAY[1]),)
    return of_riser(IMPERIAL, weights, 0, 1.0627, 1.9888, soils=soils, heave=1.0, metre=1.0 / 0.3048, **pipe)


def slope() -> SecondModel:
    pipe = steel(207.0e9, 0.3239, 0.2827, 7850.0, 1025.0, 9.81)
    weights = np.full(250, pipe.pop("weight"))
    soils = (soil(0.3239, *CLAY),)
    return of_riser(SLOPE, weights, 0, 0.3239, 1025.0, soils=soils, heave=1.0, slope=math.radians(5.0), **pipe)


MODELS: dict[str, tuple[Callable[[], SecondModel], Riser | None, str]] = {
    "scr-dynamic.keyxm": (dynamic, None, "metric"),
    "scr-vessel.keyxm": (vessel, None, "metric"),
    "lazy wave": (lazy_wave, LAZY, "metric"),
    "imperial": (imperial, IMPERIAL, "imperial"),
    "on a slope, from the top": (slope, SLOPE, "metric"),
}


@cache
def second(name: str) -> SecondModel:
    return MODELS[name][0]()


@cache
def zone(name: str) -> Zone:
    _, riser, units = MODELS[name]
    deck = mudline.from_keyword(riser.text(), units=units) if riser else mudline.read(SAMPLES / name)
    scene = deck.scene()._resolved
    return touchdown_zone(scene, scene.contact_input(), None, None)


@pytest.mark.parametrize("name", MODELS)
def test_tension_and_touchdown_are_those_of_the_second_model(name: str) -> None:
    own, other = zone(name), second(name)
    assert own.line.catenary is not None
    assert own.beam.tension == pytest.approx(other.tension, rel=0.001)
    assert own.line.catenary.lying[-1][1] == pytest.approx(other.lying, rel=0.001)
    assert own.travel == pytest.approx(other.travel, rel=0.001)
    assert own.beam.lengths == pytest.approx(other.zone[0])


@pytest.mark.parametrize("name", MODELS)
def test_the_state_at_rest_is_that_of_the_second_model(name: str) -> None:
    own, other = zone(name), second(name).rest()
    beam, _, rest = own.rest()
    assert rest.reaction.per_length[own.landing].max() == pytest.approx(other.force, rel=0.001)
    assert np.abs(beam.moments(rest.state[1::2])).max() == pytest.approx(other.moment, rel=0.001)
    assert float(beam.touchdown(rest.state[::2])) - own.start == pytest.approx(other.touchdown[0], abs=0.01)


def assert_alike(own: Zone, steps: int, other: Measured) -> None:
    found, _ = own.run(steps)
    assert (found.largest_force, found.largest_moment) == pytest.approx((other.force, other.moment), rel=0.002)
    assert found.moment_range == pytest.approx(other.range, rel=0.002)
    assert found.touchdown == pytest.approx(other.touchdown, abs=0.02 * float(np.ptp(other.touchdown)))


@pytest.mark.parametrize("name", MODELS)
def test_forces_moments_and_touchdown_in_motion(name: str) -> None:
    """A coarse step, at which both have the same error."""
    own, other = zone(name), second(name)
    steps = 3 * 30
    assert_alike(own, steps, other.run(3.0 * other.period / steps))


@pytest.mark.alike
@pytest.mark.parametrize("name", ["imperial", "lazy wave"])
def test_errors_are_those_of_the_second_model(name: str) -> None:
    own, other = study(zone(name).scene, ("accuracy",), timer=lambda: 0.0), second(name)
    assert own.reference is not None
    fine = other.run(own.reference.step)
    for row in own.steps:
        assert row.errors == pytest.approx(other.run(row.step).errors(fine), rel=0.2, abs=2e-4)


def test_another_scheme() -> None:
    """Worked by a third program: Hilber-Hughes with -0.25 at 50 ms."""
    own = replace(zone("scr-dynamic.keyxm"), scheme=hilber_hughes(-0.25))
    found, _ = own.run(720)
    worked = 1114.16, 125958.0, 40679.6
    assert (found.largest_force, found.largest_moment, found.moment_range) == pytest.approx(worked, rel=0.001)
    assert_alike(own, 720, replace(second("scr-dynamic.keyxm"), scheme=(0.0, 0.25)).run(0.05))
