"""The curves of a deck: names, points, faults."""

from __future__ import annotations

import pytest

from tests.helpers.builders.scenes import all_reported, messages, reported, scene_of

STIFFNESS = "$MODEL\n*SEABED STIFFNESS\n"


def test_curves_keep_the_order_of_the_file_and_are_sorted_for_use() -> None:
    scene = scene_of(STIFFNESS + " CURVE=Soft Clay\n 0.5, 4000\n 0, 0\n CURVE=b\n 0, 1\n 1, 2\n")
    assert [entry.name for entry in scene.laws.curves] == ["Soft Clay", "b"]
    assert scene.laws.curves[0].points.tolist() == [[0.5, 4000], [0, 0]]
    assert scene.curves["Soft Clay"].ratios.tolist() == [0, 0.5]
    assert scene.curves["Soft Clay"].name == "Soft Clay"


def test_a_curve_of_embedment_has_the_name_of_its_set() -> None:
    scene = scene_of("$MODEL\n*EMBEDMENT\n 0, 0\n 1, 1\n SET=East\n 0, 0\n 1, 2\n")
    assert [(entry.name, entry.embedment) for entry in scene.laws.curves] == [("ALL", True), ("East", True)]
    assert list(scene.curves) == ["ALL", "East"]


def test_of_two_curves_of_a_name_the_later_holds() -> None:
    scene = scene_of(STIFFNESS + " CURVE=Clay\n 0, 0\n 1, 1\n*SEABED STIFFNESS\n CURVE=CLAY\n 0, 0\n 1, 2\n")
    assert {name: curve.forces.tolist() for name, curve in scene.curves.items()} == {"CLAY": [0, 2]}


def test_a_named_curve_goes_before_one_of_a_set_of_the_same_name() -> None:
    scene = scene_of(STIFFNESS + " CURVE=a\n 0, 0\n 1, 1\n*EMBEDMENT\n SET=a\n 0, 0\n 1, 2\n")
    assert scene.curves["a"].forces.tolist() == [0, 1]


def test_a_curve_of_too_few_points_is_told_at_its_line() -> None:
    assert reported(STIFFNESS + " CURVE=a\n CURVE=b\n 1, 1\n") == [("E", "CRV001", 3, 2), ("E", "CRV001", 4, 2)]
    assert reported(STIFFNESS + " CURVE=b\n 1, 1\n 1, 1\n") == [("E", "CRV001", 3, 2)]
    assert "curve 'a' has no point" in messages(STIFFNESS + " CURVE=a\n")[0]


def test_two_forces_at_one_ratio_are_told_at_the_later_point() -> None:
    text = STIFFNESS + " CURVE=a\n 0, 0\n 1, 5\n 0, 1\n 1, 5\n 1, 6\n 1, 7\n"
    assert reported(text) == [("E", "CRV003", line, 2) for line in (6, 8, 9)]
    entry = scene_of(text).laws.curves[0]
    assert entry.curve is not None
    assert entry.curve.forces.tolist() == [0, 5]
    assert not entry.usable


def test_a_fault_behind_points_left_out_counts_no_points() -> None:
    text = STIFFNESS + " CURVE=a\n 0, 0\n 0, 1\n 1.0E-4, 1.0E305\n"
    assert reported(text) == [("E", "CRV003", 5, 2), ("E", "CRV011", 6, 2)]
    assert "points" not in messages(text)[1]


@pytest.mark.parametrize("row", ["x, 1", "1", "1, 2, 3", "1, =[nothing]", "0,5, 1,5"])
def test_a_curve_with_a_row_that_could_not_be_read_is_not_used_and_not_told_again(row: str) -> None:
    scene = scene_of(STIFFNESS + f" CURVE=a\n 0, 0\n {row}\n")
    entry = scene.laws.curves[0]
    assert entry.points.tolist() == [[0, 0]]
    assert not entry.usable
    assert "CRV001" not in [problem.code.code for problem in scene.problems]


def test_places_skip_rows_that_could_not_be_read() -> None:
    text = STIFFNESS + " CURVE=a\n x, 0\n 0, 0\n 1, 5\n 1, 6\n"
    assert all_reported(text) == [("E", "SYN002", 4, 2), ("E", "CRV003", 7, 2)]


def test_a_curve_without_a_readable_name_is_no_curve_but_may_be_the_one_that_is_missing() -> None:
    text = STIFFNESS + " CURVE=\n 0, 0\n 1, 1\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=a\n"
    assert scene_of(text).curves == {}
    assert reported(text) == [("W", "REF002", 9, 12)]


def test_points_of_embedment_under_a_set_that_could_not_be_read_hold_for_nothing() -> None:
    text = "$MODEL\n*ELASTIC SURFACE\n 1\n*EMBEDMENT\n SET=\n 0, 0\n 1, 1\n"
    scene = scene_of(text)
    assert scene.curves == {}
    assert not scene.laws.curves[0].name
    assert scene.problems == []
