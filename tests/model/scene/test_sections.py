"""Sections: which entry an element has, and its diameter."""

from __future__ import annotations

import math

import pytest

from mudline.model.scene.weights import stiffnesses
from tests.helpers.builders.decks import PIPE
from tests.helpers.builders.scenes import all_reported, reported, scene_of

SETS = PIPE + "*ELEMENT SETS\n SET=a\n GEN=1, 5\n SET=b\n GEN=4, 8\n"
GEOMETRY = SETS + "*GEOMETRIC SETS\n"


def diameters(lines: str) -> list[float | None]:
    found = scene_of(GEOMETRY + lines).diameter.tolist()
    return [None if math.isnan(value) else value for value in found]


@pytest.mark.parametrize(
    ("lines", "diameter"),
    [
        (" SET=ALL\n 1, 1, 1, 1, 100, 1, 0.2, 0.3, 0.4, 0.35, 0.5\n", 0.35),
        (" SET=ALL\n 1, 1, 1, 1, 100, 1, 0.2, 0.3, 0.4\n", 0.3),
        (" SET=ALL\n , , , , 100, 1, 0.2, 0.3, 0.4, , 0.5\n", 0.3),
        (" OPTION=RIGID\n SET=ALL\n 1, 1, 0.25, 0.2, 7850, , , , 0.6, 0.7, 0.8\n", 0.25),
        (" OPTION=RIGID\n SET=ALL\n , 1, 0.25, 0.2, 7850\n", 0.25),
        (" OPTION=MOORING\n SET=ALL\n 1, 100, 0.12, 0.2, 0.3\n", 0.12),
        (" OPTION=TRUSS\n SET=ALL\n , 100, 0.14\n", 0.14),
    ],
)
def test_the_diameter_of_each_format(lines: str, diameter: float) -> None:
    assert diameters(lines) == [diameter] * 10


JOINT = "*TAPER\n SET=b\n 2.0E11, 8.0E10, 7850.0, 0.2, 0.3, 0.4"


def test_the_elements_of_a_joint_have_the_diameters_at_their_middles() -> None:
    scene = scene_of(SETS + "*OCEAN\n 9.0, 1025.0, 9.81\n" + JOINT + "\n")
    assert scene.diameter[3:8].tolist() == pytest.approx([0.31, 0.33, 0.35, 0.37, 0.39])
    assert scene.mass_per_length[3] == pytest.approx(7850.0 * math.pi / 4 * (0.31**2 - 0.2**2))
    stiffness = stiffnesses(scene, scene.section_table.sections[0])
    assert stiffness.bending == pytest.approx(2.0e11 * math.pi / 64 * (0.31**4 - 0.2**4))
    assert stiffness.torsion == pytest.approx(8.0e10 * math.pi / 32 * (0.31**4 - 0.2**4))
    buoyant = scene_of(SETS + "*OCEAN\n 9.0, 1025.0, 9.81\n" + JOINT + ", 0.3, 0.5, 0.6\n")
    bore, lift = 0.21, 0.51
    assert buoyant.submerged_weight[3] == pytest.approx(
        9.81 * math.pi / 4 * (7850.0 * (0.31**2 - bore**2) - 1025.0 * lift**2)
    )


def test_a_joint_begins_where_its_set_begins_and_wins() -> None:
    listed = SETS.replace(" GEN=4, 8", " 8, 7, 6\n 5, 4")
    steel = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 2.0E11, 8.0E10, 0.25, 0.2, 7850.0\n"
    found = scene_of(listed + JOINT + "\n" + steel).diameter.tolist()
    assert found[3:8] == pytest.approx([0.39, 0.37, 0.35, 0.33, 0.31])
    assert set(found[:3] + found[8:]) == {0.25}
    nested = SETS + " SET=c\n SUBSET=b\n" + JOINT.replace("SET=b", "SET=c") + "\n"
    assert scene_of(nested).diameter[3:8].tolist() == pytest.approx([0.31, 0.33, 0.35, 0.37, 0.39])


def test_drag_diameter_counts_only_for_flexible() -> None:
    sections = scene_of(GEOMETRY + " SET=a\n ,,,, 1, 1, 0, 0.3, 0.3\n OPTION=TRUSS\n SET=b\n , 1, 0.1\n").section_table
    assert [(section.name, section.source, section.diameter) for section in sections.sections] == [
        ("a", "Dd", 0.3),
        ("b", "Do", 0.1),
    ]


