"""Lines formed by elements: elements at each node, directions along the line, arc length, summary of a line.

A line runs between two ends, free or at a junction.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from mudline.basics.quantities import as_json
from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray, SmallIndexArray
from mudline.model.contact.vectors import in_plane, turned, units

if TYPE_CHECKING:
    from mudline.model.contact.laws.friction import FrictionLaw


class Incidence:
    """The elements (m, 2) among nodes (n).

    Along most lines an element runs from one node to the next, so that slices of arrays replace indices.

    Attributes:
        ends: (m, 2) the nodes of the elements.
        first, second: (m,) the nodes at each end.
        start, elements: the elements at node i are elements[start[i]:start[i + 1]]: in order those that begin there,
            then those that end there.
        sides: (2 m,) the end, 0 or 1, of each entry of `elements` at its node.
        senses: (2 m,) sign of the direction of each entry at its node. It is -1 for the later one of two elements that
            both begin or both end at a node: the line runs through whichever way its elements are written.
        turns: whether a sense is negative.
    """

    def __init__(self, element_nodes: IndexArray, nodes: int) -> None:
        self.ends: IndexArray = np.ascontiguousarray(element_nodes, np.intp)
        self.first, self.second = np.ascontiguousarray(self.ends.T)
        count = len(element_nodes)
        order = np.argsort(np.concatenate([self.first, self.second]), kind="stable")
        degree = np.bincount(self.first, minlength=nodes) + np.bincount(self.second, minlength=nodes)
        self.start: IndexArray = np.append(0, np.cumsum(degree)).astype(np.intp)
        self.elements: SmallIndexArray = (order % max(count, 1)).astype(np.int32)
        begins = order < count
        self.sides: IndexArray = np.where(begins, 0, 1)
        two = np.flatnonzero(degree == 2)
        same = two[begins[self.start[two]] == begins[self.start[two] + 1]]
        self.senses: FloatArray = np.ones(2 * count)
        self.senses[self.start[same] + 1] = -1.0
        self.turns = bool(same.size)
        self._junctions = np.flatnonzero(degree > 2)
        along = np.arange(nodes)
        self._chain = np.array_equal(self.first, along[:-1]) and np.array_equal(self.second, along[1:])

    @cached_property
    def beside(self) -> IndexArray:
        """The first two elements (n, 2) at each node, -1 for a missing element."""
        padded, degree = np.append(self.elements, [-1, -1]), np.diff(self.start)
        pair = np.stack([padded[self.start[:-1]], padded[self.start[:-1] + 1]], axis=1).astype(np.intp)
        pair[degree < 2, 1] = pair[degree < 1, 0] = -1
        return pair

    @cached_property
    def _first_two(self) -> list[tuple[IndexArray, FloatArray]]:
        """The first, and the second element (n,) at each node and its sense; without one the column of zeros."""
        senses, start = np.append(self.senses, [1.0] * 2), self.start[:-1]
        pair = 1 + np.where(self.beside < 0, len(self.first), self.beside)
        return [(pair[:, side], senses[start + side]) for side in range(2)]

    def at(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return values (steps, m) at both ends of the elements, from values (steps, n) at nodes."""
        if self._chain:
            return values[:, :-1], values[:, 1:]
        return values.take(self.first, axis=1), values.take(self.second, axis=1)

    def sums(self, values: FloatArray, *, directed: bool = False) -> FloatArray:
        """Return sums (steps, n) at nodes of the values (steps, m + 2) of their elements.

        The values stand between two columns of zeros, and are added in the order of `elements`. With `directed` each
        value is multiplied by its sense.
        """
        if self._chain:
            total: FloatArray = values[:, 1:] + values[:, :-1]
            total += 0.0
            return total
        total = np.zeros((len(values), len(self.start) - 1))
        for elements, senses in self._first_two:
            total += values.take(elements, axis=1) * senses if directed else values.take(elements, axis=1)
        for node in self._junctions.tolist():  # of three or more elements
            sums = np.zeros(len(total))
            for element in self.elements[self.start[node] : self.start[node + 1]].tolist():
                sums += values[:, 1 + element]
            total[:, node] = sums
        return total


