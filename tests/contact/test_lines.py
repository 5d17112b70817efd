"""Lines that elements form, in whatever order and direction they are written, and arc length along them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact.lines import Lines, _followed, _in_order, lines_of


def lines(*ends: tuple[int, int], nodes: int = 0, length: float = 2.0) -> Lines:
    """The lines of elements by their nodes from 0."""
    pairs = np.array(ends, dtype=np.intp).reshape(-1, 2)
    count = nodes or int(pairs.max(initial=-1)) + 1
    return lines_of(pairs, np.full(len(pairs), length), count)


def test_a_chain() -> None:
    found = lines((0, 1), (1, 2), (2, 3))
    assert found.of_element.tolist() == [0, 0, 0]
    assert found.of_node.tolist() == [0, 0, 0, 0]
    assert found.element_arc.tolist() == [1.0, 3.0, 5.0]
    assert found.node_arc.tolist() == [0.0, 2.0, 4.0, 6.0]
    assert [each.tolist() for each in found.nodes] == [[0, 1, 2, 3]]


def test_elements_in_any_order_and_direction_follow_the_first() -> None:
    found = lines((2, 1), (3, 2), (0, 1))
    assert found.elements[0].tolist() == [1, 0, 2]
    assert found.nodes[0].tolist() == [3, 2, 1, 0]
    assert found.node_arc.tolist() == [6.0, 4.0, 2.0, 0.0]
    assert found.element_arc.tolist() == [3.0, 1.0, 5.0]


def test_two_lines_and_a_node_of_none() -> None:
    found = lines((0, 1), (1, 2), (3, 4), nodes=6)
    assert found.of_element.tolist() == [0, 0, 1]
    assert found.of_node.tolist() == [0, 0, 0, 1, 1, -1]
    assert found.node_arc[:5].tolist() == [0.0, 2.0, 4.0, 0.0, 2.0]
    assert np.isnan(found.node_arc[5])


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


def test_elements_that_join_the_same_nodes_or_a_node_with_itself() -> None:
    for ends in (((0, 1), (0, 1)), ((0, 1), (1, 0)), ((0, 0),), ((0, 0), (0, 1)), ((0, 1), (1, 1))):
        found = lines(*ends)
        assert sorted(np.concatenate(found.elements).tolist()) == list(range(len(ends)))


def test_no_elements() -> None:
    found = lines(nodes=2)
    assert (found.elements, found.nodes) == ([], [])
    assert found.of_node.tolist() == [-1, -1]


def test_lengths_that_overflow_are_no_error() -> None:
    found = lines((0, 1), (1, 2), length=1.5e308)
    assert found.node_arc.tolist() == [0.0, 1.5e308, np.inf]


@settings(max_examples=80)
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
    quick = _in_order(pairs, 10)
    if quick is not None:
        slow = _followed(pairs, 10)
        assert [(one.tolist(), other.tolist()) for one, other in quick] == [(a.tolist(), b.tolist()) for a, b in slow]
