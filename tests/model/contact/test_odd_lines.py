"""Lines that meet, stop, turn back or leave the seabed, and nodes without elements."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.directions import directions_of
from mudline.model.contact.seabed import PlanesSeabed
from tests.helpers.builders.contact import LINEAR, at_depths, chain, drawn, friction, on, trench, walk


def along_z(nodes: int, depth: float = 0.02) -> FloatArray:
    """A line along Z, far from the origin in Y."""
    points = at_depths(np.full(nodes, depth))
    points[:, 1] = 50.0
    points[:, 2] = 2.0 * np.arange(nodes)
    return points


def drifted(points: FloatArray, y: float, z: float) -> FloatArray:
    """The line moved along the seabed."""
    moved: FloatArray = points + np.array([0.0, y, z])
    return moved


def axes(contact: ContactModel, points: FloatArray) -> FloatArray:
    """Directions u1 of the nodes."""
    result, _ = contact.step(points, None, contact.initial_state())
    return directions_of(contact._tables, points, result.normal).axes[0]


@pytest.mark.parametrize("elements", [[[0, 1], [2, 1]], [[1, 0], [1, 2]], [[1, 0], [2, 1]], [[2, 1], [0, 1]]])
def test_a_line_goes_through_its_nodes_whichever_way_its_elements_are_written(elements: list[list[int]]) -> None:
    straight = chain([LINEAR] * 2, friction(3), on("lateral", 2, stiffness=100.0))
    contact = ContactModel(replace(straight, element_nodes=np.array(elements, np.intp)))
    first = axes(contact, along_z(3))
    assert np.abs(first) == pytest.approx(np.array([[0.0, 0.0, 1.0]] * 3), abs=1e-15)
    path = [along_z(3), drifted(along_z(3), 0.004, 0.002), drifted(along_z(3), 0.03, -0.01)]
    for one, other in zip(walk(contact, path), walk(ContactModel(straight), path), strict=True):
        assert one.reaction == pytest.approx(other.reaction, rel=1e-12, abs=1e-9)


def bounded(elements: int) -> ContactInput:
    """A chain with friction whose seabed ends at Z = 4.5."""
    seabed = PlanesSeabed([[0.0, 0.0, 0.0]], [0.0], [0.0], [[-100.0, 100.0, -100.0, 4.5]])
    return chain([LINEAR] * elements, friction(elements + 1), seabed=seabed)


def test_a_line_that_slides_off_the_seabed_forgets_and_comes_back_without_a_force() -> None:
    contact = ContactModel(bounded(1))
    points = along_z(2)
    path = [drifted(points, 0.0, shift) for shift in (0.0, 0.003, 3.0, 1.0, 1.002)]
    axial = [result.friction[:, 0].tolist() for result in walk(contact, path) if result.friction is not None]
    assert axial[1] == pytest.approx([-300.0, -300.0])
    assert axial[2] == axial[3] == [0.0, 0.0]
    assert axial[4] == pytest.approx([-200.0, -200.0])


def test_a_trench_holds_a_node_beside_an_absent_one() -> None:
    """The lost element is written first, so that the node would look there for its trench."""
    inputs = chain([LINEAR] * 2, friction(3), trench([1], 0.02, 0.42, 500.0, {}))
    inputs = replace(inputs, element_nodes=np.array([[1, 2], [0, 1]], np.intp))
    path = drawn([(0.0, 0.0), (0.0, 0.11)], nodes=3)
    result = ContactModel(inputs).evaluate(path, present=np.array([True, True, False]))
    assert result.friction is not None
    # mu N + PEAK at the middle of the wall; N is half of one element of 2 m at 1000 N/m
    assert result.friction[1, :2, 1] == pytest.approx([-1300.0, -1300.0])


def test_elements_of_no_extent_have_a_force_and_finite_tangents() -> None:
    everywhere = friction(3), on("lateral", 2, stiffness=300.0), trench(2, 0.02, 0.4, 50.0)
    contact = ContactModel(chain([LINEAR] * 2, *everywhere))
    points = at_depths([0.02] * 3)
    _, state = contact.step(points, None, contact.initial_state())
    result, _ = contact.step(drifted(points, 0.0, 0.01), None, state)
    tangent = contact.tangent(drifted(points, 0.0, 0.01), None, state)
    assert result.normal_force == pytest.approx([1000.0, 2000.0, 1000.0])
    assert np.isfinite(tangent.by_position.values).all()
    assert np.isfinite(result.reaction).all()


def test_a_vertical_line_takes_its_directions_from_y() -> None:
    contact = ContactModel(chain([LINEAR] * 2, friction(3), on("lateral", 2, stiffness=300.0)))
    points = np.zeros((3, 3))
    points[:, 0] = [-2.0, -1.0, 1.0]
    assert axes(contact, points).tolist() == [[0.0, 1.0, 0.0]] * 3
    results = walk(contact, [points, drifted(points, 0.0, 0.001)])
    # each element gives half of L k elongation to its nodes, as friction gives Kt times it where it sticks
    lateral = 0.5 * 2.0 * 300.0 * 0.001
    assert results[1].contact.tolist() == [True, False]
    assert results[1].reaction[:, 2] == pytest.approx([-100.0 - lateral, -100.0 - lateral, 0.0])
    _, state = contact.step(points, None, contact.initial_state())
    assert np.isfinite(contact.tangent(points, None, state).by_position.values).all()


def test_a_node_of_three_elements_rubs_once_under_all_their_weight() -> None:
    star = chain([LINEAR] * 3, friction(4, (0.5, 0.5), 1e5, ellipse=True))
    star = replace(star, element_nodes=np.array([[0, 1], [0, 2], [0, 3]], np.intp))
    points = at_depths([0.02] * 4)
    points[1:, 1:] = [[2.0, 0.0], [-1.0, np.sqrt(3.0)], [-1.0, -np.sqrt(3.0)]]
    results = walk(ContactModel(star), [points, drifted(points, 1.0, 0.0)])
    assert results[1].normal_force == pytest.approx([3000.0, 1000.0, 1000.0, 1000.0])
    sideways = results[1].reaction[:, 1:]
    assert sideways == pytest.approx(np.array([[-1500.0, 0.0]] + [[-500.0, 0.0]] * 3), abs=1e-6)


def test_a_node_without_elements_has_only_its_own_spring() -> None:
    contact = ContactModel(chain([], on("nodal", 1, stiffness=1e4), friction(1, (0.5, 0.5), 1e3)))
    results = walk(contact, [[[-0.1, 0.0, 0.0]], [[-0.1, 0.3, 0.0]], [[0.1, 0.3, 0.0]]])
    assert [result.reaction[0].tolist() for result in results] == [
        pytest.approx([1000.0, 0.0, 0.0]),
        pytest.approx([1000.0, -300.0, 0.0]),
        [0.0, 0.0, 0.0],
    ]
