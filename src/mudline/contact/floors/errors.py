"""What can be wrong with a sea floor, and the checks that find it."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray

LARGEST = 1e150
"""Largest magnitude of a coordinate of a floor: differences and squares stay finite."""


class FloorError(ValueError):
    """A sea floor cannot be made from the numbers given."""


def checked(what: str, values: ArrayLike, *shape: int | None) -> FloatArray:
    """Return a copy of `values` as floats of `shape` (None: any length); FloorError when they are not or not finite."""
    array = np.array(values, np.float64)
    if array.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, array.shape, strict=True)):
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise FloorError(f"{what} has shape {array.shape}; expected ({wanted})")
    wrong = np.argwhere(~(np.abs(array) <= LARGEST))
    if len(wrong):
        index = tuple(wrong[0].tolist())
        place = f" of point {index[0] + 1}" if index else ""
        raise FloorError(f"{what}{place} is {array[index]}; expected a finite number of magnitude up to {LARGEST:g}")
    return array


def checked_slope(what: str, degrees: float) -> None:
    """Raise FloorError when a slope in degrees is not between -90 and 90, both excluded."""
    if not abs(degrees) < 90.0:
        raise FloorError(f"{what} is {degrees:g} degrees; expected more than -90 and less than 90: a bed has no walls")
