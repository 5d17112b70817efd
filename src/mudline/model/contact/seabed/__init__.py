"""Seabed shapes: the signed gap of points in space to the seabed and its unit normal out of the soil.

Angles are in degrees, X is up. This module has the interface of all shapes, a flat seabed, a uniform slope and planes.
A profile (`profile`) and scattered points (`scattered`, which needs scipy) have modules of their own.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from mudline.basics.limits import LARGEST_COORDINATE
from mudline.basics.short_repr import outline
from mudline.model.contact.arrays import FloatArray, IndexArray


def checked(what: str, values: ArrayLike, *shape: int | None) -> FloatArray:
    """Return a copy of `values` as finite floats of `shape` (None: any length), or raise ValueError."""
    array = np.array(values, np.float64)
    if array.ndim != len(shape) or any(n not in (None, m) for n, m in zip(shape, array.shape, strict=True)):
        expected = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{what} has shape {array.shape}; expected ({expected})")
    wrong = np.argwhere(~(np.abs(array) <= LARGEST_COORDINATE))
    if len(wrong):
        index = tuple(wrong[0].tolist())
        place = f" of point {index[0] + 1}" if index else ""
        raise ValueError(
            f"{what}{place} is {array[index]}; expected a finite number of magnitude up to {LARGEST_COORDINATE:g}"
        )
    return array


def checked_slope(what: str, degrees: float) -> None:
    """Raise ValueError for a slope in degrees that is not between -90 and 90, both excluded."""
    if not abs(degrees) < 90.0:
        raise ValueError(f"{what} is {degrees:g} degrees; expected more than -90 and less than 90")


_CHUNK = 8192
"""Points evaluated at a time: the work arrays stay in the cache."""
STEEPEST = 1e150
"""Largest slope of a surface, whose square is finite."""


class Seabed(ABC):
    """A seabed given as an elevation over the horizontal plane. Holds no state; may be shared by threads.

    Attributes:
        faceted: whether the seabed consists of planes, on each of which the gradient of the gap is exactly the normal.
            The gap of a curved seabed is measured to the tangent plane above or below the point. Its true gradient has
            a term of curvature times gap, which a tangent with the normal held leaves out.
        same_normal: the unit normal (3,), read-only, if all points share it; else None.
    """

    faceted: bool = True
    same_normal: FloatArray | None = None

    def __repr__(self) -> str:
        return outline(type(self).__name__, self.describe())

    @abstractmethod
    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps (...) and unit normals out of the soil (..., 3) of `points` (..., 3), which are finite.

        The gap is (x - elevation) n_x, in the points' unit: the distance to the local tangent plane, positive above
        it. Where there is no seabed the gap is NaN and the normal (1, 0, 0).
        """

    def gaps(self, points: FloatArray, gap: FloatArray) -> None:
        """Write only the gaps."""
        self.locate(points, gap, np.empty(points.shape))

    @abstractmethod
    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return the elevation X of the seabed at `y` and `z`, arrays of one shape; NaN where there is no seabed."""

    @abstractmethod
    def describe(self) -> str:
        """Return a description of the seabed in one line, including the region outside of it."""


class SurfaceSeabed(Seabed):
    """A seabed with an elevation and a gradient at points in a row."""

    chunk: ClassVar[int] = _CHUNK

    @abstractmethod
    def surface(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return elevation and its derivatives by Y and Z at `y` (n,) and `z` (n,); elevation is NaN without a seabed.

        The derivatives have magnitudes up to `STEEPEST`.
        """

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Seabed`."""
        rows = points.reshape(-1, 3)
        flat_gap, flat_normal = gap.reshape(-1), normal.reshape(-1, 3)  # views where the arrays allow it, else copies
        for start in range(0, len(rows), self.chunk):
            part = slice(start, start + self.chunk)
            x, y, z = np.ascontiguousarray(rows[part].T)
            with np.errstate(over="ignore"):  # an elevation that overflows makes an infinite gap
                level, along_y, along_z = self.surface(y, z)
                upward = 1.0 / np.sqrt(1.0 + along_y * along_y + along_z * along_z)
                flat_gap[part] = (x - level) * upward + 0.0
            unit = flat_normal[part]
            unit[:, 0] = upward
            unit[:, 1] = 0.0 - along_y * upward
            unit[:, 2] = 0.0 - along_z * upward
            void = np.isnan(level)
            if void.any():
                unit[void] = (1.0, 0.0, 0.0)
        if not np.may_share_memory(flat_gap, gap):
            gap[...] = flat_gap.reshape(gap.shape)
        if not np.may_share_memory(flat_normal, normal):
            normal[...] = flat_normal.reshape(normal.shape)

    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return elevations, see `Seabed`."""
        with np.errstate(over="ignore"):
            level = self.surface(np.ravel(y), np.ravel(z))[0] + 0.0
        return level.reshape(np.shape(y))


def heading(degrees: float) -> tuple[float, float]:
    """Return cosine and sine of an angle in degrees with full precision; exact at the multiples of 90.

    The remainder of the angle after a multiple of 90 is exact in degrees, and would not be in radians.
    """
    turned = math.fmod(degrees, 360.0)
    quarters = round(turned / 90.0)
    angle = math.radians(turned - 90.0 * quarters)
    cosine, sine = math.cos(angle), math.sin(angle)
    for _ in range(quarters % 4):
        cosine, sine = 0.0 - sine, cosine
    return cosine, sine


def _tangents(degrees: FloatArray) -> FloatArray:
    """Return the tangents of angles above -90 and below 90 degrees, with full precision near these bounds too."""
    with np.errstate(under="ignore"):
        from_vertical = 90.0 - np.abs(degrees)  # exact from 45 degrees on
        steep = np.copysign(1.0 / np.tan(np.radians(from_vertical)), degrees)
        tangents: FloatArray = np.where(from_vertical < 45.0, steep, np.tan(np.radians(degrees)))
    return tangents


_UP = np.array([1.0, 0.0, 0.0])
_UP.setflags(write=False)


class FlatSeabed(Seabed):
    """The seabed X = 0, everywhere."""

    same_normal = _UP

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Seabed`."""
        self.gaps(points, gap)
        normal[...] = _UP

    def gaps(self, points: FloatArray, gap: FloatArray) -> None:
        """Write the heights above X = 0."""
        np.add(points[..., 0], 0.0, out=gap)  # adding 0 turns -0 into 0

    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return elevations, see `Seabed`."""
        return np.zeros(np.broadcast_shapes(np.shape(y), np.shape(z)))

    def describe(self) -> str:
        """Return the description of the seabed."""
        return "one flat seabed at X = 0"


