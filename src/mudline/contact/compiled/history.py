"""Loops over the elements of a step that remember: unloading lines and suction."""

from __future__ import annotations

import math
from typing import Final

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out, Work
from mudline.contact.compiled.pull import breakout, next_state, pull
from mudline.contact.compiled.springs import passed
from mudline.contact.compiled.tables import Curves, Elements
from mudline.contact.compiled.unload import deepened, on_line

_COMPRESSION: Final = 1
_SUCTION: Final = 2


@jitted
def steepest_at(curves: Curves, curve: int, ratio: float) -> float:
    """The steepest slope between the mudline and a ratio; at a point the segment to its right does not count yet."""
    first = curves.first[curve]
    i = passed(curves.ratios, first, curves.last[curve], ratio)
    steepest: float = curves.steepest[i - 1 if i > first and ratio == curves.ratios[i] else i]
    return steepest


@jitted
def unload(elements: Elements, curves: Curves, step: int, memory: tuple[Memory, Memory], work: Work, out: Out) -> None:
    """Put the reactions on unloading lines in the place of the virgin ones."""
    held, numbers, curve, height, compressed = (
        elements.unloaded,
        elements.numbers,
        elements.curve,
        work.height,
        work.compressed,
    )
    before, after = memory
    stiff, z_max, force_max, z_p = before.stiffness, before.z_max, before.force_max, before.z_p
    new_stiff, new_z_max, new_force_max, new_z_p = after.stiffness, after.z_max, after.force_max, after.z_p
    depth, force, slope, stiffness = out.depth[step], out.force[step], out.slope[step], out.stiffness[step]
    for u in range(len(held)):
        e = held[u]
        line = (stiff[u], z_max[u], force_max[u], z_p[u])
        z = max(0.0, depth[e])  # 0 for NaN
        if z > line[1]:
            reached = 0.0 if math.isnan(numbers[e, 2]) else numbers[e, 2]
            if curve[e] >= 0:
                reached = steepest_at(curves, curve[e], z / numbers[e, 1]) / numbers[e, 1]
            line = deepened(line[0], z, force[e], reached)
        else:
            force[e], stiffness[e] = on_line(line, z)
        new_stiff[u], new_z_max[u], new_force_max[u], new_z_p[u] = line
        slope[e] = stiffness[e] * numbers[e, 1]
        height[e] = line[3] - depth[e]
        compressed[e] = height[e] < 0.0


@jitted
def suck(elements: Elements, laws: FloatArray, step: int, memory: tuple[Memory, Memory], work: Work, out: Out) -> None:
    """Add suction, and write its states."""
    held, ends, numbers = elements.pulled, elements.ends, elements.numbers
    height, compressed, along = work.height, work.compressed, work.along
    before, after = memory
    was_armed, so_far, was = before.armed, before.v_max, before.state
    new_armed, new_so_far, new = after.armed, after.v_max, after.state
    states, force, slope, stiffness = out.state[step], out.force[step], out.slope[step], out.stiffness[step]
    for k in range(len(held)):
        e = held[k]
        armed, v_max, state = was_armed[k], so_far[k], int(was[k])
        if compressed[e]:
            armed, v_max, state = True, 0.0, _COMPRESSION
        elif math.isnan(height[e]) or not (armed or state > _COMPRESSION):
            armed, v_max, state = False, 0.0, 0
        else:
            velocity = 0.5 * along[ends[e, 0]] + 0.5 * along[ends[e, 1]]
            v_max = max(v_max, velocity) if armed else v_max
            limit = breakout((laws[k, 0], laws[k, 1], laws[k, 2], laws[k, 3]), v_max)
            armed, v_max, state = next_state((armed, v_max, state), limit, height[e], velocity)
            if state == _SUCTION:
                law = (laws[k, 4], laws[k, 5], laws[k, 6], laws[k, 7], laws[k, 8])
                suction, by_uplift = pull(law, limit, height[e], velocity)
                force[e] += suction
                stiffness[e] -= by_uplift
                slope[e] -= by_uplift * numbers[e, 1]
        new_armed[k], new_so_far[k], new[k] = armed, v_max, state
        states[e] = state
