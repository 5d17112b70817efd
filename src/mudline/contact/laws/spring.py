"""What every normal law gives, and how it is asked."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray, Picked


class LawError(ValueError):
    """A law has no finite value; `index` says for which of the points it was asked."""

    def __init__(self, message: str, index: int) -> None:
        super().__init__(message)
        self.index = index


class Spring(NamedTuple):
    """Reaction of points in contact, all arrays (k,).

    force: per unit length, positive pushing out of the bed.
    slope: d force / d embedment ratio, per unit length; NaN without a diameter.
    stiffness: d force / d penetration, per unit length and length of penetration.
    cut: where a pulling force was set to 0, or None for a law that never does so.
    """

    force: FloatArray
    slope: FloatArray
    stiffness: FloatArray
    cut: BoolArray | None = None

    def checked(self) -> Spring:
        """Return the spring itself.

        Raises:
            LawError: a value overflows.
        """
        for what, values in (("force", self.force), ("slope", self.slope), ("stiffness", self.stiffness)):
            infinite = np.isinf(values)
            if infinite.any():
                raise LawError(f"its {what} overflows", int(infinite.argmax()))
        return self


class Springs(Protocol):
    """The elements that share a law."""

    @property
    def elements(self) -> IndexArray:
        """Indices of the elements."""

    def spring(self, element: Picked, depth: FloatArray, ratio: FloatArray) -> Spring:
        """Return the reaction of `element` (k,), each in contact at its depth and ratio (k,); an element may repeat.

        A slice stands for elements that follow each other; depth and ratio may then have a leading (steps,).

        Raises:
            LawError: a value overflows.
        """
