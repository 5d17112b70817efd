"""Directions of elements and nodes in the plane of the seabed, as tuples of components: floats in loops, or arrays.

Over a horizontal seabed vectors in its plane have two components, (Y, Z); else three. All functions are expressions
that give the same bits for floats and for arrays, see `mudline.model.contact.laws`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import Value, where

Vector = tuple[Value, ...]

LEAST_SQUARE, LARGEST_SQUARE = 1e-280, 1e280
"""Bounds of squares of lengths that are computed without under- or overflow."""
_STEEPEST = 1e-18
"""Square of the sine of the angle to the normal of the seabed below which a direction has no projection."""


def dot_2(a: Vector, b: Vector) -> Value:
    """Return the scalar product in the plane of a horizontal seabed."""
    return a[0] * b[0] + a[1] * b[1]


def dot_3(a: Vector, b: Vector) -> Value:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def across_2(along: Vector, _normal: Vector) -> Vector:
    """Return n x u of a horizontal seabed."""
    return 0.0 - along[1], along[0]


def across_3(along: Vector, normal: Vector) -> Vector:
    """Return n x u."""
    return (
        normal[1] * along[2] - normal[2] * along[1],
        normal[2] * along[0] - normal[0] * along[2],
        normal[0] * along[1] - normal[1] * along[0],
    )


def mean_normal(a: Vector, b: Vector) -> Vector:
    """Return the mean of two unit normals, as a unit vector."""
    x, y, z = added_3(a, b)
    size = np.sqrt(dot_3((x, y, z), (x, y, z)))
    return x / size, y / size, z / size


def tangent_share(square: Value) -> Value:
    """Return 1 / length of a span with this square, which lies between `LEAST_SQUARE` and `LARGEST_SQUARE`."""
    return 1.0 / np.sqrt(square)


def span_scale(dx: Value, dy: Value, dz: Value) -> Value:
    """Return a divisor of a span that keeps its square finite; 1 for a span without length."""
    largest = np.maximum(np.maximum(np.abs(dx), np.abs(dy)), np.abs(dz))
    return where((largest > 0.0) & (largest < np.inf), largest, 1.0)


def projected_2(vector: Vector, _normal: Vector) -> tuple[Vector, Value]:
    """Return the unit vector along a vector in the plane, and whether the vector has a length."""
    square = dot_2(vector, vector)
    exists = square > _STEEPEST
    share = 1.0 / np.sqrt(where(exists, square, 1.0))
    return (vector[0] * share, vector[1] * share), exists


def projected_3(vector: Vector, normal: Vector) -> tuple[Vector, Value]:
    """Return the unit vector along the projection of a vector on the plane of a normal, and whether it exists."""
    along = dot_3(vector, normal)
    rest = vector[0] - normal[0] * along, vector[1] - normal[1] * along, vector[2] - normal[2] * along
    square = dot_3(rest, rest)
    exists = square > _STEEPEST
    share = 1.0 / np.sqrt(where(exists, square, 1.0))
    return (rest[0] * share, rest[1] * share, rest[2] * share), exists


def default_2(normal: Vector) -> Vector:
    """Return the direction of elements and nodes without a direction of their own: +Y."""
    return 1.0 + 0.0 * normal[0], 0.0 * normal[0]


def default_3(normal: Vector) -> Vector:
    """Return the default direction: the projection of +Y, or of +Z if +Y is the normal."""
    nothing, one = 0.0 * normal[0], 1.0 + 0.0 * normal[0]
    along_y, exists = projected_3((nothing, one, nothing), normal)
    along_z, _ = projected_3((nothing, nothing, one), normal)
    return (
        where(exists, along_y[0], along_z[0]),
        where(exists, along_y[1], along_z[1]),
        where(exists, along_y[2], along_z[2]),
    )


def turned_2(cosine: Value, sine: Value, _normal: Vector) -> Vector:
    """Return u1 at an angle to +Y over a horizontal seabed."""
    return cosine, sine


def turned_3(cosine: Value, sine: Value, normal: Vector) -> Vector:
    """Return u1 at an angle to the projection of +Y, about the normal."""
    along = default_3(normal)
    return blend_3(along, across_3(along, normal), cosine, sine)


def blend_2(a: Vector, b: Vector, f: Value, g: Value) -> Vector:
    """Return f a + g b in the plane of a horizontal seabed."""
    return a[0] * f + b[0] * g, a[1] * f + b[1] * g


def blend_3(a: Vector, b: Vector, f: Value, g: Value) -> Vector:
    """Return f a + g b."""
    return a[0] * f + b[0] * g, a[1] * f + b[1] * g, a[2] * f + b[2] * g


def added_2(a: Vector, b: Vector) -> Vector:
    """Return the sum of two vectors in the plane of a horizontal seabed."""
    return a[0] + b[0], a[1] + b[1]


def added_3(a: Vector, b: Vector) -> Vector:
    """Return the sum of two vectors."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def reaction_2(normal_force: Value, normal: Vector, tangential: Vector) -> Vector:
    """Return the reaction of a horizontal seabed, (X, Y, Z)."""
    # adding 0 turns -0 into 0
    return normal_force * normal[0] + 0.0, tangential[0] + 0.0, tangential[1] + 0.0


