"""Decks with a model of a trench, a table of its resistance, or a floor of cyclic loading, evaluated by hand."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from mudline.model.contact import ContactResult
from tests.helpers.builders.decks import FOOT, IMPERIAL, METRIC, POUND, Units, line_deck
from tests.helpers.builders.scenes import messages, scene_of

PRESSED = 0.05 * 50000.0 * 10.0
"""Normal force in N of a node between two elements of 10 m."""

BOTH = pytest.mark.parametrize(("units", "length", "force"), [(METRIC, 1.0, 1.0), (IMPERIAL, FOOT, POUND)])


def bed(units: Units, trench: str, mu2: float = 0.5) -> str:
    u = units.value
    return f"""\
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS={u(50000.0, -2, 1)}
*SEABED FRICTION
 SET=ALL
 COEFFICIENTS=0.3, {mu2}
 STIFFNESS={u(90000.0, -1, 1)}
*SEABED TRENCH
 SET=ALL
{trench}"""


def moved(units: Units, seabed: str, sideways: list[float]) -> ContactResult:
    """The line laid straight, then moved by so many m across itself, step by step."""
    scene = scene_of(line_deck(units, seabed), f"deck.{units.suffix}")
    shift = np.array([0.0, *sideways])[:, None, None] * np.array([0.0, 0.0, 1.0]) / units.length
    return scene.contact().evaluate(scene.coordinates + shift)


def lateral(units: Units, trench: str, sideways: list[float]) -> list[float]:
    """The size of the lateral force in the middle of the line, in the deck's units."""
    friction = moved(units, bed(units, trench), sideways).friction
    assert friction is not None
    found: list[float] = np.abs(friction[1:, 5, 1]).tolist()
    return found


@BOTH
def test_a_residual_a_lowered_level_and_rounded_corners(units: Units, length: float, force: float) -> None:
    u = units.value
    more = f" RESIDUAL={u(500.0, -1, 1)}, {u(3.0, 1)}\n SMOOTHING={u(0.2, 1)}\n"
    trench = f" GEOMETRY={u(0.02, 1)}, {u(1.0, 1)}, {u(3.0, 1)}\n PEAK={u(2000.0, -1, 1)}\n"
    found = lateral(units, trench + more, [0.5, 1.0, 2.0, 4.0])
    # corners: slope 4000 over four half widths; from 4000 to -750
    added = [4000.0 * 0.05, 2000.0 - 4750.0 * 0.05, 1250.0, 500.0]
    np.testing.assert_allclose(found, [(0.5 * PRESSED + 10.0 * each) / force for each in added], rtol=1e-9)
    low = moved(units, bed(units, trench + " LEVEL=LOWERED\n" + more), [1.0, 4.0])
    np.testing.assert_allclose(low.depth[:, 5], np.array([0.03, 0.04, 0.05]) / length, rtol=1e-9)


BED = bed(METRIC, " GEOMETRY=0.5, 1.0, 3.0\n")


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (" PEAK=2000.0\n RESIDUAL=500.0, 1.0\n", "no later than the peak, at 1"),
        (" PEAK=2000.0\n SMOOTHING=0.3\n", "half of the shortest side of the resistance, 0.5"),
        (" PEAK=2000.0\n SMOOTHING=0.25\n RESIDUAL=500.0, 1.2\n", "resistance, 0.2"),
        (" PEAK=TABLE\n 0.4, 300.0\n 1.0, 50.0\n SMOOTHING=0.1\n", "resistance, 0"),
        (" PEAK=TABLE\n 0.4, 300.0\n 1.0, 0.0\n RESIDUAL=500.0, 1.2\n", "a table has a residual"),
        (" MODEL=WALL\n LEVEL=LOWERED\n", "LEVEL= does not go with"),
        (" MODEL=WALL\n RESIDUAL=500.0, 1.2\n", "RESIDUAL= does not go with"),
        (" MODEL=WALL\n SMOOTHING=0.1\n", "SMOOTHING= does not go with"),
        (" PEAK=2000.0\n SMOOTHING=0.25\n RESIDUAL=500.0, 1.5\n LEVEL=LOWERED\n", ""),
        (" PEAK=TABLE\n 0.4, 300.0\n 1.0, 0.0\n SMOOTHING=0.3\n", ""),
        (" MODEL=WALL\n LEVEL=UNCHANGED\n", ""),
    ],
)
def test_what_a_trench_may_not_say(lines: str, message: str) -> None:
    found = messages(line_deck(METRIC, BED + lines))
    assert [message in text for text in found] == [True] * bool(message)


