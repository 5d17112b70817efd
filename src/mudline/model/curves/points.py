"""Points of a curve: sorted and checked, with the slopes between them; the errors that curves raise."""

from __future__ import annotations

from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.arguments import as_array

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

Number = TypeVar("Number", bound=np.generic)


def read_only(array: NDArray[Number]) -> NDArray[Number]:
    """Make an array read-only, and return it."""
    array.setflags(write=False)
    return array


def real_numbers(values: ArrayLike, what: str) -> NDArray[np.generic]:
    """Return `values` as an array of booleans, integers or floats.

    Raises:
        ValueError: they are something else; `what` is their name in the message.
    """
    array: NDArray[np.generic] = as_array(values, what)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{what} must be real numbers, not {array.dtype}")
    return array


class CurveError(ValueError):
    """Points that do not make a curve.

    Attributes:
        code: rule code of the fault: `SYN002` (a number that is not finite), `CRV001` (fewer than two distinct points),
            `CRV003` (two forces at one ratio), `CRV011` (a width or a slope that a float64 cannot hold).
        index: the wrong point in the order given, from 0; of two points the later one; -1 for the whole curve.
    """

    def __init__(self, code: str, index: int, message: str) -> None:
        super().__init__(message)
        self.code = code
        self.index = index

    def __reduce__(self) -> tuple[type[CurveError], tuple[str, int, str]]:
        return type(self), (self.code, self.index, str(self))


_NORMAL = float(np.finfo(np.float64).tiny)


class CurvePoints(NamedTuple):
    """Sorted points without repeats, and the slopes between them.

    Attributes:
        ratios: (n,) strictly ascending, n >= 2.
        forces: (n,) forces at the ratios.
        slopes: (n - 1,) slopes; a slope is 0 or normal.
    """

    ratios: FloatArray
    forces: FloatArray
    slopes: FloatArray


def checked_points(points: ArrayLike) -> CurvePoints:
    """Sort and check `points`: pairs (ratio, force) in any order; a repeated pair counts once.

    Raises:
        CurveError: the points do not make a curve.
        ValueError: the points are not pairs of real numbers.
    """
    pairs = _pairs(points)
    order = np.arange(len(pairs))
    if np.count_nonzero(pairs[1:, 0] > pairs[:-1, 0]) < len(pairs) - 1:
        order = pairs[:, 0].argsort(kind="stable")
        order = order[_first_of_each_ratio(pairs, order)]
    if len(order) < 2:
        raise CurveError("CRV001", -1, f"a curve needs two distinct points or more, not {len(order)}")
    ratios, forces = pairs[:, 0].take(order), pairs[:, 1].take(order)
    return CurvePoints(ratios, forces, _slopes(ratios, forces, order))


def _pairs(points: ArrayLike) -> FloatArray:
    """Return the points as an (n, 2) float64 array, every number finite, no negative zeros."""
    array = real_numbers(points, "points")
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"points must be pairs (ratio, force), not an array of shape {array.shape}")
    with np.errstate(over="ignore"):
        pairs = array.astype(np.float64) + 0.0
    finite = np.isfinite(pairs)
    if np.count_nonzero(finite) < finite.size:
        index = int(finite.all(axis=1).argmin())
        ratio, force = pairs[index].tolist()
        raise CurveError("SYN002", index, f"point {index + 1} is not finite: ({ratio!r}, {force!r})")
    return pairs


def _first_of_each_ratio(pairs: FloatArray, order: IndexArray) -> NDArray[np.bool_]:
    """Return a mask over the sorted points that drops repeats.

    Raises:
        CurveError: CRV003, one ratio with two forces.
    """
    ratios, forces = pairs[order, 0], pairs[order, 1]
    repeats = ratios[1:] == ratios[:-1]
    clashes = np.flatnonzero(repeats & (forces[1:] != forces[:-1]))
    if clashes.size:
        first, later = order[clashes[0]], order[clashes[0] + 1]
        values = f"{pairs[first, 1].item()!r} (point {first + 1}) and {pairs[later, 1].item()!r} (point {later + 1})"
        raise CurveError("CRV003", int(later), f"two forces at ratio {pairs[first, 0].item()!r}: {values}")
    return np.concatenate((np.ones(min(len(order), 1), np.bool_), ~repeats))


def _slopes(ratios: FloatArray, forces: FloatArray, order: IndexArray) -> FloatArray:
    """Return the slope of each segment.

    Raises:
        CurveError: CRV011, a width or a slope overflows, or a slope is not zero but too small to be a normal number.
    """
    with np.errstate(all="ignore"):
        widths = ratios[1:] - ratios[:-1]
        plain = (forces[1:] - forces[:-1]) / widths
    steepness = np.abs(plain)
    if np.minimum.reduce(steepness) >= _NORMAL and np.maximum.reduce(steepness) < np.inf:
        return plain  # the case of most curves
    slopes = difference_quotient(forces[1:], forces[:-1], widths)
    subnormal = (forces[1:] != forces[:-1]) & (np.abs(slopes) < _NORMAL)
    usable = np.isfinite(widths) & np.isfinite(slopes) & ~subnormal
    if np.count_nonzero(usable) < len(usable):
        segment = int(usable.argmin())
        ends = order[segment : segment + 2]
        what = "width" if not np.isfinite(widths[segment]) else "slope"
        fault = "is too small" if what == "slope" and subnormal[segment] else "is too large"
        message = f"the {what} between points {ends[0] + 1} and {ends[1] + 1} {fault} for a float64"
        raise CurveError("CRV011", int(ends.max()), message)
    return slopes


def difference_quotient(
    upper: FloatArray | np.float64, lower: FloatArray | np.float64, divisor: FloatArray | np.float64
) -> FloatArray:
    """Return (upper - lower) / divisor, also where only the difference overflows."""
    with np.errstate(all="ignore"):
        plain = np.asarray((upper - lower) / divisor)
        overflowed = np.isinf(plain)
        if not np.count_nonzero(overflowed):
            return plain
        return np.where(overflowed, (0.5 * upper - 0.5 * lower) / divisor * 2.0, plain)
