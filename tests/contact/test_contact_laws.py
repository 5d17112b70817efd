"""Element results: depth, ratio, force, slope and stiffness under each law."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mudline.contact import ContactModel
from mudline.curves import ForceCurve
from tests.contact.chains import CURVE, LINEAR, NONE, PULLING, RIGID, SAND, at_depths, chain, depth_at


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


def test_a_curve_that_does_not_start_at_zero_gives_nothing_above_the_bed() -> None:
    curve = ForceCurve([(-0.5, 100.0), (0.5, 300.0)])
    result = ContactModel(chain([CURVE], curves=(curve,), diameter=1.0)).evaluate(at_depths([[0.0] * 2, [0.25] * 2]))
    assert result.force.tolist() == [[0.0], [250.0]]


def test_linear_law() -> None:
    result = ContactModel(chain([LINEAR])).evaluate(at_depths([[0.01, 0.03], [0.1, 0.1]]))
    assert result.depth.ravel() == pytest.approx([0.02, 0.1])
    assert result.force.ravel() == pytest.approx([1000.0, 5000.0])
    assert result.stiffness.ravel().tolist() == [50000.0, 50000.0]
    assert result.slope.ravel() == pytest.approx([15000.0, 15000.0])
    assert result.ratio.ravel() == pytest.approx([0.02 / 0.3, 0.1 / 0.3])


def test_a_linear_law_needs_no_diameter() -> None:
    inputs = chain([LINEAR, NONE, LINEAR], diameter=[np.nan, np.nan, 0.5])
    result = ContactModel(inputs).evaluate(at_depths([0.02, 0.02, 0.02, 0.02]))
    assert result.force.tolist() == [1000.0, 0.0, 1000.0]
    assert result.stiffness.tolist() == [50000.0, 0.0, 50000.0]
    assert np.isnan(result.ratio).tolist() == [True, True, False]
    assert np.isnan(result.slope).tolist() == [True, True, False]
    assert np.isfinite(result.reaction).all()


def test_depth_is_the_mean_of_both_nodes_and_a_node_above_the_bed_takes_its_half() -> None:
    result = ContactModel(chain([LINEAR])).evaluate(at_depths([0.05, -0.01]))
    assert result.gap.tolist() == [-0.05, 0.01]
    assert result.depth == pytest.approx([0.02])
    assert result.force == pytest.approx([1000.0])
    assert result.normal_force == pytest.approx([1000.0, 1000.0])
    assert result.reaction == pytest.approx(np.array([[1000.0, 0.0, 0.0]] * 2))


def test_nodes_moving_against_each_other_change_nothing() -> None:
    model = ContactModel(chain([CURVE] * 6))
    zigzag = 0.02 * (-1.0) ** np.arange(7)
    straight, bent = model.evaluate(at_depths(np.full(7, 0.03))), model.evaluate(at_depths(0.03 + zigzag))
    assert bent.force == pytest.approx(straight.force, rel=1e-14)
    assert bent.gap != pytest.approx(straight.gap)


def test_every_element_has_its_own_law() -> None:
    inputs = chain([CURVE, LINEAR, NONE, RIGID, CURVE], curves=(SAND, PULLING), curve_index=[0, 0, 0, 0, 1])
    result = ContactModel(inputs).evaluate(at_depths(np.full(6, 0.09)))
    assert result.contact.all()
    assert result.force == pytest.approx([12000.0, 4500.0, 0.0, 0.0, 500.0])
    assert result.stiffness == pytest.approx([40000.0 / 0.3, 50000.0, 0.0, 0.0, 4000.0 / 0.3])
    assert result.slope == pytest.approx([40000.0, 15000.0, 0.0, 0.0, 4000.0])
    assert result.normal_force == pytest.approx([12000.0, 16500.0, 4500.0, 0.0, 500.0, 500.0])


def test_one_curve_under_two_diameters() -> None:
    result = ContactModel(chain([CURVE, CURVE], diameter=[0.3, 0.6])).evaluate(at_depths(np.full(3, 0.06)))
    assert result.ratio == pytest.approx([0.2, 0.1])
    assert result.force == pytest.approx([3250.0, 2000.0])
    assert result.stiffness[0] == pytest.approx(12500.0 / 0.3)


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
