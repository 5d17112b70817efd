"""The third loop of a step: tangents of the elements, and their lateral springs, added up at their nodes."""

from __future__ import annotations

import math

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.tables import Elements
from mudline.contact.compiled.vectors import along_line, cross, dot, unit_tangent


@jitted
def add_tangents(elements: Elements, points: FloatArray, total: FloatArray) -> None:
    """Add the directions of the elements to `total` (n, 3)."""
    ends, senses = elements.ends, elements.senses
    for e in range(len(ends)):
        a, b = ends[e, 0], ends[e, 1]
        unit = unit_tangent((points[a, 0], points[a, 1], points[a, 2]), (points[b, 0], points[b, 1], points[b, 2]))
        for axis in range(3):
            total[a, axis] += unit[axis] * senses[e, 0]
            total[b, axis] += unit[axis] * senses[e, 1]


@jitted
def spring_back(
    elements: Elements,
    points: FloatArray,
    normals: FloatArray,
    contact: BoolArray,
    touchdown: tuple[FloatArray, FloatArray],
    total: FloatArray,
) -> None:
    """Add the forces of lateral springs to `total` (n, 3); touchdown points (m, 3) before and after the step."""
    ends, numbers = elements.ends, elements.numbers
    before, after = touchdown
    stride = len(normals) > 1
    for e in elements.guided:
        if not contact[e]:
            after[e, 0] = after[e, 1] = after[e, 2] = math.nan
            continue
        a, b = ends[e, 0], ends[e, 1]
        start, end = (points[a, 0], points[a, 1], points[a, 2]), (points[b, 0], points[b, 1], points[b, 2])
        middle = (0.5 * start[0] + 0.5 * end[0], 0.5 * start[1] + 0.5 * end[1], 0.5 * start[2] + 0.5 * end[2])
        held = (before[e, 0], before[e, 1], before[e, 2])
        if math.isnan(held[0]):
            after[e, 0], after[e, 1], after[e, 2] = middle
            continue
        after[e, 0], after[e, 1], after[e, 2] = held
        i, k = (a, b) if stride else (0, 0)
        mean = (normals[i, 0] + normals[k, 0], normals[i, 1] + normals[k, 1], normals[i, 2] + normals[k, 2])
        share = 1.0 / math.sqrt(dot(mean, mean))
        mean = (mean[0] * share, mean[1] * share, mean[2] * share)
        across = cross(mean, along_line(unit_tangent(start, end), mean))
        arm = (middle[0] - held[0], middle[1] - held[1], middle[2] - held[2])
        factor = -0.5 * numbers[e, 7] * dot(across, arm)
        for axis in range(3):
            total[a, axis] += across[axis] * factor
            total[b, axis] += across[axis] * factor
