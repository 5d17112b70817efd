"""Directions along and across the line at its nodes, and the seabed below trenches."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.model.contact import vectors
from mudline.model.contact.arrays import BoolArray, FloatArray, IndexArray
from mudline.model.contact.tables import LawTables
from mudline.model.contact.vectors import in_plane, turned_3, units

if TYPE_CHECKING:
    from mudline.model.contact.trenches import Lowered


class Directions(NamedTuple):
    """Directions at nodes (n,) in one step.

    Attributes:
        axes: u1 and u2, each (n, 3).
        follows: (n,) nodes whose directions turn with the line.
        senses: (m, 2) sign of each element's direction at its two ends.
        size: (n,) length of the projection of the sum of the elements' directions.
    """

    axes: tuple[FloatArray, FloatArray]
    follows: BoolArray
    senses: FloatArray
    size: FloatArray


def directions_of(tables: LawTables, points: FloatArray, normals: FloatArray) -> Directions:
    """Return the directions of nodes at `points` (n, 3) with unit normals (n, 3)."""
    line, nodes = tables.line, len(points)
    with np.errstate(all="ignore"):
        spans = (points[line.second] - points[line.first]).T
        unit = units(spans)
        total = np.ascontiguousarray(line.sums(np.pad(unit, ((0, 0), (1, 1))), directed=True).T)
        flat = total - (total * normals).sum(axis=1)[:, None] * normals
        along = projected(total, normals)
        follows = np.ones(nodes, np.bool_)
        friction = tables.friction
        if friction is not None and friction.turned.size:
            there = tuple(normals[friction.turned].T)
            along[friction.turned] = np.stack(turned_3(friction.cosine, friction.sine, there), axis=1)
            follows[friction.turned] = False
        senses = np.ones((len(line.first), 2))
        senses[line.elements, line.sides] = line.senses
    return Directions((along, np.cross(normals, along)), follows, senses, np.sqrt((flat * flat).sum(axis=1)))


def lower(tables: LawTables, points: FloatArray, laid: FloatArray, normal: FloatArray, gap: FloatArray) -> None:
    """Add the depth of trenches with a lowered seabed to gaps (steps, n) of `points` (steps, n, 3)."""
    for place, normals, height in zip(points, normal, gap, strict=True):
        np.add(height, level(tables, place, laid, normals).depth, out=height)


def level(tables: LawTables, points: FloatArray, laid: FloatArray, normal: FloatArray) -> Lowered:
    """Return depth and gradient of trenches below nodes at `points` (n, 3).

    Raises TypeError if no trench lowers the seabed.
    """
    from mudline.model.contact.trenches import level_at  # noqa: PLC0415 - few trenches do

    if tables.level is None:
        raise TypeError("no trench lowers the seabed")
    lateral = directions_of(tables, points, normal).axes[1]
    return level_at(tables.level, tables.laid_line(laid), points, lateral)


def projected(vectors: FloatArray, normal: FloatArray) -> FloatArray:
    """Return unit vectors (k, 3) along projections of vectors; the default direction for a vector along the normal."""
    return np.stack(in_plane(tuple(vectors.T), tuple(normal.T)), axis=1)


def mean_normal(tables: LawTables, elements: IndexArray, normal: FloatArray) -> tuple[FloatArray, ...]:
    """Return components (steps, k) of the mean unit normal at both ends of elements (k,); normals are (steps, n, 3)."""
    if normal.strides[1] == 0:  # all nodes share a normal
        return tuple(normal[:1, :1, axis] for axis in range(3))
    start, end = (normal[:, side[elements]] for side in (tables.line.first, tables.line.second))
    return vectors.mean_normal(*(tuple(each[..., axis] for axis in range(3)) for each in (start, end)))