class SlopingSeabed(Seabed):
    """An infinite plane through the origin.

    Args:
        slope_degrees: steepest slope, above -90 and below 90; positive rises towards the direction.
        direction_degrees: direction from +Y, counter-clockwise about X (Y turns to Z).

    Raises:
        ValueError: the slope is 90 degrees or more, or a value is not finite.
    """

    same_normal: FloatArray

    def __init__(self, slope_degrees: float, direction_degrees: float = 0.0) -> None:
        self._slope = float(checked("slope of the seabed", slope_degrees))
        self._direction = float(checked("direction of the slope", direction_degrees))
        checked_slope("slope of the seabed", self._slope)
        upright, steep = heading(self._slope)
        cosine, sine = heading(self._direction)
        self._rise = 2.0 * (steep / upright)
        self._half = 0.5 * cosine, 0.5 * sine
        self.same_normal = np.array([upright, 0.0 - steep * cosine, 0.0 - steep * sine])
        self.same_normal.setflags(write=False)

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Seabed`."""
        # a product with the normal: near a wall the elevation would be a large number times a small one
        upward, along_y, along_z = 0.25 * self.same_normal  # quarters first: their sum cannot overflow
        with np.errstate(over="ignore"):
            quarter = points[..., 0] * upward + points[..., 1] * along_y + points[..., 2] * along_z
            gap[...] = 4.0 * quarter + 0.0
        normal[...] = self.same_normal

    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return elevations, see `Seabed`."""
        with np.errstate(over="ignore"):
            level = self._rise * (self._half[0] * np.asarray(y) + self._half[1] * np.asarray(z))  # see the halves above
            return np.asarray(level + 0.0, np.float64)

    def describe(self) -> str:
        """Return the description of the seabed."""
        return f"plane through the origin, slope {self._slope:g} deg, direction {self._direction:g} deg, without end"


class PlanesSeabed(SurfaceSeabed):
    """Planes, each with a horizontal extent: the highest plane at a place is the seabed, the later one of two equals.

    Without extents planes form valleys; a ridge needs extents. A place outside of all extents has no seabed.

    Args:
        points: a point of each plane (k, 3): X is the elevation.
        slopes: steepest slopes in degrees (k,), above -90 and below 90.
        directions: directions of rise in degrees from +Y, counter-clockwise about X (k,); 0 when left out.
        bounds: ymin, ymax, zmin, zmax of each plane (k, 4), edges included; infinite for no bound; None for no bounds.

    Raises:
        ValueError: no planes, lengths that differ, a wall, an empty extent, or a value that is not finite.
    """

    def __init__(
        self, points: ArrayLike, slopes: ArrayLike, directions: ArrayLike | None = None, bounds: ArrayLike | None = None
    ) -> None:
        self._points = checked("the planes' points", points, None, 3)
        planes = len(self._points)
        if not planes:
            raise ValueError("the seabed has no plane; expected one or more")
        angles = checked("the planes' slopes", slopes, planes)
        for number, angle in enumerate(angles.tolist(), 1):
            checked_slope(f"slope of plane {number}", angle)
        turns = checked("the planes' directions", np.zeros(planes) if directions is None else directions, planes)
        self._headings = np.array([heading(turn) for turn in turns.tolist()])
        self._rises = _tangents(angles)
        self._bounds = _checked_bounds(bounds, planes)
        self._gradients = self._headings.T * self._rises
        if planes == 1 and np.isinf(self._bounds).all():
            normal = np.array([1.0, *(0.0 - self._gradients[:, 0])]) / np.hypot(1.0, self._rises[0]) + 0.0
            normal.setflags(write=False)
            self.same_normal = normal

    def surface(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return elevation and derivatives, see `SurfaceSeabed`."""
        level, plane = self._highest(y, z)
        level[plane < 0] = np.nan
        along_y, along_z = self._gradients
        return level, along_y[plane], along_z[plane]

    def _highest(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, IndexArray]:
        """Return the highest elevation at each place and the index of its plane, -1 for none."""
        best, plane = np.full(len(y), -np.inf), np.full(len(y), -1, np.intp)
        for number, (point, (cosine, sine), rise) in enumerate(
            zip(self._points, self._headings, self._rises, strict=True)
        ):
            # Halves first: their sum cannot overflow, and an overflow afterwards has a sign.
            level = (y - point[1]) * (0.5 * cosine) + (z - point[2]) * (0.5 * sine)
            level *= 2.0 * rise
            level += point[0]
            wins = level >= best
            for edge, sign, place in zip(self._bounds[number], (1.0, -1.0) * 2, (y, y, z, z), strict=True):
                if np.isfinite(edge):
                    wins &= (place - edge) * sign >= 0.0
            best, plane = np.where(wins, level, best), np.where(wins, number, plane)  # without branches: faster
        return best, plane

    def describe(self) -> str:
        """Return the description of the seabed."""
        planes = len(self._points)
        bounded = int(np.isfinite(self._bounds).any(axis=1).sum())
        if planes == 1:
            extent = "no seabed outside of its bounds" if bounded else "without end"
            return f"one plane, {extent}"
        outside = "no seabed outside of all bounds" if bounded == planes else f"{planes - bounded} without end"
        return f"{planes} planes, the highest is the seabed, {outside}; depth and normal jump where two meet"


def _checked_bounds(bounds: ArrayLike | None, planes: int) -> FloatArray:
    """Return bounds (planes, 4); raise ValueError if a lower bound is above the upper."""
    free = np.broadcast_to([-np.inf, np.inf, -np.inf, np.inf], (planes, 4))
    array = np.array(free if bounds is None else bounds, np.float64)
    if array.shape != (planes, 4):
        raise ValueError(f"the planes' bounds have shape {array.shape}; expected ({planes}, 4)")
    for axis, low, high in (("Y", 0, 1), ("Z", 2, 3)):
        least, most = array[:, low], array[:, high]
        for number in np.flatnonzero(~((least <= most) & (least < np.inf) & (most > -np.inf))).tolist():
            extent = f"{axis} from {least[number]:g} to {most[number]:g}"
            raise ValueError(f"plane {number + 1} has {extent}; expected the smallest, then the largest")
    return array
