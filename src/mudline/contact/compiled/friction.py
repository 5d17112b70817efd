"""The loop over the nodes of a step that have friction."""

from __future__ import annotations

import math

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Memory, Out
from mudline.contact.compiled.slip import dragged, inside, returned
from mudline.contact.compiled.tables import Nodes, SmallIndexArray
from mudline.contact.compiled.trench import added, nearest, straight
from mudline.contact.compiled.vectors import Vector, at_angle, cross, dot

Line = tuple[FloatArray, SmallIndexArray, SmallIndexArray]
"""Where the nodes were laid, the nodes of the elements, and the first two elements at each node."""


@jitted
def in_trench(nodes: Nodes, line: Line, i: int, place: Vector, across: Vector) -> float:
    """Offset of a node from the centreline of its trench."""
    k = nodes.line[i]
    if k < 0:
        foot = nearest(line[0], line[1], line[2], i, place)
    else:
        foot = straight((nodes.lines[k, 0], nodes.lines[k, 1], nodes.lines[k, 2], nodes.lines[k, 3]), place)
    return dot(across, (place[0] - foot[0], place[1] - foot[1], place[2] - foot[2]))


@jitted
def leave(memory: Memory, i: int, active: bool) -> None:  # noqa: FBT001 - compiled calls name no arguments
    """An open node forgets its anchor."""
    memory.anchors[i, 0] = memory.anchors[i, 1] = memory.anchors[i, 2] = math.nan
    memory.rubbing[i, 0] = memory.rubbing[i, 1] = 0 if active else -1


@jitted
def rub(
    nodes: Nodes,
    step: int,
    places: tuple[FloatArray, FloatArray, FloatArray],
    line: Line,
    memory: tuple[Memory, Memory],
    out: Out,
) -> bool:
    """Add friction to the reactions; return whether all offsets from trenches are finite.

    `places` are points, normals and directions along the line, of the nodes.
    """
    points, normals, tangent = places
    numbers, trench, active, elliptic = nodes.numbers, nodes.trench, nodes.active, nodes.elliptic
    anchors, rubbing = memory[0].anchors, memory[0].rubbing
    new_anchors, new_rubbing = memory[1].anchors, memory[1].rubbing
    gap, total, reaction, friction = out.gap[step], out.normal_force[step], out.reaction[step], out.friction[step]
    stride = 1 if len(normals) > 1 else 0
    fine = True
    for i in range(len(gap)):
        pressure = total[i]
        if not (active[i] and pressure > 0.0) or math.isnan(gap[i]):
            leave(memory[1], i, active[i])
            friction[i, 0] = friction[i, 1] = 0.0
            continue
        n = (normals[i * stride, 0], normals[i * stride, 1], normals[i * stride, 2])
        u = (tangent[i, 0], tangent[i, 1], tangent[i, 2])
        if not math.isnan(numbers[i, 6]):
            u = at_angle(numbers[i, 6], numbers[i, 7], n)
        v = cross(n, u)
        p = (points[i, 0], points[i, 1], points[i, 2])
        anchor = p
        if rubbing[i, 0] > 0:
            anchor = (anchors[i, 0], anchors[i, 1], anchors[i, 2])
        way = (p[0] - anchor[0], p[1] - anchor[1], p[2] - anchor[2])
        along, across = dot(u, way), dot(v, way)
        stiff, rigid = numbers[i, 2] + numbers[i, 4] * pressure, numbers[i, 3] + numbers[i, 5] * pressure
        first, second = stiff * along, rigid * across
        limit, wall = numbers[i, 0] * pressure, numbers[i, 1] * pressure
        one = other = False
        # a trench only raises the limit: what is inside without it asks for no more
        if not inside(first, second, limit, wall, elliptic[i]):
            if not math.isnan(trench[i, 2]):
                offset = in_trench(nodes, line, i, p, v)
                fine &= math.isfinite(offset)
                if offset != 0.0 and (offset > 0.0) == (second > 0.0):
                    wall += added(offset, trench[i, 0], trench[i, 1], trench[i, 2])
            first, second, one, other = returned(first, second, limit, wall, elliptic[i])
            gone, lost = dragged(one, along, first, stiff), dragged(other, across, second, rigid)
            anchor = (
                anchor[0] + u[0] * gone + v[0] * lost,
                anchor[1] + u[1] * gone + v[1] * lost,
                anchor[2] + u[2] * gone + v[2] * lost,
            )
        new_anchors[i, 0], new_anchors[i, 1], new_anchors[i, 2] = anchor
        new_rubbing[i, 0], new_rubbing[i, 1] = 1 + one, 1 + other
        friction[i, 0], friction[i, 1] = 0.0 - first, 0.0 - second
        for axis in range(3):
            reaction[i, axis] += u[axis] * friction[i, 0] + v[axis] * friction[i, 1]
    out.friction_state[step] = new_rubbing
    return fine
