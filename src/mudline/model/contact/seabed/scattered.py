"""The seabed through scattered points, as their Delaunay triangles in the horizontal plane. Needs scipy."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CloughTocher2DInterpolator
from scipy.spatial import Delaunay, QhullError

from mudline.model.contact.arrays import FloatArray, IndexArray
from mudline.model.contact.seabed import STEEPEST, SurfaceSeabed, checked

_STEP = 1e-5
"""Step of a difference, as a part of the distance to a corner of the triangle."""
_TOLERANCE = 1e-10
"""Relative tolerance of the iterated gradients at the points."""
_EDGE = 1e-12
"""Share of a triangle by which rounding may put a place on the edge outside of the hull."""
_INWARD = 1e-11
"""Share of the distance to the middle of its triangle by which a place on the edge is moved for the cubic surface."""
_THIN = 1e-10
"""Spread of directions below which a triangle is a line to the differences: its plane's gradient is used."""


class ScatteredSeabed(SurfaceSeabed):
    """A surface through points; no seabed outside of their convex hull, whose edge belongs to the seabed.

    LINEAR is the plane of each triangle, with its gradient. CUBIC is the surface of Clough and Tocher with continuous
    gradient. The gradient is computed by second-order differences towards the corners of the triangle, which all lie in
    the hull; its error is about 1e-8 of the steepest slope.

    Args:
        points: elevation, Y and Z of each point (k, 3), k >= 3, in any order.
        interpolation: LINEAR or CUBIC.

    Raises:
        ValueError: fewer than three points, all on a line, two elevations at one place, points too close to
            distinguish, an unknown interpolation, or a value that is not finite. (A repeated point counts once.)
    """

    def __init__(self, points: ArrayLike, interpolation: Literal["LINEAR", "CUBIC"] = "LINEAR") -> None:
        if interpolation not in ("LINEAR", "CUBIC"):
            raise ValueError(f"interpolation of the surface is {interpolation!r}; expected LINEAR or CUBIC")
        self._how, self.faceted = interpolation, interpolation == "LINEAR"
        distinct = _different_points(points)
        low, high = distinct[:, 1:].min(axis=0), distinct[:, 1:].max(axis=0)
        self._middle, self._scale = low + 0.5 * (high - low), float(0.5 * (high - low).max())
        self._places = (distinct[:, 1:] - self._middle) / self._scale
        self._levels = distinct[:, 0]
        self._triangles = _triangulated(self._places)
        self._gradients = _plane_gradients(self._places, self._levels, self._triangles.simplices.astype(np.intp))
        if not (np.abs(self._gradients) < 1e-3 * STEEPEST * self._scale).all():
            raise ValueError("the surface is too steep to compute with; expected its points further apart")
        self._cubic = (
            None if self.faceted else CloughTocher2DInterpolator(self._triangles, self._levels, tol=_TOLERANCE)
        )

    def surface(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return elevation and derivatives, see `SurfaceSeabed`."""
        places = (np.column_stack([y, z]) - self._middle) / self._scale
        np.clip(places, -2.0, 2.0, out=places)  # the hull ends at 1: outside places stay outside, and finite
        triangle = self._triangles.find_simplex(places, tol=_EDGE).astype(np.intp)
        level, gradient = self._linear(places, triangle) if self._cubic is None else self._curved(places, triangle)
        level[triangle < 0] = np.nan
        gradient /= self._scale
        return level, gradient[:, 0], gradient[:, 1]

    def _linear(self, places: FloatArray, triangle: IndexArray) -> tuple[FloatArray, FloatArray]:
        corner, gradient = self._triangles.simplices[triangle, 0], self._gradients[triangle]
        return self._levels[corner] + ((places - self._places[corner]) * gradient).sum(axis=1), gradient

    def _curved(self, places: FloatArray, triangle: IndexArray) -> tuple[FloatArray, FloatArray]:
        """Return elevation and gradient, from least squares of the derivatives towards the three corners."""
        corners = self._places[self._triangles.simplices[triangle]]
        levels = self._around(places, corners)
        on_edge = np.isnan(levels).any(axis=1) & (triangle >= 0)
        if on_edge.any():
            places = places.copy()
            places[on_edge] += _INWARD * (corners[on_edge].mean(axis=1) - places[on_edge])
            levels = self._around(places, corners)
        level, near, far = levels[:, :1], levels[:, 1:4], levels[:, 4:]
        rises = (4.0 * (near - level) - (far - level)) / (2.0 * _STEP)
        return levels[:, 0], _least_squares(corners - places[:, None, :], rises, self._gradients[triangle])

    def _around(self, places: FloatArray, corners: FloatArray) -> FloatArray:
        """Return elevations (n, 7) at places, and one and two steps from there towards the corners (n, 3, 2)."""
        steps = _STEP * (corners - places[:, None, :])
        here = places[:, None, :]
        around = np.concatenate([here, here + steps, here + 2.0 * steps], axis=1)
        return np.asarray(self._cubic(around) if self._cubic is not None else np.nan, np.float64)

    def describe(self) -> str:
        """Return the description of the seabed."""
        how = "plane triangles" if self.faceted else "cubic triangles (Clough-Tocher)"
        count = len(self._triangles.simplices)
        return f"{count} {how} through {len(self._levels)} scattered points, no seabed outside of their convex hull"


def _different_points(points: ArrayLike) -> FloatArray:
    """Return the points without repeats, elevation first."""
    distinct = np.unique(checked("the surface's points", points, None, 3) + 0.0, axis=0)
    order = np.lexsort((distinct[:, 2], distinct[:, 1]))
    distinct = distinct[order]
    twice = np.flatnonzero((np.diff(distinct[:, 1:], axis=0) == 0.0).all(axis=1))
    if twice.size:
        (first, y, z), second = distinct[twice[0]].tolist(), float(distinct[twice[0] + 1, 0])
        raise ValueError(f"the surface has elevations {first:g} and {second:g} at Y = {y!r}, Z = {z!r}; expected one")
    if len(distinct) < 3:
        raise ValueError(f"the surface has {len(distinct)} different points; expected three or more, not on a line")
    return distinct


def _triangulated(places: FloatArray) -> Delaunay:
    try:
        triangles = Delaunay(places)
    except QhullError as error:
        raise ValueError("the points of the surface lie on a line; expected one off it, or a 2D profile") from error
    if len(triangles.coplanar):
        raise ValueError(f"the surface has {len(triangles.coplanar)} points too close to others to distinguish")
    return triangles


def _plane_gradients(places: FloatArray, levels: FloatArray, corners: IndexArray) -> FloatArray:
    """Return gradients (triangles, 2) of the planes through the corners."""
    arms = places[corners[:, 1:]] - places[corners[:, :1]]
    rises = levels[corners[:, 1:]] - levels[corners[:, :1]]
    (a, b), (c, d) = arms[:, 0].T, arms[:, 1].T
    return _solved(a * d - b * c, rises[:, 0] * d - rises[:, 1] * b, rises[:, 1] * a - rises[:, 0] * c)


def _least_squares(arms: FloatArray, rises: FloatArray, otherwise: FloatArray) -> FloatArray:
    """Return gradients (n, 2) that best fit rises (n, 3) along arms (n, 3, 2); `otherwise` for collinear arms."""
    a, b = arms[..., 0], arms[..., 1]
    aa, ab, bb = (a * a).sum(axis=1), (a * b).sum(axis=1), (b * b).sum(axis=1)
    ar, br = (a * rises).sum(axis=1), (b * rises).sum(axis=1)
    spread = aa * bb - ab * ab
    fitted = _solved(spread, ar * bb - br * ab, br * aa - ar * ab)
    return np.where((spread > _THIN * (aa + bb) ** 2)[:, None], fitted, otherwise)


def _solved(determinant: FloatArray, first: FloatArray, second: FloatArray) -> FloatArray:
    """Return both unknowns (n, 2); 0 if there is no solution."""
    safe = np.where(determinant == 0.0, np.inf, determinant)
    return np.stack([first / safe, second / safe], axis=1)
