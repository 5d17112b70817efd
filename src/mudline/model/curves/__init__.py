"""Force-embedment curves: piecewise linear, with the end segments continued to infinity.

curve = ForceCurve([(0.3, 4500.0), (0.0, 0.0), (0.1, 2000.0)])
force, slope = curve.evaluate(0.2)

The embedment ratio r is penetration / external diameter (dimensionless); the force f is per unit length, in the units
of the deck. With the points sorted by ratio and s_i = (F_(i+1) - F_i) / (r_(i+1) - r_i):

* r_i <= r < r_(i+1):  f = F_i + s_i (r - r_i), slope s_i (at a point that of the segment to its right);
* r < r_0:             the same with i = 0;
* r >= r_n, the last:  f = F_n + s_(n-1) (r - r_n).

The force is exact at every point and nothing is clamped.
"""

from __future__ import annotations

from importlib import import_module
from types import NoneType
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mudline.basics.arguments import as_array, expect, read_only
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.short_repr import counted, cut

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["CurveError", "ForceCurve"]

FloatArray = NDArray[np.float64]
IndexArray = NDArray[np.intp]

BLOCK = 32768
"""Numbers evaluated at a time, so that work arrays stay in the second-level cache."""
_COUNTED_POINTS = 60
"""Number of points up to which comparing with each point is faster than a binary search."""
_RATIOS_PER_POINT = 50
"""Number of ratios per point below which a binary search is faster."""
_NORMAL = float(np.finfo(np.float64).tiny)


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


