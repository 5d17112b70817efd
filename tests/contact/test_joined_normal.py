"""Published numbers of the normal reaction, its zone and its slopes, through the whole evaluator."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from mudline.contact import ContactModel
from mudline.contact.arrays import FloatArray
from mudline.contact.extras import Extras
from mudline.contact.floors import SlopingFloor
from tests.contact.chains import LINEAR, NONE, at_depths, chain
from tests.contact.joined import model, nodal, smoothing

K, H = 50000.0, 0.005
DEPTHS = [-0.005, -0.0025, 0.0, 0.0025, 0.005, 0.01, 0.02, 0.05]
CENTRED = [0.0, 15.625, 62.5, 140.625, 250.0, 500.0, 1000.0, 2500.0]
CENTRED_SLOPES = [0.0, 12500.0, 25000.0, 37500.0, *[50000.0] * 4]
ONE_SIDED = [0.0, 0.0, 0.0, 15.625, 62.5, 250.0, 750.0, 2250.0]
ONE_SIDED_SLOPES = [0.0, 0.0, 0.0, 12500.0, 25000.0, *[50000.0] * 3]
FORMS = [(False, CENTRED, CENTRED_SLOPES), (True, ONE_SIDED, ONE_SIDED_SLOPES)]


@pytest.mark.parametrize(("one_sided", "forces", "slopes"), FORMS)
def test_zone_of_elements(one_sided: bool, forces: list[float], slopes: list[float]) -> None:
    contact = model(chain([LINEAR]), Extras(smoothing=smoothing(1, H, one_sided=one_sided)))
    result = contact.evaluate(at_depths([[z, z] for z in DEPTHS]))
    assert result.force.ravel() == pytest.approx(forces, rel=1e-12)
    assert result.stiffness.ravel() == pytest.approx(slopes, rel=1e-12)
    assert result.slope.ravel() == pytest.approx([0.3 * slope for slope in slopes], rel=1e-12)
    assert result.normal_force == pytest.approx(np.column_stack([forces, forces]), rel=1e-12)
    assert result.contact.ravel().tolist() == [z > (0.0 if one_sided else -H) for z in DEPTHS]


@pytest.mark.parametrize(("one_sided", "forces", "slopes"), FORMS)
def test_zone_of_nodes(one_sided: bool, forces: list[float], slopes: list[float]) -> None:
    contact = model(chain([NONE]), Extras(nodal=nodal([K, np.nan], H, one_sided=one_sided)))
    for depth, force, slope in zip(DEPTHS, forces, slopes, strict=True):
        place = at_depths([depth, 0.3])
        assert contact.evaluate(place).normal_force == pytest.approx([force, 0.0], rel=1e-12)
        tangent = contact.tangent(place, None, contact.initial_state()).by_position.dense()
        assert tangent[0, 0] == pytest.approx(-slope, rel=1e-12)
        assert not tangent[3:].any()


def under(load: float, reaction: Callable[[float], float]) -> float:
    """The depth at which the reaction carries a load."""
    low, high = -0.01, 1.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if reaction(middle) < load else (low, middle)
    return 0.5 * (low + high)


@pytest.mark.parametrize(
    ("one_sided", "static", "light"), [(False, 0.05, 0.0013245553203), (True, 0.055, 0.0063245553203)]
)
def test_static_penetration_of_a_line_of_one_element(one_sided: bool, static: float, light: float) -> None:
    contact = model(chain([NONE]), Extras(nodal=nodal([K, K], H, one_sided=one_sided)))

    def reaction(depth: float) -> float:
        return float(contact.evaluate(at_depths([depth, depth])).reaction[0, 0])

    assert under(0.5 * 1000.0 * 5.0, reaction) == pytest.approx(static, rel=1e-12)
    assert under(100.0, reaction) == pytest.approx(light, rel=1e-10)


def test_a_node_inside_a_line_carries_a_whole_element() -> None:
    inside = model(chain([NONE] * 2), Extras(nodal=nodal([K, K, K])))
    result = inside.evaluate(at_depths([0.05, 1000.0 * 5.0 / K, 0.05]))
    assert result.normal_force == pytest.approx([2500.0, 5000.0, 2500.0], rel=1e-12)


@pytest.mark.parametrize(("one_sided", "work"), [(False, 62.708333333333), (True, 50.833333333333)])
def test_work_of_a_node(one_sided: bool, work: float) -> None:
    contact = model(chain([]), Extras(nodal=nodal([K], H, one_sided=one_sided)))
    # Simpson's rule is exact on each of the pieces
    start, end = (0.0, 2.0 * H) if one_sided else (-H, H)
    done = 0.0
    for low, high in ((start, end), (end, 0.05)):
        force = contact.evaluate(at_depths([[low], [0.5 * (low + high)], [high]])).normal_force[:, 0]
        done += (high - low) / 6.0 * float(force[0] + 4.0 * force[1] + force[2])
    assert done == pytest.approx(work, rel=1e-11)


def on_slope(kind: str, degrees: float) -> tuple[ContactModel, FloatArray]:
    """Nodes 0.05 vertically below a slope, with K at each."""
    floor = SlopingFloor(degrees)
    tangent = math.tan(math.radians(degrees))
    points = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    points[:, 0] = tangent * points[:, 1] - 0.05
    if kind == "nodes":
        return model(replace(chain([NONE]), floor=floor), Extras(nodal=nodal([K, K]))), points
    return ContactModel(replace(chain([LINEAR]), floor=floor)), points  # an element of 2 m, half to each node


@pytest.mark.parametrize("kind", ["nodes", "elements"])
def test_slope_of_ten_degrees(kind: str) -> None:
    contact, points = on_slope(kind, 10.0)
    result = contact.evaluate(points)
    assert result.gap == pytest.approx([-0.049240387651] * 2, rel=1e-10)
    assert result.normal_force == pytest.approx([2462.0193825] * 2, rel=1e-10)
    assert result.reaction == pytest.approx(np.array([[2424.615776, -427.52517916, 0.0]] * 2), rel=1e-10)
    tangent = contact.tangent(points, None, contact.initial_state()).by_position.dense()
    ahead = tangent.reshape(2, 3, 2, 3).sum(axis=2)  # both nodes move as one
    expected = np.array([[48492.31552, -8550.5035831, 0.0], [-8550.5035831, 1507.6844804, 0.0], [0.0, 0.0, 0.0]])
    assert ahead[0] == pytest.approx(-expected, rel=1e-10)
    assert ahead[1] == pytest.approx(-expected, rel=1e-10)
