"""The bed that slopes uniformly."""

from __future__ import annotations

import math

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.floors.base import Floor, heading
from mudline.contact.floors.errors import checked, checked_slope


class SlopingFloor(Floor):
    """A plane through the origin, without end.

    Args:
        slope_degrees: steepest slope, above -90 and below 90; positive rises towards the direction.
        direction_degrees: direction from +Y, counter-clockwise about X (Y turns to Z).

    Raises:
        FloorError: the slope is 90 degrees or more, or a value is not finite.
    """

    same_normal: FloatArray

    def __init__(self, slope_degrees: float, direction_degrees: float = 0.0) -> None:
        self._slope = float(checked("slope of the bed", slope_degrees))
        self._direction = float(checked("direction of the slope", direction_degrees))
        checked_slope("slope of the bed", self._slope)
        angle = math.radians(self._slope)
        cosine, sine = heading(self._direction)
        self._rise = 2.0 * math.tan(angle)
        self._half = 0.5 * cosine, 0.5 * sine
        steep = math.sin(angle)
        self.same_normal = np.array([math.cos(angle), 0.0 - steep * cosine, 0.0 - steep * sine])
        self.same_normal.setflags(write=False)

    def locate(self, points: FloatArray, gap: FloatArray, normal: FloatArray) -> None:
        """Write gaps and normals, see `Floor`."""
        # As a product with the normal, not by the elevation: near a wall that is a large number times a small one.
        upward, along_y, along_z = 0.25 * self.same_normal  # quarters first: their sum cannot overflow
        with np.errstate(over="ignore"):
            quarter = points[..., 0] * upward + points[..., 1] * along_y + points[..., 2] * along_z
            gap[...] = 4.0 * quarter + 0.0
        normal[...] = self.same_normal

    def elevation(self, y: FloatArray, z: FloatArray) -> FloatArray:
        """Return elevations, see `Floor`."""
        with np.errstate(over="ignore"):
            level = self._rise * (self._half[0] * np.asarray(y) + self._half[1] * np.asarray(z))  # see the halves
            return np.asarray(level + 0.0, np.float64)

    def describe(self) -> str:
        """Say what the bed is."""
        return f"plane through the origin, slope {self._slope:g} deg, direction {self._direction:g} deg, without end"
