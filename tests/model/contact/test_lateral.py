"""Lateral springs: from where an element touched down, half of the force to each of its nodes."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.seabed import PlanesSeabed, SlopingSeabed
from tests.helpers.builders.contact import LINEAR, at_depths, chain, drawn, friction, on, stepped

K = 3000.0
"""With an element of 2 m a node gets 3000 N per m of displacement."""


def springs(*beside: object) -> ContactModel:
    return ContactModel(chain([LINEAR], on("lateral", 1, stiffness=K), *beside))  # type: ignore[arg-type]


def test_a_new_touchdown_begins_anew() -> None:
    path = drawn([(0.0, 0.0), (0.0, 0.1), (0.0, 0.1), (0.0, 0.3), (0.0, 0.31)], [0.02, 0.02, -0.01, 0.02, 0.02])
    steps = list(stepped(springs(), path))
    assert [result.reaction[0, 2] for result, _ in steps] == pytest.approx([0.0, -300.0, 0.0, 0.0, -30.0])
    points = [state.touchdown for _, state in steps]
    expected = [[[-0.02, 1.0, 0.0]]] * 2 + [[[np.nan] * 3]] + [[[-0.02, 1.0, 0.3]]] * 2
    np.testing.assert_array_equal(np.array(points), expected)


def test_it_acts_at_the_middle_along_the_normal_of_the_element() -> None:
    """The element is turned by 90 degrees about its middle, which has moved by (0.3, 0.1): only Y counts then."""
    path = drawn([(0.0, 0.0), (0.0, 0.0)])
    path[1, :, 1:] = [[1.3, -0.9], [1.3, 1.1]]
    result = springs().evaluate(path)
    assert result.reaction[1, :, 1:] == pytest.approx(np.array([[-900.0, 0.0]] * 2), abs=1e-9)


def test_on_a_slope_it_acts_in_the_plane_of_the_seabed() -> None:
    seabed = SlopingSeabed(30.0, 90.0)  # rises along Z
    contact = ContactModel(chain([LINEAR], on("lateral", 1, stiffness=K), seabed=seabed))
    path = at_depths([[0.02 / np.cos(np.pi / 6)] * 2] * 2)
    path[:, :, 1] = [0.0, 2.0]
    uphill = np.array([0.5, 0.0, np.cos(np.pi / 6)])
    path[1] += 0.1 * uphill
    result = contact.evaluate(path)
    normal = np.array([np.cos(np.pi / 6), 0.0, -0.5])
    assert result.reaction[1] == pytest.approx(np.array([1000.0 * normal - 300.0 * uphill] * 2), rel=1e-9)


def test_over_a_break_it_follows_the_mean_of_both_normals() -> None:
    """One node on the level, one on a slope of 60 degrees up along Y; the line runs along Z across the break."""
    seabed = PlanesSeabed([[0.0, 0.0, 0.0]] * 2, [0.0, 60.0], [0.0, 0.0])
    contact = ContactModel(chain([LINEAR], on("lateral", 1, stiffness=K), seabed=seabed))
    path = np.array([[[-0.1, -0.1, 0.0], [-0.1, 0.1, 0.1]]] * 2)
    path[1, :, 0] -= 0.05
    path[1, :, 1] -= 0.002
    result = contact.evaluate(path)
    normals = result.normal[1]
    assert normals[:, 0] == pytest.approx([1.0, 0.5])
    mean = normals.sum(axis=0) / np.linalg.norm(normals.sum(axis=0))
    span = path[1, 1] - path[1, 0]
    along = span - (span @ mean) * mean
    across = np.cross(mean, along / np.linalg.norm(along))
    way = across @ (path[1] - path[0]).mean(axis=0)
    lateral = result.reaction[1] - result.normal_force[1, :, None] * normals
    assert abs(way) > 0.01
    assert lateral == pytest.approx(np.array([-K * way * across] * 2), rel=1e-9)


def test_results_hold_its_components_along_both_directions_of_the_node() -> None:
    """u1 of the nodes is at 30 degrees to the element, along Y: 300 N along -Z are -150 N and -259.8 N there."""
    path = drawn([(0.0, 0.0), (0.0, 0.1)])
    lone = springs().evaluate(path)
    assert lone.friction is not None
    assert lone.friction[1] == pytest.approx(np.array([[0.0, -300.0]] * 2), abs=1e-9)
    turned = springs(friction(2, (0.5, 0.5), 1e5, angle=30.0)).evaluate(path)
    rubbing = ContactModel(chain([LINEAR], friction(2, (0.5, 0.5), 1e5, angle=30.0))).evaluate(path)
    assert turned.friction is not None
    assert rubbing.friction is not None
    added = turned.friction[1] - rubbing.friction[1]
    assert added == pytest.approx(np.array([[-150.0, -300.0 * np.cos(np.pi / 6)]] * 2), rel=1e-12)
    assert turned.reaction[1] - rubbing.reaction[1] == pytest.approx(np.array([[0.0, 0.0, -300.0]] * 2), abs=1e-9)
