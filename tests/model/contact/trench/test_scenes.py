"""Trenches through the whole evaluator: what they add to the lateral limit of friction at the nodes of their elements.

In most scenes an element of 2 m presses with 1000 N on each of its nodes, and K2 is so stiff that they slip.
"""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.trench import diagram, rounded
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import ALONG_Y, LINEAR, chain, drawn, each_backend, friction, on, trench

MU = 0.4
WIDTHS = {"bottom": 0.5, "upper": 1.7, **ALONG_Y}
"""Walls from 0.25 to 0.85, their middle at 0.55."""


def lateral(inputs: ContactInput, offset: float, depth: float = 0.02) -> FloatArray:
    """The resistance of each node against being drawn out to an offset, towards +Z."""
    nodes = len(inputs.node_ids)
    result = ContactModel(inputs).evaluate(drawn([(0.0, 0.0), (0.0, offset)], depth, nodes))
    return -result.reaction[1, :, 2]


@pytest.mark.parametrize(
    ("offset", "on_the_wall"), [(0.1, False), (0.24, False), (0.26, True), (0.55, True), (0.84, True), (0.86, False)]
)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_wall_holds_more_the_harder_the_node_presses(offset: float, on_the_wall: bool, side: float) -> None:
    """tan theta = 0.3 / 0.6 = 0.5; on the wall the lateral limit is 1.125 N, elsewhere 0.4 N."""
    contact = ContactModel(chain([LINEAR], friction(2, (0.5, MU), 1e6), on("trench wall", 1, depth=0.3, **WIDTHS)))
    places = [(0.0, side * place) for place in (0.0, offset - 0.05, offset, offset - 0.02)]
    for depth, pressing in ((0.02, 1000.0), (0.05, 2500.0)):
        result = contact.evaluate(drawn(places, depth))
        limit = (1.125 if on_the_wall else 0.4) * pressing
        assert result.reaction[2, :, 2] == pytest.approx([-side * limit] * 2, rel=1e-12)
        assert result.reaction[3, :, 2] == pytest.approx([side * 0.4 * pressing] * 2, rel=1e-12)
        assert result.reaction[..., 0] == pytest.approx(np.full((4, 2), pressing))


TABLE = np.array([[0.1, 100.0], [0.3, 500.0], [0.5, 200.0]])


RESIDUAL = diagram(0.25, 0.85, 600.0, (150.0, 1.05))
"""Rises from 0.25 to its peak at 0.55, falls to 150 at 1.05."""


@each_backend
@pytest.mark.parametrize(
    ("points", "width", "offset", "resistance"),
    [
        (RESIDUAL, 0.0, 0.55, 600.0),
        (RESIDUAL, 0.0, 0.80, 375.0),
        (RESIDUAL, 0.0, 5.0, 150.0),
        (RESIDUAL, 0.1, 0.25, 50.0),  # slope 2000 over 4 times the half width 0.1
        (RESIDUAL, 0.1, 0.20, 12.5),
        (RESIDUAL, 0.1, 0.55, 600.0 - 2900.0 * 0.025),
        (RESIDUAL, 0.1, 0.80, 375.0),
        (RESIDUAL, 0.1, 1.15, 150.0),
        (diagram(0.25, 0.85, 600.0, None), 0.1, 0.85, 50.0),
        (diagram(0.25, 0.85, 600.0, None), 0.1, 0.96, 0.0),
        (TABLE, 0.0, 0.4, 350.0),
    ],
)
def test_a_residual_and_rounded_corners(
    points: FloatArray, width: float, offset: float, resistance: float, backend: Backend
) -> None:
    ditch = on("trench table", 1, table=0, **WIDTHS)
    inputs = chain([LINEAR], friction(2, (0.5, MU), 1e5), ditch, tables=(rounded(points, width),))
    result = ContactModel(inputs, backend=backend).evaluate(drawn([(0.0, 0.0), (0.0, offset)]))
    assert result.reaction[1, :, 2] == pytest.approx([-(400.0 + resistance)] * 2, rel=1e-12)


