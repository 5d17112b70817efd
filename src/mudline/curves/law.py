"""Force and slope of a block of ratios, by numpy alone or by compiled loops, and the ratios that have none.

Loading numba takes about a second, so the compiled loops are loaded by the first query that is large enough to make
more of them likely; once they are loaded, they also serve smaller ones.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from typing import Literal, NoReturn, Protocol, cast

import numpy as np

from mudline.curves.points import FloatArray, IndexArray, QueryError
from mudline.curves.search import Knots, Search, Workspace, search_for

Backend = Literal["auto", "numpy", "fast"]

_COMPILED = "mudline.curves.compiled"

_WORTH_LOADING = 2**22
_WORTH_CALLING = 2**12


class Law(Protocol):
    """A way to evaluate a curve.

    All ways do the same operations in the same order and round after each, so that they agree bit for bit.
    """

    def fill(self, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
        """Write force and slope at each ratio; return whether every force is finite."""
        ...


class NumpyLaw:
    """Evaluates with numpy alone."""

    def __init__(self, knots: Knots, search: Search, work: Workspace) -> None:
        self._knots = knots
        self._search = search
        self._work = work

    def fill(self, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
        """See `Law`."""
        knots, work, size = self._knots, self._work, len(ratio)
        point = self._search.passed(ratio)
        offset = work.real[:size]
        np.take(knots.ratios, point, out=offset, mode="clip")
        np.subtract(ratio, offset, out=offset)
        np.take(knots.tails, point, out=slope, mode="clip")
        np.multiply(offset, slope, out=offset)
        np.take(knots.forces, point, out=force, mode="clip")
        np.add(force, offset, out=force)
        return bool(np.isfinite(force, out=work.flag[:size]).all())


def law_for(knots: Knots, total: int, work: Workspace, backend: Backend = "auto") -> Law:
    """Return the way to evaluate a query of `total` ratios.

    Raises:
        ImportError: `backend` is "fast", but the extra `mudline[fast]` is not installed.
        ValueError: `backend` is unknown.
    """
    if backend not in ("auto", "numpy", "fast"):
        raise ValueError(f"backend must be auto, numpy or fast, not {backend!r}")
    if backend == "fast" or (backend == "auto" and _pays(total)):
        return cast("Law", import_module(_COMPILED).compiled_law(knots))
    return NumpyLaw(knots, search_for(knots, total, work), work)


def _pays(total: int) -> bool:
    return total >= _WORTH_CALLING and (_COMPILED in sys.modules or (total >= _WORTH_LOADING and _loads()))


@cache
def _loads() -> bool:
    try:
        import_module(_COMPILED)
    except ImportError:
        return False
    return True


def recompute_overflowed(knots: Knots, ratio: FloatArray, force: FloatArray) -> IndexArray:
    """Compute again the forces that are not finite; return where they still are not.

    Only an intermediate value may have overflowed: added in two halves the force may well be finite.
    """
    where = np.flatnonzero(~np.isfinite(force))
    at = np.minimum(np.searchsorted(knots.inner, ratio[where], side="right"), len(knots.inner))
    half = knots.tails[at] * (0.5 * ratio[where] - 0.5 * knots.ratios[at])
    force[where] = knots.forces[at] + half + half
    found: IndexArray = where[~np.isfinite(force[where])]
    return found


def refuse_infinite(ratio: FloatArray, start: int) -> None:
    """Check that ratios are finite, for queries that compute no force.

    Raises:
        QueryError: a ratio is NaN or infinite; `start` is the index of the first ratio in the query.
    """
    finite = np.isfinite(ratio)
    if not finite.all():
        refuse(ratio, int(np.argmin(finite)), start)


def refuse(ratio: FloatArray, index: int, start: int) -> NoReturn:
    """Raise the QueryError of a ratio; `start` is the index of the first ratio in the query."""
    value = float(ratio[index])
    why = "the force there overflows" if np.isfinite(value) else "it is not finite"
    raise QueryError(start + index, value, f"no force at ratio {value!r} (index {start + index}): {why}")
