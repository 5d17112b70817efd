"""Whether a series is stepped through by the stages, with numpy alone, or by compiled loops.

The choice depends on the size of a series alone, not on what was done before: the two agree to rounding only.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import Literal

Backend = Literal["auto", "numpy", "fast"]

_WORTH_LOADING = 2**26
"""Nodes times steps from which on the loops save some ten seconds: about what it takes to compile them, once."""


def checked(backend: Backend) -> Backend:
    """Return the backend itself.

    Raises:
        ImportError: it is "fast", but the extra `mudline[fast]` is not installed.
        ValueError: there is no such backend.
    """
    if backend not in ("auto", "numpy", "fast"):
        raise ValueError(f"backend must be auto, numpy or fast, not {backend!r}")
    if backend == "fast":
        import_module("numba")
    return backend


def compiles(backend: Backend, total: int) -> bool:
    """Whether `total` nodes times steps are for the compiled loops."""
    return backend == "fast" or (backend == "auto" and total >= _WORTH_LOADING and _loads())


@cache
def _loads() -> bool:
    try:
        import_module("numba")
    except ImportError:
        return False
    return True
