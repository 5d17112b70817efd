"""The results of the evaluator for elements on one curve in plain numpy, a line for each result.

Nothing is checked, and there is no history, no other law and no seabed but the flat one. Results have the same bits as
those of the evaluator, which the study verifies before it compares times.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.input import ContactInput
from mudline.contact.result import ContactResult
from mudline.curves import ForceCurve


class PlainResult(NamedTuple):
    """What a `ContactResult` has, by the same names, for positions (n, 3) or (steps, n, 3)."""

    gap: FloatArray
    normal: FloatArray
    depth: FloatArray
    ratio: FloatArray
    contact: BoolArray
    cut: BoolArray
    force: FloatArray
    slope: FloatArray
    stiffness: FloatArray
    normal_force: FloatArray
    reaction: FloatArray
    evaluated: BoolArray
    present: BoolArray

    def equals(self, result: ContactResult) -> bool:
        """Whether all numbers are those of the evaluator, bit by bit."""
        pairs = [(mine, np.asarray(getattr(result, name))) for name, mine in self._asdict().items()]
        return all(mine.shape == other.shape and mine.tobytes() == other.tobytes() for mine, other in pairs)


class Plain(NamedTuple):
    """Elements on one curve.

    first, second: the nodes of each element: ranges for a chain, else indices.
    half: half of the lengths.
    unbranched: no two elements begin at the same node, and no two end there.
    """

    curve: ForceCurve
    first: Any
    second: Any
    diameter: FloatArray
    half: FloatArray
    unbranched: bool

    @classmethod
    def of(cls, inputs: ContactInput) -> Plain:
        """Of an input whose elements all have its first curve."""
        nodes = inputs.element_nodes
        row, half = np.arange(len(nodes)), 0.5 * inputs.length
        if np.array_equal(nodes, np.column_stack([row, row + 1])) and len(inputs.node_ids) == len(nodes) + 1:
            return cls(inputs.curves[0], slice(None, -1), slice(1, None), inputs.diameter, half, unbranched=True)
        unbranched = all(len(np.unique(ends)) == len(ends) for ends in nodes.T)
        return cls(inputs.curves[0], nodes[:, 0].copy(), nodes[:, 1].copy(), inputs.diameter, half, unbranched)

    def evaluate(self, points: FloatArray) -> PlainResult:
        """All results of positions (n, 3) or (steps, n, 3)."""
        gap = points[..., 0].copy()
        depth = -0.5 * (gap[..., self.first] + gap[..., self.second])
        ratio = depth / self.diameter
        contact = depth > 0.0
        force, slope = self.curve.evaluate(ratio)
        force[~contact] = slope[~contact] = 0.0
        stiffness = slope / self.diameter
        normal_force = self._at_nodes(self.half * force, gap.shape)
        reaction = np.zeros(points.shape)
        reaction[..., 0] = normal_force
        normal = np.broadcast_to(np.array([1.0, 0.0, 0.0]), points.shape)
        cut, elements, nodes = np.zeros(contact.shape, np.bool_), contact.shape[-1], gap.shape[-1]
        whole = np.ones(elements, np.bool_), np.ones(nodes, np.bool_)
        return PlainResult(
            gap, normal, depth, ratio, contact, cut, force, slope, stiffness, normal_force, reaction, *whole
        )

    def _at_nodes(self, share: FloatArray, shape: tuple[int, ...]) -> FloatArray:
        """The sum of the shares of its elements at each node."""
        total = np.zeros(shape)
        if self.unbranched:
            total[..., self.first] += share
            total[..., self.second] += share
        else:
            np.add.at(total.T, self.first, share.T)
            np.add.at(total.T, self.second, share.T)
        return total
