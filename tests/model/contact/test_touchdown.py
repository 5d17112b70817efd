"""Touchdown points, length in contact, extremes, reaction and weight of lines against worked numbers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.quantities import LINES
from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.lines import Lines, LineSummary, TouchdownPoint, lines_of
from mudline.model.contact.result import ResultPart
from mudline.model.contact.touchdown import LineResults, line_summaries

STIFFNESS, WEIGHT = 1000.0, 100.0


def line_input(nodes: int, *, law: str = "linear", weight: float | None = WEIGHT) -> ContactInput:
    """A line along Y with elements of 10 m."""
    chain = np.arange(nodes - 1)
    parameters = {"stiffness": STIFFNESS} if law == "linear" else {}
    return ContactInput(
        node_ids=np.arange(1, nodes + 1),
        coordinates=np.zeros((nodes, 3)),
        element_ids=chain + 101,
        element_nodes=np.stack([chain, chain + 1], axis=1),
        length=np.full(nodes - 1, 10.0),
        diameter=np.full(nodes - 1, 0.5),
        laws=(LawAssignment(law, chain, parameters),),
        weight=None if weight is None else np.full(nodes - 1, weight),
    )


def at_heights(*heights: float) -> np.ndarray:
    places = np.zeros((len(heights), 3))
    places[:, 0] = heights
    places[:, 1] = 10.0 * np.arange(len(heights))
    return places


def summary(*heights: float, law: str = "linear", weight: float | None = WEIGHT) -> LineSummary:
    given = line_input(len(heights), law=law, weight=weight)
    (found,) = line_summaries(ContactModel(given).evaluate(at_heights(*heights)))
    return found


def test_a_line_that_comes_down_lies_and_goes_up() -> None:
    found = summary(3.0, -1.0, -1.0, 1.0)
    first, second = found.touchdown
    assert first == TouchdownPoint(7.5, 0.0, 7.5, 0.0, "after")
    assert second == TouchdownPoint(25.0, 0.0, 25.0, 0.0, "before")
    assert found.contact_length == pytest.approx(2.5 + 10.0 + 5.0)
    assert (found.first_element, found.last_element, found.length, found.time) == (101, 103, 30.0, None)
    assert found.largest_force is not None
    assert (found.largest_force.force, found.largest_force.element) == (1000.0, 102)
    assert (found.largest_force.arc_length, found.largest_force.y, found.largest_force.x) == (15.0, 15.0, -1.0)
    assert found.largest_uplift is None
    # element 101 hangs in the mean of its nodes, 103 has no depth: only 102 carries
    assert (found.reaction, found.submerged_weight, found.ratio) == (10_000.0, 1000.0, 10.0)


def test_a_node_exactly_at_the_seabed_is_the_touchdown_point() -> None:
    (point,) = summary(0.0, -1.0).touchdown
    assert (point.arc_length, point.contact) == (0.0, "after")
    (point,) = summary(-1.0, 0.0, 1.0).touchdown
    assert (point.arc_length, point.contact) == (10.0, "before")


def test_a_rigid_seabed_holds_what_lies_at_it() -> None:
    found = summary(0.0, 0.0, 1.0, law="rigid")
    (point,) = found.touchdown
    assert (point.arc_length, point.contact) == (10.0, "before")
    assert found.contact_length == 10.0
    assert (found.largest_force, found.reaction, found.submerged_weight) == (None, None, 10.0 * WEIGHT)


def test_only_elements_with_a_law_are_in_contact() -> None:
    given = line_input(4)
    (law,) = given.laws
    given = replace(given, laws=(LawAssignment(law.law, np.array([0]), {"stiffness": 1000.0}),))
    (found,) = line_summaries(ContactModel(given).evaluate(at_heights(-1.0, -1.0, -1.0, 1.0)))
    assert (found.touchdown, found.contact_length, found.submerged_weight) == ((), 10.0, 10.0 * WEIGHT)


def test_uplift_is_the_largest_pull() -> None:
    given = line_input(3)
    spring = LawAssignment("suction spring", np.arange(2), {"stiffness": 50.0, "extent": 1.0})
    given = replace(given, laws=(*given.laws, spring))
    (found,) = line_summaries(ContactModel(given).evaluate(at_heights(0.2, 0.2, 0.6)))
    assert found.largest_uplift is not None
    assert found.largest_uplift.force == pytest.approx(-20.0)
    assert found.largest_uplift.element == 102
    assert found.largest_force is None


def test_a_series_has_a_row_for_each_step_and_its_time() -> None:
    given = line_input(3)
    series = np.stack([at_heights(-1.0, -1.0, 1.0), at_heights(-1.0, -1.0, 3.0), at_heights(1.0, 1.0, 1.0)])
    result = ContactModel(given).evaluate(series, times=[0.0, 0.5, 2.0])
    rows = result.summary()
    assert rows == line_summaries(result)
    assert [row.time for row in rows] == [0.0, 0.5, 2.0]
    assert [[point.arc_length for point in row.touchdown] for row in rows] == [[15.0], [12.5], []]
    assert [row.contact_length for row in rows] == [15.0, 12.5, 0.0]


def test_the_table_says_the_same_as_the_rows() -> None:
    given = line_input(4)
    series = np.stack([at_heights(1.0, -1.0, -1.0, 2.0), at_heights(1.0, 1.0, 1.0, 1.0)])
    result = ContactModel(given).evaluate(series, times=[0.0, 1.0])
    columns = LineResults(given, np.arange(3)).columns(ResultPart(0, result))
    assert [column.name for column in columns] == list(LINES)
    values = {column.name: column.cut(0, 2)[:, 0] for column in columns}
    first, last = line_summaries(result)
    points = first.touchdown
    assert values["touchdown_points"].tolist() == [2, 0]
    assert values["first_touchdown"][0] == points[0].arc_length
    assert values["last_touchdown"][0] == points[1].arc_length
    assert [values[f"last_touchdown_{axis}"][0] for axis in "xyz"] == [*points[1][1:4]]
    assert np.isnan([values[name][1] for name in ("first_touchdown", "last_touchdown_y", "largest_force")]).all()
    assert values["largest_force_element"].tolist() == [102, -1]
    assert values["contact_length"].tolist() == [first.contact_length, last.contact_length]
    assert values["ratio"][0] == first.ratio


def test_nodes_without_positions_are_no_touchdown() -> None:
    given = line_input(4)
    result = ContactModel(given).evaluate(at_heights(-1.0, -1.0, 1.0, 1.0), present=[True, True, False, True])
    (found,) = line_summaries(result)
    assert (found.touchdown, found.contact_length, found.reaction) == ((), 10.0, 10_000.0)


def test_json_has_no_value_for_what_overflowed() -> None:
    found = LineSummary(
        None, 1, 1, 1, np.inf, (TouchdownPoint(np.inf, 0.0, 0.0, 0.0, "after"),), 0.0, None, None, 1.0, None, None, None
    )
    row = found.row()
    assert row["length"] is None
    assert row["touchdown"] == [{"arc_length": None, "x": 0.0, "y": 0.0, "z": 0.0, "contact": "after"}]


def lines(*ends: tuple[int, int], nodes: int = 0, length: float = 2.0) -> Lines:
    """The lines of elements by their nodes from 0."""
    pairs = np.array(ends, dtype=np.intp).reshape(-1, 2)
    count = nodes or int(pairs.max(initial=-1)) + 1
    return lines_of(pairs, np.full(len(pairs), length), count)


def test_a_junction_ends_lines_and_belongs_to_the_first() -> None:
    found = lines((0, 1), (1, 2), (1, 3))
    assert found.of_element.tolist() == [0, 1, 2]
    assert [each.tolist() for each in found.nodes] == [[0, 1], [1, 2], [1, 3]]
    assert (found.of_node[1], found.node_arc[1]) == (0, 2.0)


@pytest.mark.parametrize("ends", [((0, 1), (1, 2), (2, 0)), ((1, 2), (0, 1), (2, 0))])
def test_a_closed_line_begins_with_its_first_element(ends: tuple[tuple[int, int], ...]) -> None:
    found = lines(*ends)
    assert len(found.nodes) == 1
    assert found.nodes[0][0] == found.nodes[0][-1] == ends[0][0]
    assert found.elements[0][0] == 0
    assert found.node_arc[ends[0][0]] == 0.0
    assert sorted(found.node_arc.tolist()) == [0.0, 2.0, 4.0]


@given(st.integers(1, 9).flatmap(lambda n: st.lists(st.tuples(st.integers(0, n), st.integers(0, n)), max_size=14)))
def test_every_element_is_in_one_line_whose_elements_join(ends: list[tuple[int, int]]) -> None:
    pairs = np.array(ends, dtype=np.intp).reshape(-1, 2)
    found = lines_of(pairs, np.ones(len(pairs)), 10)
    assert sorted(each for line in found.elements for each in line.tolist()) == list(range(len(pairs)))
    degree = np.bincount(pairs.ravel(), minlength=10)
    for along, through in zip(found.elements, found.nodes, strict=True):
        assert len(through) == len(along) + 1
        for element, begin, end in zip(along, through[:-1], through[1:], strict=True):
            assert {int(begin), int(end)} == set(pairs[element].tolist())
        assert (degree[through[1:-1]] == 2).all()
        assert (degree[through[[0, -1]]] != 2).all() or through[0] == through[-1]
