"""Deck of a seabed from GeoTIFF, ESRI ASC or MoorDyn's grid, with as few points as a bound on the error allows."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from mudline.basics.limits import LARGEST_FILE, MOST_CELLS
from mudline.basics.quantities import shown
from mudline.basics.short_repr import counted
from mudline.basics.units import FOOT
from mudline.model.contact.seabed.scattered import ScatteredSeabed
from mudline.model.scene.csv_file import data_error
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.seabed import parse_profile
from mudline.tools.exporting.report import one_line

_METRE = ("metre", "meter", "m")
_UNITS = {
    **dict.fromkeys(("", "metre", "meter", "metres", "meters", "m"), 1.0),
    **dict.fromkeys(("centimetre", "centimeter", "centimetres", "centimeters", "cm"), 0.01),
    **dict.fromkeys(("millimetre", "millimeter", "millimetres", "millimeters", "mm"), 0.001),
    **dict.fromkeys(("kilometre", "kilometer", "kilometres", "kilometers", "km"), 1000.0),
    **dict.fromkeys(("foot", "feet", "ft", "international foot"), FOOT),
    **dict.fromkeys(("us survey foot", "us survey feet", "ftus"), 1200.0 / 3937.0),
    **dict.fromkeys(("fathom", "fathoms"), 1.8288),
}
"""Metres per unit of a raster band."""
_EARTH = (-11_100.0, 9_000.0)
"""Range of ground elevations on earth, in metres: deepest trench and highest mountain, rounded outwards."""
_ISOLATED = 10.0
"""Ratio of the gap next to a presumed fill value to the spread of all other elevations."""


class Bed(NamedTuple):
    """Deck of a seabed made from a grid.

    Attributes:
        deck: text of the deck.
        points: text of the file of points.
        kept: number of points in the file.
        given: number of points of the grid.
        error: largest difference from the grid.
        above: number of points above sea level, the X = 0 of the grid.
    """

    deck: str
    points: str
    kept: int
    given: int
    error: float
    above: int


def read_bed(path: Path, form: str) -> Floats:
    """Return the points (k, 3) of a grid: elevation, easting and northing in metres.

    Points without a value are left out. Raises OSError, or DeckError for a file that is not a grid.
    """
    file = path.as_posix()
    try:
        points = _geotiff(path) if form == "geotiff" else _text_grid(path, form)
    except _GridError as error:
        raise data_error(file, f"not a seabed in the form {form}: {error}", error.line) from error
    except (ValueError, IndexError, OverflowError) as error:
        raise data_error(file, f"not a seabed in the form {form}: {error}") from error
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < 3:
        raise data_error(file, f"the grid has {len(points)} points with a value; expected three or more")
    if filled := _fill(points):
        raise data_error(file, filled)
    return points


def _fill(points: Floats) -> str:
    """Return a message about an elevation that must be an undeclared fill value; "" if there is none.

    No ground on earth is so high or so deep; or the value is a usual fill value, alone and far from all others.
    """
    level = points[:, 0]
    low, high = float(level.min()), float(level.max())
    for value in (low, high):
        others = level[level != value]
        least, most = (float(others.min()), float(others.max())) if others.size else (value, value)
        gap = least - value if value == low else value - most
        round_ = value in (-9999.0, -99999.0, -32768.0, 9999.0, 99999.0, 32767.0)
        if not _EARTH[0] <= value <= _EARTH[1] or (round_ and gap > _ISOLATED * (most - least)):
            _, east, north = points[int(np.flatnonzero(level == value)[0])].tolist()
            return (
                f"the elevation {shown(value)} of {counted(int((level == value).sum()), 'cell')}, first at easting "
                f"{shown(east, 9)}, northing {shown(north, 9)}, seems to stand for no value, as the others are between "
                f"{shown(least)} and {shown(most)}: declare it in the grid (NODATA_value, or nodata of the band)"
            )
    return ""


def _geotiff(path: Path) -> Floats:
    import rasterio  # noqa: PLC0415 - an extra
    from rasterio.errors import RasterioError  # noqa: PLC0415 - as above

    path.open("rb").close()  # raises OSError as for any other file
    try:
        with rasterio.open(path) as source:
            if source.crs is not None and (source.crs.is_geographic or source.crs.linear_units not in _METRE):
                raise ValueError("its coordinates are not in metres: project it, as to UTM")
            if source.width * source.height > MOST_CELLS:
                raise ValueError(f"more than {MOST_CELLS // 10**6} million cells: cut out what lies around the line")
            unit = (source.units[0] or "").strip()
            if unit.lower() not in _UNITS:
                raise ValueError(f"its elevations are in {unit!r}: convert them to metres")
            level = source.read(1, masked=True).astype(np.float64).filled(np.nan)
            level = (level * source.scales[0] + source.offsets[0]) * _UNITS[unit.lower()]
            rows, columns = np.indices(level.shape)
            a, b, c, d, e, f = source.transform[:6]
    except RasterioError as error:
        raise ValueError(str(error)) from error
    column, row = columns.ravel() + 0.5, rows.ravel() + 0.5
    return np.column_stack([level.ravel(), a * column + b * row + c, d * column + e * row + f])


def _text_grid(path: Path, form: str) -> Floats:
    if path.stat().st_size > LARGEST_FILE:
        raise ValueError(f"more than {LARGEST_FILE // 10**6} million bytes: cut out what lies around the line")
    lines = path.read_text(encoding="utf-8").split("\n")
    if form == "esri-asc":
        return _esri(lines)
    return _moordyn_f(lines) if lines[0].startswith("-") else _moordyn_c(lines)


def _esri(lines: list[str]) -> Floats:
    """Return the cells row by row from the north; the corner or the middle of the lowest left cell is given."""
    head: dict[str, float] = {}
    while len(head) < len(lines) and lines[len(head)].strip()[:1].isalpha():
        key, _, value = lines[len(head)].strip().partition(" ")
        head[key.lower()] = _floats([value.strip()], len(head) + 1)[0]
    names = {name.replace("center", "corner") for name in head}
    if lacking := [name for name in ("ncols", "nrows", "xllcorner", "yllcorner", "cellsize") if name not in names]:
        raise _GridError(len(head) + 1, f"{' and '.join(lacking)} missing in the header above this line")
    columns, rows, size = int(head["ncols"]), int(head["nrows"]), head["cellsize"]
    table = [(number, words) for number, line in enumerate(lines, 1) if number > len(head) and (words := line.split())]
    if sum(len(words) for _, words in table) != columns * rows:
        for number, words in table:
            if len(words) != columns:
                raise _GridError(number, f"{len(words)} elevations, expected {columns} as ncols says")
        raise _GridError(len(head) + 1, f"{counted(len(table), 'row')} of elevations, expected {rows} as nrows says")
    level = np.concatenate([_floats(words, number) for number, words in table]).reshape(rows, columns)
    level[level == head.get("nodata_value", -9999.0)] = np.nan
    west, south = (
        head[f"{axis}llcenter"] if f"{axis}llcenter" in head else head[f"{axis}llcorner"] + 0.5 * size for axis in "xy"
    )
    row, column = np.indices(level.shape)
    return np.column_stack([level.ravel(), (west + size * column).ravel(), (south + size * (rows - 1 - row)).ravel()])


def _moordyn_c(lines: list[str]) -> Floats:
    """Return the points after the numbers of columns and rows and their x and y: x, y and elevation of each."""
    columns, rows = (int(number) for number in _floats(lines[0].split(), 1))
    points = [_floats(line.split(), number) for number, line in enumerate(lines[3:], 4) if line.strip()]
    if len(points) != columns * rows or any(len(point) != 3 for point in points):
        raise _GridError(4, f"expected {columns} x {rows} lines of x, y and elevation")
    return np.array(points)[:, [2, 0, 1]]


def _moordyn_f(lines: list[str]) -> Floats:
    """Return the points of a file with `nGridX n`, `nGridY m`, the x of the columns, then y and depths of each row."""
    columns, rows = (int(_floats(lines[at].split()[1:2], at + 1)[0]) for at in (1, 2))
    east = _floats(lines[3].split(), 4)
    table = [_floats(line.split(), number) for number, line in enumerate(lines[4 : 4 + rows], 5)]
    if len(table) != rows or any(len(row) != columns + 1 for row in table) or len(east) != columns:
        raise _GridError(5, f"expected {rows} lines of y and {columns} depths")
    values = np.array(table)
    return np.column_stack([-values[:, 1:].ravel(), np.tile(east, rows), np.repeat(values[:, 0], columns)])


class _GridError(ValueError):
    """Fault in a grid in text form, with its line."""

    def __init__(self, line: int, message: str) -> None:
        super().__init__(message)
        self.line = line


def _floats(words: list[str], line: int) -> Floats:
    """Return the numbers of a line; raises _GridError for a word that is not a number."""
    numbers = np.empty(len(words))
    for at, word in enumerate(words):
        try:
            numbers[at] = float(word)
        except ValueError:
            comma = ": write a point for the decimal comma" if "," in word else ""
            raise _GridError(line, f"{word!r} is not a number{comma}") from None
    return numbers


def thinned(points: Floats, within: float) -> Indices:
    """Return points (indices) whose triangulated seabed is `within` a bound of all points.

    Starting from the corners of the hull, the worst point of each block of the plane is added until none exceeds the
    bound.
    """
    places = points[:, 1:] - points[:, 1:].min(axis=0)
    chosen: Indices = np.sort(ConvexHull(places).vertices.astype(np.intp))
    while True:
        error = np.nan_to_num(np.abs(differences(points, points[chosen])), nan=np.inf)
        error[chosen] = 0.0
        far = np.flatnonzero(error > within)
        if not far.size:
            return chosen
        size = max(float(np.max(places)) / np.sqrt(4.0 * len(chosen)), 1e-9)
        block = np.floor(places[far] / size).astype(np.int64)
        order = np.lexsort((-error[far], block[:, 1], block[:, 0]))
        first = np.append(True, (np.diff(block[order], axis=0) != 0).any(axis=1))
        chosen = np.union1d(chosen, far[order[first]])


def differences(points: Floats, kept: Floats) -> Floats:
    """Return the elevation of the seabed through some points minus that of all points (k,); NaN outside the seabed."""
    return ScatteredSeabed(kept).elevation(points[:, 1], points[:, 2]) - points[:, 0]


def bed_deck(path: Path, form: str, output: str, within: float, origin: tuple[float, float, float]) -> Bed:
    """Return the deck of a grid; `origin` is the elevation, easting and northing of X = Y = Z = 0.

    Raises OSError, or DeckError for a file that is not a grid or has its points on one line.
    """
    grid = read_bed(path, form)
    local = grid - np.array(origin)
    try:
        kept = local[thinned(local, within)]
    except (QhullError, ValueError) as error:
        raise data_error(path.as_posix(), f"the points make no surface: {str(error).splitlines()[0]}") from error
    rows = "".join(f"{x!r}, {y!r}, {z!r}\n" for x, y, z in kept.tolist())
    # The bound must hold for the numbers in the text, evaluated as in the deck.
    off = np.abs(differences(local, parse_profile(rows.encode(), output, 3)))
    worst = float(np.nan_to_num(off, nan=np.inf).max())
    elevation, east, north = map(shown, origin, (12, 12, 12))
    head = [
        f"Seabed of {one_line(path.name)}: {len(kept)} of {len(local)} points of the grid",
        f"No point of the grid is more than {shown(worst, 3)} m off, {shown(within)} m were allowed",
        f"X = 0 is at elevation {elevation}; Y is easting - {east}, Z northing - {north}. Metres",
    ]
    deck = [*(f"C {line}" for line in head), "$MODEL", "*SEABED PROFILE", " TYPE=3D", f" FILE={output}"]
    return Bed("".join(f"{line}\n" for line in deck), rows, len(kept), len(local), worst, int((grid[:, 0] > 0.0).sum()))
