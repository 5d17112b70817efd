"""Laws with a history once more, for one element in plain Python from their formulas alone, on random paths.

What numpy gives is looked at: the loops give the same bits, by other tests.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, inf

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import BUILT_IN
from tests.helpers.builders.contact import LINEAR, chain, friction, on, trench
from tests.model.contact.exact import EXACT

K, LENGTH = 5.0e4, 2.0
STEPS = 400

SECOND_OPINIONS = {
    "exact": {*EXACT, "rigid"},  # which has no force
    "soil_program": {"soil"},
    "friction/test_breakout": {"breakout"},
    "trench/test_law": {
        "trench table",
        "trench wall",
        "trench level",
    },  # worked numbers; the table has the peak's driver
    "test_damping": {"nodal damping"},
    "here": {"unloading", "suction", "suction spring", "damping", "lateral", "friction", "trench peak"},
}
"""Where each law is computed a second time, from its formulas."""


def test_every_law_has_a_second_opinion() -> None:
    assert set().union(*SECOND_OPINIONS.values()) == set(BUILT_IN)


# ---------------------------------------------------------------------------------------------------- along the normal


@dataclass
class Uplift:
    """Suction after Bridge: factor and exponent of force and depth, corners, v_r, factor of a cycle and its floor."""

    force: tuple[float, float]
    depth: tuple[float, float]
    corners: tuple[float, float]
    slowest: float
    cyclic: float
    floor: float | None
    armed: bool = False
    broken: bool = False
    fastest: float = 0.0
    factor: float = 1.0

    def __post_init__(self) -> None:
        self.factor = self.cyclic if self.floor is None else 1.0

    def cycle(self) -> None:
        if self.floor is not None:
            self.factor = max(self.factor * self.cyclic, self.floor)

    def largest(self, v: float) -> float:
        alpha, n = self.force
        if v >= self.slowest:
            return self.factor * alpha * math.pow(v, n)
        r = v / self.slowest
        return self.factor * alpha * math.pow(self.slowest, n) * ((2.0 - n) * r + (n - 1.0) * r * r)

    def pull(self, x: float, v: float, *, compressed: bool) -> float:
        if compressed:
            if self.armed and self.fastest > 0.0:
                self.cycle()
            self.armed, self.fastest = True, 0.0
            return 0.0
        if not self.armed:
            return 0.0
        self.fastest = max(self.fastest, v)
        if v <= 0.0:
            return 0.0
        share = x / (self.depth[0] * max(self.fastest, self.slowest) ** self.depth[1])
        if share >= 1.0:
            self.armed = False
            self.cycle()
            return 0.0
        first, second = self.corners
        part = share / first if share < first else (1.0 - share) / (1.0 - second) if share > second else 1.0
        return -self.largest(v) * max(part, 0.0)


def program(depths: list[float], speeds: list[float], unloading: float, uplift: Uplift | None, c: float) -> list[float]:
    """Force per unit length by step: a line with unloading, suction, and damping of inward motion."""
    deepest, found = 0.0, []
    bottom, most = 0.0, 0.0
    line = max(K, unloading)
    for z, v in zip(depths, speeds, strict=True):
        if unloading == 0.0:
            force = max(K * z, 0.0)
        elif z > deepest:
            deepest, most = z, K * z
            bottom = deepest - most / line
            force = most
        else:
            force = max(most - line * (deepest - z), 0.0)
        if uplift is not None:
            force += uplift.pull(bottom - z, v, compressed=force > 0.0)
        if z > 0.0 and v < 0.0:
            force -= c * v
        found.append(force)
    return found


def path(rng: np.random.Generator, low: float, high: float) -> list[float]:
    """Places of a walk that turns now and then."""
    turns = rng.uniform(low, high, STEPS // 20 + 1)
    return [float(x) for x in np.interp(np.arange(STEPS) / 20.0, np.arange(len(turns)), turns)]


def moved(heights: list[float], along: list[float], across: list[float]) -> FloatArray:
    """Positions of both nodes."""
    places = np.zeros((STEPS, 2, 3))
    places[:, 1, 1] = LENGTH
    places += np.array([heights, along, across]).T[:, None, :]
    return places


@pytest.mark.parametrize("seed", range(6))
def test_the_way_of_an_element_along_the_normal(seed: int) -> None:
    rng = np.random.default_rng(seed)
    depths = path(rng, -0.15, 0.1)
    speeds = [float(one) for one in rng.uniform(-0.05, 0.1, STEPS)]
    floor = None if seed % 2 else 0.6
    uplift = Uplift((1500.0, 0.18), (0.25, 0.26), (0.2, 0.8), 0.02, 0.9, floor)
    laws = [
        on("suction", 1, force_factor=1500.0, force_exponent=0.18, depth_factor=0.25, depth_exponent=0.26,
           regularisation=0.02, cyclic=0.9, cyclic_floor=np.nan if floor is None else floor),
        on("damping", 1, damping=700.0),
    ]  # fmt: skip
    unloading = 0.0 if seed < 2 else 1e4 if seed == 2 else 4e5
    if unloading:
        laws.append(on("unloading", 1, stiffness=unloading))
    rates = np.zeros((STEPS, 2, 3))
    rates[:, :, 0] = np.array(speeds)[:, None]
    model = ContactModel(chain([LINEAR], *laws, stiffness=K))
    result = model.evaluate(moved([-z for z in depths], [0.0] * STEPS, [0.0] * STEPS), velocities=rates)
    wanted = program(depths, speeds, unloading, uplift, 700.0)
    assert min(wanted) < -100.0
    assert result.reaction[:, 0, 0] == pytest.approx(np.array(wanted) * LENGTH / 2.0, rel=1e-9, abs=1e-6)


def test_a_spring_against_uplift() -> None:
    depths = path(np.random.default_rng(9), -0.3, 0.05)
    model = ContactModel(chain([LINEAR], on("suction spring", 1, stiffness=800.0, extent=0.2), stiffness=K))
    result = model.evaluate(moved([-z for z in depths], [0.0] * STEPS, [0.0] * STEPS))
    wanted = [K * z if z > 0.0 else 800.0 * z if z >= -0.2 else 0.0 for z in depths]
    assert result.reaction[:, 0, 0] == pytest.approx(np.array(wanted) * LENGTH / 2.0, rel=1e-9, abs=1e-9)


# ------------------------------------------------------------------------------------------------ along and across


Limit = Callable[[float, float], float]
"""What is added to the limit across at a place, in a direction."""


def slid(
    normal: list[float],
    ways: list[tuple[float, float]],
    mu: tuple[float, float],
    spring: float,
    *,
    ellipse: bool,
    extra: Limit,
) -> list[tuple[float, float]]:
    """Force on a node by step: springs to a stick point, up to the limits; `spring` is stiffness, or < 0 a length."""
    stick: tuple[float, float] | None = None
    found = []
    for force, place in zip(normal, ways, strict=True):
        if force <= 0.0:
            stick = None
            found.append((0.0, 0.0))
            continue
        stick = stick or place
        limits = [mu[0] * force, mu[1] * force]
        springs = [spring, spring] if spring > 0.0 else [limits[0] / -spring, limits[1] / -spring]
        trial = [stiffness * (at - held) for stiffness, at, held in zip(springs, place, stick, strict=True)]
        limits[1] += extra(place[1], trial[1])
        if ellipse:
            size = hypot(trial[0] / limits[0], trial[1] / limits[1])
            held = [one / max(size, 1.0) for one in trial]
        else:
            held = [min(max(one, -limit), limit) for one, limit in zip(trial, limits, strict=True)]
        stick = (place[0] - held[0] / springs[0], place[1] - held[1] / springs[1])
        found.append((-held[0], -held[1]))
    return found


def no_trench(_: float, __: float) -> float:
    return 0.0


def in_trench(place: float, force: float) -> float:
    """Half of the element has a peak of 5000 per unit length at 0.55, the middle of walls from 0.25 to 0.85."""
    outward = force * place > 0.0
    return LENGTH / 2.0 * 5000.0 * max(0.0, 1.0 - abs(abs(place) - 0.55) / 0.3) if outward else 0.0


@pytest.mark.parametrize(
    ("spring", "ellipse", "extra"),
    [
        (1e5, False, no_trench),
        (1e5, True, no_trench),
        (-0.05, False, no_trench),
        (-0.05, True, no_trench),
        (1e5, False, in_trench),
    ],
)
def test_the_way_of_a_node_over_the_seabed(spring: float, ellipse: bool, extra: Limit) -> None:
    rng = np.random.default_rng(3)
    depths, along, across = path(rng, -0.01, 0.1), path(rng, -0.3, 0.3), path(rng, -1.0, 1.0)
    law = friction(
        2,
        (0.5, 0.8),
        spring if spring > 0.0 else np.nan,
        mobilisation=-spring if spring < 0.0 else np.nan,
        ellipse=ellipse,
    )
    laws = [law] if extra is no_trench else [law, trench(1, 0.5, 1.7, 5000.0)]
    model = ContactModel(chain([LINEAR], *laws, stiffness=K))
    result = model.evaluate(moved([-z for z in depths], along, across))
    normal = [max(K * z, 0.0) * LENGTH / 2.0 for z in depths]
    wanted = slid(normal, list(zip(along, across, strict=True)), (0.5, 0.8), spring, ellipse=ellipse, extra=extra)
    assert result.friction is not None
    assert result.friction[:, 0] == pytest.approx(np.array(wanted), rel=1e-9, abs=1e-6)


def test_a_spring_to_where_the_element_touched_down() -> None:
    rng = np.random.default_rng(4)
    depths, across = path(rng, -0.05, 0.1), path(rng, -1.0, 1.0)
    result = ContactModel(chain([LINEAR], on("lateral", 1, stiffness=900.0), stiffness=K)).evaluate(
        moved([-z for z in depths], [0.0] * STEPS, across)
    )
    touched, wanted = inf, []
    for z, place in zip(depths, across, strict=True):
        touched = inf if z <= 0.0 else place if touched == inf else touched
        wanted.append(0.0 if touched == inf else -900.0 * (place - touched) * LENGTH / 2.0)
    assert result.reaction[:, 0, 2] == pytest.approx(np.array(wanted), rel=1e-9, abs=1e-9)
