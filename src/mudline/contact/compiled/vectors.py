"""Vectors of three numbers in compiled loops; the sums in the order of `contact.vectors`."""

from __future__ import annotations

import math
from typing import Final

from mudline.contact.compiled.jit import jitted

Vector = tuple[float, float, float]

_STEEPEST: Final = 1.0e-9
"""As in `friction.directions`."""
_SHORTEST: Final = 1.0e-300
"""The inverse of a length above this is finite."""
_CLEAR: Final = 1.0e-12
"""A sum of unit tangents whose square in the bed is above this has a projection on the bed, at some elements a node."""


@jitted
def dot(one: Vector, other: Vector) -> float:
    """Scalar product."""
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


@jitted
def cross(one: Vector, other: Vector) -> Vector:
    """Vector product."""
    return (
        one[1] * other[2] - one[2] * other[1],
        one[2] * other[0] - one[0] * other[2],
        one[0] * other[1] - one[1] * other[0],
    )


@jitted
def projected(wanted: Vector, normal: Vector) -> Vector:
    """The unit vector along the projection on the plane of a unit normal, NaN where there is none."""
    along = dot(wanted, normal)
    rest = (wanted[0] - normal[0] * along, wanted[1] - normal[1] * along, wanted[2] - normal[2] * along)
    size = math.sqrt(dot(rest, rest))
    if not size > _STEEPEST * math.sqrt(dot(wanted, wanted)):
        return (math.nan, math.nan, math.nan)
    return (rest[0] / size, rest[1] / size, rest[2] / size)


@jitted
def in_plane(wanted: Vector, normal: Vector) -> Vector:
    """See `friction.directions.in_plane`: the first of the two vectors, the other is n x u1."""
    first = projected(wanted, normal)
    if math.isnan(first[0]):
        first = projected((0.0, 1.0, 0.0), normal)
    if math.isnan(first[0]):
        first = projected((0.0, 0.0, 1.0), normal)
    return first


@jitted
def unit_tangent(start: Vector, end: Vector) -> Vector:
    """The direction of an element, 0 where it has none."""
    span = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    length = math.sqrt(dot(span, span))
    if not _SHORTEST < length < math.inf:
        if not 0.0 < length < math.inf:
            return (0.0, 0.0, 0.0)
        return (span[0] / length, span[1] / length, span[2] / length)
    share = 1.0 / length
    return (span[0] * share, span[1] * share, span[2] * share)


@jitted
def along_line(tangent: Vector, normal: Vector) -> Vector:
    """The direction u1 of a node from the sum of the unit tangents of its elements."""
    along = dot(tangent, normal)
    rest = (tangent[0] - normal[0] * along, tangent[1] - normal[1] * along, tangent[2] - normal[2] * along)
    square = dot(rest, rest)
    if not square > _CLEAR:
        return in_plane(tangent, normal)
    share = 1.0 / math.sqrt(square)
    return (rest[0] * share, rest[1] * share, rest[2] * share)


@jitted
def at_angle(cosine: float, sine: float, normal: Vector) -> Vector:
    """The direction u1 of a node whose u1 is +Y in the bed, turned."""
    u = along_line((0.0, 1.0, 0.0), normal)
    v = cross(normal, u)
    return (cosine * u[0] + sine * v[0], cosine * u[1] + sine * v[1], cosine * u[2] + sine * v[2])
