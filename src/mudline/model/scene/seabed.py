"""Shape of the seabed that a deck describes: flat, a slope, a profile, a surface or planes; files of points.

It also has the evaluator's seabed, the share of each element where the seabed rises above the water, and the end of the
survey.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from enum import Enum
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple, cast

import numpy as np

from mudline.basics.limits import LARGEST_FILE
from mudline.basics.outside import without_text
from mudline.basics.short_repr import counted, short_repr
from mudline.language.diagnostics import Where
from mudline.language.keywords.text import shown
from mudline.model.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed, heading
from mudline.model.scene.context import Context
from mudline.model.scene.data_files import lines_of, number_of
from mudline.model.scene.deck_values import file_name, find_file, number
from mudline.model.scene.numbering import Floats, Indices, Mask

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_surface import Plane, SeabedPlanes, SeabedProfile
    from mudline.model.contact.seabed.profile import Interpolation


_NO_POINTS = np.zeros((0, 2))
COMPILED = ".fcsbd"
_SAMPLES, _PLANE = 65, 1e-6
"""Sampling of a seabed below a line.

_SAMPLES: number of places.
_PLANE: distance from one plane, over the line's length, up to which the seabed is plane.
"""
_PARTS = re.compile(r"[\s,]+")
FLAT = 0.01
"""Share of the water depth by which the X of nodes may differ in a line that is upright along Z."""
NEAR = 0.05
"""Share of the water depth within which a riser ends at the seabed or the sea surface."""


class SeabedKind(Enum):
    """Form in which the seabed is given."""

    FLAT = "flat"
    SLOPING = "sloping"
    PROFILE = "2D profile"
    SURFACE = "3D surface"
    PLANES = "planes"


class SeabedPlane(NamedTuple):
    """Plane: a point (elevation, Y, Z), slope and direction in degrees, bounds (Y and Z, infinite where open)."""

    name: str
    point: tuple[float, float, float]
    slope: float
    direction: float
    bounds: tuple[float, float, float, float]


class SeabedShape(NamedTuple):
    """Seabed, angles in degrees, lengths in the deck's units.

    kind: form in which it is given.
    slope, direction: of a slope or profile.
    interpolation: between points.
    points: (k, 2) Y and elevation of a profile, (k, 3) elevation, Y and Z of a surface, in the order of the deck.
    planes: planes of the seabed.
    file: file of the points.
    missing: reason why the points are not known, "" if they are.
    where: place in the deck.
    unreadable: places and faults of all files of points that could not be read, even of unused profiles.
    """

    kind: SeabedKind = SeabedKind.FLAT
    slope: float = 0.0
    direction: float = 0.0
    interpolation: str = "LINEAR"
    points: Floats = _NO_POINTS
    planes: tuple[SeabedPlane, ...] = ()
    file: str = ""
    missing: str = ""
    where: Where = Where()
    unreadable: tuple[tuple[Where, str], ...] = ()

    def __repr__(self) -> str:
        return short_repr(self)


class LineExtent(NamedTuple):
    """Smallest and largest coordinates of the nodes of a line, and the depth of the water; NaN where not known."""

    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]
    depth: float

    def spans_depth_in_z(self) -> bool:
        """Return True if Z goes from 0 to the depth, or from the depth below 0 to 0, as the height of a riser does."""
        near, (low, high) = NEAR * self.depth, self.z
        return abs(high - low - self.depth) <= near and min(abs(low), abs(high)) <= near

    def height_along_z(self) -> str:
        """Return in words that Z spans the depth of the water and X is the same, as if Z were the height; else ""."""
        if not self.spans_depth_in_z() or not self.x[1] - self.x[0] <= FLAT * self.depth:
            return ""
        return f"X is the same at all nodes and Z goes from {self.z[0]:.5g} to {self.z[1]:.5g}"


def read_seabed(context: Context) -> SeabedShape:
    """Return the seabed of a deck: the last `*SEABED PLANES`, else the last `*SEABED PROFILE`, else the surface's."""
    shape = SeabedShape()
    unreadable: list[tuple[Where, str]] = []
    for where, surface in context.surfaces:
        if surface.profile is not None:
            points = np.column_stack((surface.profile.column(0), surface.profile.column(1)))
            shape = SeabedShape(SeabedKind.PROFILE, points=points, where=where.inside("profile"))
        elif surface.slope is not None:
            shape = SeabedShape(SeabedKind.SLOPING, number(surface, "slope"), where=where.inside("slope"))
    for where, block in context.blocks("SEABED PROFILE"):
        shape = _profile(context, cast("SeabedProfile", block), where, unreadable)
    blocks = [(where, cast("SeabedPlanes", block)) for where, block in context.blocks("SEABED PLANES")]
    if planes := tuple(_plane(plane) for _, block in blocks for plane in block.planes):
        shape = SeabedShape(SeabedKind.PLANES, planes=planes, where=blocks[0][0])
    return shape._replace(unreadable=tuple(unreadable))