@each_backend
def test_a_lowered_seabed(backend: Backend) -> None:
    """0.3 m at the bottom, half of it at mid-wall, nothing outside; the line was laid along its own middle."""
    laws = friction(2, (0.5, MU), 1e5), on("trench level", 1, depth=0.3, bottom=0.5, upper=1.7)
    contact = ContactModel(chain([LINEAR], *laws), backend=backend)
    result = contact.evaluate(drawn([(0.0, y) for y in (0.0, 0.25, -0.55, 0.85, 2.0)], 0.32))
    assert result.depth[:, 0] == pytest.approx([0.02, 0.02, 0.17, 0.32, 0.32], rel=1e-12)
    assert (result.normal == [1.0, 0.0, 0.0]).all()
    half = ContactModel(chain([LINEAR] * 2, friction(3), on("trench level", [0], depth=0.3, bottom=0.5, upper=1.7)))
    assert half.evaluate(drawn([(0.0, 0.0)], 0.3, 3)).gap[0] == pytest.approx([0.0, -0.15, -0.3], abs=1e-15)


def test_tangent_on_a_lowered_wall() -> None:
    """The height changes as the pipe moves sideways: the normal stays, so the tangent is not symmetric."""
    law = on("trench level", 1, depth=0.3, bottom=0.5, upper=1.7)
    contact = ContactModel(chain([LINEAR], law, friction(2, (0.5, MU), 1e5)))
    places = drawn([(0.0, 0.0), (0.0, 0.5)], 0.32)
    _, state = contact.step(places[0], None, contact.initial_state())
    matrix = contact.tangent(places[1], None, state).by_position.dense()
    for column, at in enumerate(np.ndindex(places[1].shape)):
        moved = [places[1].copy(), places[1].copy()]
        moved[0][at] += 1e-7
        moved[1][at] -= 1e-7
        found = [contact.step(each, None, state)[0].reaction for each in moved]
        np.testing.assert_allclose(matrix[:, column], (found[0] - found[1]).ravel() / 2e-7, rtol=1e-5, atol=0.1)
    assert matrix[0, 2] == pytest.approx(12500.0 * 2.0 * 0.5)


BLOCKS: dict[str, tuple[tuple[LawAssignment, ...], list[float]]] = {
    "peaks of one shape": (
        (trench([0], 0.5, 1.7, 300.0), trench([1], 0.5, 1.7, 500.0)),
        [300.0, 300.0 + 3.0 * 500.0, 3.0 * 500.0],
    ),
    "peaks of two shapes": (
        (trench([0], 0.5, 1.7, 300.0), trench([1], 0.85, 1.25, 500.0)),
        [300.0, 300.0 + 3.0 * 375.0, 3.0 * 375.0],
    ),
    "a peak, and no trench": ((trench([0], 0.5, 1.7, 300.0),), [300.0, 300.0, 0.0]),
    "no trench, and a peak": ((trench([1], 0.5, 1.7, 500.0),), [0.0, 1500.0, 1500.0]),
    "a peak and a table": (
        (trench([0], 0.5, 1.7, 300.0), on("trench table", [1], table=0, **WIDTHS)),
        [300.0, 300.0 + 3.0 * 125.0, 3.0 * 125.0],
    ),
    "two tables": ((on("trench table", 2, table=[0, 1], **WIDTHS),), [125.0, 125.0 + 3.0 * 50.0, 3.0 * 50.0]),
    "a wall, and no trench": ((on("trench wall", [0], depth=0.3, **WIDTHS),), [725.0, 0.25 * 0.725 * 4000.0, 0.0]),
    "two walls": (
        (on("trench wall", 2, depth=[0.3, 0.6], **WIDTHS),),
        [725.0, (0.25 * 0.725 + 0.75 * (1.4 / 0.6 - 0.4)) * 4000.0, (1.4 / 0.6 - 0.4) * 3000.0],
    ),
    "a peak and a wall": (
        (trench([0], 0.5, 1.7, 300.0), on("trench wall", [1], depth=0.3, **WIDTHS)),
        [300.0, 300.0 + 0.75 * 0.725 * 4000.0, 0.725 * 3000.0],
    ),
}
"""Two blocks of trenches on elements of 2 m and 6 m, and what they add at the three nodes 0.55 off the centreline."""


