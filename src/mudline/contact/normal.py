"""Stage `normal law`: the springs of the bed, applied where elements are in contact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mudline.contact.arrays import BoolArray, IndexArray
from mudline.contact.errors import ElementError
from mudline.contact.inputs import ContactInput
from mudline.contact.laws.spring import LawError, Springs
from mudline.contact.result import ContactResult


class NormalLaw:
    """All springs of an input; `elements` are the indices of the elements that have one, ascending."""

    def __init__(self, inputs: ContactInput, springs: Sequence[Springs]) -> None:
        self._ids = inputs.element_ids
        self._groups = [(group, self._mask(group.elements)) for group in springs]
        self.elements = np.sort(np.concatenate([group.elements for group in springs]))

    def apply(self, part: ContactResult, first_step: int) -> None:
        """Write force, slope, stiffness and cut of `part` (steps, m) where its `contact` holds.

        Raises:
            ElementError: a value overflows.
        """
        for springs, mask in self._groups:
            self._apply_group(springs, np.flatnonzero(part.contact & mask), part, first_step)

    def _apply_group(self, springs: Springs, where: IndexArray, part: ContactResult, first_step: int) -> None:
        """Apply one law at the flat positions `where` of (steps, m)."""
        if not where.size:
            return
        element = where % len(self._ids)
        depth, ratio = part.depth.reshape(-1)[where], part.ratio.reshape(-1)[where]
        try:
            spring = springs.spring(element, depth, ratio)
        except LawError as error:
            culprit = int(self._ids[element[error.index]])
            step = first_step + int(where[error.index]) // len(self._ids)
            raise ElementError(f"element {culprit} at step {step}: {error}", culprit, step) from error
        part.force.reshape(-1)[where] = spring.force
        part.slope.reshape(-1)[where] = spring.slope
        part.stiffness.reshape(-1)[where] = spring.stiffness
        if spring.cut is not None:
            part.cut.reshape(-1)[where] = spring.cut

    def _mask(self, elements: IndexArray) -> BoolArray:
        mask = np.zeros(len(self._ids), np.bool_)
        mask[elements] = True
        return mask
