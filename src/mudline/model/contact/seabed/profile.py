"""The seabed of a 2D profile: a curve over one horizontal direction, constant along the other."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.seabed import STEEPEST, SurfaceSeabed, checked, heading

Interpolation = Literal["LINEAR", "CUBIC SPLINE", "CUBIC BESSEL"]
_NAMES = {"LINEAR": "straight lines", "CUBIC SPLINE": "a cubic spline", "CUBIC BESSEL": "Bessel's cubics"}


class ProfileSeabed(SurfaceSeabed):
    """A profile through points, in any order; beyond its ends flat at the elevation of the end point.

    A place on a point belongs to the segment on the side of larger Y. Cubic profiles have slope 0 at both ends.

    Args:
        y: horizontal coordinates of the points (n,), n >= 2.
        elevation: elevations X of the points (n,).
        interpolation: between points: LINEAR, CUBIC SPLINE (continuous curvature) or CUBIC BESSEL (continuous slope).
        direction_degrees: direction of the profile from +Y, counter-clockwise about X; its coordinate is Y cos + Z sin.

    Raises:
        ValueError: fewer than two points, one Y with two elevations, a slope beyond 1e149, an unknown interpolation, or
            a value that is not finite. (A repeated point counts once.)
    """

    def __init__(
        self,
        y: ArrayLike,
        elevation: ArrayLike,
        interpolation: Interpolation = "LINEAR",
        direction_degrees: float = 0.0,
    ) -> None:
        if interpolation not in _NAMES:
            raise ValueError(f"interpolation of the profile is {interpolation!r}; expected {', '.join(_NAMES)}")
        self._how, self.faceted = interpolation, interpolation == "LINEAR"
        self._direction = float(checked("direction of the profile", direction_degrees))
        self._heading = heading(self._direction)
        self._y, self._x = _sorted_points(y, elevation)
        self._pieces = _pieces(self._y, self._x, interpolation)

    def surface(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return elevation and derivatives, see `SurfaceSeabed`."""
        cosine, sine = self._heading
        along = y * cosine + z * sine
        piece = np.searchsorted(self._y, along, side="right")
        origin, level, first = (column[piece] for column in self._pieces[:3])
        u = np.clip(along, self._y[0], self._y[-1]) - origin
        if self.faceted:
            return level + u * first, first * cosine, first * sine
        width, second, third = (column[piece] for column in self._pieces[3:])
        t = u / width
        level += u * (first + t * (second + t * third))
        slope = first + t * (2.0 * second + t * 3.0 * third)
        return level, slope * cosine, slope * sine

    def describe(self) -> str:
        """Return the description of the seabed."""
        ends = f"Y = {self._y[0]:g} to {self._y[-1]:g}, flat beyond"
        return f"{_NAMES[self._how]} through {len(self._y)} points, {ends}, direction {self._direction:g} deg"


def _sorted_points(y: ArrayLike, elevation: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return the points in ascending order of Y, without repeats."""
    places = checked("Y of the profile", y, None)
    levels = checked("elevation of the profile", elevation, len(places))
    points = np.unique(np.column_stack([places, levels]) + 0.0, axis=0)
    twice = np.flatnonzero(np.diff(points[:, 0]) == 0.0)
    if twice.size:
        (place, first), (_, last) = points[twice[0] : twice[0] + 2].tolist()
        raise ValueError(f"the profile has elevations {first:g} and {last:g} at Y = {place!r}; expected one for each Y")
    if len(points) < 2:
        raise ValueError(f"the profile has {len(points)} different points; expected two or more")
    return points[:, 0].copy(), points[:, 1].copy()


def _pieces(y: FloatArray, x: FloatArray, interpolation: Interpolation) -> tuple[FloatArray, ...]:
    """Return origin, level, width and coefficients per piece: flat before the first point, segments, flat after.

    Elevation is level + u (first + t (second + t third)), u from the origin, t = u / width.
    """
    h, rise = np.diff(y), np.diff(x)
    with np.errstate(over="ignore", invalid="ignore"):
        chord = rise / h
        if interpolation == "LINEAR":
            slopes = np.append(chord, 0.0)
        else:
            slopes = (spline_slopes if interpolation == "CUBIC SPLINE" else bessel_slopes)(h, chord)
        second = 3.0 * chord - 2.0 * slopes[:-1] - slopes[1:]
        third = slopes[:-1] + slopes[1:] - 2.0 * chord
        largest = np.abs(chord) + np.abs(slopes[:-1]) + np.abs(slopes[1:])  # the cubic is nowhere 9 times as steep
    steep = np.flatnonzero(~(9.0 * largest < STEEPEST))
    if steep.size:
        begin, end = y[steep[0] : steep[0] + 2].tolist()
        raise ValueError(f"the profile is too steep from Y = {begin!r} to {end!r}; expected points further apart")
    columns = {"origin": (y[0], y[:-1], y[-1]), "level": (x[0], x[:-1], x[-1]), "first": (0.0, slopes[:-1], 0.0)}
    if interpolation != "LINEAR":
        columns |= {"width": (1.0, h, 1.0), "second": (0.0, second, 0.0), "third": (0.0, third, 0.0)}
    return tuple(np.concatenate([[before], inside, [after]]) for before, inside, after in columns.values())


def bessel_slopes(h: FloatArray, c: FloatArray) -> FloatArray:
    """Return the slopes at the points of parabolas through each point and its two neighbours: continuous slope."""
    share = h[1:] / (h[:-1] + h[1:])
    return np.concatenate([[0.0], share * c[:-1] + (1.0 - share) * c[1:], [0.0]])


def spline_slopes(h: FloatArray, c: FloatArray) -> FloatArray:
    """Return the slopes of continuous curvature: share m- + 2 m + (1 - share) m+ = 3 (Bessel's slope).

    The system is diagonally dominant, so elimination needs no pivots.
    """
    share = (h[1:] / (h[:-1] + h[1:])).tolist()
    right = (3.0 * bessel_slopes(h, c)[1:-1]).tolist()
    upper, before = [0.0], [0.0]
    for low, value in zip(share, right, strict=True):
        pivot = 2.0 - low * upper[-1]
        upper.append((1.0 - low) / pivot)
        before.append((value - low * before[-1]) / pivot)
    slopes = np.zeros(len(h) + 1)
    for number in range(len(h) - 1, 0, -1):
        slopes[number] = before[number] - upper[number] * slopes[number + 1]
    return slopes
