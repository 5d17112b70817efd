"""Lateral springs of elements, LATERAL= of `*SEABED PROPERTIES`: they pull to where it touched down (INFERRED).

The spring acts per unit length at the middle of an element that is in contact, along n x t, where t is the element's
direction and n the mean normal of the bed at its nodes, half of the force to each node.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.friction.directions import axial, in_plane, senses
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult
from mudline.contact.vectors import added_at, dot, scaled


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
        self._ends = inputs.element_nodes[self._elements]
        with np.errstate(over="ignore"):  # a step refuses the reaction
            self._stiffness = stiffness[self._elements] * inputs.length[self._elements]
        self._all = inputs.element_nodes
        self._sense = senses(inputs.element_nodes, len(inputs.node_ids))

    def initial(self) -> FloatArray:
        """No element has touched down."""
        return np.full((len(self._all), 3), np.nan)

    def apply(
        self, part: ContactResult, points: FloatArray, touchdown: FloatArray
    ) -> tuple[LateralSprings, FloatArray]:
        """Add to the reaction of the one step of `part`; return the springs and the touchdown points (m, 3)."""
        touches = part.contact[0, self._elements]
        elements, ends = self._elements[touches], self._ends[touches]
        first, second = points[ends[:, 0]], points[ends[:, 1]]
        middle = 0.5 * first + 0.5 * second
        held = touchdown[elements]
        new = np.isnan(held[:, 0])
        held = np.where(new[:, None], middle, held)
        mean = part.normal[0, ends[:, 0]] + part.normal[0, ends[:, 1]]
        mean = mean / np.sqrt(dot(mean, mean))[:, None]
        across = in_plane(second - first, mean)[1]
        arm = middle - held
        stiffness = np.where(new, 0.0, self._stiffness[touches])  # where it touches down there is no force yet
        springs = LateralSprings(elements, stiffness, across, dot(across, arm), arm)
        share = scaled(across, -0.5 * springs.stiffness * springs.elongation)
        forces = added_at(list(ends.T), share, len(points))
        part.reaction[0] += forces
        if part.friction is not None:
            _, lateral = axial(points, self._all, part.normal[0], self._sense)
            part.friction[0, :, 1] += dot(forces, lateral)
        after = self.initial()
        after[elements] = held
        return springs, after
