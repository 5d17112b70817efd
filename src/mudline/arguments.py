"""What public functions are given: what cannot be used is refused with an error that names the argument."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.short_repr import cut


def expect(value: object, name: str, kind: type | tuple[type, ...], expected: str) -> None:
    """Raise TypeError for an argument that is not of a kind, which `expected` says in words."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} must be {expected}, not {type(value).__name__}")


def several(values: object, name: str, kind: type | tuple[type, ...], expected: str) -> list[Any]:
    """An argument as a list. Raises TypeError for anything but several of a kind: one str is not its letters."""
    found = list(values) if isinstance(values, Iterable) and not isinstance(values, str | bytes) else None
    if found is None or not all(isinstance(each, kind) for each in found):
        raise TypeError(f"{name} must be {expected}, not {cut(repr(values), 60)}")
    return found


def as_array(values: ArrayLike, name: str) -> NDArray[Any]:
    """An argument as an array. Raises ValueError for rows of different lengths."""
    try:
        return np.asarray(values)
    except ValueError as error:
        raise ValueError(f"{name} must be an array: {error}") from error


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A view of an array that others hold too, through which it cannot be changed."""
    view = array.view()
    view.flags.writeable = False
    return view
