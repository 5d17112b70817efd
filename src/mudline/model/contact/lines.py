"""Lines formed by elements, with arc length between their ends, free or at a junction; summary of a line."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from mudline.basics.quantities import as_json
from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import FloatArray, IndexArray


class Lines(NamedTuple):
    """The lines of an input with nodes (n) and elements (m).

    A line passes every node of two elements, and ends at a node with one element or more than two. Its direction is
    that of its first element in the deck. Arc length is the sum of the elements' lengths from the first node of the
    line.

    Attributes:
        of_element: (m,) number of each element's line, from 0 in the order of the lines' first elements.
        of_node: (n,) number of each node's line, -1 for a node without elements; a junction belongs to its first line.
        element_arc: (m,) arc length at the middle of each element.
        node_arc: (n,) arc length of each node on its line; NaN for a node without elements.
        elements: for each line its elements (k,) along the line.
        nodes: for each line its nodes (k + 1,) along the line; the last node of a closed line is its first.
        arcs: for each line the arc lengths (k + 1,) of these nodes; infinite from where they overflow.
    """

    of_element: IndexArray
    of_node: IndexArray
    element_arc: FloatArray
    node_arc: FloatArray
    elements: list[IndexArray]
    nodes: list[IndexArray]
    arcs: list[FloatArray]

    def __repr__(self) -> str:
        return short_repr(self)


def lines_of(element_nodes: IndexArray, length: FloatArray, nodes: int) -> Lines:
    """Return the lines that elements (m, 2) with lengths (m,) form among `nodes` nodes."""
    ends = np.ascontiguousarray(element_nodes, np.intp)
    elements = len(ends)
    along_lines, through_lines = _followed(ends, nodes)
    of_element, of_node = np.zeros(elements, np.intp), np.full(nodes, -1, np.intp)
    element_arc, node_arc = np.zeros(elements), np.full(nodes, np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        arcs = [np.append(0.0, np.cumsum(length[along])) for along in along_lines]
        for number in range(len(arcs) - 1, -1, -1):  # a junction keeps the first of its lines
            along, through, arc = along_lines[number], through_lines[number], arcs[number]
            of_element[along], element_arc[along] = number, 0.5 * (arc[:-1] + arc[1:])
            of_node[through], node_arc[through] = number, arc
            if through[0] == through[-1]:
                node_arc[through[0]] = 0.0
    return Lines(of_element, of_node, element_arc, node_arc, along_lines, through_lines, arcs)


def _followed(ends: IndexArray, nodes: int) -> tuple[list[IndexArray], list[IndexArray]]:
    """Return elements and nodes of each line, found by going from element to element."""
    numbers, places = np.arange(len(ends)), ends.ravel()
    inside = np.bincount(places, minlength=nodes) == 2
    beside = np.bincount(places, numbers.repeat(2), nodes)[ends] - numbers[:, None]
    firsts, seconds = ends.T.tolist()
    before, behind = np.where(inside[ends], beside, -1.0).astype(np.intp).T.tolist()

    def follow(element: int, node: int) -> tuple[list[int], list[int]]:
        """Return the elements from `element` on, leading away from its node `node`, and the node behind each."""
        along, through, following = [], [], element
        while following >= 0:
            along.append(following)
            if node == firsts[following]:
                node, following = seconds[following], behind[following]
            else:
                node, following = firsts[following], before[following]
            through.append(node)
            if following == element:
                break
        return along, through

    left, element = bytearray(b"\1") * len(ends), -1
    along_lines, through_lines = [], []
    while (element := left.find(1, element + 1)) >= 0:
        back, through = follow(element, seconds[element])
        first, start = back[-1], through[-1]
        if start == seconds[element] and len(back) > 1 and inside[start]:  # closed
            first, start = element, firsts[element]
        along, through = follow(first, start)
        for each in along:
            left[each] = 0
        along_lines.append(np.array(along, np.intp))
        through_lines.append(np.array([start, *through], np.intp))
    return along_lines, through_lines


class TouchdownPoint(NamedTuple):
    """A point of a line where the gap of its nodes changes sign, interpolated between two nodes.

    `contact` is the side, in the direction of arc length, on which the line lies on the seabed.
    """

    arc_length: float
    x: float
    y: float
    z: float
    contact: Literal["after", "before"]


class ElementForce(NamedTuple):
    """A force per unit length and its element: number, arc length and coordinates of the middle."""

    force: float
    element: int
    arc_length: float
    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class LineSummary:
    """Summary of a line at a step.

    Attributes:
        time: time of the step; None for a single state without a time.
        line: number of the line, from 1.
        first_element, last_element: numbers of the elements at its ends.
        length: length of the line.
        touchdown: points where the line leaves the seabed or touches down, along the line.
        contact_length: length below the seabed, between the touchdown points, of elements with a law.
        largest_force: largest force out of the seabed; None if there is none.
        largest_uplift: largest pull by suction or a curve, a negative force; None if there is none.
        reaction: total normal force on its nodes; a junction counts for its first line only. None on a rigid seabed,
            whose force is not known.
        submerged_weight: weight of its elements in contact that have a law, with contents and masses at nodes; None if
            unknown.
        empty_weight: that weight without contents.
        ratio: reaction / submerged weight; None if the weight is not above 0.
    """

    time: float | None
    line: int
    first_element: int
    last_element: int
    length: float
    touchdown: tuple[TouchdownPoint, ...]
    contact_length: float
    largest_force: ElementForce | None
    largest_uplift: ElementForce | None
    reaction: float | None
    submerged_weight: float | None
    empty_weight: float | None
    ratio: float | None

    def row(self) -> dict[str, object]:
        """Return the line as JSON."""
        row: dict[str, object] = as_json({name: getattr(self, name) for name in self.__slots__})
        return row
