"""Array types, arrays that do not change, and the check that a user gave real numbers."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

Number = TypeVar("Number", bound=np.generic)


def read_only(array: NDArray[Number]) -> NDArray[Number]:
    """Return the array itself, from now on read-only."""
    array.setflags(write=False)
    return array


def real_numbers(values: ArrayLike, what: str) -> NDArray[np.generic]:
    """Return `values` as an array of booleans, integers or floats.

    Raises:
        ValueError: they are something else; `what` is what the message calls them.
    """
    array: NDArray[np.generic] = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{what} must be real numbers, not {array.dtype}")
    return array
