"""Compiled loops for curves; needs numba, the extra `mudline[fast]`.

No reassociation, no contraction of products and sums: bit for bit the results of `NumpyLaw`. The arrays go through in
chunks that stay in the first-level cache, one plain loop per step, which is what the compiler makes vectors of.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, TypeVar, cast

import numba
import numpy as np

from mudline.curves.points import FloatArray
from mudline.curves.search import BucketTable, Knots

_COUNTED_POINTS: Final = 8
"""Up to this many points counting is as fast as a table."""

_COUNTED_IF_CROWDED: Final = 32
"""Up to this many points counting is faster than a table in which points share a bucket."""

_CHUNK: Final = 1024

Curve = tuple[FloatArray, FloatArray, FloatArray]
Function = TypeVar("Function", bound=Callable[..., object])


def compiled(function: Function, **options: bool) -> Function:
    """Compile at the first call, or load what an earlier process left in the cache; `options` are more of numba's."""
    always: Any = {"error_model": "numpy", "nogil": True, **options}
    try:
        made = numba.njit(cache=True, **always)(function)
    except RuntimeError:  # there is no place where numba may write
        made = numba.njit(**always)(function)
    return cast("Function", made)


def _passed(knots: FloatArray, value: float) -> int:
    """How many of the knots lie at or below the value; the last is infinity."""
    first, count = 0, len(knots)
    while count > 1:
        half = count // 2
        first = first + half if value >= knots[first + half - 1] else first
        count -= half
    return first


def _fill_counting(curve: Curve, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
    ratios, forces, tails = curve
    counts = np.empty(_CHUNK, np.int64)
    finite = True
    for start in range(0, len(ratio), _CHUNK):
        r, f, s = ratio[start : start + _CHUNK], force[start : start + _CHUNK], slope[start : start + _CHUNK]
        first = ratios[1]
        for j in range(len(r)):
            counts[j] = r[j] >= first
        for k in range(2, len(ratios)):
            point = ratios[k]
            for j in range(len(r)):
                counts[j] += r[j] >= point
        for j in range(len(r)):
            i = np.uint64(counts[j])
            value = forces[i] + tails[i] * (r[j] - ratios[i])
            f[j], s[j] = value, tails[i]
            finite &= np.isfinite(value)
    return finite


def _fill_bucketing(curve: Curve, table: BucketTable, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
    ratios, forces, tails = curve
    knots, below = table.knots, table.below
    addend, shift, base = table.addend, table.shift, table.base
    sums = np.empty(_CHUNK)
    keys = sums.view(np.int64)
    last = len(below) - 1
    finite = True
    for start in range(0, len(ratio), _CHUNK):
        r, f, s = ratio[start : start + _CHUNK], force[start : start + _CHUNK], slope[start : start + _CHUNK]
        for j in range(len(r)):
            sums[j] = r[j] + addend
        for j in range(len(r)):
            keys[j] = min(max((keys[j] >> shift) - base, 0), last)
        for j in range(len(r)):
            i = np.uint64(below[np.uint64(keys[j])])
            if i < len(knots):
                i += np.uint64(r[j] >= knots[i])
            else:
                i = np.uint64(passed(knots, r[j]))
            i = min(i, np.uint64(len(ratios) - 1))
            value = forces[i] + tails[i] * (r[j] - ratios[i])
            f[j], s[j] = value, tails[i]
            finite &= np.isfinite(value)
    return finite


passed = compiled(_passed)
fill_counting = compiled(_fill_counting)
fill_bucketing = compiled(_fill_bucketing)


class CompiledLaw:
    """Evaluates with one of the compiled functions."""

    def __init__(self, compiled: Callable[..., bool], *tables: Curve | BucketTable) -> None:
        self.compiled, self.tables = compiled, tables

    def fill(self, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
        """See `Law`."""
        return bool(self.compiled(*self.tables, _given(ratio), force, slope))


def _given(ratio: FloatArray) -> FloatArray:
    """The ratios as an array that may not be written: one type to compile for."""
    view = ratio.view()
    view.setflags(write=False)
    return view


def compiled_law(knots: Knots) -> CompiledLaw:
    """Return the fastest compiled law of the curve.

    It compares every ratio with every point, or looks into the table of buckets and bisects in a bucket of several.
    """
    points, curve = len(knots.inner), (knots.ratios, knots.forces, knots.tails)
    if points <= _COUNTED_POINTS or (points <= _COUNTED_IF_CROWDED and knots.prepare().crowded):
        return CompiledLaw(fill_counting, curve)
    return CompiledLaw(fill_bucketing, curve, knots.prepare())