class ForceCurve:
    """A force-embedment curve: force per unit length over embedment ratio. Immutable.

    Attributes:
        name: name of the curve, or None.
        ratios: (n,) embedment ratios, strictly ascending, read-only.
        forces: (n,) forces per unit length at the ratios, read-only.
        slopes: (n - 1,) d force / d ratio of each segment, read-only.
    """

    __slots__ = ("_tails", "forces", "name", "ratios", "slopes")

    name: str | None
    ratios: FloatArray
    forces: FloatArray
    slopes: FloatArray
    _tails: FloatArray
    """(n,) slopes to the right of the points."""

    def __init__(self, points: ArrayLike, name: str | None = None) -> None:
        """Sort and check `points`: pairs (ratio, force) in any order; a repeated pair counts once.

        Raises:
            CurveError: the points do not make a curve; its `code` and `index` are the fault and the point.
            ValueError: `points` are not pairs of real numbers.
        """
        expect(name, "name", (str, NoneType), "a str or None")
        ratios, forces, slopes = (read_only(array) for array in _checked_points(points))
        fields = {
            "name": name,
            "ratios": ratios,
            "forces": forces,
            "slopes": slopes,
            "_tails": read_only(np.concatenate((slopes, slopes[-1:]))),
        }
        for field, value in fields.items():
            object.__setattr__(self, field, value)

    def evaluate(
        self, ratios: ArrayLike, *, out: tuple[FloatArray, FloatArray] | None = None
    ) -> tuple[FloatArray, FloatArray]:
        """Return force and slope (d force / d ratio) at `ratios`, in arrays of the same shape.

        `out=(force, slope)` receives the values in place: float64 arrays of the shape of `ratios`, which may share the
        memory of `ratios`. After an error their content is undefined.

        Raises:
            ValueError: a ratio is NaN or infinite, or the force there overflows; or `ratios` are not real numbers, or
                `out` does not fit.
        """
        query = _real_numbers(ratios, "ratios")
        force, slope = (np.empty(query.shape), np.empty(query.shape)) if out is None else _checked_out(out, query.shape)
        # results may overwrite ratios that an error message needs
        replaced = out is not None and any(np.may_share_memory(query, array) for array in out)
        done = 0
        with np.errstate(all="ignore"), _blocks(query, force, slope) as pieces:
            for block, block_force, block_slope in pieces:
                ratio = block.copy() if replaced else block
                if not self._fill(ratio, block_force, block_slope):
                    bad = self._recompute_overflowed(ratio, block_force)
                    if bad.size:
                        _refuse(ratio, int(bad[0]), done)
                done += len(ratio)
        return force, slope

    def fill(self, ratios: FloatArray, force: FloatArray, slope: FloatArray) -> None:
        """Write force and slope at `ratios` (k,), for callers that check the force themselves.

        The force is not finite if a ratio is not finite or the force overflows. All three arrays are float64 and
        contiguous.
        """
        for start in range(0, len(ratios), BLOCK):
            piece = slice(start, start + BLOCK)
            if not self._fill(ratios[piece], force[piece], slope[piece]):
                self._recompute_overflowed(ratios[piece], force[piece])

    def _fill(self, ratio: FloatArray, force: FloatArray, slope: FloatArray) -> bool:
        """Write force and slope at each ratio of a block; return True if every force is finite."""
        # a ratio below the second point, even below the first, belongs to the first segment
        point = _passed(self.ratios[1:], ratio)
        offset = self.ratios.take(point)
        np.subtract(ratio, offset, out=offset)
        np.take(self._tails, point, out=slope, mode="clip")
        np.multiply(offset, slope, out=offset)
        np.take(self.forces, point, out=force, mode="clip")
        np.add(force, offset, out=force)
        return bool(np.isfinite(force).all())

    def _recompute_overflowed(self, ratio: FloatArray, force: FloatArray) -> IndexArray:
        """Recompute forces that are not finite; return the indices of those that still are not.

        Only an intermediate value may have overflowed: the force may be finite if added in two halves.
        """
        where = np.flatnonzero(~np.isfinite(force))
        at = _passed(self.ratios[1:], ratio[where])
        half = self._tails[at] * (0.5 * ratio[where] - 0.5 * self.ratios[at])
        force[where] = self.forces[at] + half + half
        return where[~np.isfinite(force[where])]

    def segment(self, ratios: ArrayLike) -> IndexArray:
        """Return the segment at `ratios`, from 0; the first also below, the last also beyond the points.

        Raises:
            ValueError: a ratio is NaN or infinite.
        """
        query = _finite_ratios(ratios)
        segments = _passed(self.ratios[1:], query.reshape(-1))
        np.minimum(segments, len(self.slopes) - 1, out=segments)
        return segments.reshape(query.shape)

    def extrapolated(self, ratios: ArrayLike) -> NDArray[np.int8]:
        """Return -1 where `ratios` lie below the first point, 1 beyond the last, 0 between them and at them.

        Raises:
            ValueError: a ratio is NaN or infinite.
        """
        query = _finite_ratios(ratios)
        return np.asarray(np.subtract(query > self.ratios[-1], query < self.ratios[0], dtype=np.int8))

    def ratios_at_force(self, force: float) -> tuple[float, ...]:
        """Return every ratio at which the curve, including its continued ends, has this force, ascending.

        A flat segment at this force is represented by its end points. A ratio too large for a float64 is left out. With
        the submerged weight per unit length as `force` these are the static embedments.

        Raises:
            ValueError: `force` is NaN or infinite.
        """
        if (shape := _real_numbers(force, "force").shape) != ():
            raise ValueError(f"force must be one number, not an array of shape {shape}")
        if not np.isfinite(force):
            raise ValueError(f"no ratio has the force {force}")
        reached = self.ratios[self.forces == force]
        ratios = {*reached.tolist(), *self._inside(force).tolist(), *self._beyond_ends(force)}
        return tuple(sorted(ratios))

    def _inside(self, force: float) -> FloatArray:
        """Return the ratios of this force between points, each computed from the point nearer in force."""
        low, high = self.forces[:-1], self.forces[1:]
        segment = np.flatnonzero(((low < force) & (force < high)) | ((high < force) & (force < low)))
        middle = 0.5 * low[segment] + 0.5 * high[segment]
        near = segment + ((force > middle) == (high[segment] > low[segment]))
        offset = _difference_quotient(np.float64(force), self.forces[near], self.slopes[segment])
        ratio: FloatArray = np.clip(self.ratios[near] + offset, self.ratios[segment], self.ratios[segment + 1])
        return ratio

    def _beyond_ends(self, force: float) -> list[float]:
        """Return the ratios of this force below the first and beyond the last point."""
        ratios = []
        for end, outward in ((0, -1.0), (-1, 1.0)):
            rise = outward * self.slopes[end]
            if (rise > 0.0 and force > self.forces[end]) or (rise < 0.0 and force < self.forces[end]):
                offset = _difference_quotient(np.float64(force), self.forces[end], self.slopes[end])
                with np.errstate(over="ignore"):
                    ratio = self.ratios[end] + offset
                if np.isfinite(ratio):
                    ratios.append(float(ratio))
        return ratios

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"a ForceCurve does not change: cannot set {name}")

    def __delattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a ForceCurve does not change: cannot delete {name}")

    def __reduce__(self) -> tuple[type[ForceCurve], tuple[FloatArray, str | None]]:
        return type(self), (np.column_stack((self.ratios, self.forces)), self.name)

    def __eq__(self, other: object) -> bool:
        """Return True for a curve with the same name and points."""
        if not isinstance(other, ForceCurve):
            return NotImplemented
        same_points = np.array_equal(self.ratios, other.ratios) and np.array_equal(self.forces, other.forces)
        return self.name == other.name and same_points

    def __hash__(self) -> int:
        return hash((self.name, self.ratios.tobytes(), self.forces.tobytes()))

    def __repr__(self) -> str:
        count = len(self.ratios)
        ends = [(float(self.ratios[end]), float(self.forces[end])) for end in (0, -1)]
        shown = f"<{count} points from {ends[0]} to {ends[1]}>"
        if count <= 8:
            pairs = repr(list(zip(self.ratios.tolist(), self.forces.tolist(), strict=True)))
            shown = pairs if len(pairs) <= 120 else shown
        return f"ForceCurve({shown}, name={self.name if self.name is None else cut(self.name, 60)!r})"

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the curve, dashed beyond its points, and return the axes; needs matplotlib."""
        if ax is not None and not hasattr(ax, "plot"):
            raise ValueError("ax must be axes of matplotlib")
        try:
            plots: Any = import_module("mudline.model.results.plots.curves")
            axes = import_module("matplotlib.pyplot").subplots(layout="constrained")[1] if ax is None else ax
        except ImportError as error:
            raise ImportError("a plot needs matplotlib: pip install 'mudline[plot]'") from error
        plots.draw_curve(axes, self.name or "curve", np.column_stack((self.ratios, self.forces)))
        return axes

    def _repr_html_(self) -> str:
        """Return a picture, and the points with the slopes after them, as HTML for notebooks."""
        from mudline.basics.html_repr import html_line, html_page, html_table  # noqa: PLC0415 - only notebooks ask for it

        columns = (array[:SHOWN_ROWS].tolist() for array in (self.ratios, self.forces, np.append(self.slopes, np.nan)))
        table = html_table(("ratio", "force", "slope"), zip(*columns, strict=True), len(self.ratios))
        summary = f"{self.name or ''} {counted(len(self.ratios), 'point')}".strip()
        return html_page("ForceCurve", summary, html_line(self.ratios.tolist(), self.forces.tolist()), table)


def _real_numbers(values: ArrayLike, what: str) -> NDArray[np.generic]:
    """Return `values` as an array of booleans, integers or floats.

    Raises:
        ValueError: they are something else; `what` is their name in the message.
    """
    array: NDArray[np.generic] = as_array(values, what)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"{what} must be real numbers, not {array.dtype}")
    return array


def _checked_points(points: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return sorted ratios (n,) and forces (n,) without repeats, n >= 2, and the slopes (n - 1,), each 0 or normal.

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
    return ratios, forces, _slopes(ratios, forces, order)


def _pairs(points: ArrayLike) -> FloatArray:
    """Return the points as an (n, 2) float64 array, every number finite, no negative zeros."""
    array = _real_numbers(points, "points")
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
    with np.errstate(over="ignore"):
        widths = ratios[1:] - ratios[:-1]
    slopes = _difference_quotient(forces[1:], forces[:-1], widths)
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


def _difference_quotient(
    upper: FloatArray | np.float64, lower: FloatArray | np.float64, divisor: FloatArray | np.float64
) -> FloatArray:
    """Return (upper - lower) / divisor, also where only the difference overflows."""
    with np.errstate(all="ignore"):
        plain = np.asarray((upper - lower) / divisor)
        overflowed = np.isinf(plain)
        if not np.count_nonzero(overflowed):
            return plain
        return np.where(overflowed, (0.5 * upper - 0.5 * lower) / divisor * 2.0, plain)


def _checked_out(out: tuple[FloatArray, FloatArray], shape: tuple[int, ...]) -> tuple[FloatArray, FloatArray]:
    expect(out, "out", tuple, "two arrays (force, slope)")
    if len(out) != 2:
        raise ValueError(f"out must be two arrays (force, slope), not {len(out)}")
    for array in out:
        expect(array, "out", np.ndarray, "two arrays (force, slope)")
        if not array.flags.writeable:
            raise ValueError("out must be arrays that can be written")
        if array.shape != shape or array.dtype != np.float64:
            raise ValueError(f"out must be float64 of shape {shape}, not {array.dtype} of shape {array.shape}")
    return out


def _finite_ratios(ratios: ArrayLike) -> FloatArray:
    """Return ratios as float64, for queries that compute no force; raise ValueError for one that is not finite."""
    with np.errstate(over="ignore"):
        query = _real_numbers(ratios, "ratios").astype(np.float64, copy=False)
    finite = np.isfinite(query)
    if not finite.all():
        _refuse(query.reshape(-1), int(np.argmin(finite)), 0)
    return query


def _refuse(ratio: FloatArray, index: int, start: int) -> NoReturn:
    """Raise ValueError for a ratio; `start` is the index of the first ratio in the query."""
    value = float(ratio[index])
    why = "the force there overflows" if np.isfinite(value) else "it is not finite"
    raise ValueError(f"no force at ratio {value!r} (index {start + index}): {why}")


def _blocks(source: NDArray[np.generic], *targets: NDArray[np.generic]) -> np.nditer:
    """Iterate over `source` (as float64) and `targets` in flat order, in contiguous blocks of up to BLOCK numbers.

    A target may be the memory of `source`, number for number: its blocks are then those of the source. A target that
    overlaps it in any other way is written to a copy first.
    """
    # typed Any: numpy's stubs do not know "contig"
    access: list[list[Any]] = [["readonly", "contig", "overlap_assume_elementwise"]]
    access += [["writeonly", "contig", "overlap_assume_elementwise"] for _ in targets]
    return np.nditer(
        [source, *targets],
        flags=["external_loop", "buffered", "zerosize_ok", "copy_if_overlap"],
        op_flags=access,
        op_dtypes=[np.dtype(np.float64), *[target.dtype for target in targets]],
        order="C",
        casting="same_kind",
        buffersize=BLOCK,
    )


def _passed(points: FloatArray, ratio: FloatArray) -> IndexArray:
    """Return how many of the ascending points (n,) lie at or below each ratio (k,); any number up to n for NaN."""
    if len(points) > _COUNTED_POINTS or len(ratio) < _RATIOS_PER_POINT * len(points):
        return np.searchsorted(points, ratio, side="right")
    count: NDArray[np.uint8] = (ratio >= points[0]).view(np.uint8)
    more = np.empty(len(ratio), np.bool_)
    for point in points[1:]:
        np.greater_equal(ratio, point, out=more)
        np.add(count, more.view(np.uint8), out=count)
    return count.astype(np.intp)
