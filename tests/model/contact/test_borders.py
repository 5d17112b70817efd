"""Where laws meet: ends of lines, borders of sets, nodes above the seabed, elements with laws of their own."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.seabed import PlanesSeabed
from tests.helpers.builders.contact import (
    CLAY,
    CURVE,
    LINEAR,
    NONE,
    RIGID,
    at_depths,
    bridge_law,
    chain,
    drawn,
    friction,
    heave,
    on,
    suction,
    walk,
)
from tests.model.contact.single import COMPRESSION, FORCE, FREE, SUCTION


def test_every_law_gives_its_half_to_the_nodes_that_it_shares() -> None:
    """Curve, linear, linear with a zone, none, rigid, on springs of nodes, and a curve that unloads; all at 0.06 m."""
    inputs = chain(
        [CURVE, LINEAR, NONE, NONE, RIGID, NONE, CURVE],
        on("smoothed", [2], stiffness=50000.0, half_width=0.01, one_sided=1.0),
        on("nodal", [5, 6], stiffness=[2e4, 1e4]),
        on("unloading", [6], stiffness=500000.0),
    )
    first, second = walk(ContactModel(inputs), at_depths([[0.06] * 8, [0.058] * 8]))
    # forces per length: 3250 of the curve, 3000 of the linear law, 2500 beyond a zone of 0.02 m; elements of 2 m
    assert first.force == pytest.approx([3250.0, 3000.0, 2500.0, 0.0, 0.0, 0.0, 3250.0])
    assert first.normal_force == pytest.approx([3250.0, 6250.0, 5500.0, 2500.0, 0.0, 1200.0, 600.0 + 3250.0, 3250.0])
    loading = 12500.0 / 0.3
    assert second.force == pytest.approx([3250.0 - 0.002 * loading, 2900.0, 2400.0, 0.0, 0.0, 0.0, 2250.0])
    assert second.stiffness == pytest.approx([loading, 50000.0, 50000.0, 0.0, 0.0, 0.0, 500000.0])


def test_suction_of_one_set_ends_at_its_border() -> None:
    contact = ContactModel(chain([LINEAR] * 3, suction(bridge_law(2), [2, 0])))
    first, second = walk(contact, *heave([0.02, -0.08], [0.0, 0.1], nodes=4))
    assert first.state is not None
    assert second.state is not None
    assert first.state.tolist() == [COMPRESSION, -1, COMPRESSION]
    assert second.state.tolist() == [SUCTION, -1, SUCTION]
    assert second.force == pytest.approx([-FORCE, 0.0, -FORCE])
    assert second.normal_force == pytest.approx([-FORCE] * 4)


def test_springs_against_uplift_beside_suction_with_a_history() -> None:
    springs = on("suction spring", [1, 2], stiffness=[800.0, 0.0], extent=0.1)
    contact = ContactModel(chain([LINEAR] * 3, suction(bridge_law(1), [0]), springs))
    results = walk(contact, *heave([-0.05, 0.02, -0.08, -0.1, -0.11], [0.1, 0.0, 0.1, 0.1, 0.1], nodes=4))
    assert [result.force[1] for result in results] == pytest.approx([-40.0, 1000.0, -64.0, -80.0, 0.0])
    assert [result.force[0] for result in results] == pytest.approx([0.0, 1000.0, *[-FORCE] * 3])
    assert not any(result.force[2] for result in (results[0], *results[2:]))
    assert [result.state[0] for result in results if result.state is not None] == [FREE, COMPRESSION, *[SUCTION] * 3]
    assert results[2].stiffness[1] == 800.0


def test_a_node_above_the_seabed_rubs_under_its_half_of_the_force() -> None:
    """The depth, and so the force and the friction that it allows, is that of the middle of the element."""
    contact = ContactModel(chain([LINEAR], friction(2, (0.5, 0.5), 1e5)))
    path = at_depths([[0.05, -0.01], [0.05, -0.01]])
    path[..., 1] = [0.0, 2.0]
    path[1, :, 2] = 0.1
    result = contact.evaluate(path)
    assert result.gap[0].tolist() == [-0.05, 0.01]
    assert result.reaction[1] == pytest.approx(np.array([[1000.0, 0.0, -500.0]] * 2))


def test_springs_of_nodes_look_at_their_own_node() -> None:
    contact = ContactModel(chain([LINEAR], on("nodal", 2, stiffness=1e4), friction(2, (0.5, 0.5), 1e5)))
    result = contact.evaluate(at_depths([0.05, -0.09]))
    assert not result.contact.any()
    assert result.normal_force == pytest.approx([500.0, 0.0])


def test_ends_of_a_line_take_half_an_element() -> None:
    laws = suction(bridge_law(3)), friction(4, (0.5, 0.5), 1e5)
    contact = ContactModel(chain([LINEAR] * 3, *laws, length=[1.0, 2.0, 4.0]))
    path, rates = heave([0.02, 0.02, -0.08], [0.0, 0.0, 0.1], nodes=4)
    path[1, :, 1] += 1.0
    results = walk(contact, path, rates)
    assert results[1].normal_force == pytest.approx([500.0, 1500.0, 3000.0, 2000.0])
    assert results[1].reaction[:, 1] == pytest.approx([-250.0, -750.0, -1500.0, -1000.0])
    assert results[2].normal_force == pytest.approx([-0.5 * FORCE, -1.5 * FORCE, -3.0 * FORCE, -2.0 * FORCE])
    assert results[2].friction is not None
    assert not results[2].friction.any()  # suction is no pressure


def test_lateral_springs_and_friction_at_the_border_of_two_sets() -> None:
    """Friction at the first two nodes, a spring on the second element: the node between has both."""
    laws = friction(2, (0.5, 0.5), 1e5), on("lateral", [1], stiffness=3000.0)
    result = ContactModel(chain([LINEAR] * 2, *laws)).evaluate(drawn([(0.0, 0.0), (0.0, 0.004)], nodes=3))
    assert result.friction is not None
    assert result.friction_state is not None
    assert result.friction[1, :, 1] == pytest.approx([-400.0, -400.0 - 12.0, -12.0])
    assert result.reaction[1, :, 2] == pytest.approx([-400.0, -412.0, -12.0])
    assert result.friction_state[1].tolist() == [[1, 1], [1, 1], [-1, -1]]


def test_friction_of_a_node_that_hops_from_plane_to_plane() -> None:
    """Over the break N and the directions change; what pulls is the way from the stick point within the new plane."""
    seabed = PlanesSeabed([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], [0.0, 30.0])
    laws = on("nodal", 1, stiffness=5e4), friction(1, (0.9, 0.9), 1e4)
    contact = ContactModel(chain([], *laws, seabed=seabed))
    level, steep = np.array([-0.02, -0.01, 0.0]), np.array([-0.01, 0.01, 0.0])
    results = walk(contact, [[level], [steep], [level]])
    normal = np.array([np.cos(np.pi / 6), -0.5, 0.0])
    along = np.array([0.5, np.cos(np.pi / 6), 0.0])
    assert results[1].normal[0] == pytest.approx(normal)
    depth = -float(steep @ normal)
    stretch = float((steep - level) @ along)
    assert 1e4 * stretch < 0.9 * 5e4 * depth
    assert results[1].reaction[0] == pytest.approx(5e4 * depth * normal - 1e4 * stretch * along)
    assert results[2].reaction[0] == pytest.approx([1000.0, 0.0, 0.0], abs=1e-9)  # back at its stick point


def test_two_diameters_on_one_curve_that_unloads() -> None:
    unloading = on("unloading", 2, stiffness=2e5)
    contact = ContactModel(chain([CURVE, CURVE], unloading, curves=(CLAY,), diameter=[0.3, 0.6]))
    results = contact.evaluate(at_depths([[0.06] * 3, [0.055] * 3, [0.12] * 3]))
    assert results.force[0] == pytest.approx([3250.0, 2000.0])
    assert results.force[1] == pytest.approx([2250.0, 1000.0])
    assert results.force[2] == pytest.approx([5250.0, 3250.0])
    assert results.slope[1] == pytest.approx([2e5 * 0.3, 2e5 * 0.6])