class Directions(NamedTuple):
    """Directions at nodes (n,) in one step.

    Attributes:
        axes: u1 and u2, each (n, 3).
        follows: (n,) nodes whose directions turn with the line.
        senses: (m, 2) sign of each element's direction at its two ends.
        size: (n,) length of the projection of the sum of the elements' directions.
    """

    axes: tuple[FloatArray, FloatArray]
    follows: BoolArray
    senses: FloatArray
    size: FloatArray


def directions_of(line: Incidence, friction: FrictionLaw | None, points: FloatArray, normals: FloatArray) -> Directions:
    """Return the directions of nodes at `points` (n, 3) with unit normals (n, 3)."""
    with np.errstate(all="ignore"):
        unit = units((points[line.second] - points[line.first]).T)
        total = np.ascontiguousarray(line.sums(np.pad(unit, ((0, 0), (1, 1))), directed=True).T)
        flat = total - (total * normals).sum(axis=1)[:, None] * normals
        along = along_seabed(total, normals)
        follows = np.ones(len(points), np.bool_)
        if friction is not None and friction.turned.size:
            there = tuple(normals[friction.turned].T)
            along[friction.turned] = np.stack(turned(friction.cosine, friction.sine, there), axis=1)
            follows[friction.turned] = False
        senses = np.ones((len(line.first), 2))
        senses[line.elements, line.sides] = line.senses
    return Directions((along, np.cross(normals, along)), follows, senses, np.sqrt((flat * flat).sum(axis=1)))


def along_seabed(vectors: FloatArray, normal: FloatArray) -> FloatArray:
    """Return unit vectors (k, 3) along projections of vectors; the default direction for a vector along the normal."""
    return np.stack(in_plane(tuple(vectors.T), tuple(normal.T)), axis=1)


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
        """Return arc lengths (k + 1,) of the nodes along a line, from all elements' lengths (m,); inf on overflow."""
        with np.errstate(over="ignore"):
            arcs: FloatArray = np.append(0.0, np.cumsum(length[self.elements[line]]))
        return arcs


def lines_of(element_nodes: IndexArray, length: FloatArray, nodes: int) -> Lines:
    """Return the lines that elements (m, 2) with lengths (m,) form among `nodes` nodes."""
    ends = np.ascontiguousarray(element_nodes, np.intp)
    elements = len(ends)
    parts = _followed(ends, nodes)
    of_element, of_node = np.zeros(elements, np.intp), np.full(nodes, -1, np.intp)
    element_arc, node_arc = np.zeros(elements), np.full(nodes, np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        for number in range(len(parts) - 1, -1, -1):  # a junction keeps the first of its lines
            along, through = parts[number]
            arc = np.append(0.0, np.cumsum(length[along]))
            of_element[along], element_arc[along] = number, 0.5 * (arc[:-1] + arc[1:])
            closed = through[0] == through[-1]
            of_node[through], node_arc[through] = number, arc
            if closed:
                node_arc[through[0]] = 0.0
    return Lines(of_element, of_node, element_arc, node_arc, [each for each, _ in parts], [each for _, each in parts])


def _followed(ends: IndexArray, nodes: int) -> list[tuple[IndexArray, IndexArray]]:
    """Return elements and nodes of each line, found by going from element to element."""
    joined: list[list[int]] = [[] for _ in range(nodes)]
    pairs: list[list[int]] = ends.tolist()
    for element, (start, end) in enumerate(pairs):
        joined[start].append(element)
        joined[end].append(element)

    def follow(element: int, node: int) -> tuple[list[int], list[int]]:
        """Return the elements from `element` on, leading away from its node `node`, and the node behind each."""
        along, through = [element], []
        while True:
            start, end = pairs[along[-1]]
            node = end if node == start else start
            through.append(node)
            beside = joined[node]
            if len(beside) != 2:
                return along, through
            following = beside[1] if beside[0] == along[-1] else beside[0]
            if following in {element, along[-1]}:
                return along, through
            along.append(following)

    left = bytearray(b"\1") * len(pairs)
    lines = []
    for element, (first, second) in enumerate(pairs):
        if not left[element]:
            continue
        back, behind = follow(element, second)
        start = behind[-1]
        closed = start == second and len(back) > 1 and len(joined[start]) == 2
        along, through = follow(element, first) if closed else follow(back[-1], start)
        nodes_along = [first if closed else start, *through]
        for each in along:
            left[each] = 0
        lines.append((np.array(along, np.intp), np.array(nodes_along, np.intp)))
    return lines


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
