"""The law and the resistance of each element, of both families, and what is wrong with them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.model.contact.input import LawKind
from mudline.model.scene.model import Scene
from tests.helpers.builders.decks import CLAY, PIPE, STEEL
from tests.helpers.builders.scenes import messages, reported, scene_of

BASE = PIPE + STEEL + "*ELEMENT SETS\n SET=a\n GEN=1, 5\n SET=b\n GEN=4, 8\n"
NEW = BASE + CLAY + "*SEABED PROPERTIES\n TYPE=ELASTIC\n"
LINE = NEW.count("\n") + 1


def laws(text: str) -> str:
    """A letter for each element: c(urve), l(inear), r(igid), - (none)."""
    letters = {LawKind.NONE: "-", LawKind.CURVE: "c", LawKind.LINEAR: "l", LawKind.RIGID: "r"}
    return "".join(letters[LawKind(kind)] for kind in scene_of(text).law.tolist())


def stiffnesses(scene: Scene) -> list[float | None]:
    grants = [scene.set_law(index) for index in range(len(scene.element_ids))]
    return [None if grant is None or math.isnan(grant.stiffness) else grant.stiffness for grant in grants]


def embedment(*names: str) -> str:
    return "*EMBEDMENT\n" + "".join(f" SET={name}\n 0, 0\n 1, {index}\n" for index, name in enumerate(names, 1))


def test_elements_whose_law_an_extension_replaced_do_not_follow_their_curve() -> None:
    bed = NEW + " SET=ALL\n STIFFNESS=Clay\n"
    assert scene_of(bed).followers(0).tolist() == list(range(10))
    assert scene_of(bed + "*SEABED CONTACT\n SET=a\n NODAL STIFFNESS=7\n").followers(0).tolist() == [5, 6, 7, 8, 9]


# ------------------------------------------------------------------------------------------------------- new family


def test_the_last_block_that_holds_an_element_wins() -> None:
    scene = scene_of(NEW + " SET=ALL\n STIFFNESS=1\n SET=a\n STIFFNESS=2\n SET=b\n STIFFNESS=3\n")
    assert stiffnesses(scene) == [2, 2, 2, 3, 3, 3, 3, 3, 1, 1]
    assert scene.law_sets == ["a"] * 3 + ["b"] * 5 + ["ALL"] * 2


def test_a_block_is_taken_whole() -> None:
    """What the last block does not give is absent, not inherited."""
    assert laws(NEW + " SET=ALL\n STIFFNESS=1\n SET=a\n FRICTION=0.3\n") == "-----lllll"


def test_a_block_whose_law_cannot_be_known_takes_that_of_the_surface_away() -> None:
    scene = scene_of(BASE + "*ELASTIC SURFACE\n 500\n*SEABED PROPERTIES\n SET=a\n FRICTION=0.3\n")
    assert stiffnesses(scene) == [None] * 5 + [500.0] * 5


def test_a_stiffness_that_reads_as_a_number_is_one() -> None:
    scene = scene_of(NEW + " SET=a\n STIFFNESS=100\n*SEABED STIFFNESS\n CURVE=100\n 0, 0\n 1, 7\n")
    assert stiffnesses(scene)[:5] == [100] * 5
    assert scene.referenced == set()


def test_lines_before_any_set_hold_for_all() -> None:
    assert laws(NEW + " STIFFNESS=1\n SET=a\n STIFFNESS=Clay\n") == "ccccclllll"


@pytest.mark.parametrize("extra", ["", " STIFFNESS=0\n", " LATERAL=0\n"])
def test_a_rigid_bed(extra: str) -> None:
    text = BASE + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=a\n FRICTION=0.3\n" + extra
    assert laws(text) == "rrrrr-----"
    assert reported(text) == []


# ----------------------------------------------------------------------------------------------------------- legacy


def test_an_undefined_set_gives_nothing_to_anything() -> None:
    text = NEW + " SET=ALL\n STIFFNESS=1\n SET=c\n STIFFNESS=Clay\n"
    assert laws(text) == "l" * 10
    assert reported(text) == [("E", "REF001", LINE + 2, 6)]
    assert scene_of(text).laws.uncertain


@pytest.mark.parametrize("order", [1, -1])
def test_curves_of_sets_win_over_the_surface_in_whatever_order(order: int) -> None:
    text = BASE + "".join(["*ELASTIC SURFACE\n 500\n", embedment("a")][::order])
    assert laws(text) == "ccccclllll"


def test_points_before_any_set_hold_for_all() -> None:
    text = BASE + "*ELASTIC SURFACE\n ,\n*EMBEDMENT\n 0, 0\n 1, 1\n"
    assert scene_of(text).law_names == ["curve:ALL"] * 10
    assert scene_of(text).law_sets == ["ALL"] * 10


# ------------------------------------------------------------------------------------------------------------- both


def test_a_new_block_that_gives_a_stiffness_wins_over_the_legacy_family() -> None:
    text = BASE + "*ELASTIC SURFACE\n 500\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n STIFFNESS=1\n"
    assert stiffnesses(scene_of(text)) == [1] * 5 + [500] * 5


def test_a_legacy_curve_wins_over_a_number_of_the_new_family() -> None:
    new = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=30000\n"
    for text in (BASE + embedment("b") + new, BASE + new + embedment("b")):
        assert laws(text) == "lllcccccll"
        assert scene_of(text).law_sets == ["ALL"] * 3 + ["b"] * 5 + ["ALL"] * 2


def test_of_two_curves_of_both_families_that_of_the_new_one_wins() -> None:
    curve = "*SEABED STIFFNESS\n CURVE=clay\n 0, 0\n 1, 5\n"
    text = BASE + embedment("ALL") + curve + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n STIFFNESS=clay\n"
    assert scene_of(text).law_names == ["curve:clay"] * 5 + ["curve:ALL"] * 5


def test_a_new_block_without_stiffness_leaves_the_legacy_law() -> None:
    text = BASE + embedment("b") + "*ELASTIC SURFACE\n 500\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n FRICTION=1\n"
    assert laws(text) == "lllcccccll"


# ----------------------------------------------------------------------------------------------------------- checks


@pytest.mark.parametrize(
    ("lines", "line", "column"),
    [
        ("*RIGID SURFACE\n 0.3\n*ELASTIC SURFACE\n 1\n", 3, 1),
        ("*ELASTIC SURFACE\n 1\n*RIGID SURFACE\n 0.3\n", 3, 1),
        ("*SEABED PROPERTIES\n TYPE=RIGID\n*SEABED PROPERTIES\n TYPE=ELASTIC\n", 4, 7),
        ("*SEABED PROPERTIES\n TYPE=ELASTIC\n*RIGID SURFACE\n 0.3\n", 3, 1),
        ("*RIGID SURFACE\n 0.3\n*RIGID SURFACE\n 0.3\n*SEABED PROPERTIES\n TYPE=ELASTIC\n", 6, 7),
    ],
)
def test_two_types_are_told_at_the_first_line_that_contradicts(lines: str, line: int, column: int) -> None:
    assert reported(BASE + lines) == [("E", "SBD002", BASE.count("\n") + line, column)]


def test_two_types_in_two_model_sections_are_a_warning_because_that_is_inferred() -> None:
    text = "$MODEL\n*RIGID SURFACE\n 0.3\n$LOAD CASE\n*TIME\n$MODEL\n*ELASTIC SURFACE\n 1\n"
    assert reported(text) == [("W", "SBD002", 7, 1)]


def test_an_elastic_surface_without_stiffness_needs_embedment() -> None:
    text = BASE + "*ELASTIC SURFACE\n , 0.3, 0.4\n"
    assert reported(text) == [("E", "SBD004", BASE.count("\n") + 1, 1)]
    assert reported(text + embedment("a")) == []
    assert reported("$LOAD CASE\n*RESTART\n LAST=x\n" + text) == [("W", "SBD004", BASE.count("\n") + 4, 1)]


@pytest.mark.parametrize("row", ["5O000, 0.3", "=[nothing], 0.3", "-1, 0.3"])
def test_a_stiffness_that_could_not_be_read_is_not_missing(row: str) -> None:
    scene = scene_of(BASE + f"*ELASTIC SURFACE\n {row}\n")
    assert "SBD004" not in [problem.code.code for problem in scene.problems]
    grant = scene.set_law(0)
    assert grant is not None
    assert grant.unknown


def test_embedment_whose_lines_could_not_be_read_is_there() -> None:
    assert reported(BASE + "*ELASTIC SURFACE\n , 0.3\n*EMBEDMENT\n SEET=a\n") == []


# -------------------------------------------------------------------------------------------------------- diameters


def test_embedment_without_an_elastic_bed() -> None:
    text = BASE + embedment("a")
    assert reported(text) == [("E", "SBD005", BASE.count("\n") + 2, 2)]
    assert reported(text + "*SEABED PROPERTIES\n SET=a\n") == [("E", "SBD003", text.count("\n") + 1, 1)]
    assert reported(text + "*SEABED PROPERTES\n SET=a\n") == []


def test_missing_diameters_are_told_once_for_each_place_that_gives_a_curve() -> None:
    steel = STEEL.replace("SET=ALL", "SET=a")
    text = PIPE + steel + "*ELEMENT SETS\n SET=a\n GEN=1, 5\n SET=b\n GEN=4, 8\n" + CLAY
    text += "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n SET=b\n STIFFNESS=clay\n"
    assert reported(text) == [("E", "SBD009", LINE + 1, 12), ("E", "SBD009", LINE + 3, 12)]
    assert [message.split(" have ")[0] for message in messages(text)] == [
        "2 elements (first: 9)",
        "3 elements (first: 6)",
    ]


def test_a_stiffness_of_the_nodes_needs_no_diameter_whatever_curve_it_replaces() -> None:
    text = PIPE + "*ELEMENT SETS\n SET=a\n GEN=1, 5\n" + CLAY
    text += "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
    nodal = "*SEABED CONTACT\n SET={}\n NODAL STIFFNESS=5000\n"
    assert reported(text + nodal.format("ALL")) == []
    assert [message.split(" have ")[0] for message in messages(text + nodal.format("a"))] == ["5 elements (first: 6)"]


def test_a_drag_diameter_of_0_is_no_diameter() -> None:
    text = PIPE + "*GEOMETRIC SETS\n SET=ALL\n ,,,, 1, 1, 0, 0.0, 0.3\n" + CLAY
    text += "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
    assert [(severity, code) for severity, code, _, _ in reported(text)] == [("E", "SBD009")]


def test_a_section_of_a_set_of_lines_may_be_that_of_any_element() -> None:
    text = PIPE + "*LINES\n LINE=Riser\n" + STEEL.replace("ALL", "riser") + CLAY
    text += "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
    assert [(severity, code) for severity, code, _, _ in reported(text)] == [("W", "SBD009")]


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
