"""Incidence of elements and nodes: values of nodes at the ends of elements, sums of element values at nodes.

Along most lines an element runs from one node to the next, so that slices of arrays replace indices.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from mudline.model.contact.arrays import FloatArray, IndexArray, SmallIndexArray


class Incidence:
    """The elements (m, 2) among nodes (n).

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
