"""Lateral springs of elements, LATERAL= of `*SEABED PROPERTIES`: they pull to where it touched down (INFERRED).

The spring acts per unit length at the middle of an element that is in contact, along n x t, where t is the element's
direction and n the mean normal of the bed at its nodes, half of the force to each node.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.friction.directions import in_plane
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.vectors import added_at, dot, gathered, scaled


class LateralSprings(NamedTuple):
    """Springs of one step: their elements (k,), stiffness L k (k,), directions (k, 3) and elongations (k,).

    `arm` (k, 3) is the way from the touchdown point to the middle of the element.
    """

    elements: IndexArray
    stiffness: FloatArray
    direction: FloatArray
    elongation: FloatArray
    arm: FloatArray


class LateralStage:
    """The elements that have a lateral spring; `stiffness` (m,) is NaN or 0 for the others."""

    def __init__(self, inputs: ContactInput, stiffness: FloatArray) -> None:
        self._elements: IndexArray = np.flatnonzero(stiffness > 0.0)
        self._ends = np.ascontiguousarray(inputs.element_nodes[self._elements].T)
        with np.errstate(over="ignore"):  # a step refuses the reaction
            self._stiffness = stiffness[self._elements] * inputs.length[self._elements]
        self._count = len(inputs.element_nodes)

    def initial(self) -> FloatArray:
        """No element has touched down."""
        return np.full((3, self._count), np.nan).T

    def apply(
        self,
        part: ContactResult,
        points: FloatArray,
        along: tuple[FloatArray, FloatArray],
        touchdown: FloatArray,
    ) -> tuple[LateralSprings, FloatArray]:
        """Add to the reaction of the one step of `part`; return the springs and the touchdown points (m, 3).

        `along` are the directions of the line and across it at the nodes.
        """
        (touches,) = part.contact[0][self._elements].nonzero()
        elements = self._elements[touches]
        first, second = (end[touches] for end in self._ends)
        start, end = gathered(points, first), gathered(points, second)
        middle = 0.5 * start
        middle += 0.5 * end
        held = gathered(touchdown, elements)
        new = np.isnan(held[:, 0])
        if new.any():
            held = np.where(new[:, None], middle, held)
        mean = _mean_normal(part.normal[0], first, second)
        end -= start
        across = in_plane(end, np.broadcast_to(mean, end.shape))[1]
        middle -= held
        stiffness = np.where(new, 0.0, self._stiffness[touches])  # where it touches down there is no force yet
        springs = LateralSprings(elements, stiffness, across, dot(across, middle), middle)
        share = scaled(across, -0.5 * springs.stiffness * springs.elongation)
        forces = added_at([first, second], share, len(points))
        part.reaction[0] += forces
        if part.friction is not None:
            part.friction[0, :, 1] += dot(forces, along[1])
        return springs, self._touched(elements, held)

    def _touched(self, elements: IndexArray, held: FloatArray) -> FloatArray:
        after = self.initial()
        for column, values in zip(after.T, held.T, strict=True):
            column[elements] = values
        return after


def _mean_normal(normals: FloatArray, first: IndexArray, second: IndexArray) -> FloatArray:
    """The mean of the unit normals (n, 3) at the two ends (k,) of elements."""
    if normals.strides[0] == 0:  # one for all nodes
        first = second = np.zeros(1, np.intp)
    mean = gathered(normals, first)
    mean += gathered(normals, second)
    mean /= np.sqrt(dot(mean, mean))[:, None]
    return mean
