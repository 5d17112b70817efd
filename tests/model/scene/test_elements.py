"""Elements: tables, generators, nodes, lengths."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.basics.limits import MOST_GENERATED
from tests.helpers.builders.scenes import all_reported, ends_of, messages, reported, scene_of

NODES = "$MODEL\n*NODE\n 1, 0, 0\n 21, 0, 200\n GEN=1, 21\n"
NODES_END = NODES.count("\n")
ELEMENT = NODES + "*ELEMENT\n"


def test_the_pattern_of_the_manual() -> None:
    """Master 1 joins 4 and 6; of four elements with increment 2 the others join 6-8, 8-10 and 10-12."""
    scene = scene_of(ELEMENT + " 1, 4, 6\n GEN=1, 4, 2\n")
    assert ends_of(scene) == {1: [4, 6], 3: [6, 8], 5: [8, 10], 7: [10, 12]}


def test_the_count_of_a_generator_holds_its_master() -> None:
    assert ends_of(scene_of(ELEMENT + " 5, 1, 2\n GEN=5, 3\n")) == {5: [1, 2], 6: [2, 3], 7: [3, 4]}
    assert ends_of(scene_of(ELEMENT + " 5, 1, 2\n GEN=5, 1\n")) == {5: [1, 2]}


def test_lengths_are_distances_between_the_nodes() -> None:
    scene = scene_of("$MODEL\n*NODE\n 1, 0, 0\n 2, 2, 3, 6\n 3, 2, 3, 6\n*ELEMENT\n 1, 1, 2\n 2, 2, 3\n")
    assert scene.length.tolist() == [7.0, 0.0]


def test_axes_of_an_element_are_no_nodes() -> None:
    assert ends_of(scene_of(ELEMENT + " 1, 1, 2, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0\n")) == {1: [1, 2]}


def test_an_undefined_node_is_told_at_its_field() -> None:
    text = ELEMENT + " 1, 1, 2\n 2, 2, 30\n 3, 31, 32\n"
    line = NODES_END + 3
    assert reported(text) == [("E", "REF006", line, 8), ("E", "REF006", line + 1, 5), ("E", "REF006", line + 1, 9)]
    assert ends_of(scene_of(text)) == {1: [1, 2], 2: [2, 0], 3: [0, 0]}
    assert messages(text)[0] == "element 2 ends at node 30, which is not defined: define it"


def test_a_generator_that_runs_beyond_the_nodes_is_told_once() -> None:
    text = ELEMENT + " 1, 1, 2\n GEN=1, 25\n"
    assert reported(text) == [("E", "REF006", NODES_END + 3, 2)]
    assert len(ends_of(scene_of(text))) == 25


def test_the_later_definition_holds() -> None:
    text = ELEMENT + " 1, 1, 2\n 1, 3, 4\n"
    assert ends_of(scene_of(text)) == {1: [3, 4]}
    assert reported(text) == [("E", "REF007", NODES_END + 3, 2)]


def test_a_master_must_be_defined_before() -> None:
    text = ELEMENT + " GEN=1, 3\n 1, 1, 2\n"
    assert reported(text) == [("E", "REF005", NODES_END + 2, 6)]
    assert ends_of(scene_of(text)) == {2: [0, 0], 3: [0, 0], 1: [1, 2]}


@pytest.mark.parametrize("line", ["GEN=1, 0", "GEN=1, -3", "GEN=1, 3, 0", "GEN=1, 3, -1"])
def test_generators_of_nothing(line: str) -> None:
    text = ELEMENT + f" 1, 1, 2\n {line}\n"
    assert reported(text) == [("E", "REF010", NODES_END + 3, 2)]
    assert ends_of(scene_of(text)) == {1: [1, 2]}


@pytest.mark.parametrize("line", [f"GEN=1, {MOST_GENERATED + 2}", "GEN=1, 3, 9007199254740991"])
def test_a_slip_of_a_digit_does_not_fill_the_memory(line: str) -> None:
    assert reported(ELEMENT + f" 1, 1, 2\n {line}\n") == [("E", "REF010", NODES_END + 3, 2)]


def test_a_generator_that_is_refused_makes_what_it_may_have_defined_a_warning() -> None:
    text = ELEMENT + " 5, 1, 2\n GEN=5, 0\n*ELEMENT SETS\n SET=a\n 4, 6\n"
    found = reported(text)
    assert found[1:] == [("E", "REF005", NODES_END + 6, 2), ("W", "REF005", NODES_END + 6, 5)]
    assert "a GEN= of *ELEMENT that could not be used may define it" in messages(text)[2]


def test_labels_name_nothing_without_lines() -> None:
    text = ELEMENT + " 1, {Seabed End}, 2\n"
    assert reported(text) == [("E", "REF006", NODES_END + 2, 5)]
    assert ends_of(scene_of(text)) == {1: [0, 2]}


def test_rows_that_could_not_be_read_lead_to_nothing_more() -> None:
    text = ELEMENT + " 1, 1, 2\n x, 2, 3\n 3, 3, 4-\n"
    scene = scene_of(text)
    assert all_reported(text) == [("E", "SYN002", NODES_END + 3, 2), ("E", "SYN002", NODES_END + 4, 8)]
    assert ends_of(scene) == {1: [1, 2], 3: [3, 0]}
    assert np.isnan(scene.length[1])
    assert [scene.table.numbered.where(index).path[-1] for index in (0, 1)] == [0, 2]


def test_an_element_that_was_not_read_may_be_the_one_that_a_set_lists() -> None:
    text = ELEMENT + " 1, 1, 2\n 2x, 2, 3\n*ELEMENT SETS\n SET=a\n 1, 2\n 1, 22, 33\n GEN=1, 3\n"
    assert reported(text) == [("E", "REF005", NODES_END + 7, 9)]


def test_a_deck_without_elements_is_empty_and_fine() -> None:
    scene = scene_of("$LOAD CASE\n*TIME\n 0, 1\n")
    assert len(scene.nodes) == len(scene.table.numbered) == 0
    assert scene.element_nodes.shape == (0, 2)
    assert scene.length.tolist() == []
    assert math.isclose(scene.coordinates.sum(), 0.0)
    assert scene.problems == []


def test_lengths_whose_squares_under_or_overflow() -> None:
    for size in (1e-300, 1e-162, 1e-160, 1.0, 1e160, 1e300):
        deck = f"$MODEL\n*NODE\n 1, 0, 0\n 2, 0, {3 * size!r}, {4 * size!r}\n*ELEMENT\n 1, 1, 2\n"
        assert scene_of(deck).length[0] == pytest.approx(5 * size, rel=1e-15)
