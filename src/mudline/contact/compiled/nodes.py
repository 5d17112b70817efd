"""The last loop of a step: nodal springs, friction in trenches, and the reactions of the nodes."""

from __future__ import annotations

import math

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out, Work
from mudline.contact.compiled.slip import box, dragged, ellipse, inside
from mudline.contact.compiled.springs import zone
from mudline.contact.compiled.tables import SmallIndexArray, Tables
from mudline.contact.compiled.trench import added, nearest, straight
from mudline.contact.compiled.vectors import along_line, at_angle, cross, dot


@jitted
def react(
    tables: Tables,
    step: int,
    places: tuple[FloatArray, FloatArray, FloatArray],
    elements_at: SmallIndexArray,
    memory: tuple[Memory, Memory],
    work: Work,
    out: Out,
) -> bool:
    """Write the nodes of a step, and what they remember; return whether everything is finite.

    `places` are points and normals of the nodes, and where they were laid.
    """
    points, normals, laid = places
    numbers, springs, one_sided = tables.nodes.numbers, tables.nodes.springs, tables.nodes.one_sided
    active, elliptic, trench = tables.nodes.active, tables.nodes.elliptic, tables.nodes.trench
    line, lines, ends = tables.nodes.line, tables.nodes.lines, tables.elements.ends
    rubs, bends = tables.has.friction, tables.has.lateral
    anchors, rubbing = memory[0].anchors, memory[0].rubbing
    new_anchors, new_rubbing = memory[1].anchors, memory[1].rubbing
    tangent, sideways = work.tangent, work.sideways
    gap, total, reaction = out.gap[step], out.normal_force[step], out.reaction[step]
    stride = 1 if len(normals) > 1 else 0
    fine = True
    for i in range(len(gap)):
        n = (normals[i * stride, 0], normals[i * stride, 1], normals[i * stride, 2])
        pressure = total[i]
        if springs[i, 0] > 0.0:
            pressure += zone(0.0 - gap[i], springs[i, 0], springs[i, 1], one_sided[i])[0]
            total[i] = pressure
        x, y, z = pressure * n[0] + 0.0, pressure * n[1] + 0.0, pressure * n[2] + 0.0
        first = second = 0.0
        if rubs or bends:
            u = along_line((tangent[i, 0], tangent[i, 1], tangent[i, 2]), n)
            v = cross(n, u)
            f = (sideways[i, 0], sideways[i, 1], sideways[i, 2])
            to_side = dot(f, v)
            if rubs and active[i] and pressure > 0.0 and not math.isnan(gap[i]):
                if not math.isnan(numbers[i, 6]):
                    u = at_angle(numbers[i, 6], numbers[i, 7], n)
                    v = cross(n, u)
                p = (points[i, 0], points[i, 1], points[i, 2])
                held = rubbing[i, 0] > 0
                anchor = (
                    anchors[i, 0] if held else p[0],
                    anchors[i, 1] if held else p[1],
                    anchors[i, 2] if held else p[2],
                )
                way = (p[0] - anchor[0], p[1] - anchor[1], p[2] - anchor[2])
                along, across = dot(u, way), dot(v, way)
                stiff = numbers[i, 2] + numbers[i, 4] * pressure
                rigid = numbers[i, 3] + numbers[i, 5] * pressure
                first, second = stiff * along, rigid * across
                limit, wall = numbers[i, 0] * pressure, numbers[i, 1] * pressure
                one = other = False
                # a trench only raises the limit: what is inside without it asks for no more
                if not inside(first, second, limit, wall, elliptic[i]):
                    if not math.isnan(trench[i, 2]) and second != 0.0:
                        k = line[i]
                        if k < 0:
                            foot = nearest(laid, ends, elements_at, i, p)
                        else:
                            foot = straight((lines[k, 0], lines[k, 1], lines[k, 2], lines[k, 3]), p)
                        offset = dot(v, (p[0] - foot[0], p[1] - foot[1], p[2] - foot[2]))
                        fine &= math.isfinite(offset)
                        if (offset > 0.0) == (second > 0.0):
                            wall += added(offset, trench[i, 0], trench[i, 1], trench[i, 2])
                    if elliptic[i]:
                        first, second, one, other = ellipse(first, second, limit, wall)
                    else:
                        first, second, one, other = box(first, second, limit, wall)
                    gone = dragged(one, along, first, stiff)
                    lost = dragged(other, across, second, rigid)
                    anchor = (
                        anchor[0] + u[0] * gone + v[0] * lost,
                        anchor[1] + u[1] * gone + v[1] * lost,
                        anchor[2] + u[2] * gone + v[2] * lost,
                    )
                new_anchors[i, 0], new_anchors[i, 1], new_anchors[i, 2] = anchor
                new_rubbing[i, 0], new_rubbing[i, 1] = 1 + one, 1 + other
                first, second = 0.0 - first, 0.0 - second
                x += u[0] * first + v[0] * second
                y += u[1] * first + v[1] * second
                z += u[2] * first + v[2] * second
            elif rubs:
                new_anchors[i, 0] = new_anchors[i, 1] = new_anchors[i, 2] = math.nan
                new_rubbing[i, 0] = new_rubbing[i, 1] = 0 if active[i] else -1
            if rubs:
                out.friction_state[step, i, 0], out.friction_state[step, i, 1] = new_rubbing[i, 0], new_rubbing[i, 1]
            second += to_side
            x, y, z = x + f[0], y + f[1], z + f[2]
            out.friction[step, i, 0], out.friction[step, i, 1] = first, second
        reaction[i, 0], reaction[i, 1], reaction[i, 2] = x, y, z
        fine &= math.isfinite(x + y + z)
    return fine
