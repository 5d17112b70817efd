"""Element results under each normal law: depth, ratio, force, slope and stiffness; and springs of nodes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.linear import automatic_half_width
from mudline.model.contact.seabed import SlopingSeabed
from tests.helpers.builders.contact import CURVE, LINEAR, NONE, PULLING, at_depths, chain, depth_at, on


@pytest.mark.parametrize(
    ("ratio", "force", "stiffness"),
    [
        (0.05, 1000.0, 66666.666667),
        (0.1, 2000.0, 41666.666667),
        (0.2, 3250.0, 41666.666667),
        (0.3, 4500.0, 25000.0),
        (0.4, 5250.0, 25000.0),
        (0.5, 6000.0, 25000.0),
        (0.8, 8250.0, 25000.0),
    ],
)
def test_worked_table_of_a_curve(ratio: float, force: float, stiffness: float) -> None:
    depth = depth_at(ratio, 0.3)
    result = ContactModel(chain([CURVE])).evaluate(at_depths([depth, depth]))
    assert result.depth[0] == depth
    assert result.ratio[0] == ratio
    assert result.contact.tolist() == [True]
    assert result.force[0] == pytest.approx(force, rel=1e-12)
    assert result.stiffness[0] == pytest.approx(stiffness, rel=1e-11)
    assert result.slope[0] == pytest.approx(stiffness * 0.3, rel=1e-11)
    assert result.normal_force == pytest.approx([force, force], rel=1e-12)


@pytest.mark.parametrize("depth", [-0.006, 0.0, -0.0])
def test_out_of_contact_there_is_a_ratio_and_nothing_else(depth: float) -> None:
    result = ContactModel(chain([CURVE, LINEAR])).evaluate(at_depths([depth] * 3))
    assert result.ratio == pytest.approx([depth / 0.3] * 2)
    for values in (result.contact, result.force, result.slope, result.stiffness, result.reaction, result.normal_force):
        assert not values.any()
    for floats in (result.force, result.reaction, result.normal_force):
        assert not np.signbit(floats).any()


def test_a_linear_law_needs_no_diameter() -> None:
    inputs = chain([LINEAR, NONE, LINEAR], diameter=[np.nan, np.nan, 0.5])
    result = ContactModel(inputs).evaluate(at_depths([0.02, 0.02, 0.02, 0.02]))
    assert result.force.tolist() == [1000.0, 0.0, 1000.0]
    assert result.stiffness.tolist() == [50000.0, 0.0, 50000.0]
    assert np.isnan(result.ratio).tolist() == [True, True, False]
    assert np.isnan(result.slope).tolist() == [True, True, False]
    assert np.isfinite(result.reaction).all()


def test_depth_is_the_mean_of_both_nodes_and_a_node_above_the_seabed_takes_its_half() -> None:
    result = ContactModel(chain([LINEAR])).evaluate(at_depths([0.05, -0.01]))
    assert result.gap.tolist() == [-0.05, 0.01]
    assert result.depth == pytest.approx([0.02])
    assert result.force == pytest.approx([1000.0])
    assert result.normal_force == pytest.approx([1000.0, 1000.0])
    assert result.reaction == pytest.approx(np.array([[1000.0, 0.0, 0.0]] * 2))


def test_a_pull_is_kept_unless_it_is_cut() -> None:
    depths = at_depths([[depth] * 2 for depth in (0.12, 0.16, 0.3)])
    inputs = chain([CURVE], curves=(PULLING,), diameter=1.0)
    kept = ContactModel(inputs).evaluate(depths)
    assert kept.force.ravel() == pytest.approx([-60.0, 20.0, 500.0])
    assert kept.reaction[0] == pytest.approx(np.array([[-60.0, 0.0, 0.0]] * 2))
    assert not kept.cut.any()
    assert not np.signbit(kept.reaction[..., 1:]).any()
    cut = ContactModel(replace(inputs, tension="cut")).evaluate(depths)
    assert cut.cut.ravel().tolist() == [True, False, False]
    assert cut.contact.all()
    for values in (cut.force, cut.slope, cut.stiffness, cut.normal_force):
        assert not values[0].any()
    assert np.array_equal(cut.force[1:], kept.force[1:])
    assert np.array_equal(cut.stiffness[1:], kept.stiffness[1:])


def test_no_elements_and_no_nodes() -> None:
    lone = ContactModel(chain([])).evaluate()
    assert lone.depth.shape == (0,)
    assert lone.reaction.tolist() == [[0.0, 0.0, 0.0]]
    inputs = chain([])
    empty = replace(inputs, node_ids=inputs.node_ids[:0], coordinates=inputs.coordinates[:0])
    assert ContactModel(empty).evaluate(np.empty((4, 0, 3))).reaction.shape == (4, 0, 3)


def test_without_positions_the_coordinates_hold() -> None:
    inputs = chain([CURVE, CURVE])
    model = ContactModel(replace(inputs, coordinates=at_depths([0.03, 0.03, 0.09])))
    assert model.evaluate().force == pytest.approx([2000.0, 3250.0])
    assert model.input.coordinates[2, 0] == -0.09


def test_a_parameter_of_minus_zero_is_zero() -> None:
    inputs = chain([LINEAR, NONE], on("smoothed", [1], stiffness=-0.0, half_width=-0.0), stiffness=-0.0)
    for law, name in (("linear", "stiffness"), ("smoothed", "stiffness"), ("smoothed", "half_width")):
        assert not np.signbit(inputs.assigned[law][name]).any()
    result = ContactModel(inputs).evaluate(at_depths([0.1] * 3))
    for values in (result.force, result.slope, result.stiffness, result.reaction):
        assert not values.any()
        assert not np.signbit(values).any()


# ---------------------------------------------------------------------------------------------- zones, nodes and slopes

K, H = 50000.0, 0.005
DEPTHS = [-0.005, -0.0025, 0.0, 0.0025, 0.005, 0.01, 0.02, 0.05]
CENTRED = [0.0, 15.625, 62.5, 140.625, 250.0, 500.0, 1000.0, 2500.0]
CENTRED_SLOPES = [0.0, 12500.0, 25000.0, 37500.0, *[50000.0] * 4]
ONE_SIDED = [0.0, 0.0, 0.0, 15.625, 62.5, 250.0, 750.0, 2250.0]
ONE_SIDED_SLOPES = [0.0, 0.0, 0.0, 12500.0, 25000.0, *[50000.0] * 3]
FORMS = [(False, CENTRED, CENTRED_SLOPES), (True, ONE_SIDED, ONE_SIDED_SLOPES)]


@pytest.mark.parametrize(("one_sided", "forces", "slopes"), FORMS)
def test_zone_of_elements(one_sided: bool, forces: list[float], slopes: list[float]) -> None:
    contact = ContactModel(chain([NONE], on("smoothed", 1, stiffness=K, half_width=H, one_sided=one_sided)))
    result = contact.evaluate(at_depths([[z, z] for z in DEPTHS]))
    assert result.force.ravel() == pytest.approx(forces, rel=1e-12)
    assert result.stiffness.ravel() == pytest.approx(slopes, rel=1e-12)
    assert result.slope.ravel() == pytest.approx([0.3 * slope for slope in slopes], rel=1e-12)
    assert result.normal_force == pytest.approx(np.column_stack([forces, forces]), rel=1e-12)
    assert result.contact.ravel().tolist() == [z > (0.0 if one_sided else -H) for z in DEPTHS]


@pytest.mark.parametrize(("one_sided", "forces", "slopes"), FORMS)
def test_zone_of_nodes(one_sided: bool, forces: list[float], slopes: list[float]) -> None:
    contact = ContactModel(chain([NONE], on("nodal", [0], stiffness=K, half_width=H, one_sided=one_sided)))
    for depth, force, slope in zip(DEPTHS, forces, slopes, strict=True):
        place = at_depths([depth, 0.3])
        assert contact.evaluate(place).normal_force == pytest.approx([force, 0.0], rel=1e-12)
        tangent = contact.tangent(place, None, contact.initial_state()).by_position.dense()
        assert tangent[0, 0] == pytest.approx(-slope, rel=1e-12)
        assert not tangent[3:].any()


@pytest.mark.parametrize(("one_sided", "onset"), [([0.0, 0.0], -0.004), ([1.0, 0.0], -0.003), ([1.0, 1.0], 0.0)])
def test_an_element_on_springs_of_its_nodes_is_in_contact_from_the_wider_zone_on(
    one_sided: list[float], onset: float
) -> None:
    """The nodes have half widths of 0.004 and 0.003; a one-sided zone begins at the mudline."""
    springs = on("nodal", 2, stiffness=K, half_width=[0.004, 0.003], one_sided=one_sided)
    contact = ContactModel(chain([NONE, NONE], springs))
    depths = [onset - 1e-12, onset, onset + 1e-12]
    result = contact.evaluate(at_depths([[depth] * 3 for depth in depths]))
    assert result.contact[:, 0].tolist() == [False, False, True]
    assert result.contact[:, 1].tolist() == [depth > 0.0 for depth in depths]  # its second node has no spring
    assert not result.force.any()


def on_slope(kind: str, degrees: float) -> tuple[ContactModel, FloatArray]:
    """Nodes 0.05 vertically below a slope, with K at each."""
    seabed = SlopingSeabed(degrees)
    tangent = math.tan(math.radians(degrees))
    points = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    points[:, 0] = tangent * points[:, 1] - 0.05
    if kind == "nodes":
        return ContactModel(chain([NONE], on("nodal", 2, stiffness=K), seabed=seabed)), points
    return ContactModel(chain([LINEAR], seabed=seabed)), points  # an element of 2 m, half to each node


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


K, H = 50000.0, 0.005

TINY, HUGE = 5e-324, 1.7e308


def test_automatic_half_width() -> None:
    z = np.array([0.01, 0.05, 0.05, 0.0, -0.1, np.nan, 0.05, np.inf])
    diameter = np.array([0.3, 0.3, 1.0, 0.3, 0.3, 0.3, np.nan, 0.3])
    width = automatic_half_width(z, diameter)
    assert width == pytest.approx([0.001, 0.003, 0.005, 0.0, 0.0, 0.0, 0.0, 0.003], rel=1e-15)
    assert not np.signbit(width).any()
