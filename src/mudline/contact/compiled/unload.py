"""One element on its unloading line; see `laws.unloading`."""

from __future__ import annotations

from typing import Final

import numpy as np

from mudline.contact.compiled.jit import jitted

_LARGEST: Final = float(np.finfo(np.float64).max)

Line = tuple[float, float, float, float]
"""Stiffness, z_max, force_max and z_p of an `UnloadingHistory`."""


@jitted
def line_stiffness(stiffness: float, z_max: float, force_max: float) -> float:
    """Stiffness of the line through the deepest point."""
    return max(stiffness, min(force_max / (z_max if z_max > 0.0 else 1.0), _LARGEST))


@jitted
def deepened(stiffness: float, z: float, force: float, steepest: float) -> Line:
    """The history with the deepest point at z, where the virgin path has this force and its steepest slope so far."""
    stiffness, force_max = max(stiffness, steepest), max(force, 0.0)
    deepest = np.nextafter(z, 0.0) if force_max > 0.0 else z
    bottom = z - force_max / line_stiffness(stiffness, z, force_max)
    return stiffness, z, force_max, min(max(bottom, 0.0), deepest)


@jitted
def on_line(line: Line, z: float) -> tuple[float, float]:
    """Force and stiffness at a penetration that is not the largest so far."""
    stiffness, z_max, force_max, z_p = line
    if not z > z_p:
        return 0.0, 0.0
    rise = line_stiffness(stiffness, z_max, force_max)
    return max(force_max - rise * (z_max - z), 0.0), rise
