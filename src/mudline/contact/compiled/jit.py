"""How the loops are compiled: no reassociation, no contraction of products and sums, divisions as numpy does them."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from importlib.resources import files
from typing import TypeVar, cast

import numba

Function = TypeVar("Function", bound=Callable[..., object])


def jitted(function: Function) -> Function:
    """Compile for whatever arguments a compiled caller has."""
    return cast("Function", numba.njit(error_model="numpy", nogil=True)(function))


def compiled(function: Function, example: tuple[object, ...]) -> Function:
    """Compile for arguments like these, or load what an earlier process left in the cache."""
    signature = tuple(cast("Callable[[object], object]", numba.typeof)(argument) for argument in example)
    try:
        made = numba.njit([signature], cache=True, error_model="numpy", nogil=True)(function)
    except RuntimeError:
        # There is no place where numba may write.
        made = numba.njit([signature], error_model="numpy", nogil=True)(function)
    return cast("Function", made)


def edition() -> int:
    """A number that changes with any file of this package."""
    digest = hashlib.sha256()
    for file in sorted(files(__package__).iterdir(), key=lambda entry: entry.name):
        if file.name.endswith(".py"):
            digest.update(file.read_bytes())
    return int.from_bytes(digest.digest()[:4], "big")
