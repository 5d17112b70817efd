"""The two directions of friction at a node, in the plane of the bed."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray, IndexArray
from mudline.contact.ends import Ends
from mudline.contact.vectors import blank, cross, dot, scaled

_ALONG_Y = np.array([0.0, 1.0, 0.0])
_ALONG_Z = np.array([0.0, 0.0, 1.0])
_STEEPEST = 1.0e-9
"""Sine of the angle to the bed normal below which a direction has no projection on the bed."""


def senses(element_nodes: IndexArray, nodes: int) -> FloatArray:
    """How the tangent of each element (m, 2) counts at its first and at its second node: 1 or -1, (m, 2).

    -1 where the two elements of a node both begin or both end there, and this is the later one: so the line goes
    through the node, whichever way its elements are written.
    """
    sense = np.ones(element_nodes.shape)
    counts = [np.bincount(end, minlength=nodes) for end in element_nodes.T]
    for side, end in enumerate(element_nodes.T):
        twice = (counts[side] == 2) & (counts[1 - side] == 0)
        later = np.zeros(nodes, np.intp)
        later[end] = np.arange(len(end))  # of several the last one stays
        sense[later[twice], side] = -1.0
    return sense


def axial(
    points: FloatArray, element_nodes: IndexArray, normals: FloatArray, sense: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """Directions u1 along the line and u2 = n x u1, each (n, 3), of nodes at `points` (n, 3).

    u1 is the mean of the unit tangents of the node's elements (m, 2), projected on the plane with the unit normal
    (n, 3); where that leaves nothing, +Y is projected instead. An element with a node at NaN has no tangent. `sense`
    is that of `senses`; None where all elements run the same way.
    """
    return in_plane(tangents(points, Ends(element_nodes, len(points)), sense), normals)


def tangents(points: FloatArray, ends: Ends, sense: FloatArray | None = None) -> FloatArray:
    """Sums (n, 3) of the unit tangents of the elements at each node; see `axial`."""
    span = [np.subtract(second, first) for first, second in map(ends.at, points.T)]
    length = np.sqrt(span[0] * span[0] + span[1] * span[1] + span[2] * span[2])
    length[~(length > 0.0)] = np.inf  # no tangent
    total = blank(len(points))
    for axis, part in enumerate(span):
        unit = np.divide(part, length, out=part)
        absent = np.isnan(unit)
        if absent.any():
            unit[absent] = 0.0
        given = [unit if sense is None else unit * sense[:, side] for side in range(2)]
        total[:, axis] = ends.summed(*given)
    return total


class Line:
    """The line that runs through nodes, with what does not change as they move."""

    def __init__(self, element_nodes: IndexArray, nodes: int) -> None:
        self._ends = Ends(element_nodes, nodes)
        sense = senses(element_nodes, nodes)
        self._sense = None if (sense == 1.0).all() else np.asfortranarray(sense)

    def axial(self, points: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Directions of the line and across it at nodes at `points` (n, 3); see `axial`."""
        return in_plane(tangents(points, self._ends, self._sense), normals)


def at_angle(angles: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Directions of nodes whose u1 is +Y in the bed, turned by an angle (n,), degrees, about the bed normal."""
    along, across = in_plane(np.broadcast_to(_ALONG_Y, normals.shape), normals)
    turn = np.radians(angles)[:, None]
    first = np.cos(turn) * along + np.sin(turn) * across
    return first, cross(normals, first)


def in_plane(wanted: FloatArray, normals: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Unit vectors (n, 3) in the planes of unit normals: `wanted` (n, 3) projected, and across it, n x u1.

    A vector along the normal has no projection: +Y takes its place, and +Z where that stands on the bed too.
    """
    first = _projected(wanted, normals)
    for instead in (_ALONG_Y, _ALONG_Z):
        lost = np.isnan(first[:, 0])
        if not lost.any():
            break
        first[lost] = _projected(np.broadcast_to(instead, (int(lost.sum()), 3)), normals[lost])
    return first, cross(normals, first)


def _projected(wanted: FloatArray, normals: FloatArray) -> FloatArray:
    """Unit vectors in the planes, NaN where there is none."""
    rest = scaled(normals, dot(wanted, normals))
    np.subtract(wanted, rest, out=rest)
    size, whole = (np.sqrt(dot(part, part)) for part in (rest, wanted))
    whole *= _STEEPEST
    able = size > whole
    if not able.all():
        size[~able] = np.nan
    rest /= size[:, np.newaxis]
    return rest