def reaction_3(normal_force: Value, normal: Vector, tangential: Vector) -> Vector:
    """Return the reaction of the seabed."""
    return (
        (normal_force * normal[0] + 0.0) + tangential[0],
        (normal_force * normal[1] + 0.0) + tangential[1],
        (normal_force * normal[2] + 0.0) + tangential[2],
    )


class PlaneFunctions(NamedTuple):
    """The functions above for two or for three components.

    project, default, across, dot, turned, blend, added, reaction: as the functions.
    """

    project: Callable[..., Any]
    default: Callable[..., Any]
    across: Callable[..., Any]
    dot: Callable[..., Any]
    turned: Callable[..., Any]
    blend: Callable[..., Any]
    added: Callable[..., Any]
    reaction: Callable[..., Any]


PLANES = {
    2: PlaneFunctions(projected_2, default_2, across_2, dot_2, turned_2, blend_2, added_2, reaction_2),
    3: PlaneFunctions(projected_3, default_3, across_3, dot_3, turned_3, blend_3, added_3, reaction_3),
}
"""The functions by number of components."""


Components = tuple[FloatArray, ...]


def in_plane(vectors: Components, normal: Components) -> Components:
    """Return the unit projections of vectors on the seabed; the default direction for a vector along the normal.

    Vectors of two components lie in the plane of a horizontal seabed.
    """
    plane = PLANES[len(vectors)]
    unit: Components
    unit, exists = plane.project(vectors, normal)
    if not exists.all():
        default = plane.default(normal)
        unit = tuple(np.where(exists, here, there) for here, there in zip(unit, default, strict=True))
    return unit


def rescale(spans: FloatArray, square: FloatArray) -> FloatArray:
    """Divide spans whose squares under- or overflow by their largest component; return the squares.

    Spans without length, or of absent nodes, become 0.
    """
    odd = ~((square > LEAST_SQUARE) & (square < LARGEST_SQUARE))
    parts = spans[:, odd]
    scale = span_scale(*parts)
    spans[:, odd] = parts = np.where(np.isfinite(parts), parts / scale, 0.0)
    squares = dot_3(tuple(parts), tuple(parts))
    square[odd] = np.where(squares > 0.0, squares, np.inf)
    return square


def units(spans: FloatArray) -> FloatArray:
    """Return the unit directions of spans (3, ...), which may be overwritten; 0 for a span without length."""
    squares = spans * spans
    square = squares[0] + squares[1] + squares[2]
    if not (square.min(initial=1.0) > LEAST_SQUARE and square.max(initial=1.0) < LARGEST_SQUARE):
        square = rescale(spans, square)
    directions: FloatArray = spans * tangent_share(square)
    return directions