def _profile(context: Context, block: SeabedProfile, where: Where, unreadable: list[tuple[Where, str]]) -> SeabedShape:
    direction = number(block, "direction", 0.0)
    if block.type_ == "SLOPING":
        return SeabedShape(SeabedKind.SLOPING, number(block, "slope"), direction, where=where)
    kind, columns = (SeabedKind.SURFACE, 3) if block.type_ == "3D" else (SeabedKind.PROFILE, 2)
    name = file_name(block.file or "")
    place = where.inside("file")
    points, missing, fault = _read_points(context, name, columns, place)
    if fault:
        unreadable.append((place, f"the profile {shown(name)} cannot be read: {fault}"))
    return SeabedShape(
        kind,
        direction=direction,
        interpolation=block.interpolation or "LINEAR",
        points=points,
        file=name,
        missing=missing,
        where=where,
    )


def _read_points(context: Context, name: str, columns: int, where: Where) -> tuple[Floats, str, str]:
    """Return the points of a file, the reason why they are not known, and the fault of an existing or compiled file."""
    folder = context.deck.folder_of(where)
    path = find_file(folder, name)
    try:
        if path is None and not name.lower().endswith(COMPILED):
            return _NO_POINTS, f"{shown(name)} was not found", ""
        return read_profile(path or Path(name), columns), "", ""
    except ValueError as error:
        fault = without_text(str(error), path, folder) if path else str(error)
    except OSError as error:
        fault = str(error.strerror)
    return _NO_POINTS, fault, fault


def _plane(plane: Plane) -> SeabedPlane:
    x, y, z = (number(plane.point, axis) for axis in "xyz")
    sides = (("y_min", -math.inf), ("y_max", math.inf), ("z_min", -math.inf), ("z_max", math.inf))
    y_min, y_max, z_min, z_max = (number(plane.bounds, side, unbounded) for side, unbounded in sides)
    slope, direction = number(plane, "slope"), number(plane, "direction", 0.0)
    return SeabedPlane(plane.name, (x, y, z), slope, direction, (y_min, y_max, z_min, z_max))


def read_profile(path: Path, columns: int) -> Floats:
    """Return the points (k, columns) of a file, in its order, without blank lines and comments (C in column 1).

    `columns` is 2 for Y and elevation of a profile, 3 for X, Y and Z of a surface. Raises OSError, or ValueError for a
    compiled file and for the first line that is not a point.
    """
    if path.suffix.lower() == COMPILED:
        raise ValueError(
            f"a compiled profile ({COMPILED}) is binary, and its format is not public: give a text file instead"
        )
    if path.stat().st_size > LARGEST_FILE:
        raise ValueError(f"the file has more than {LARGEST_FILE // 10**6} million bytes: is it a profile?")
    return parse_profile(path.read_bytes(), path.name, columns)


