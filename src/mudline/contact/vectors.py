"""Products of rows of vectors (n, 3), column by column: sums over axes of three numbers take many times that.

Arrays made here have the shape (n, 3) and each component in one piece of memory, so that columns are read in sequence.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray


def blank(count: int, components: int = 3) -> FloatArray:
    """Room for vectors (count, components)."""
    return np.empty((components, count)).T


def nothing(count: int, components: int = 3) -> FloatArray:
    """Vectors (count, components) of zeros."""
    return np.zeros((components, count)).T


def gathered(vectors: FloatArray, rows: IndexArray) -> FloatArray:
    """The `rows` (k,) of vectors (n, components)."""
    return vectors.T.take(rows, axis=1).T


def dot(one: FloatArray, other: FloatArray) -> FloatArray:
    """Scalar products (n,) of vectors (n, 3)."""
    product = np.multiply(one, other, order="F")
    total: FloatArray = product[:, 0] + product[:, 1]
    total += product[:, 2]
    return total


def cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """Vector products (n, 3) of vectors (n, 3)."""
    product, term = blank(len(one)), np.empty(len(one))
    for axis in range(3):
        following, last = (axis + 1) % 3, (axis + 2) % 3
        column = product[:, axis]
        np.multiply(one[:, following], other[:, last], out=column)
        column -= np.multiply(one[:, last], other[:, following], out=term)
    return product


def scaled(vectors: FloatArray, factors: FloatArray) -> FloatArray:
    """Vectors (n, 3), each times its factor (n,)."""
    return np.multiply(vectors, factors[:, np.newaxis], order="F")


def added_at(rows: Sequence[IndexArray], vectors: FloatArray, count: int) -> FloatArray:
    """Sums (count, 3) of vectors (k, 3) over each of the `rows`, arrays (k,) of where they go."""
    total = blank(count)
    for axis in range(3):
        values = np.ascontiguousarray(vectors[:, axis])
        total[:, axis] = sum(np.bincount(at, values, count) for at in rows)
    return total
