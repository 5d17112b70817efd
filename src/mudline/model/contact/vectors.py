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
"""Squares of lengths between these are computed without under- or overflow."""
_STEEPEST = 1e-18
"""Square of the sine of the angle to the normal of the seabed below which a direction has no projection."""


def dot_2(one: Vector, other: Vector) -> Value:
    """Return the scalar product in the plane of a horizontal seabed."""
    return one[0] * other[0] + one[1] * other[1]


def dot_3(one: Vector, other: Vector) -> Value:
    """Return the scalar product."""
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


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


def mean_normal(one: Vector, other: Vector) -> Vector:
    """Return the mean of two unit normals, as a unit vector."""
    x, y, z = added_3(one, other)
    size = np.sqrt(dot_3((x, y, z), (x, y, z)))
    return x / size, y / size, z / size


def tangent_share(square: Value) -> Value:
    """Return 1 / length of a span with this square, which lies between `LEAST_SQUARE` and `LARGEST_SQUARE`."""
    return 1.0 / np.sqrt(square)


def span_scale(dx: Value, dy: Value, dz: Value) -> Value:
    """Return a number by which any span may be divided before its square is taken; 1 for one without length."""
    largest = np.maximum(np.maximum(np.abs(dx), np.abs(dy)), np.abs(dz))
    return where((largest > 0.0) & (largest < np.inf), largest, 1.0)


def projected_2(wanted: Vector, _normal: Vector) -> tuple[Vector, Value]:
    """Return the unit vector along `wanted`, which lies in the plane, and whether it has a length."""
    square = wanted[0] * wanted[0] + wanted[1] * wanted[1]
    able = square > _STEEPEST
    share = 1.0 / np.sqrt(where(able, square, 1.0))
    return (wanted[0] * share, wanted[1] * share), able


def projected_3(wanted: Vector, normal: Vector) -> tuple[Vector, Value]:
    """Return the unit vector along the projection of `wanted` on the plane of a normal, and whether there is one."""
    along = wanted[0] * normal[0] + wanted[1] * normal[1] + wanted[2] * normal[2]
    rest_x, rest_y = wanted[0] - normal[0] * along, wanted[1] - normal[1] * along
    rest_z = wanted[2] - normal[2] * along
    square = rest_x * rest_x + rest_y * rest_y + rest_z * rest_z
    able = square > _STEEPEST
    share = 1.0 / np.sqrt(where(able, square, 1.0))
    return (rest_x * share, rest_y * share, rest_z * share), able


def default_2(normal: Vector) -> Vector:
    """Return the direction of what has none of its own: +Y."""
    return 1.0 + 0.0 * normal[0], 0.0 * normal[0]


def default_3(normal: Vector) -> Vector:
    """Return the direction of what has none of its own: the projection of +Y, or of +Z where +Y is the normal."""
    nothing, one = 0.0 * normal[0], 1.0 + 0.0 * normal[0]
    along_y, able = projected_3((nothing, one, nothing), normal)
    along_z, _ = projected_3((nothing, nothing, one), normal)
    return (
        where(able, along_y[0], along_z[0]),
        where(able, along_y[1], along_z[1]),
        where(able, along_y[2], along_z[2]),
    )


def turned_2(cosine: Value, sine: Value, _normal: Vector) -> Vector:
    """Return u1 at an angle to +Y over a horizontal seabed."""
    return cosine, sine


def turned_3(cosine: Value, sine: Value, normal: Vector) -> Vector:
    """Return u1 at an angle to the projection of +Y, about the normal."""
    along = default_3(normal)
    across = across_3(along, normal)
    return (
        cosine * along[0] + sine * across[0],
        cosine * along[1] + sine * across[1],
        cosine * along[2] + sine * across[2],
    )


def blend_2(one: Vector, other: Vector, f: Value, g: Value) -> Vector:
    """Return f one + g other in the plane of a horizontal seabed."""
    return one[0] * f + other[0] * g, one[1] * f + other[1] * g


def blend_3(one: Vector, other: Vector, f: Value, g: Value) -> Vector:
    """Return f one + g other."""
    return one[0] * f + other[0] * g, one[1] * f + other[1] * g, one[2] * f + other[2] * g


def added_2(one: Vector, other: Vector) -> Vector:
    """Return the sum of two vectors in the plane of a horizontal seabed."""
    return one[0] + other[0], one[1] + other[1]


def added_3(one: Vector, other: Vector) -> Vector:
    """Return the sum of two vectors."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2]


def reaction_2(normal_force: Value, normal: Vector, tangential: Vector) -> Vector:
    """Return the reaction of a horizontal seabed, (X, Y, Z)."""
    # a sum with 0 knows no -0
    return normal_force * normal[0] + 0.0, tangential[0] + 0.0, tangential[1] + 0.0


def reaction_3(normal_force: Value, normal: Vector, tangential: Vector) -> Vector:
    """Return the reaction of the seabed."""
    return (
        (normal_force * normal[0] + 0.0) + tangential[0],
        (normal_force * normal[1] + 0.0) + tangential[1],
        (normal_force * normal[2] + 0.0) + tangential[2],
    )


class Plane(NamedTuple):
    """The functions above for one number of components.

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
    2: Plane(projected_2, default_2, across_2, dot_2, turned_2, blend_2, added_2, reaction_2),
    3: Plane(projected_3, default_3, across_3, dot_3, turned_3, blend_3, added_3, reaction_3),
}
"""By the number of components."""


Components = tuple[FloatArray, ...]


def in_plane(wanted: Components, normal: Components) -> Components:
    """Return the unit projections on the seabed; the default direction for what has none.

    Vectors of two components lie in the plane of a horizontal seabed.
    """
    plane = PLANES[len(wanted)]
    unit: Components
    unit, able = plane.project(wanted, normal)
    if not able.all():
        default = plane.default(normal)
        unit = tuple(np.where(able, here, there) for here, there in zip(unit, default, strict=True))
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
    """Return the unit directions of spans (3, ...), which may be changed; 0 for one without length."""
    squares = spans * spans
    square = squares[0] + squares[1] + squares[2]
    if not (square.min(initial=1.0) > LEAST_SQUARE and square.max(initial=1.0) < LARGEST_SQUARE):
        square = rescale(spans, square)
    found: FloatArray = spans * tangent_share(square)
    return found
