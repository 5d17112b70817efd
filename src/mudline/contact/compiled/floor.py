"""The first loop of a step: gaps of the nodes, their pull-out velocities, and sums set to 0."""

from __future__ import annotations

import math

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Work


@jitted
def gaps(points: FloatArray, normal: FloatArray, gap: FloatArray, plain: int) -> bool:
    """Write the gaps to a plane through the origin: horizontal (1) or not (2); 0 leaves what a floor wrote.

    Returns whether none of them overflowed.
    """
    infinite = 0
    upward, along_y, along_z = 0.25 * normal[0, 0], 0.25 * normal[0, 1], 0.25 * normal[0, 2]
    for i in range(len(gap)):
        if plain == 1:
            gap[i] = points[i, 0] + 0.0
        elif plain == 2:
            gap[i] = 4.0 * (points[i, 0] * upward + points[i, 1] * along_y + points[i, 2] * along_z) + 0.0
        infinite += math.isinf(gap[i])
    return infinite == 0


@jitted
def velocities(
    rates: FloatArray, before: FloatArray, dt: float, normals: FloatArray, gap: FloatArray, along: FloatArray
) -> bool:
    """Write the velocities along the normals: those given, or differences of places where dt > 0.

    Returns whether all that count are finite.
    """
    stride = len(normals) > 1
    wrong = 0
    for i in range(len(gap)):
        k = i if stride else 0
        vx, vy, vz = rates[i, 0], rates[i, 1], rates[i, 2]
        if dt > 0.0:
            vx, vy, vz = (vx - before[i, 0]) / dt, (vy - before[i, 1]) / dt, (vz - before[i, 2]) / dt
        along[i] = vx * normals[k, 0] + vy * normals[k, 1] + vz * normals[k, 2]
        wrong += not math.isfinite(along[i]) and not math.isnan(gap[i])
    return wrong == 0


@jitted
def begin(work: Work, normal_force: FloatArray) -> None:
    """Set the sums at the nodes to 0."""
    normal_force[:] = 0.0
    work.tangent[:] = 0.0
    work.sideways[:] = 0.0