@pytest.mark.parametrize("name", BLOCKS)
def test_between_two_blocks_each_counts_with_half_of_its_own_element(name: str) -> None:
    laws, added = BLOCKS[name]
    tables = (np.array([[0.0, 125.0], [1.0, 125.0]]), np.array([[0.5, 60.0], [0.6, 40.0]]))
    inputs = chain([LINEAR] * 2, friction(3, (0.5, MU), 1e6), *laws, length=[2.0, 6.0], tables=tables)
    pressing = np.array([1000.0, 4000.0, 3000.0])
    assert lateral(inputs, 0.55) == pytest.approx(MU * pressing + added, rel=1e-12)


def test_a_straight_centreline_may_run_at_any_angle() -> None:
    """Through (0, 0) and (-3, -4): its offset counts along u2 of the node, which stands across the line."""
    slanted = {"start_y": 0.0, "start_z": 0.0, "end_y": -3.0, "end_z": -4.0}
    inputs = chain([LINEAR], friction(2, (0.5, MU), 1e6), trench(1, 0.1, 0.5, 600.0, slanted))
    path = np.zeros((2, 2, 3))
    path[..., 0] = -0.02
    path[:, 1, 1:] = 1.2, 1.6
    path[1, :, 1:] += 0.15 * np.array([-0.8, 0.6])
    result = ContactModel(inputs).evaluate(path)
    assert result.friction is not None
    assert result.friction[1] == pytest.approx(np.array([[0.0, -1000.0]] * 2), abs=1e-9)


def test_a_trench_along_the_line_as_laid_follows_its_bends() -> None:
    """The line is laid along Y and then Z; each end is drawn across its own piece by 0.55."""
    inputs = chain([LINEAR] * 2, friction([0, 2], (0.5, MU), 1e6), trench(2, 0.5, 1.7, 600.0, {}))
    path = np.zeros((2, 3, 3))
    path[..., 0] = -0.02
    path[:, 1:, 1], path[:, 2, 2] = 2.0, 2.0
    path[1] += np.array([[0.0, 0.0, -0.55], [0.0, 0.0, 0.0], [0.0, 0.55, 0.0]])
    result = ContactModel(inputs).evaluate(path)
    assert result.friction is not None
    # u2 of the ends has turned a little with their elements, and the offset along it is a little less
    limits = np.abs(result.friction[1, [0, 2], 1])
    offset = 0.55 * np.cos(np.arctan2(0.55, 2.0))
    assert limits == pytest.approx([400.0 + 600.0 * (offset - 0.25) / 0.3] * 2, rel=1e-12)


def test_in_an_ellipse_the_wall_raises_the_limit_across_the_line_only() -> None:
    inputs = chain([LINEAR], friction(2, (0.5, MU), 1e6, ellipse=True), on("trench wall", 1, depth=0.3, **WIDTHS))
    result = ContactModel(inputs).evaluate(drawn([(0.0, 0.0), (0.3, 0.6)]))
    force = -result.reaction[1, 0, 1:]
    assert np.hypot(force[0] / 500.0, force[1] / 1125.0) == pytest.approx(1.0, rel=1e-12)
    assert force[1] / force[0] == pytest.approx(2.0)


@pytest.mark.parametrize(("depth", "mu"), [(0.6, 1.0), (0.3, 2.0), (1.5, 0.4)])
def test_a_wall_that_locks_itself_is_refused_and_the_node_named(depth: float, mu: float) -> None:
    """mu tan theta is 1 or more."""
    inputs = chain([LINEAR] * 2, friction(3, (0.5, mu), 1e5), on("trench wall", [1], depth=depth, **WIDTHS))
    with pytest.raises(ValueError, match="node 102 lies in a trench whose wall locks itself"):
        ContactModel(inputs)
