"""Nodes: tables, generators, later definitions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.limits import MOST_GENERATED
from mudline.language.diagnostics import Where
from mudline.model.scene.numbering import DefinitionBatch, Definitions
from tests.helpers.builders.scenes import all_reported, messages, nodes_of, reported, scene_of

NODE = "$MODEL\n*NODE\n"


def test_coordinates_are_those_of_the_table_and_z_is_0_unless_given() -> None:
    scene = scene_of(NODE + " 3, -1.5, 2.0\n 1, 4.0, 5.0, 6.0\n 2, 7.0, 8.0,\n")
    assert scene.node_ids.tolist() == [3, 1, 2]
    assert scene.coordinates.tolist() == [[-1.5, 2.0, 0.0], [4.0, 5.0, 6.0], [7.0, 8.0, 0.0]]


def test_generated_nodes_are_evenly_spaced_and_exact_where_the_spacing_is_whole() -> None:
    scene = scene_of(NODE + " 1, -1.0, 0.0, 3.0\n 30, 28.0, 290.0, 3.0\n GEN=1, 30\n")
    nodes = nodes_of(scene)
    assert len(nodes) == 30
    for number in range(1, 31):
        assert nodes[number] == [number - 2.0, 10.0 * (number - 1), 3.0]


def test_an_increment_spaces_the_numbers_and_the_nodes() -> None:
    nodes = nodes_of(scene_of(NODE + " 10, 0, 0\n 50, 0, 8\n GEN=10, 50, 10\n"))
    assert {number: y for number, (_, y, _) in nodes.items()} == {10: 0, 50: 8, 20: 2, 30: 4, 40: 6}


def test_generators_build_on_generated_nodes() -> None:
    nodes = nodes_of(scene_of(NODE + " 1, 0, 0\n 5, 0, 8\n GEN=1, 5, 2\n GEN=1, 3\n"))
    assert nodes[3][1] == 4.0
    assert nodes[2][1] == 2.0


def test_blocks_and_sections_add_up() -> None:
    scene = scene_of(
        "$MODEL\n*NODE\n 1, 0, 0\n$LOAD CASE\n*TIME\n$MODEL\n*NODE\n 5, 0, 4\n*OCEAN\n 9\n*NODE\n GEN=1, 5\n"
    )
    assert sorted(scene.node_ids.tolist()) == [1, 2, 3, 4, 5]
    assert scene.problems == []


def test_the_later_definition_holds_and_is_told_at_its_row() -> None:
    text = NODE + " 1, 0, 0\n 2, 0, 1\n 1, 0, 9\n"
    assert nodes_of(scene_of(text)) == {1: [0, 9, 0], 2: [0, 1, 0]}
    assert reported(text) == [("E", "REF007", 5, 2)]


def test_a_generator_that_defines_nodes_again_is_told_once() -> None:
    text = NODE + " 1, 0, 0\n 2, 7, 7\n 3, 7, 7\n 5, 0, 4\n GEN=1, 5\n"
    assert nodes_of(scene_of(text))[2] == [0, 1, 0]
    assert reported(text) == [("E", "REF007", 7, 2)]
    assert messages(text)[0].startswith("2 nodes (first: 2) are defined twice")


def test_a_row_after_a_generator_holds() -> None:
    text = NODE + " 1, 0, 0\n 5, 0, 4\n GEN=1, 5\n 3, -2, 2\n"
    assert nodes_of(scene_of(text))[3] == [-2, 2, 0]
    assert reported(text) == [("E", "REF007", 6, 2)]


def test_twice_in_two_model_sections_is_a_warning_because_that_is_inferred() -> None:
    text = NODE + " 1, 0, 0\n$LOAD CASE\n*TIME\n" + NODE + " 1, 0, 2\n"
    assert reported(text) == [("W", "REF007", 8, 2)]
    assert "inferred" in messages(text)[0]


@pytest.mark.parametrize("line", ["GEN=5, 1", "GEN=1, 1", "GEN=1, 5, 3", "GEN=1, 5, 0", "GEN=1, 5, -1"])
def test_generators_that_lead_nowhere(line: str) -> None:
    text = NODE + f" 1, 0, 0\n 5, 0, 4\n {line}\n"
    assert scene_of(text).node_ids.tolist() == [1, 5]
    assert reported(text) == [("E", "REF010", 5, 2)]


def test_a_slip_of_a_digit_does_not_fill_the_memory() -> None:
    text = NODE + f" 1, 0, 0\n {MOST_GENERATED * 3}, 0, 4\n GEN=1, {MOST_GENERATED * 3}\n"
    assert reported(text) == [("E", "REF010", 5, 2)]
    assert f"more than {MOST_GENERATED}" in messages(text)[0]


def test_the_limit_holds_for_all_generators_together(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.model.scene.mesh.MOST_GENERATED", 10)
    ends = " 1, 0, 0\n 11, 0, 1\n 13, 0, 2\n 15, 0, 3\n"
    text = NODE + ends + " GEN=1, 11\n GEN=11, 13\n GEN=13, 15\n"
    assert reported(text) == [("E", "REF010", 9, 2)]


def test_ends_that_nothing_defines_are_told_each_and_the_nodes_still_have_numbers() -> None:
    text = NODE + " 1, 0, 0\n GEN=1, 5\n GEN=7, 9\n*ELEMENT\n 1, 2, 8\n"
    scene = scene_of(text)
    assert scene.node_ids.tolist() == [1, 2, 3, 4, 8]
    assert np.isnan(scene.coordinates[1:]).all()
    assert reported(text) == [("E", "REF006", 4, 9), ("E", "REF006", 5, 6), ("E", "REF006", 5, 9)]


def test_ends_that_are_defined_later_are_taken_with_a_warning() -> None:
    text = NODE + " 1, 0, 0\n GEN=1, 5\n 5, 0, 4\n"
    assert nodes_of(scene_of(text))[2] == [0, 1, 0]
    assert reported(text) == [("W", "REF006", 4, 2)]
    assert "inferred" in messages(text)[0]


def test_a_row_with_a_bad_field_still_defines_its_number() -> None:
    text = NODE + " 1, 0, 0\n 2, zero, 1\n 3, 0, 2\n*ELEMENT\n 1, 1, 2\n 2, 2, 3\n"
    scene = scene_of(text)
    assert scene.node_ids.tolist() == [1, 2, 3]
    assert np.isnan(scene.coordinates[1, 0])
    assert np.isnan(scene.length).all()
    assert all_reported(text) == [("E", "SYN002", 4, 5)]


@pytest.mark.parametrize("number", ["1.5", "1E300", "9007199254740994"])
def test_a_number_that_is_not_whole_defines_nothing(number: str) -> None:
    scene = scene_of(NODE + f" {number}, 0, 0\n 1, 0, 1\n 9007199254740992, 0, 2\n")
    assert scene.node_ids.tolist() == [1, 9007199254740992]
    assert [scene.nodes.where(index).path for index in (0, 1)] == [("entries", 0, "nodes", row) for row in (1, 2)]


@pytest.mark.parametrize("increment", ["=[nothing]", "=[1/2]", "=[2^60]", "x"])
def test_a_generator_of_which_a_value_is_not_known_makes_nothing(increment: str) -> None:
    scene = scene_of(NODE + f" 1, 0, 0\n 5, 0, 4\n GEN=1, 5, {increment}\n")
    assert scene.node_ids.tolist() == [1, 5]
    assert "NODE" in scene.context.unread


_BATCHES = st.lists(st.lists(st.integers(-5, 40), max_size=12), max_size=8)


def gathered(batches: list[list[int]]) -> Definitions:
    """Definitions whose value is their row among all of them."""
    found = Definitions()
    row = 0
    for index, ids in enumerate(batches):
        values = np.arange(row, row + len(ids), dtype=np.float64)[:, np.newaxis]
        found.add(DefinitionBatch(np.array(ids, dtype=np.int64), values, Where(0, index), "rows", range(len(ids))))
        row += len(ids)
    return found


@given(_BATCHES)
def test_settled_definitions_are_those_of_a_dictionary(batches: list[list[int]]) -> None:
    flat = [number for ids in batches for number in ids]
    held = {number: row for row, number in enumerate(flat)}
    settled = gathered(batches).resolve(1)
    assert settled.ids.tolist() == list(dict.fromkeys(flat))
    assert settled.values[:, 0].tolist() == [held[number] for number in settled.ids.tolist()]
    assert settled.rows.tolist() == [held[number] for number in settled.ids.tolist()]
    assert settled.firsts.tolist() == [flat.index(number) for number in settled.ids.tolist()]
    assert settled.repeats.tolist() == [row for row, number in enumerate(flat) if number in flat[:row]]
    places = [Where(0, index, ("rows", row)) for index, ids in enumerate(batches) for row in range(len(ids))]
    assert [settled.where_row(row) for row in range(len(flat))] == places
    assert [settled.where(index) for index in range(len(settled))] == [places[held[n]] for n in settled.ids.tolist()]


@given(_BATCHES, st.integers(-7, 45), st.integers(0, 50), st.integers(1, 9))
def test_a_range_holds_the_indices_of_its_numbers(batches: list[list[int]], start: int, span: int, step: int) -> None:
    settled = gathered(batches).resolve(1)
    wanted = set(range(start, start + span + 1, step))
    expected = [index for index, number in enumerate(settled.ids.tolist()) if number in wanted]
    assert settled.between(start, start + span, step).tolist() == expected


def test_the_current_definition_is_found_while_batches_are_added() -> None:
    found = Definitions()
    found.add(DefinitionBatch(np.arange(20), np.arange(20.0)[:, np.newaxis], Where()))
    assert found.find(19) == [19.0]
    assert found.find(20) is None
    assert found.find(-1) is None
    found.add(DefinitionBatch(np.array([7, 30]), np.array([[-7.0], [-8.0]]), Where()))
    assert found.find(7) == [-7.0]
    assert found.find(30) == [-8.0]
    assert found.find(8) == [8.0]
    found.add(DefinitionBatch(np.arange(40)[::-1], np.arange(40.0)[:, np.newaxis], Where()))
    assert found.find(7) == [32.0]
    assert found.find(39) == [0.0]
