"""Products of rows of vectors (n, 3), column by column: sums over axes of three numbers take many times that."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray


def dot(one: FloatArray, other: FloatArray) -> FloatArray:
    """Scalar products (n,) of vectors (n, 3)."""
    total: FloatArray = one[:, 0] * other[:, 0]
    total += one[:, 1] * other[:, 1]
    total += one[:, 2] * other[:, 2]
    return total


def cross(one: FloatArray, other: FloatArray) -> FloatArray:
    """Vector products (n, 3) of vectors (n, 3)."""
    product = np.empty(one.shape)
    for axis in range(3):
        following, last = (axis + 1) % 3, (axis + 2) % 3
        np.multiply(one[:, following], other[:, last], out=product[:, axis])
        product[:, axis] -= one[:, last] * other[:, following]
    return product


def scaled(vectors: FloatArray, factors: FloatArray) -> FloatArray:
    """Vectors (n, 3), each times its factor (n,)."""
    product = np.empty(vectors.shape)
    for axis in range(3):
        np.multiply(vectors[:, axis], factors, out=product[:, axis])
    return product


def added_at(rows: Sequence[IndexArray], vectors: FloatArray, count: int) -> FloatArray:
    """Sums (count, 3) of vectors (k, 3) over each of the `rows`, arrays (k,) of where they go."""
    total = np.empty((count, 3))
    for axis in range(3):
        values = np.ascontiguousarray(vectors[:, axis])
        total[:, axis] = sum(np.bincount(at, values, count) for at in rows)
    return total
