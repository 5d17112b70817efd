"""What it takes to evaluate a curve, prepared once."""

from __future__ import annotations

import numpy as np

from mudline.curves.arrays import FloatArray, read_only
from mudline.curves.buckets import BucketTable, bucket_table


class Knots:
    """The sorted points of a curve.

    Attributes:
        ratios: (n,) ascending ratios.
        forces: (n,) forces there.
        tails: (n,) slopes to the right of the points.
        inner: (n - 1,) the ratios that can be passed: all but the first, below which the first segment goes on.
        table: buckets over `inner`, once `prepare` has made them.
    """

    __slots__ = ("forces", "inner", "ratios", "table", "tails")

    table: BucketTable | None

    def __init__(self, ratios: FloatArray, forces: FloatArray, slopes: FloatArray) -> None:
        self.ratios = ratios
        self.forces = forces
        self.tails = read_only(np.append(slopes, slopes[-1]))
        self.inner = ratios[1:]
        self.table = None

    def prepare(self) -> BucketTable:
        """Return the buckets, made at the first call; needs three points or more."""
        if self.table is None:
            self.table = bucket_table(self.ratios)
        return self.table
