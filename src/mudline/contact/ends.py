"""The two nodes of each element: values of nodes at elements, and sums of values of elements at nodes."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray


class Ends:
    """The ends of elements (m, 2) among nodes (n).

    Where element k runs from node k to node k + 1, as along most lines, parts of arrays do instead of indices.

    Attributes:
        first, second: the nodes (m,) of each end.
    """

    def __init__(self, element_nodes: IndexArray, nodes: int) -> None:
        self.first, self.second = np.ascontiguousarray(element_nodes.T, np.intp)
        count = len(element_nodes)
        self._nodes = nodes
        self._chained = slice(0, count), slice(1, count + 1)
        order = np.arange(count)
        self._chain = bool((self.first == order).all() and (self.second == order + 1).all())

    def at(self, values: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Values (..., m) at the first and at the second ends, of those of the nodes (..., n); maybe views."""
        if self._chain:
            first, second = self._chained
            return values[..., first], values[..., second]
        return values[..., self.first], values[..., self.second]

    def summed(self, at_first: FloatArray, at_second: FloatArray) -> FloatArray:
        """Sums (n,) at the nodes of values (m,) of each end, in the order of the elements."""
        total = np.zeros(self._nodes)
        if self._chain:
            for part, values in zip(self._chained, (at_first, at_second), strict=True):
                total[part] += values
        else:
            total += np.bincount(self.first, at_first, self._nodes)
            total += np.bincount(self.second, at_second, self._nodes)
        return total

    def add(self, values: FloatArray, at_nodes: FloatArray) -> None:
        """Add values (steps, m) of elements at both of their nodes to `at_nodes` (steps, n), in one piece of memory."""
        if self._chain:
            for part in self._chained:
                at_nodes[:, part] += values
            return
        total, row = at_nodes.reshape(-1), self._nodes * np.arange(len(at_nodes))[:, np.newaxis]
        for end in (self.first, self.second):
            total += np.bincount((row + end).reshape(-1), values.reshape(-1), len(total))