@BOTH
def test_a_table_raises_the_limit_by_the_resistance_at_the_offset(units: Units, length: float, force: float) -> None:
    u = units.value
    rows = [(0.4, 300.0), (1.0, 2000.0), (2.0, 500.0)]
    table = "".join(f" {u(offset, 1)}, {u(resistance, -1, 1)}\n" for offset, resistance in rows)
    trench = f" GEOMETRY={u(0.5, 1)}, {u(1.0, 1)}, {u(4.0, 1)}\n PEAK=TABLE\n{table}"
    found = lateral(units, trench, [0.3, 0.7, 1.0, 1.5, 2.5])
    added = [300.0, 300.0 + 0.5 * 1700.0, 2000.0, 1250.0, 0.0]
    expected = [(0.5 * PRESSED + 10.0 * each) / force for each in added]
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    assert length == units.length


@BOTH
def test_a_sloped_wall_turns_the_normal_force(units: Units, length: float, force: float) -> None:
    u = units.value
    trench = f" GEOMETRY={u(0.5, 1)}, {u(1.0, 1)}, {u(3.0, 1)}\n MODEL=WALL\n"
    found = lateral(units, trench, [0.4, 1.0, 2.0])
    wall = (0.5 + 0.5) / (1.0 - 0.5 * 0.5)  # tan(theta) = 0.5 / ((3 - 1) / 2)
    expected = [0.5 * PRESSED / force, wall * PRESSED / force, 0.5 * PRESSED / force]
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    assert length == units.length


def test_a_number_and_the_model_peak_are_the_default() -> None:
    trench = " GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000.0\n"
    plain = lateral(METRIC, trench, [0.6, 1.0, 1.3])
    assert plain == lateral(METRIC, trench + " MODEL=PEAK\n", [0.6, 1.0, 1.3])
    expected = [0.5 * PRESSED + 20000.0 * share for share in (0.2, 1.0, 0.4)]
    np.testing.assert_allclose(plain, expected, rtol=1e-9)


def test_blocks_with_tables_of_their_own_and_one_without() -> None:
    trench = (
        " GEOMETRY=0.5, 1, 3\n PEAK=TABLE\n 0, 900\n 9, 900\n"
        " SET=Left\n GEOMETRY=0.5, 1, 3\n MODEL=WALL\n PEAK=TABLE\n 0, 7\n 9, 7\n"
        " SET=Right\n GEOMETRY=0.5, 1, 3\n PEAK=TABLE\n 0, 100\n 9, 100\n"
    )
    friction = moved(METRIC, bed(METRIC, trench), [1.0]).friction
    assert friction is not None
    limit = np.abs(friction[1, [2, 8], 1])
    np.testing.assert_allclose(limit, [PRESSED * 1.0 / 0.75, 0.5 * PRESSED + 1000.0], rtol=1e-9)


def cycles(units: Units, cyclic: str, count: int) -> NDArray[np.float64]:
    """The pull of each of some uplifts in a row, to the middle of the plateau and back, in the deck's units."""
    u = units.value
    seabed = (
        f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={u(50000.0, -2, 1)}\n*SEABED SUCTION\n SET=ALL\n"
        f" FORCE={u(900.0, -1, 1)}, 0.0\n DEPTH={u(0.2, 1)}, 0.0\n CYCLIC={cyclic}\n"
    )
    scene = scene_of(line_deck(units, seabed), f"deck.{units.suffix}")
    heights = np.array([-0.05, 0.1] * count) / units.length
    series = np.repeat(scene.coordinates[None], len(heights), axis=0)
    series[:, :, 0] = heights[:, None]
    result = scene.contact().evaluate(series, times=np.arange(len(heights), dtype=np.float64))
    return result.force[1::2, 4]


@BOTH
def test_a_factor_with_a_floor_is_applied_once_for_each_cycle(units: Units, length: float, force: float) -> None:
    pull = -900.0 / force * length
    np.testing.assert_allclose(cycles(units, "0.5, 0.3", 4), [pull, 0.5 * pull, 0.3 * pull, 0.3 * pull], rtol=1e-9)
    np.testing.assert_allclose(cycles(units, "0.5, 0.0", 4), [pull, 0.5 * pull, 0.25 * pull, 0.125 * pull], rtol=1e-9)
    np.testing.assert_allclose(cycles(units, "0.5", 4), [0.5 * pull] * 4, rtol=1e-9)
