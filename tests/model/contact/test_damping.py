"""Damping of inward motion: in contact only, never pulling, per unit length or of nodes."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mudline.model.contact import ContactModel
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import LINEAR, chain, each_backend, friction, heave, on
from tests.helpers.builders.scenes import legal_scene

DEPTHS, PULL_OUT = [0.02, 0.02, 0.02, -0.01, 0.0], [-0.1, 0.1, 0.0, -0.1, -0.1]
ADDED = [50.0, 0.0, 0.0, 0.0, 0.0]
"""c = 500 per unit length at these depths and pull-out velocities."""


@each_backend
def test_per_unit_length(backend: Backend) -> None:
    contact = ContactModel(chain([LINEAR], on("damping", 1, damping=500.0)), backend=backend)
    positions, velocities = heave(DEPTHS, PULL_OUT)
    result = contact.evaluate(positions, velocities=velocities)
    elastic = np.maximum(5e4 * np.array(DEPTHS), 0.0)
    assert_allclose(result.force[:, 0], elastic + ADDED, rtol=1e-12)
    assert_allclose(result.normal_force, np.repeat((elastic + ADDED)[:, None], 2, axis=1), rtol=1e-12)
    assert_allclose(result.stiffness[:, 0], np.where(np.array(DEPTHS) > 0.0, 5e4, 0.0), rtol=1e-12)


def test_steps_without_velocities_take_differences() -> None:
    contact = ContactModel(chain([LINEAR], on("damping", 1, damping=500.0)))
    positions, _ = heave([0.01, 0.02], [0.0, 0.0])
    _, state = contact.step(positions[0], None, contact.initial_state())
    with pytest.raises(ValueError, match="dt"):
        contact.step(positions[1], None, state)
    result, _ = contact.step(positions[1], None, state, 0.1)
    assert result.force == pytest.approx([1000.0 + 500.0 * 0.1])
    with pytest.raises(ValueError, match="needs velocities"):
        contact.evaluate(positions)


def test_tangent_by_velocity() -> None:
    laws = on("damping", 1, damping=500.0), on("nodal damping", 2, damping=100.0), friction(2)
    contact = ContactModel(chain([LINEAR], *laws))
    positions, velocities = heave([0.02, 0.02], [-0.1, -0.2])
    _, state = contact.step(positions[0], velocities[0], contact.initial_state())
    points = positions[1] + [[0.0, 0.05, 0.0]]
    matrix = contact.tangent(points, velocities[1], state).by_velocity.dense()
    for column, at in enumerate(np.ndindex(points.shape)):
        moved = [velocities[1].copy(), velocities[1].copy()]
        moved[0][at] += 1e-4
        moved[1][at] -= 1e-4
        found = [contact.step(points, each, state)[0].reaction for each in moved]
        assert_allclose(matrix[:, column], (found[0] - found[1]).ravel() / 2e-4, rtol=1e-7, atol=1e-6)


DECK = """\
$MODEL
*NODE
 1, -0.05, 0.0
 5, -0.05, 40.0
 GEN=1, 5
*ELEMENT
 1, 1, 2
 GEN=1, 4
*GEOMETRIC SETS
 OPTION=MOORING
 SET=ALL
 480.0E6, 200.0, 0.3
*OCEAN
 100.0, 1025.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50000.0
*SEABED CONTACT
 SET=ALL
"""


@pytest.mark.parametrize(
    ("lines", "laws", "damping"),
    [
        (" DAMPING=300.0\n", {"linear", "damping"}, [300.0] * 4),
        (" DAMPING=300.0\n FORM=CENTRED\n", {"smoothed", "damping"}, [300.0] * 4),
        (" DAMPING=300.0\n SMOOTHING=0.005\n", {"smoothed", "damping"}, [300.0] * 4),
        (
            " NODAL STIFFNESS=50000.0\n DAMPING=300.0\n",
            {"nodal", "nodal damping"},
            [1500.0, 1500.0, 3000.0, 3000.0, 3000.0],
        ),
        ("", {"smoothed"}, None),
    ],
)
def test_in_a_deck(lines: str, laws: set[str], damping: list[float] | None) -> None:
    scene = legal_scene(DECK + lines)
    given = scene.contact_input("keep")
    assert set(given.assigned) == laws
    for name in laws & {"damping", "nodal damping"}:
        assert given.assigned[name]["damping"] == pytest.approx(damping)
