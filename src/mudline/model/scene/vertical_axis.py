"""Signs that coordinates have Z as the vertical axis; in a deck it is X."""

from __future__ import annotations

import numpy as np

from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices

FLAT = 0.01
"""Share of the water depth by which the X of nodes may differ in a line that is upright along Z."""
NEAR = 0.05
"""Share of the water depth within which a riser ends at the seabed or the sea surface."""
DEEPEST = 5.0
"""Depth in diameters below 0 at which Z may still be the height of a pipe that lies on the seabed."""
LEVEL = 0.005
"""Ratio of rise to length of a level element."""


@np.errstate(over="ignore", invalid="ignore")
def height_along_z(scene: Scene, elements: Indices, places: Floats) -> str:
    """Return in words the signs that Z is the height of nodes at `places` (n, 3); "" without any.

    Either the line has one X and Z spans the water depth. Or elements run along X, and lie just below Z = 0, or at
    minus the water depth, as a pipe on the seabed does. A vertical riser at Z = 0 shows neither sign, unless it is
    longer than the water depth.
    """
    ends = scene.element_nodes[elements]
    used = places[ends.ravel()]
    if not used.size or not np.isfinite(used).all():
        return ""
    (low_x, _, low_z), (high_x, _, high_z) = used.min(axis=0), used.max(axis=0)
    oceans = [block for _, block in scene.deck.blocks("OCEAN")]
    depth = number(oceans[-1], "depth") if oceans else np.nan
    rise = high_z - low_z
    near = NEAR * depth
    if abs(rise - depth) <= near and min(abs(low_z), abs(high_z)) <= near and high_x - low_x <= FLAT * depth:
        return f"X is the same at all nodes and Z goes from {low_z:.5g} to {high_z:.5g}"
    first, second = places[ends[:, 0]], places[ends[:, 1]]
    run = np.abs(second - first)
    along_x = (run[:, 0] > 0.0) & (run[:, 2] <= LEVEL * run[:, 0]) & (run[:, 1] <= run[:, 0])
    middle = 0.5 * first[:, 2] + 0.5 * second[:, 2]
    sunk = along_x & (abs(middle + depth) <= FLAT * depth)
    if sunk.sum() > 1 and high_z > low_z + near:
        return f"{int(sunk.sum())} elements run along X at minus the water depth in Z"
    limit = DEEPEST * np.nan_to_num(scene.diameter[elements])
    lies = along_x & (middle <= 0.0) & (middle >= -limit)
    below = lies & (middle < 0.0)
    if below.sum() > 1 or (lies.any() and high_x - low_x > (1.0 + NEAR) * depth):
        level = f"at Z = {low_z:.5g}" if low_z == high_z else f"with Z from {low_z:.5g} to {high_z:.5g}"
        return f"{int(lies.sum())} elements run along X {level}"
    return ""
