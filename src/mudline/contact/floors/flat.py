"""The flat bed."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.floors.base import Floor

_UP = np.array([1.0, 0.0, 0.0])
_UP.setflags(write=False)


class FlatFloor(Floor):
    """The bed X = 0, everywhere."""

    same_normal = _UP

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Floor`."""
        self.gaps(points, gap)
        normal[...] = _UP

    def gaps(self, points: FloatArray, gap: FloatArray) -> None:
        """Write the heights."""
        np.add(points[..., 0], 0.0, out=gap)  # a sum with 0 knows no -0

    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return elevations, see `Floor`."""
        return np.zeros(np.broadcast_shapes(np.shape(y), np.shape(z)))

    def describe(self) -> str:
        """Say what the bed is."""
        return "one flat bed at X = 0"
