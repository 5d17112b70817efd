"""A seabed from GeoTIFF, ESRI ASC or MoorDyn's grid, as few of its points as keep to a bound, and its deck."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from mudline.basics.limits import LARGEST_FILE, MOST_CELLS
from mudline.basics.quantities import shown
from mudline.model.contact.seabed.scattered import ScatteredSeabed
from mudline.model.scene.csv_file import data_error
from mudline.model.scene.numbering import Floats, Indices
from mudline.model.scene.seabed import parse_profile
from mudline.tools.exporting.report import one_line

_METRE = ("metre", "meter", "m")


class Bed(NamedTuple):
    """The deck of a seabed, the text of its file of points, how many points of how many, and the largest difference."""

    deck: str
    points: str
    kept: int
    given: int
    error: float


def read_bed(path: Path, form: str) -> Floats:
    """The points (k, 3) of a grid, elevation, easting and northing in metres; without those that have no value.

    Raises OSError, or DeckError for what is not such a file.
    """
    file = path.as_posix()
    try:
        found = _geotiff(path) if form == "geotiff" else _text_grid(path, form)
    except (ValueError, IndexError, KeyError) as error:
        raise data_error(file, f"not a seabed in the form {form}: {error}") from error
    found = found[np.isfinite(found).all(axis=1)]
    if len(found) < 3:
        raise data_error(file, f"the grid has {len(found)} points with a value; expected three or more")
    return found


def _geotiff(path: Path) -> Floats:
    import rasterio  # noqa: PLC0415 - an extra
    from rasterio.errors import RasterioError  # noqa: PLC0415 - as above

    path.open("rb").close()  # what cannot be opened is reported as any file
    try:
        with rasterio.open(path) as source:
            if source.crs is not None and (source.crs.is_geographic or source.crs.linear_units not in _METRE):
                raise ValueError("its coordinates are not in metres: project it, as to UTM")
            if source.width * source.height > MOST_CELLS:
                raise ValueError(f"more than {MOST_CELLS // 10**6} million cells: cut out what lies around the line")
            level = source.read(1, masked=True).astype(np.float64).filled(np.nan)
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
    """Cells row by row from the north; the corner or the middle of the lowest on the left is given."""
    head: dict[str, float] = {}
    while lines[len(head)].strip()[:1].isalpha():
        key, value = lines[len(head)].split()
        head[key.lower()] = float(value)
    columns, rows, size = int(head["ncols"]), int(head["nrows"]), head["cellsize"]
    level = np.array(" ".join(lines[len(head) :]).split(), dtype=np.float64).reshape(rows, columns)
    level[level == head.get("nodata_value", -9999.0)] = np.nan
    west, south = (
        head[f"{axis}llcenter"] if f"{axis}llcenter" in head else head[f"{axis}llcorner"] + 0.5 * size for axis in "xy"
    )
    row, column = np.indices(level.shape)
    return np.column_stack([level.ravel(), (west + size * column).ravel(), (south + size * (rows - 1 - row)).ravel()])


def _moordyn_c(lines: list[str]) -> Floats:
    """Numbers of columns and rows, their x and y, then x, y and elevation of each point."""
    columns, rows = (int(word) for word in lines[0].split())
    points = np.array([[float(word) for word in line.split()] for line in lines[3:] if line.strip()])
    if points.shape != (columns * rows, 3):
        raise ValueError(f"expected {columns} x {rows} lines of x, y and elevation")
    return points[:, [2, 0, 1]]


def _moordyn_f(lines: list[str]) -> Floats:
    """`nGridX n`, `nGridY m`, the x of the columns, then y and the depths of each row."""
    columns, rows = (int(line.split()[1]) for line in lines[1:3])
    east = np.array(lines[3].split(), dtype=np.float64)
    table = np.array([[float(word) for word in line.split()] for line in lines[4 : 4 + rows]])
    if table.shape != (rows, columns + 1) or len(east) != columns:
        raise ValueError(f"expected {rows} lines of y and {columns} depths")
    return np.column_stack([-table[:, 1:].ravel(), np.tile(east, rows), np.repeat(table[:, 0], columns)])


def thinned(points: Floats, within: float) -> Indices:
    """Points (indices) whose triangles, as the deck's seabed is evaluated, are `within` a bound of all the points.

    From the corners of the hull on, the worst point of each of some blocks is taken, until none is farther off.
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
    """Elevation of the seabed through some points less that of all (k,); NaN where it has none."""
    return ScatteredSeabed(kept).elevation(points[:, 1], points[:, 2]) - points[:, 0]


def bed_deck(path: Path, form: str, output: str, within: float, origin: tuple[float, float, float]) -> Bed:
    """Read a grid and make its deck; `origin` is the elevation, easting and northing of X = Y = Z = 0.

    Raises OSError, or DeckError for what is not a grid or has its points on a line.
    """
    given = read_bed(path, form) - np.array(origin)
    try:
        kept = given[thinned(given, within)]
    except (QhullError, ValueError) as error:
        raise data_error(path.as_posix(), f"the points make no surface: {str(error).splitlines()[0]}") from error
    rows = "".join(f"{x!r}, {y!r}, {z!r}\n" for x, y, z in kept.tolist())
    # The bound holds for what is read back from the text, evaluated as the deck is.
    off = np.abs(differences(given, parse_profile(rows.encode(), output, 3)))
    worst = float(np.nan_to_num(off, nan=np.inf).max())
    elevation, east, north = map(shown, origin, (12, 12, 12))
    head = [
        f"Seabed of {one_line(path.name)}: {len(kept)} of {len(given)} points of the grid",
        f"No point of the grid is more than {shown(worst, 3)} m off, {shown(within)} m were allowed",
        f"X = 0 is at elevation {elevation}; Y is easting - {east}, Z northing - {north}. Metres",
    ]
    deck = [*(f"C {line}" for line in head), "$MODEL", "*SEABED PROFILE", " TYPE=3D", f" FILE={output}"]
    return Bed("".join(f"{line}\n" for line in deck), rows, len(kept), len(given), worst)
