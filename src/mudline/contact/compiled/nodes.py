"""The last loop of a step: nodal springs, friction in trenches, and the reactions of the nodes."""

from __future__ import annotations

import math

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out, Work
from mudline.contact.compiled.slip import box, ellipse
from mudline.contact.compiled.springs import zone
from mudline.contact.compiled.tables import SmallIndexArray, Tables
from mudline.contact.compiled.trench import added, nearest, straight
from mudline.contact.compiled.vectors import cross, dot, in_plane


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
    stride = len(normals) > 1
    fine = True
    for i in range(len(gap)):
        k = i if stride else 0
        n = (normals[k, 0], normals[k, 1], normals[k, 2])
        pressure = total[i]
        if springs[i, 0] > 0.0:
            pressure += zone(0.0 - gap[i], springs[i, 0], springs[i, 1], one_sided[i])[0]
            total[i] = pressure
        x, y, z = pressure * n[0] + 0.0, pressure * n[1] + 0.0, pressure * n[2] + 0.0
        first = second = 0.0
        closed = rubs and active[i] and pressure > 0.0 and not math.isnan(gap[i])
        if closed:
            if math.isnan(numbers[i, 6]):
                u = in_plane((tangent[i, 0], tangent[i, 1], tangent[i, 2]), n)
                v = cross(n, u)
            else:
                u = in_plane((0.0, 1.0, 0.0), n)
                v = cross(n, u)
                c, s = numbers[i, 6], numbers[i, 7]
                u = (c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2])
                v = cross(n, u)
            p = (points[i, 0], points[i, 1], points[i, 2])
            anchor = p
            if rubbing[i, 0] > 0:
                anchor = (anchors[i, 0], anchors[i, 1], anchors[i, 2])
            way = (p[0] - anchor[0], p[1] - anchor[1], p[2] - anchor[2])
            along, across = dot(u, way), dot(v, way)
            stiff, rigid = numbers[i, 2], numbers[i, 3]
            stiff = numbers[i, 4] * pressure if math.isnan(stiff) else stiff
            rigid = numbers[i, 5] * pressure if math.isnan(rigid) else rigid
            pull, push = stiff * along, rigid * across
            limit, wall = numbers[i, 0] * pressure, numbers[i, 1] * pressure
            # within the limit without the trench, the box asks for no more
            if not math.isnan(trench[i, 2]) and push != 0.0 and (elliptic[i] or abs(push) > wall):
                if line[i] < 0:
                    foot = nearest(laid, ends, elements_at, i, p)
                else:
                    c = line[i]
                    foot = straight((lines[c, 0], lines[c, 1], lines[c, 2], lines[c, 3]), p)
                offset = dot(v, (p[0] - foot[0], p[1] - foot[1], p[2] - foot[2]))
                fine &= math.isfinite(offset)
                if offset * push > 0.0:
                    wall += added(offset, trench[i, 0], trench[i, 1], trench[i, 2])
            if elliptic[i]:
                pull_back, push_back, one, other = ellipse(pull, push, limit, wall)
            else:
                pull_back, push_back, one, other = box(pull, push, limit, wall)
            gone = along - (pull_back / stiff if stiff > 0.0 else along) if one else 0.0
            lost = across - (push_back / rigid if rigid > 0.0 else across) if other else 0.0
            new_anchors[i, 0] = anchor[0] + u[0] * gone + v[0] * lost
            new_anchors[i, 1] = anchor[1] + u[1] * gone + v[1] * lost
            new_anchors[i, 2] = anchor[2] + u[2] * gone + v[2] * lost
            new_rubbing[i, 0], new_rubbing[i, 1] = 1 + one, 1 + other
            first, second = 0.0 - pull_back, 0.0 - push_back
            x += u[0] * first + v[0] * second
            y += u[1] * first + v[1] * second
            z += u[2] * first + v[2] * second
        elif rubs:
            new_anchors[i, 0] = new_anchors[i, 1] = new_anchors[i, 2] = math.nan
            new_rubbing[i, 0] = new_rubbing[i, 1] = 0 if active[i] else -1
        if rubs:
            out.friction_state[step, i, 0], out.friction_state[step, i, 1] = new_rubbing[i, 0], new_rubbing[i, 1]
        if bends:
            f = (sideways[i, 0], sideways[i, 1], sideways[i, 2])
            if f[0] != 0.0 or f[1] != 0.0 or f[2] != 0.0:
                x, y, z = x + f[0], y + f[1], z + f[2]
                second += dot(f, cross(n, in_plane((tangent[i, 0], tangent[i, 1], tangent[i, 2]), n)))
        if rubs or bends:
            out.friction[step, i, 0], out.friction[step, i, 1] = first, second
        reaction[i, 0], reaction[i, 1], reaction[i, 2] = x, y, z
        fine &= math.isfinite(x) and math.isfinite(y) and math.isfinite(z)
    return fine
