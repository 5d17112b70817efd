"""The bed of several planes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.seabed.base import SeabedError, SurfaceSeabed, checked, checked_slope, heading


class PlanesSeabed(SurfaceSeabed):
    """Planes, each with a horizontal extent: the highest at a place is the bed, of equals the later one.

    Without extents planes make valleys; a ridge needs them. A place in no plane's extent has no seabed.

    Args:
        points: a point of each plane (k, 3): X is the elevation.
        slopes: steepest slopes in degrees (k,), above -90 and below 90.
        directions: directions of rise in degrees from +Y, counter-clockwise about X (k,); 0 when left out.
        bounds: ymin, ymax, zmin, zmax of each plane (k, 4), edges included; infinite for no bound; None for no bounds.

    Raises:
        SeabedError: no planes, lengths that differ, a wall, an empty extent, or a value that is not finite.
    """

    def __init__(
        self, points: ArrayLike, slopes: ArrayLike, directions: ArrayLike | None = None, bounds: ArrayLike | None = None
    ) -> None:
        self._points = checked("the planes' points", points, None, 3)
        planes = len(self._points)
        if not planes:
            raise SeabedError("the bed has no plane; expected one or more")
        angles = checked("the planes' slopes", slopes, planes)
        for number, angle in enumerate(angles.tolist(), 1):
            checked_slope(f"slope of plane {number}", angle)
        turns = checked("the planes' directions", np.zeros(planes) if directions is None else directions, planes)
        self._headings = np.array([heading(turn) for turn in turns.tolist()])
        self._rises = np.tan(np.radians(angles))
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
        """Return the highest elevation at each place and the plane it is of, -1 for none."""
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
            best, plane = np.where(wins, level, best), np.where(wins, number, plane)  # without branches: quicker
        return best, plane

    def describe(self) -> str:
        """Say what the bed is."""
        planes = len(self._points)
        bounded = int(np.isfinite(self._bounds).any(axis=1).sum())
        if planes == 1:
            extent = "no seabed outside of its bounds" if bounded else "without end"
            return f"one plane, {extent}"
        outside = "no seabed outside of all bounds" if bounded == planes else f"{planes - bounded} without end"
        return f"{planes} planes, the highest is the bed, {outside}; depth and normal jump where two meet"


def _checked_bounds(bounds: ArrayLike | None, planes: int) -> FloatArray:
    """Return bounds (planes, 4) with the lower not above the upper."""
    free = np.broadcast_to([-np.inf, np.inf, -np.inf, np.inf], (planes, 4))
    given = np.array(free if bounds is None else bounds, np.float64)
    if given.shape != (planes, 4):
        raise SeabedError(f"the planes' bounds have shape {given.shape}; expected ({planes}, 4)")
    for axis, low, high in (("Y", 0, 1), ("Z", 2, 3)):
        least, most = given[:, low], given[:, high]
        for number in np.flatnonzero(~((least <= most) & (least < np.inf) & (most > -np.inf))).tolist():
            extent = f"{axis} from {least[number]:g} to {most[number]:g}"
            raise SeabedError(f"plane {number + 1} has {extent}; expected the smallest, then the largest")
    return given
