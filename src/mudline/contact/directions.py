"""The directions of friction at nodes, as arrays: u1 along the line in the plane of the seabed, and u2 = n x u1."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.contact import vectors
from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.tables import Tables

Components = tuple[FloatArray, ...]


def in_plane(wanted: Components, normal: Components) -> Components:
    """Return the unit projections on the seabed; the default direction for what has none.

    Vectors of two components lie in the plane of a horizontal seabed.
    """
    plane = vectors.PLANES[len(wanted)]
    unit: Components
    unit, able = plane.project(wanted, normal)
    if not able.all():
        default = plane.default(normal)
        unit = tuple(np.where(able, here, there) for here, there in zip(unit, default, strict=True))
    return unit


def rescale(spans: list[FloatArray], square: FloatArray) -> FloatArray:
    """Divide spans whose squares under- or overflow by their largest component; return the squares.

    Spans without length, or of absent nodes, become 0.
    """
    odd = ~((square > vectors.LEAST_SQUARE) & (square < vectors.LARGEST_SQUARE))
    parts = [span[odd] for span in spans]
    scale = vectors.span_scale(*parts)
    parts = [np.where(np.isfinite(part), part / scale, 0.0) for part in parts]
    for span, part in zip(spans, parts, strict=True):
        span[odd] = part
    squares = vectors.dot_3(tuple(parts), tuple(parts))
    square[odd] = np.where(squares > 0.0, squares, np.inf)
    return square


def units(spans: list[FloatArray]) -> list[FloatArray]:
    """Return the unit directions of spans, three components, which may be changed; 0 for one without length."""
    square = spans[0] * spans[0]
    for span in spans[1:]:
        square += span * span
    if not (square.min(initial=1.0) > vectors.LEAST_SQUARE and square.max(initial=1.0) < vectors.LARGEST_SQUARE):
        square = rescale(spans, square)
    share = vectors.tangent_share(square)
    return [span * share for span in spans]


class Directions(NamedTuple):
    """Directions of nodes (n,) in one step.

    axes: u1 and u2, each (n, 3).
    follows: (n,) nodes whose directions turn with the line.
    senses: (m, 2) how the direction of each element counts at its ends.
    size: (n,) length of the projection of the sum of the elements' directions.
    """

    axes: tuple[FloatArray, FloatArray]
    follows: BoolArray
    senses: FloatArray
    size: FloatArray


def directions_of(tables: Tables, points: FloatArray, normals: FloatArray) -> Directions:
    """Return the directions of nodes at `points` (n, 3) with unit normals (n, 3)."""
    line, nodes = tables.line, len(points)
    with np.errstate(all="ignore"):
        spans = [points[line.second, axis] - points[line.first, axis] for axis in range(3)]
        unit = units(spans)
        total = np.stack([line.sums(_padded(axis), 0, nodes, directed=True)[0] for axis in unit], axis=1)
        flat = total - (total * normals).sum(axis=1)[:, None] * normals
        along = np.stack(in_plane(tuple(total.T), tuple(normals.T)), axis=1)
        follows = np.ones(nodes, np.bool_)
        friction = tables.friction
        if friction is not None and friction.turned.size:
            there = tuple(normals[friction.turned].T)
            along[friction.turned] = np.stack(vectors.turned_3(friction.cosine, friction.sine, there), axis=1)
            follows[friction.turned] = False
        senses = np.ones((len(line.first), 2))
        senses[line.elements, line.sides] = line.senses
    return Directions((along, np.cross(normals, along)), follows, senses, np.sqrt((flat * flat).sum(axis=1)))


def _padded(values: FloatArray) -> FloatArray:
    return np.concatenate([[0.0], values, [0.0]])[None]
