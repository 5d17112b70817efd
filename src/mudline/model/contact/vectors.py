"""Directions of elements and nodes in the plane of the seabed, as tuples of components: floats in loops, or arrays.

All functions are expressions that give the same bits for floats and for arrays, see `mudline.model.contact.laws`.
"""

from __future__ import annotations

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import Value, every, where

Vector = tuple[Value, ...]

LEAST_SQUARE, LARGEST_SQUARE = 1e-280, 1e280
"""Bounds of squares of lengths that are computed without under- or overflow."""
_STEEPEST = 1e-18
"""Square of the sine of the angle to the normal of the seabed below which a direction has no projection."""


def dot(a: Vector, b: Vector | FloatArray) -> Value:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def across(along: Vector, normal: Vector) -> Vector:
    """Return n x u."""
    return (
        normal[1] * along[2] - normal[2] * along[1],
        normal[2] * along[0] - normal[0] * along[2],
        normal[0] * along[1] - normal[1] * along[0],
    )


def added(a: Vector, b: Vector) -> Vector:
    """Return the sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def blend(a: Vector, b: Vector, f: Value, g: Value) -> Vector:
    """Return f a + g b."""
    return a[0] * f + b[0] * g, a[1] * f + b[1] * g, a[2] * f + b[2] * g


def mean_normal(a: Vector, b: Vector) -> Vector:
    """Return the mean of two unit normals, as a unit vector."""
    x, y, z = added(a, b)
    size = np.sqrt(dot((x, y, z), (x, y, z)))
    return x / size, y / size, z / size


def span_scale(dx: Value, dy: Value, dz: Value) -> Value:
    """Return a divisor of a span that keeps its square finite; 1 for a span without length."""
    largest = np.maximum(np.maximum(np.abs(dx), np.abs(dy)), np.abs(dz))
    return where((largest > 0.0) & (largest < np.inf), largest, 1.0)


def projected(vector: Vector, normal: Vector) -> tuple[Vector, Value]:
    """Return the unit vector along the projection of a vector on the plane of a normal, and whether it exists."""
    along = dot(vector, normal)
    x, y, z = vector[0] - normal[0] * along, vector[1] - normal[1] * along, vector[2] - normal[2] * along
    square = x * x + y * y + z * z
    exists = square > _STEEPEST
    share = 1.0 / np.sqrt(where(exists, square, 1.0))
    return (x * share, y * share, z * share), exists


def default(normal: Vector) -> Vector:
    """Return the direction of elements and nodes without one: the projection of +Y, or of +Z if +Y is the normal."""
    nothing, one = 0.0 * normal[0], 1.0 + 0.0 * normal[0]
    along, exists = projected((nothing, one, nothing), normal)
    if not every(exists):
        z, _ = projected((nothing, nothing, one), normal)
        along = where(exists, along[0], z[0]), where(exists, along[1], z[1]), where(exists, along[2], z[2])
    return along


def turned(cosine: Value, sine: Value, normal: Vector) -> Vector:
    """Return u1 at an angle to the projection of +Y, about the normal."""
    along = default(normal)
    return blend(along, across(along, normal), cosine, sine)


def reaction(normal_force: Value, normal: Vector, tangential: Vector) -> Vector:
    """Return the reaction of the seabed."""
    # adding 0 turns -0 into 0
    return (
        (normal_force * normal[0] + 0.0) + tangential[0],
        (normal_force * normal[1] + 0.0) + tangential[1],
        (normal_force * normal[2] + 0.0) + tangential[2],
    )


Components = tuple[FloatArray, ...]


def in_plane(vectors: Components, normal: Components) -> Components:
    """Return the unit projections of vectors on the seabed; the default direction for a vector along the normal."""
    unit: Components
    unit, exists = projected(vectors, normal)
    if not exists.all():
        unit = tuple(np.where(exists, here, there) for here, there in zip(unit, default(normal), strict=True))
    return unit


def units(spans: FloatArray) -> FloatArray:
    """Return the unit directions of spans (3, ...), which may be overwritten.

    The direction is 0 for a span without length, or of absent nodes.
    """
    squares = spans * spans
    square = squares[0] + squares[1] + squares[2]
    if not (square.min(initial=1.0) > LEAST_SQUARE and square.max(initial=1.0) < LARGEST_SQUARE):
        odd = ~((square > LEAST_SQUARE) & (square < LARGEST_SQUARE))
        parts = spans[:, odd]
        spans[:, odd] = parts = np.where(np.isfinite(parts), parts / span_scale(*parts), 0.0)
        squares = dot(tuple(parts), tuple(parts))
        square[odd] = np.where(squares > 0.0, squares, np.inf)
    directions: FloatArray = spans * (1.0 / np.sqrt(square))
    return directions