def parse_profile(data: bytes, name: str, columns: int) -> Floats:
    """Return the points of a file's content, as `read_profile` does."""
    expected = "Y, elevation" if columns == 2 else "X, Y, Z"
    rows: list[list[float]] = []
    for at, line in lines_of(data, name):
        words = _PARTS.split(line.strip(" \t\r\n,"))
        if len(words) != columns:
            raise ValueError(f"line {at}: expected {columns} numbers (`{expected}`), found {len(words)}")
        rows.append([number_of(word, at) for word in words])
    if len(rows) < 2:
        raise ValueError(f"the file has {counted(len(rows), 'point')}: a profile needs at least two lines `{expected}`")
    return np.array(rows, dtype=np.float64)


def made_seabed(seabed: SeabedShape) -> Seabed:
    """Return the evaluator's seabed; raises ValueError if its numbers form none."""
    if seabed.kind is SeabedKind.FLAT:
        return FlatSeabed()
    if seabed.kind is SeabedKind.SLOPING:
        return SlopingSeabed(seabed.slope, seabed.direction)
    if seabed.kind is SeabedKind.PROFILE:
        from mudline.model.contact.seabed.profile import ProfileSeabed  # noqa: PLC0415 - only now is it needed

        how = cast("Interpolation", seabed.interpolation)
        return ProfileSeabed(seabed.points[:, 0], seabed.points[:, 1], how, seabed.direction)
    if seabed.kind is SeabedKind.PLANES:
        columns = (
            [getattr(plane, name) for plane in seabed.planes] for name in ("point", "slope", "direction", "bounds")
        )
        return PlanesSeabed(*map(np.array, columns))
    from mudline.model.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only now is it needed

    return ScatteredSeabed(seabed.points, cast("Literal['LINEAR', 'CUBIC']", seabed.interpolation))


class SeabedLine(NamedTuple):
    """Seabed below a line: its height at the first end, its slope along the line, and the normal's upward part."""

    height: float
    slope: float
    upright: float


def elevations(seabed: SeabedShape, places: Floats) -> Floats:
    """Return elevations (n,) of a seabed at Y and Z (n, 2); NaN where there is none."""
    return made_seabed(seabed).elevation(*places.T.copy())


