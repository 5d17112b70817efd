"""Incidence of elements and nodes: values of nodes at the ends of elements, sums of element values at nodes.

Along most lines an element runs from one node to the next, so that slices of arrays replace indices. Slices also serve
several lines, and a GEN= that numbers the ends of a line before the nodes between them.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray, IndexArray, SmallIndexArray

_FEW_RUNS = 16
"""Number of runs below which slices of arrays are copied one by one."""


class _ElementRun(NamedTuple):
    """Elements start <= e < stop whose nodes are e + first and e + second."""

    start: int
    stop: int
    first: int
    second: int


_Parts = list[tuple[slice, slice]]


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
        self._runs = _runs(self.first, self.second)
        self._chain = self._runs is not None and [*self._runs] == [_ElementRun(0, nodes - 1, 0, 1)]
        self._element_parts: dict[tuple[int, int], tuple[_Parts, _Parts]] = {}
        self._node_parts: dict[tuple[int, int], tuple[_Parts, _Parts]] = {}
        self._pair: tuple[IndexArray, FloatArray] | None = None if self._runs else _first_two(self)

    @cached_property
    def beside(self) -> IndexArray:
        """The first two elements (n, 2) at each node, -1 for a missing element."""
        padded, degree = np.append(self.elements, [-1, -1]), np.diff(self.start)
        pair = np.stack([padded[self.start[:-1]], padded[self.start[:-1] + 1]], axis=1).astype(np.intp)
        pair[degree < 2, 1] = pair[degree < 1, 0] = -1
        return pair

    def at(self, values: FloatArray, begin: int, end: int) -> tuple[FloatArray, FloatArray]:
        """Return values (steps, end - begin) at both ends of a range of elements, from values (steps, n) at nodes."""
        if self._runs is None:
            return values.take(self.first[begin:end], axis=1), values.take(self.second[begin:end], axis=1)
        if (key := (begin, end)) not in self._element_parts:
            self._element_parts[key] = _parts(self._runs, begin, end, of_nodes=False)
        parts = self._element_parts[key]
        if len(parts[0]) == 1:
            return values[:, parts[0][0][1]], values[:, parts[1][0][1]]
        found = np.empty((2, len(values), end - begin))
        for target, side in zip(found, parts, strict=True):
            for here, there in side:
                target[:, here] = values[:, there]
        return found[0], found[1]

    def sums(self, values: FloatArray, begin: int, end: int, *, directed: bool = False) -> FloatArray:
        """Return sums (steps, end - begin) at a range of nodes of the values (steps, m + 2) of their elements.

        The values stand between two columns of zeros, and are added in the order of `elements`. With `directed` each
        value is multiplied by its sense.
        """
        directed = directed and self.turns
        if self._pair is not None:
            total = np.zeros((len(values), end - begin))
            for elements, senses in zip(*(part[:, begin:end] for part in self._pair), strict=True):
                total += values.take(elements, axis=1) * senses if directed else values.take(elements, axis=1)
        else:
            total = self._summed_parts(values, begin, end)
            if directed:
                self._add_turned(total, values, begin)
        self._add_at_junctions(total, values, begin)
        return total

    def _summed_parts(self, values: FloatArray, begin: int, end: int) -> FloatArray:
        if (key := (begin, end)) not in self._node_parts:
            self._node_parts[key] = _parts(self._runs or [], begin, end, of_nodes=True)
        parts = self._node_parts[key]
        if self._chain:
            total: FloatArray = values[:, begin + 1 : end + 1] + values[:, begin:end]
            total += 0.0
            return total
        total = np.zeros((len(values), end - begin))
        for side in parts:
            for here, there in side:
                total[:, here] += values[:, 1 + there.start : 1 + there.stop]
        return total

    def _add_turned(self, total: FloatArray, values: FloatArray, begin: int) -> None:
        """Repeat the sum at nodes where both elements begin or both end."""
        nodes = np.flatnonzero(self.senses[self.start[:-1][np.diff(self.start) == 2] + 1] < 0.0)
        nodes = np.flatnonzero(np.diff(self.start) == 2)[nodes]
        low, high = np.searchsorted(nodes, [begin, begin + total.shape[1]])
        first = self.start[nodes[low:high]]
        first_element, second_element = 1 + self.elements[first], 1 + self.elements[first + 1]
        total[:, nodes[low:high] - begin] = (0.0 + values[:, first_element]) - values[:, second_element]

    def _add_at_junctions(self, total: FloatArray, values: FloatArray, begin: int) -> None:
        """Repeat the sum at nodes of three or more elements, in the order of `elements`."""
        if not self._junctions.size:
            return
        low, high = np.searchsorted(self._junctions, [begin, begin + total.shape[1]])
        for node in self._junctions[low:high].tolist():
            sums = np.zeros(len(total))
            for element in self.elements[self.start[node] : self.start[node + 1]].tolist():
                sums += values[:, 1 + element]
            total[:, node - begin] = sums


def _first_two(line: Incidence) -> tuple[IndexArray, FloatArray]:
    """Return the first two elements (2, n) at each node and their senses; a missing element is the column of zeros."""
    senses = np.append(line.senses, [1.0] * 2)
    pair = 1 + np.where(line.beside < 0, len(line.first), line.beside).T
    return pair, np.stack([senses[line.start[:-1]], senses[line.start[:-1] + 1]])


def _runs(first: IndexArray, second: IndexArray) -> list[_ElementRun] | None:
    """Return runs of elements whose two nodes both increase by one; None if there are many runs."""
    count = len(first)
    breaks = np.flatnonzero((np.diff(first) != 1) | (np.diff(second) != 1)) + 1
    if len(breaks) >= _FEW_RUNS:
        return None
    starts, stops = [0, *breaks.tolist()], [*breaks.tolist(), count]
    return [
        _ElementRun(start, stop, int(first[start]) - start, int(second[start]) - start)
        for start, stop in zip(starts, stops, strict=True)
        if start < stop
    ]


def _parts(runs: list[_ElementRun], begin: int, end: int, *, of_nodes: bool) -> tuple[_Parts, _Parts]:
    """Return for both ends of a range of elements slices of elements and of their nodes.

    With `of_nodes` return slices of a range of nodes and of the elements that begin, and that end, there.
    """
    parts: tuple[_Parts, _Parts] = ([], [])
    for run in runs:
        for side, shift in zip(parts, (run.first, run.second), strict=True):
            here, there = (shift, -shift) if of_nodes else (0, shift)
            low, high = max(run.start + here, begin), min(run.stop + here, end)
            if low < high:
                side.append((slice(low - begin, high - begin), slice(low + there, high + there)))
    return parts
