"""The second loop of a step: the forces of the elements, added up at their nodes."""

from __future__ import annotations

import math
from typing import Final

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out
from mudline.contact.compiled.pull import breakout, next_state, pull
from mudline.contact.compiled.springs import passed, zone
from mudline.contact.compiled.tables import Tables
from mudline.contact.compiled.unload import deepened, on_line

_CURVE: Final = 1
_COMPRESSION: Final = 1


@jitted
def press(tables: Tables, step: int, along: FloatArray, before: Memory, after: Memory, out: Out) -> bool:
    """Write the elements of a step, and what they remember; return whether everything is finite."""
    numbers, one_sided = tables.elements.numbers, tables.elements.one_sided
    ends, kind, curve = tables.elements.ends, tables.elements.kind, tables.elements.curve
    pulled, unloaded, laws = tables.elements.pulled, tables.elements.unloaded, tables.laws
    first_point, last_point = tables.curves.first, tables.curves.last
    ratios, forces, tails, steepest = (
        tables.curves.ratios,
        tables.curves.forces,
        tables.curves.tails,
        tables.curves.steepest,
    )
    cuts = tables.has.cuts
    gap, total = out.gap[step], out.normal_force[step]
    fine = True
    for e in range(len(ends)):
        a, b = ends[e, 0], ends[e, 1]
        half, diameter, linear, onset = numbers[e, 0], numbers[e, 1], numbers[e, 2], numbers[e, 3]
        depth = 0.0 - (0.5 * gap[a] + 0.5 * gap[b])
        ratio = depth / diameter
        touches = depth > onset
        force, stiffness, cut = 0.0, 0.0, False
        reached = 0.0 if math.isnan(linear) else linear
        slope = math.nan if math.isnan(diameter) else 0.0
        if touches and kind[e] == _CURVE:
            first = first_point[curve[e]]
            i = passed(ratios, first, last_point[curve[e]], ratio)
            force, slope = forces[i] + tails[i] * (ratio - ratios[i]), tails[i]
            reached = steepest[i - 1 if i > first and ratio == ratios[i] else i] / diameter
            cut = cuts and force < 0.0
            if cut:
                force, slope = 0.0, 0.0
            stiffness = slope / diameter
        elif touches and kind[e] > _CURVE:
            force, stiffness = zone(depth, linear, numbers[e, 4], one_sided[e])
            slope = stiffness * diameter
        height = onset - depth
        if 0.0 < height <= numbers[e, 6]:
            force -= numbers[e, 5] * height
            stiffness += numbers[e, 5]
            slope += numbers[e, 5] * diameter
        compressed = touches
        u = unloaded[e]
        if u >= 0:
            line = (before.stiffness[u], before.z_max[u], before.force_max[u], before.z_p[u])
            z = depth if depth > 0.0 else 0.0
            if z > line[1]:
                line = deepened(line[0], z, force, reached)
            else:
                force, stiffness = on_line(line, z)
            after.stiffness[u], after.z_max[u], after.force_max[u], after.z_p[u] = line
            slope = stiffness * diameter
            compressed = z > line[3] and not math.isnan(depth)
            height = line[3] - depth
        k = pulled[e]
        if k >= 0:
            armed, v_max, state = before.armed[k], before.v_max[k], int(before.state[k])
            if compressed:
                armed, v_max, state = True, 0.0, _COMPRESSION
            elif math.isnan(height) or not (armed or state > _COMPRESSION):
                armed, v_max, state = False, 0.0, 0
            else:
                law = (
                    laws[k, 0],
                    laws[k, 1],
                    laws[k, 2],
                    laws[k, 3],
                    laws[k, 4],
                    laws[k, 5],
                    laws[k, 6],
                    laws[k, 7],
                    laws[k, 8],
                )
                velocity = 0.5 * along[a] + 0.5 * along[b]
                if armed:
                    v_max = max(v_max, velocity)
                uplift_at_breakout = breakout(law, v_max)
                armed, v_max, state = next_state((armed, v_max, state), uplift_at_breakout, height, velocity)
                if state == 2:
                    suction, by_uplift = pull(law, uplift_at_breakout, height, velocity)
                    force += suction
                    stiffness -= by_uplift
                    slope -= by_uplift * diameter
            after.armed[k], after.v_max[k], after.state[k] = armed, v_max, state
            out.state[step, e] = state
        load = force * half
        total[a] += load
        total[b] += load
        out.depth[step, e], out.ratio[step, e], out.contact[step, e] = depth, ratio, touches
        out.force[step, e], out.slope[step, e], out.stiffness[step, e], out.cut[step, e] = force, slope, stiffness, cut
        fine &= math.isfinite(load) and math.isfinite(force) and math.isfinite(stiffness)
        fine &= not (math.isinf(slope) or math.isinf(depth) or math.isinf(ratio))
    return fine
