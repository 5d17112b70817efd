"""What the seabed gives elements besides their normal law: both families, blocks taken whole."""

from __future__ import annotations

import numpy as np
import pytest

from tests.builders.decks import PIPE, STEEL
from tests.builders.scenes import reported, scene_of

SETS = "*ELEMENT SETS\n SET=A\n GEN=1, 4\n SET=B\n GEN=3, 6\n"
NOTHING = float("nan")


def same(found: object, expected: object) -> bool:
    return np.array_equal(np.asarray(found, dtype=float), np.asarray(expected, dtype=float), equal_nan=True)


def test_the_legacy_surface_gives_to_every_element() -> None:
    resistance = scene_of(PIPE + "*ELASTIC SURFACE\n 1e4, 0.3, 0.5, 20, 30, 0.1, 3, 4, 5, 0.6, 0.7\n").resistance
    for name, value in {
        "friction": (0.3, 0.5),
        "mobilisation": (0.6, 0.7),
        "characteristic": (3, 4),
        "constant": 5,
        "lateral": 20,
        "suction": 30,
        "extent": 0.1,
    }.items():
        assert same(resistance.column(name), [value] * 10)


def test_the_rigid_surface_has_another_order_of_fields() -> None:
    resistance = scene_of(PIPE + "*RIGID SURFACE\n 0.3, 0.5, 3, 4, 5, 0.6, 0.7\n").resistance
    assert same(resistance.column("characteristic"), [(3, 4)] * 10)
    assert same(resistance.column("mobilisation"), [(0.6, 0.7)] * 10)
    assert same(resistance.column("lateral"), [NOTHING] * 10)


def test_a_later_block_wins_and_is_taken_whole() -> None:
    blocks = " TYPE=ELASTIC\n SET=A\n STIFFNESS=1\n FRICTION=0.1, 0.2\n SUCTION=9, 0.5\n SET=B\n LATERAL=7\n"
    resistance = scene_of(PIPE + SETS + "*SEABED PROPERTIES\n" + blocks).resistance
    assert same(resistance.column("friction")[:, 0], [0.1, 0.1, *[NOTHING] * 8])
    assert same(resistance.column("lateral"), [NOTHING, NOTHING, 7, 7, 7, 7, *[NOTHING] * 4])
    assert same(resistance.column("extent"), [0.5, 0.5, *[NOTHING] * 8])


def test_the_new_family_comes_before_the_surface() -> None:
    deck = PIPE + SETS + "*ELASTIC SURFACE\n 1e4, 0.3\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=A\n FRICTION=0.8\n"
    assert same(scene_of(deck).resistance.column("friction")[:, 0], [0.8] * 4 + [0.3] * 6)


def test_without_a_seabed_there_is_nothing() -> None:
    assert same(scene_of(PIPE).resistance.column("suction"), [NOTHING] * 10)


def test_a_value_that_could_not_be_read_is_none() -> None:
    scene = scene_of(PIPE + "*ELASTIC SURFACE\n 1e4, x, =[nothing]\n")
    assert same(scene.resistance.column("friction"), [(NOTHING, NOTHING)] * 10)


@pytest.mark.parametrize(
    "block",
    [
        "*SEABED CONTACT\n SET={}\n NODAL STIFFNESS=1\n",
        "*SEABED SUCTION\n SET={}\n COHESION=1\n",
        "*SEABED UNLOADING\n SET={}\n STIFFNESS=1\n",
        "*SEABED FRICTION\n SET={}\n COEFFICIENTS=0.1, 0.2\n STIFFNESS=1\n",
        "*SEABED TRENCH\n SET={}\n GEOMETRY=1, 2, 3\n PEAK=1\n",
    ],
)
def test_extension_blocks_by_element(block: str) -> None:
    head = PIPE + STEEL + SETS + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n FRICTION=0.3, 0.5\n"
    text = head + block.format("A") + block.format("b")
    scene = scene_of(text)
    ((keyword, found),) = scene.extensions.items()
    assert block.startswith(f"*{keyword}\n")
    assert found.of_element.tolist() == [0, 0, 1, 1, 1, 1, -1, -1, -1, -1]
    assert [getattr(entry, "set_name", "") for entry in found.entries] == ["A", "b"]
    assert reported(head + block.format("C")) == [("E", "REF001", text.count("\n") - block.count("\n") * 2 + 2, 6)]
