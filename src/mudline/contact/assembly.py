"""Stage `assembly`: element forces become normal forces of nodes.

An element of length L and force f per unit length gives f L / 2 to each of its two nodes, also to one above the bed,
along the normal of the bed at that node.
"""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.ends import Ends
from mudline.contact.errors import ElementError
from mudline.contact.inputs import ContactInput
from mudline.contact.result import ContactResult


class Assembly:
    """Adds up the forces of `elements` (indices) at their nodes."""

    def __init__(self, inputs: ContactInput, elements: IndexArray) -> None:
        self._element_ids = inputs.element_ids[elements]
        self._elements = None if len(elements) == len(inputs.element_ids) else elements
        self._ends = Ends(inputs.element_nodes[elements], len(inputs.node_ids))
        self._half_length = 0.5 * inputs.length[elements]

    def apply(self, part: ContactResult, first_step: int) -> None:
        """Write `normal_force` (steps, n) of `part` from its `force` (steps, m).

        Raises:
            ElementError: an element's force or the sum at a node overflows.
        """
        force = part.force if self._elements is None else np.take(part.force, self._elements, axis=1)
        load = force * self._half_length
        self._check(load, first_step)
        # in the order of the elements, so a step's sum does not depend on the steps beside it
        self._ends.add(load, part.normal_force)
        if not np.isfinite(part.normal_force).all():
            for at_end in self._ends.at(part.normal_force):
                self._check(at_end, first_step)

    def _check(self, values: FloatArray, first_step: int) -> None:
        """Refuse values (steps, elements) that overflowed."""
        finite = np.isfinite(values)
        if not finite.all():
            step, column = (int(index) for index in np.argwhere(~finite)[0])
            culprit, step = int(self._element_ids[column]), first_step + step
            raise ElementError(f"element {culprit} at step {step}: the reaction at its nodes overflows", culprit, step)
