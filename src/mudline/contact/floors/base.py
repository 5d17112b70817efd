"""What every sea floor offers, and the step from a surface to gaps and normals."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from mudline.contact.arrays import FloatArray

_CHUNK = 8192
"""Points worked on at a time: the work arrays stay in the cache."""
STEEPEST = 1e150
"""Largest slope of a surface: its square is finite."""
_QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


class Floor(ABC):
    """A bed given as an elevation over the horizontal plane. Holds no state; may be shared by threads.

    Attributes:
        facetted: the bed is made of planes, so inside one the gradient of the gap is exactly the normal. False for
            curved beds, whose gap is measured to the tangent plane above or below the point: the true gradient has a
            term of curvature times gap, which a tangent with the normal held leaves out.
        same_normal: the unit normal (3,), read-only, where all points share it; None where they do not.
    """

    facetted: bool = True
    same_normal: FloatArray | None = None

    @abstractmethod
    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps (...) and unit normals out of the soil (..., 3) of `points` (..., 3), which are finite.

        The gap is (x - elevation) n_x, in the points' unit: the distance to the local tangent plane, positive above
        it. Where there is no seabed the gap is NaN and the normal (1, 0, 0).
        """

    def gaps(self, points: FloatArray, gap: FloatArray) -> None:
        """Write the gaps alone."""
        self.locate(points, gap, np.empty(points.shape))

    @abstractmethod
    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return the elevation X of the bed at `y` and `z`, arrays of one shape; NaN where there is no seabed."""

    @abstractmethod
    def describe(self) -> str:
        """Say in a line what the bed is, and what holds outside of it."""


class SurfaceFloor(Floor):
    """A floor that knows its elevation and gradient at points in a row."""

    chunk: ClassVar[int] = _CHUNK

    @abstractmethod
    def surface(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return elevation and its derivatives to Y and Z at `y` (n,) and `z` (n,); elevation is NaN without bed.

        The derivatives have magnitudes up to `STEEPEST`.
        """

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Floor`."""
        rows = points.reshape(-1, 3)
        flat_gap, flat_normal = gap.reshape(-1), normal.reshape(-1, 3)  # views where the arrays allow it, else copies
        for start in range(0, len(rows), self.chunk):
            part = slice(start, start + self.chunk)
            x, y, z = np.ascontiguousarray(rows[part].T)
            with np.errstate(over="ignore"):  # an elevation beyond the largest number makes an infinite gap
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
        """Return elevations, see `Floor`."""
        with np.errstate(over="ignore"):
            level = self.surface(np.ravel(y), np.ravel(z))[0] + 0.0
        return level.reshape(np.shape(y))


def heading(degrees: float) -> tuple[float, float]:
    """Return cosine and sine of an angle in degrees, exact at the multiples of 90."""
    quarters, rest = divmod(math.fmod(degrees, 360.0), 90.0)
    if rest == 0.0:
        return _QUARTERS[int(quarters) % 4]
    angle = math.radians(math.fmod(degrees, 360.0))
    return math.cos(angle), math.sin(angle)
