"""The trench of one node: the nearest point of its centreline, and what it adds to the limit; see `friction.trench`."""

from __future__ import annotations

from mudline.contact.arrays import FloatArray
from mudline.contact.compiled.jit import jitted
from mudline.contact.compiled.tables import SmallIndexArray
from mudline.contact.compiled.vectors import Vector, dot

Foot = tuple[float, Vector, float]
"""Share of an element, the place there, and its distance squared."""


@jitted
def foot(start: Vector, end: Vector, point: Vector) -> Foot:
    """The nearest point of an element."""
    span = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    way = (point[0] - start[0], point[1] - start[1], point[2] - start[2])
    square = dot(span, span)
    share = min(max(dot(way, span) / square, 0.0), 1.0) if square > 0.0 else 0.0
    place = (start[0] + span[0] * share, start[1] + span[1] * share, start[2] + span[2] * share)
    away = (point[0] - place[0], point[1] - place[1], point[2] - place[2])
    return share, place, dot(away, away)


@jitted
def nearest(laid: FloatArray, ends: SmallIndexArray, elements_at: SmallIndexArray, node: int, point: Vector) -> Vector:
    """The nearest point of the line as it was laid, sought from the node's own place."""
    best = point
    current = elements_at[node, 0]
    if current < 0:
        return best
    share, best, distance = _foot_on(laid, ends, current, point)
    other = elements_at[node, 1]
    if other >= 0:
        second, place, away = _foot_on(laid, ends, other, point)
        if away < distance:
            current, share, best, distance = other, second, place, away
    while share <= 0.0 or share >= 1.0:
        end = ends[current, 0] if share <= 0.0 else ends[current, 1]
        following = elements_at[end, 0] if elements_at[end, 0] != current else elements_at[end, 1]
        if following < 0:
            break
        second, place, away = _foot_on(laid, ends, following, point)
        if not away < distance:
            break
        current, share, best, distance = following, second, place, away
    return best


@jitted
def _foot_on(laid: FloatArray, ends: SmallIndexArray, element: int, point: Vector) -> Foot:
    a, b = ends[element, 0], ends[element, 1]
    return foot((laid[a, 0], laid[a, 1], laid[a, 2]), (laid[b, 0], laid[b, 1], laid[b, 2]), point)


@jitted
def straight(line: tuple[float, float, float, float], point: Vector) -> Vector:
    """The foot on a straight centreline, a place and a direction in the plan, at the point's own elevation."""
    y, z, along_y, along_z = line
    way = (point[1] - y) * along_y + (point[2] - z) * along_z
    return (point[0], y + way * along_y, z + way * along_z)


@jitted
def added(offset: float, inner: float, outer: float, peak: float) -> float:
    """What the walls add against outward motion, at an offset from the centreline."""
    half = 0.5 * (outer - inner)
    distance = abs(offset)
    if inner < distance <= inner + half:
        return peak * ((distance - inner) / half)
    if inner + half < distance < outer:
        return peak * ((outer - distance) / half)
    return 0.0
