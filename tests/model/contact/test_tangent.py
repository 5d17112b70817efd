"""The assembled tangent against central differences, with everything on."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.result import ContactResult
from mudline.model.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed
from mudline.model.contact.tables import ContactState
from tests.helpers.builders.contact import everything, line

SEABEDS: dict[str, Seabed] = {
    "flat": FlatSeabed(),
    "sloping": SlopingSeabed(12.0, 30.0),
    "planes": PlanesSeabed(
        np.array([[0.0, 0.0, 0.0], [0.0, 9.0, 0.0]]),
        np.array([-4.0, 5.0]),
        np.array([0.0, 20.0]),
        np.full((2, 4), np.array([-np.inf, np.inf, -np.inf, np.inf])),
    ),
}
ELEMENTS = 8


def on_seabed(seabed: Seabed, points: FloatArray) -> FloatArray:
    """The line moved so that it lies on the seabed as it lay on X = 0."""
    moved = points.copy()
    moved[:, 0] += seabed.elevation(points[:, 1], points[:, 2])
    return moved


def after(contact: ContactModel, seabed: Seabed, seed: int) -> tuple[ContactState, FloatArray, FloatArray]:
    """A state with some history, and positions and velocities for a further step."""
    rng = np.random.default_rng(seed)
    points = on_seabed(seabed, line(ELEMENTS, seed))
    state = contact.initial_state()
    for _ in range(4):
        moving = rng.normal(scale=0.1, size=points.shape)
        _, state = contact.step(points, moving, state)
        points = points + rng.normal(scale=(0.03, 0.02, 0.03), size=points.shape)
    return state, points, rng.normal(scale=0.2, size=points.shape)


def states_of(result: ContactResult) -> bytes:
    parts = (result.contact, result.state, result.friction_state)
    return b"".join(np.asarray(part).tobytes() for part in parts)


def difference(
    contact: ContactModel, points: FloatArray, moving: FloatArray, state: ContactState, which: int
) -> tuple[FloatArray, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """Central differences of the reactions by positions (0) or velocities (1), and the columns without a kink."""
    given = [points, moving]
    columns, smooth = [], []
    for place in np.ndindex(points.shape):
        results = []
        for size in (1e-6, -1e-6, 5e-7, -5e-7):
            changed = [array.copy() for array in given]
            changed[which][place] += size
            results.append(contact.step(changed[0], changed[1], state)[0])
        wide = (results[0].reaction - results[1].reaction) / 2e-6
        narrow = (results[2].reaction - results[3].reaction) / 1e-6
        same = len({states_of(result) for result in results}) == 1
        smooth.append(same and bool(np.abs(wide - narrow).max() < 1e-5 * (np.abs(wide).max() + 1.0)))
        columns.append(((4.0 * narrow - wide) / 3.0).reshape(-1))
    return np.column_stack(columns), np.array(smooth)


@pytest.mark.untraced
@pytest.mark.parametrize("name", SEABEDS)
@pytest.mark.parametrize("seed", [3, 4, 5])  # in these every law holds somewhere
def test_tangent_against_central_differences(name: str, seed: int) -> None:
    seabed = SEABEDS[name]
    contact = ContactModel(everything(ELEMENTS, seed, seabed))
    state, points, moving = after(contact, seabed, seed)
    result, _ = contact.step(points, moving, state)
    tangent = contact.tangent(points, moving, state)
    for which, matrix in enumerate((tangent.by_position.dense(), tangent.by_velocity.dense())):
        expected, smooth = difference(contact, points, moving, state, which)
        assert smooth.mean() > 0.5
        scale = np.abs(expected[:, smooth]).max()
        np.testing.assert_allclose(matrix[:, smooth], expected[:, smooth], atol=1e-7 * max(scale, 1.0), rtol=0)
    assert result.friction is not None
