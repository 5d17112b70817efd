"""How far nodes lie below the bed, where the deck says enough of it."""

from __future__ import annotations

import numpy as np

from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, blocks_of
from mudline.scene.seabed import SeabedKind, SeabedShape

_VERTICAL = 90.0


def depths(scene: Scene) -> Floats:
    """Depths (n,) of the deck's coordinates normal to the bed, negative above it; NaN where they are not known.

    Of a polyline and of a surface it is a lower bound: no point of the bed is nearer. A surface is triangulated between
    its points, so it lies nowhere below the lowest of them. A cubic profile may lie anywhere between its points.
    """
    floor = scene.seabed
    x, y, z = scene.coordinates.T
    if not _is_bed(scene):
        return np.full(len(x), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        if floor.kind is SeabedKind.PLANES:
            return _below_planes(floor, x, y, z)
        if floor.kind in (SeabedKind.FLAT, SeabedKind.SLOPING):
            slope = np.radians(floor.slope)
            found = np.empty(len(x))
            for block in blocks_of(len(x)):
                found[block] = _along(floor.direction, y[block], z[block]) * np.sin(slope) - x[block] * np.cos(slope)
            return found
        if floor.missing or floor.points.size == 0 or floor.interpolation != "LINEAR":
            return np.full(len(x), np.nan)
        if floor.kind is SeabedKind.SURFACE:
            return np.asarray(floor.points[:, 0].min() - x)
        return _below_profile(floor, x, _along(floor.direction, y, z))


def _is_bed(scene: Scene) -> bool:
    """Whether slopes are below 90 degrees, and the deck describes one bed; other rules tell where not."""
    floor = scene.seabed
    if floor.kind is SeabedKind.PLANES and "SEABED PROFILE" in scene.deck.keywords():
        return False
    return all(abs(slope) < _VERTICAL for slope in (floor.slope, *(plane.slope for plane in floor.planes)))


def steepness(scene: Scene) -> Floats:
    """Slopes (n,) of the bed under the nodes as a tangent, without sign: of a profile; of a slope everywhere the same.

    NaN where they are not known.
    """
    floor = scene.seabed
    _, y, z = scene.coordinates.T
    if floor.kind in (SeabedKind.FLAT, SeabedKind.SLOPING):
        return np.full(len(y), abs(np.tan(np.radians(floor.slope))))
    if floor.kind is not SeabedKind.PROFILE or floor.missing or floor.points.size == 0:
        return np.full(len(y), np.nan)
    points = floor.points[np.argsort(floor.points[:, 0], kind="stable")]
    slopes = np.concatenate([[0.0], _slopes(points), [0.0]])
    place = _along(floor.direction, y, z)
    sides = (np.searchsorted(points[:, 0], place, side) for side in ("left", "right"))
    found: Floats = np.maximum(*(slopes[side] for side in sides))
    return found


def _along(direction: float, y: Floats, z: Floats) -> Floats:
    """The horizontal coordinate in which a bed that is the same across it rises or falls."""
    turned = np.radians(direction)
    along: Floats = y * np.cos(turned) + z * np.sin(turned)
    return along


def _slopes(points: Floats) -> Floats:
    widths, rises = np.diff(points, axis=0).T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slopes: Floats = np.abs(np.where(rises == 0.0, 0.0, rises / widths))
    return slopes


def _below_profile(floor: SeabedShape, x: Floats, along: Floats) -> Floats:
    points = floor.points[np.argsort(floor.points[:, 0], kind="stable")]
    steepest = float(_slopes(points).max(initial=0.0))
    below: Floats = (np.interp(along, points[:, 0], points[:, 1]) - x) / np.hypot(1.0, steepest)
    return below


def _below_planes(floor: SeabedShape, x: Floats, y: Floats, z: Floats) -> Floats:
    """Depth below the highest plane whose bounds hold the node; of two as high the later one counts."""
    highest = np.full(len(x), -np.inf)
    depth = np.full(len(x), np.nan)
    for plane in floor.planes:
        x0, y0, z0 = plane.point
        slope = np.radians(plane.slope)
        height = x0 + _along(plane.direction, y - y0, z - z0) * np.tan(slope)
        y_min, y_max, z_min, z_max = plane.bounds
        held = (y >= y_min) & (y <= y_max) & (z >= z_min) & (z <= z_max) & (height >= highest)
        highest[held] = height[held]
        depth[held] = ((height - x) * np.cos(slope))[held]
    return depth