def plane_below(seabed: SeabedShape, start: Floats, direction: Floats, distance: float) -> SeabedLine | None:
    """Return the plane seabed below a line from Y and Z (2,) along a unit vector (2,); None if it is not one plane."""
    if seabed.kind is SeabedKind.FLAT:
        return SeabedLine(0.0, 0.0, 1.0)
    along = np.linspace(0.0, max(distance, 1e-300), _SAMPLES)
    places = start + along[:, None] * direction
    levels = elevations(seabed, places)
    slope = float(levels[-1] - levels[0]) / along[-1]
    if not np.abs(levels - levels[0] - slope * along).max() <= _PLANE * max(distance, 1.0):
        return None
    normal = np.empty((1, 3))
    middle = np.append(0.0, places[_SAMPLES // 2])[np.newaxis]
    made_seabed(seabed).locate(middle, np.empty(1), normal)
    return SeabedLine(float(levels[0]), slope, float(normal[0, 0]))


def on_land(seabed: SeabedShape, level: float, places: Floats, ends: Indices) -> Floats | None:
    """Return the share (m,) of each element over ground above the `level` of the water; None if there is none.

    Between the nodes of an element, `ends` (m, 2) of `places` (n, 3), the seabed is taken as straight.
    """
    if seabed.missing or not level < np.inf or (seabed.kind is SeabedKind.SURFACE and find_spec("scipy") is None):
        return None
    column = {SeabedKind.PROFILE: 1, SeabedKind.SURFACE: 0}.get(seabed.kind)
    if column is not None and not (seabed.points[:, column] > level).any():
        return None
    try:
        heights = made_seabed(seabed).elevation(places[:, 1], places[:, 2]) - level
    except ValueError:  # numbers that make no seabed are refused where it is evaluated
        return None
    at_ends = np.append(heights, np.nan)[ends]
    low, high = at_ends.min(axis=1), at_ends.max(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        share: Floats = np.nan_to_num(np.clip(high / (high - low), 0.0, 1.0))
    return share


REACH = 100.0
"""Height in diameters above the seabed's level beyond its end; higher parts of the line touch no seabed."""


class Survey(NamedTuple):
    """Known part of the seabed.

    Attributes:
        heights: returns heights (n,) of places (n, 3) beyond the end above the level there, -inf at least; NaN within.
        end: its end in words, as they follow "node 3 lies".
        consequence: assumption of the evaluator beyond it.
    """

    heights: Callable[[Floats], Floats]
    end: str
    consequence: str = "no seabed holds the line there; give it as far as the line goes, or correct the coordinates"

    def left(self, places: Floats, diameter: float) -> Mask:
        """Return a mask (n,) of `places` (n, 3) beyond the end that are low enough for the seabed to matter."""
        with np.errstate(over="ignore", invalid="ignore"):
            return np.asarray(self.heights(places) <= REACH * diameter)


def survey_of(seabed: SeabedShape) -> Survey | None:
    """Return the known part of a seabed; None if it has no end, or its points are unknown or form no seabed."""
    kind = seabed.kind
    if seabed.missing or (kind in (SeabedKind.PROFILE, SeabedKind.SURFACE) and len(seabed.points) < 2):
        return None
    try:
        if kind is SeabedKind.PROFILE:
            return _profile_survey(seabed)
        if kind is SeabedKind.SURFACE and find_spec("scipy") is not None:
            return _surface_survey(seabed)
        return _planes_survey(seabed) if kind is SeabedKind.PLANES else None
    except ValueError:  # other findings report its fault
        return None


def _profile_survey(seabed: SeabedShape) -> Survey:
    points = seabed.points[np.argsort(seabed.points[:, 0], kind="stable")]
    (first, start), (last, stop) = points[0].tolist(), points[-1].tolist()
    cosine, sine = heading(seabed.direction)

    def heights(places: Floats) -> Floats:
        x, y, z = places.T
        along = y * cosine + z * sine
        return np.asarray(x - np.where(along < first, start, np.where(along > last, stop, np.nan)))

    axis = "Y" if seabed.direction == 0.0 else "along it"
    end = f"beyond the ends of the seabed profile ({axis} = {first:.6g} to {last:.6g})"
    level = "it is taken as level there; give the profile as far as the line goes, or correct the coordinates"
    return Survey(heights, end, level)


def _surface_survey(seabed: SeabedShape) -> Survey:
    from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - only now is it needed

    from mudline.model.contact.seabed.scattered import ScatteredSeabed  # noqa: PLC0415 - only now is it needed

    try:
        corners = ConvexHull(seabed.points[:, 1:]).vertices
    except QhullError as error:
        raise ValueError("the points lie on a line") from error
    hull, top = ScatteredSeabed(seabed.points[corners]), float(seabed.points[:, 0].max())

    def heights(places: Floats) -> Floats:
        x, y, z = places.T.copy()
        return np.where(np.isnan(hull.elevation(y, z)), x - top, np.nan)

    return Survey(heights, f"outside of the hull of the seabed's {len(seabed.points)} points")


def _planes_survey(seabed: SeabedShape) -> Survey:
    made = made_seabed(seabed)

    def heights(places: Floats) -> Floats:
        x, y, z = places.T.copy()
        level = np.full(len(x), -np.inf)
        for plane in seabed.planes:  # at its place nearest to each node
            y_min, y_max, z_min, z_max = plane.bounds
            level = np.fmax(level, made.elevation(np.clip(y, y_min, y_max), np.clip(z, z_min, z_max)))
        return np.where(np.isnan(made.elevation(y, z)), x - level, np.nan)

    return Survey(heights, "outside of the bounds of all planes of the seabed")
