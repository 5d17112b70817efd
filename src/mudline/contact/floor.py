"""The sea floor: one flat bed at X = 0.

For each point a floor gives the gap (distance to the bed along its normal, positive above) and the unit normal out of
the soil. Here gap = x and the normal is (1, 0, 0).
"""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray

_UP = np.array([1.0, 0.0, 0.0])
_UP.setflags(write=False)


def gaps(points: FloatArray, out: FloatArray) -> None:
    """Write the gaps of `points` (..., 3), in their length unit, to `out` (...)."""
    np.add(points[..., 0], 0.0, out=out)  # a sum with 0 knows no -0


def normals(shape: tuple[int, ...]) -> FloatArray:
    """Return the unit normals (*shape, 3) as a read-only view of one vector."""
    return np.broadcast_to(_UP, (*shape, 3))
