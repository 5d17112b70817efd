"""What public functions are given: what cannot be used is refused with an error that names the argument."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.short_repr import cut


class ArgumentKindError(TypeError, ValueError):
    """An argument is not of the kind that is expected: for callers that catch either."""


class ArgumentRangeError(IndexError, ValueError):
    """A number of something that is not there."""


def expect(value: object, name: str, kind: type | tuple[type, ...], expected: str) -> None:
    """Raise ArgumentKindError for an argument that is not of a kind, which `expected` says in words."""
    if not isinstance(value, kind):
        raise ArgumentKindError(f"{name} must be {expected}, not {type(value).__name__}")


def expect_word(value: object, name: str, allowed: tuple[str, ...], expected: str) -> None:
    """Raise ValueError for an argument that is not one of the allowed words, which `expected` lists."""
    if not isinstance(value, str) or value not in allowed:
        raise ValueError(f"{name} must be {expected}, not {cut(repr(value), 60)}")


def expect_number(value: object, name: str, *, or_zero: bool = False) -> None:
    """Raise ValueError for an argument that is not a number above 0, or 0 where it may be."""
    expect(value, name, (int, float), "a number")
    number = cast("float", value)
    if not (0.0 < number < math.inf or (or_zero and number == 0.0)):
        raise ValueError(f"{name} must be a number {'of 0 or more' if or_zero else 'above 0'}, not {value!r}")


def several(values: object, name: str, kind: type | tuple[type, ...], expected: str) -> list[Any]:
    """An argument as a list. Raises ArgumentKindError for what is not several of a kind: one str is not its letters."""
    found = list(values) if isinstance(values, Iterable) and not isinstance(values, str | bytes) else None
    if found is None or not all(isinstance(each, kind) for each in found):
        raise ArgumentKindError(f"{name} must be {expected}, not {cut(repr(values), 60)}")
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
