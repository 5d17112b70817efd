"""Where laws meet: ends of lines, borders of sets, nodes above the seabed, elements with laws of their own."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.seabed import PlanesSeabed
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    RIGID,
    at_depths,
    bridge_law,
    chain,
    friction,
    heave,
    on,
    suction,
    walk,
)
from tests.model.contact.single import FORCE


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


def test_a_node_above_the_seabed_rubs_under_its_half_of_the_force() -> None:
    """The depth, and so the force and the friction that it allows, is that of the middle of the element."""
    contact = ContactModel(chain([LINEAR], friction(2, (0.5, 0.5), 1e5)))
    path = at_depths([[0.05, -0.01], [0.05, -0.01]])
    path[..., 1] = [0.0, 2.0]
    path[1, :, 2] = 0.1
    result = contact.evaluate(path)
    assert result.gap[0].tolist() == [-0.05, 0.01]
    assert result.reaction[1] == pytest.approx(np.array([[1000.0, 0.0, -500.0]] * 2))


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