def test_an_option_holds_until_it_is_changed() -> None:
    lines = (
        " SET=a\n ,,,, 1, 1, 0, 0.3, 0.3\n OPTION=MOORING\n SET=b\n 1, 1, 0.1\n SET=b\n 1, 1, 0.2\n"
        " OPTION=FLEXIBLE\n SET=a\n ,,,, 1, 1, 0, 0.4, 0.3\n"
    )
    assert diameters(lines) == [0.4] * 5 + [0.2] * 3 + [None] * 2


def test_the_later_entry_is_taken_whole() -> None:
    """The later entry gives no usable Do: Dd of the same entry counts, not Do of the earlier one."""
    lines = " SET=ALL\n ,,,, 1, 1, 0, 0.3, 0.3, 0.25\n SET=a\n ,,,, 1, 1, 0, 0.5, 0.3\n"
    assert diameters(lines) == [0.5] * 5 + [0.25] * 5


def test_blocks_add_up_in_the_order_of_the_file() -> None:
    lines = " SET=b\n ,,,, 1, 1, 0, 0.3, 0.3\n*OCEAN\n 9\n*GEOMETRIC SETS\n SET=ALL\n ,,,, 1, 1, 0, 0.4, 0.3\n"
    assert diameters(lines) == [0.4] * 10


def test_a_set_named_very_often_counts_with_its_last_entry() -> None:
    lines = "".join(f" SET=ALL\n ,,,, 1, 1, 0, 0.{i:04d}, 0.3\n" for i in range(1, 300))
    scene = scene_of(GEOMETRY + lines)
    assert set(scene.diameter.tolist()) == {0.0299}
    assert set(scene.section_table.of_element.tolist()) == {298}


def test_a_set_that_is_not_defined_is_told_at_its_name() -> None:
    text = GEOMETRY + " OPTION=MOORING\n SET=c\n 1, 1, 0.1\n"
    assert reported(text) == [("E", "REF001", GEOMETRY.count("\n") + 2, 6)]


@pytest.mark.parametrize("field", ["-0.3", "0.0"])
def test_a_diameter_out_of_range_is_told_once(field: str) -> None:
    curve = "*SEABED STIFFNESS\n CURVE=c\n 0, 0\n 1, 1\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n STIFFNESS=c\n"
    text = GEOMETRY + f" OPTION=MOORING\n SET=ALL\n 1, 1, {field}\n" + curve
    scene = scene_of(text)
    assert [problem.code.code for problem in scene.problems] == ["SBD010"]
    assert scene.section_table.faulty.all()


@pytest.mark.parametrize(
    "lines",
    [
        " OPTION=RIGID\n SET=ALL\n",
        " OPTION=RIGID\n SET=ALL\n 1, 1, x, 0.2, 7850\n",
        " OPTION=RIGID\n SET=ALL\n 1, 1\n",
        " SET=ALL\n ,,,, 1, 1, 0, x, 0.3\n",
        " SET=\n ,,,, 1, 1, 0, 0.2, 0.3\n",
        " SET=nothing\n ,,,, 1, 1, 0, 0.2, 0.3\n",
        " SET=ALL\n ,,,, 1, 1, 0, =[nothing], 0.3\n",
        " SEET=ALL\n ,,,, 1, 1, 0, 0.2, 0.3\n",
    ],
)
def test_a_section_that_could_not_be_read_leads_to_no_missing_diameter(lines: str) -> None:
    curve = "*SEABED STIFFNESS\n CURVE=c\n 0, 0\n 1, 1\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=c\n"
    codes = [code for _, code, _, _ in all_reported(GEOMETRY + lines + curve)]
    assert codes
    assert "SBD009" not in codes


BEND = "*MOMENT-CURVATURE\n CURVE=K\n 0.0, 0.0\n {}, 0.1\n 150.0, 0.2\n"


def test_the_stiffness_of_a_curve_is_unknown_if_a_point_cannot_be_read() -> None:
    deck = GEOMETRY + " OPTION=FLEXIBLE\n SET=ALL, EI=K\n , , 1.0E5, 1.0E8, 50.0, 0.1, 0.2, 0.3, 0.3\n"
    for load, expected in (("100.0", 1000.0), ("x", math.nan)):
        scene = scene_of(deck + BEND.format(load))
        assert stiffnesses(scene, scene.section_table.sections[0]).bending == pytest.approx(expected, nan_ok=True)
