"""The lines that elements form, arc length along them from one end, junction or free, to the other; how one lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from mudline.basics.quantities import as_json
from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import FloatArray, IndexArray


class Lines(NamedTuple):
    """The lines of an input with nodes (n) and elements (m).

    A line goes on through every node of two elements, and ends where there is one or where more than two meet. It is
    followed in the direction of the first of its elements in the deck; arc length is the sum of the elements' lengths
    from its first node.

    Attributes:
        of_element: (m,) the number of each element's line, from 0 in the order of their first elements.
        of_node: (n,) that of each node, -1 for a node without elements; a junction is one of the first line there.
        element_arc: (m,) arc length at the middle of each element.
        node_arc: (n,) arc length of each node on its line; NaN for a node without elements.
        elements: for each line its elements (k,) along it.
        nodes: for each line its nodes (k + 1,) along it; a closed line ends with the node that it begins with.
    """

    of_element: IndexArray
    of_node: IndexArray
    element_arc: FloatArray
    node_arc: FloatArray
    elements: list[IndexArray]
    nodes: list[IndexArray]

    def __repr__(self) -> str:
        return short_repr(self)

    def node_arcs(self, line: int, length: FloatArray) -> FloatArray:
        """Arc lengths (k + 1,) of the nodes along a line, from the lengths (m,) of all elements; inf beyond numbers."""
        with np.errstate(over="ignore"):
            arcs: FloatArray = np.append(0.0, np.cumsum(length[self.elements[line]]))
        return arcs


def lines_of(element_nodes: IndexArray, length: FloatArray, nodes: int) -> Lines:
    """Return the lines that elements (m, 2) of some lengths (m,) form among so many nodes."""
    ends = np.ascontiguousarray(element_nodes, np.intp)
    elements = len(ends)
    found = _in_order(ends, nodes) or _followed(ends, nodes)
    of_element, of_node = np.zeros(elements, np.intp), np.full(nodes, -1, np.intp)
    element_arc, node_arc = np.zeros(elements), np.full(nodes, np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        for number in range(len(found) - 1, -1, -1):  # a junction keeps the first of its lines
            along, through = found[number]
            arc = np.append(0.0, np.cumsum(length[along]))
            of_element[along], element_arc[along] = number, 0.5 * (arc[:-1] + arc[1:])
            closed = through[0] == through[-1]
            of_node[through], node_arc[through] = number, arc
            if closed:
                node_arc[through[0]] = 0.0
    return Lines(of_element, of_node, element_arc, node_arc, [each for each, _ in found], [each for _, each in found])


def _in_order(ends: IndexArray, nodes: int) -> list[tuple[IndexArray, IndexArray]] | None:
    """The elements and nodes of each line, where the elements of each stand one behind the other; None elsewhere."""
    if not len(ends):
        return []
    first, second = ends.T
    degree = np.bincount(ends.ravel(), minlength=nodes)
    goes_on = (second[:-1] == first[1:]) & (degree[first[1:]] == 2)
    starts = np.append(0, np.flatnonzero(~goes_on) + 1)
    stops = np.append(starts[1:], len(ends))
    closed = first[starts] == second[stops - 1]
    ended = (degree[first[starts]] != 2) & (degree[second[stops - 1]] != 2)
    if not (closed | ended).all():
        return None
    along = np.arange(len(ends))
    return [
        (along[start:stop], np.append(first[start:stop], second[stop - 1]))
        for start, stop in zip(starts.tolist(), stops.tolist(), strict=True)
    ]


def _followed(ends: IndexArray, nodes: int) -> list[tuple[IndexArray, IndexArray]]:
    """The elements and nodes of each line, found by going from element to element."""
    joined: list[list[int]] = [[] for _ in range(nodes)]
    pairs: list[list[int]] = ends.tolist()
    for element, (one, other) in enumerate(pairs):
        joined[one].append(element)
        joined[other].append(element)

    def follow(element: int, node: int) -> tuple[list[int], list[int]]:
        """The elements from one on, away from a node of it, and the nodes behind each."""
        along, through = [element], []
        while True:
            one, other = pairs[along[-1]]
            node = other if node == one else one
            through.append(node)
            beside = joined[node]
            if len(beside) != 2:
                return along, through
            following = beside[1] if beside[0] == along[-1] else beside[0]
            if following in {element, along[-1]}:
                return along, through
            along.append(following)

    left = bytearray(b"\1") * len(pairs)
    found = []
    for element, (one, other) in enumerate(pairs):
        if not left[element]:
            continue
        back, behind = follow(element, other)
        start = behind[-1]
        closed = start == other and len(back) > 1 and len(joined[start]) == 2
        along, through = follow(element, one) if closed else follow(back[-1], start)
        nodes_along = [one if closed else start, *through]
        for each in along:
            left[each] = 0
        found.append((np.array(along, np.intp), np.array(nodes_along, np.intp)))
    return found


class TouchdownPoint(NamedTuple):
    """A point of a line where the gap of its nodes changes sign, found between two of them by interpolation.

    `contact` says on which side, in the direction of arc length, the line lies on the seabed.
    """

    arc_length: float
    x: float
    y: float
    z: float
    contact: Literal["after", "before"]


class ElementForce(NamedTuple):
    """A force per unit length, and the element that has it: its number, and arc length and place of its middle."""

    force: float
    element: int
    arc_length: float
    x: float
    y: float
    z: float


@dataclass(frozen=True, slots=True)
class LineSummary:
    """A line at a step.

    Attributes:
        time: of the step; None for a single state without a time.
        line: its number, from 1; first_element, last_element: the ends of it; length: all of it.
        touchdown: the points where it leaves the seabed or comes down on it, along the line.
        contact_length: how much of it lies below the seabed, between the touchdown points.
        largest_force: where the seabed pushes most; None where it does not push.
        largest_uplift: where the seabed pulls most, by suction or a curve; its force is negative. None without a pull.
        reaction: total normal force on its nodes; a node of several lines counts for the first of them. None on a rigid
            seabed, whose force is not known.
        submerged_weight: of its elements in contact with a law that carries, with contents and masses at nodes; None
            where it is not known. empty_weight: the same without these.
        ratio: reaction / submerged weight; None where that is not above 0.
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
        """The line as JSON has it."""
        found: dict[str, object] = as_json({name: getattr(self, name) for name in self.__slots__})
        return found
