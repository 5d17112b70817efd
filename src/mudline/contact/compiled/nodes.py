"""Loops over the nodes of a step: nodal springs, directions, and the reactions without friction."""

from __future__ import annotations

import math

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.memory import Out, Work
from mudline.contact.compiled.springs import zone
from mudline.contact.compiled.tables import Nodes
from mudline.contact.compiled.vectors import along_line, cross, dot


@jitted
def lift(nodes: Nodes, normals: FloatArray, step: int, out: Out) -> None:
    """Add nodal springs to the normal forces, and write the reactions to these."""
    gap, total, reaction = out.gap[step], out.normal_force[step], out.reaction[step]
    springs, one_sided = nodes.springs, nodes.one_sided
    for i in nodes.sprung:
        total[i] += zone(0.0 - gap[i], springs[i, 0], springs[i, 1], one_sided[i])[0]
    stride = 1 if len(normals) > 1 else 0
    for i in range(len(gap)):
        for axis in range(3):
            reaction[i, axis] = total[i] * normals[i * stride, axis] + 0.0


@jitted
def point(normals: FloatArray, tangent: FloatArray) -> None:
    """Turn the sums of tangents into the directions u1 along the line."""
    stride = 1 if len(normals) > 1 else 0
    for i in range(len(tangent)):
        n = (normals[i * stride, 0], normals[i * stride, 1], normals[i * stride, 2])
        u = along_line((tangent[i, 0], tangent[i, 1], tangent[i, 2]), n)
        tangent[i, 0], tangent[i, 1], tangent[i, 2] = u


@jitted
def bend(normals: FloatArray, step: int, work: Work, out: Out) -> None:
    """Add lateral springs to the reactions and to the forces along u2."""
    sideways, tangent, reaction, friction = work.sideways, work.tangent, out.reaction[step], out.friction[step]
    stride = 1 if len(normals) > 1 else 0
    for i in range(len(reaction)):
        n = (normals[i * stride, 0], normals[i * stride, 1], normals[i * stride, 2])
        force = (sideways[i, 0], sideways[i, 1], sideways[i, 2])
        friction[i, 1] += dot(force, cross(n, (tangent[i, 0], tangent[i, 1], tangent[i, 2])))
        for axis in range(3):
            reaction[i, axis] += force[axis]


@jitted
def sound(reaction: FloatArray) -> bool:
    """Whether all reactions are finite."""
    wrong = 0
    for i in range(len(reaction)):
        wrong += not math.isfinite(reaction[i, 0] + reaction[i, 1] + reaction[i, 2])
    return wrong == 0
