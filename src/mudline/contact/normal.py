"""Stage `normal law`: the springs of the bed, applied where elements are in contact."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mudline.contact.arrays import IndexArray, Picked, as_range
from mudline.contact.errors import ElementError
from mudline.contact.inputs import ContactInput
from mudline.contact.laws.spring import LawError, Spring, Springs
from mudline.contact.result import ContactResult

_BLOCK = 16384
"""Elements at a time: the work arrays stay in the second-level cache."""


class NormalLaw:
    """All springs of an input; `elements` are the indices of the elements that have one, ascending."""

    def __init__(self, inputs: ContactInput, springs: Sequence[Springs]) -> None:
        self._ids = inputs.element_ids
        self._pieces = [(group, piece) for group in springs for piece in _pieces(group.elements)]
        self.elements = np.sort(np.concatenate([group.elements for group in springs]))

    def apply(self, part: ContactResult, first_step: int) -> None:
        """Write force, slope, stiffness and cut of `part` (steps, m) where its `contact` holds.

        Raises:
            ElementError: a value overflows.
        """
        for springs, piece in self._pieces:
            touches = part.contact[:, piece]
            if not (isinstance(piece, slice) and touches.all() and _apply_all(springs, piece, part)):
                self._apply_some(springs, piece, np.flatnonzero(touches), part, first_step)

    def _apply_some(
        self, springs: Springs, piece: Picked, where: IndexArray, part: ContactResult, first_step: int
    ) -> None:
        """Apply one law at the flat positions `where` of (steps, piece)."""
        if not where.size:
            return
        size = piece.stop - piece.start if isinstance(piece, slice) else len(piece)
        rows, columns = (0, where) if len(part.force) == 1 else np.divmod(where, size)
        element = columns + piece.start if isinstance(piece, slice) else piece[columns]
        at = (rows, element)
        try:
            spring = springs.spring(element, part.depth[at], part.ratio[at])
        except LawError as error:
            culprit = int(self._ids[element[error.index]])
            step = first_step + int(where[error.index]) // size
            raise ElementError(f"element {culprit} at step {step}: {error}", culprit, step) from error
        _put(spring, at, part)


def _apply_all(springs: Springs, piece: slice, part: ContactResult) -> bool:
    """Apply one law to elements that all touch; False where something overflows, and who it is must be found."""
    at = (slice(None), piece)
    try:
        spring = springs.spring(piece, part.depth[at], part.ratio[at])
    except LawError:
        return False
    _put(spring, at, part)
    return True


def _put(spring: Spring, at: tuple[int | Picked, Picked], part: ContactResult) -> None:
    part.force[at] = spring.force
    part.slope[at] = spring.slope
    part.stiffness[at] = spring.stiffness
    if spring.cut is not None:
        part.cut[at] = spring.cut


def _pieces(elements: IndexArray) -> Iterator[Picked]:
    for start in range(0, len(elements), _BLOCK):
        yield as_range(elements[start : start + _BLOCK])
