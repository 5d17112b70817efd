"""Seabeds from grids: what is read, and that no point of the grid is farther off than the bound."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import mudline
from mudline.language.diagnostics import DeckError
from mudline.model.scene.numbering import Floats
from mudline.tools.exporting.bathymetry import bed_deck, differences, read_bed, thinned
from tests.cli.runner import run

pytest.importorskip("scipy", reason="scipy is not installed")

ASC = "ncols 3\nnrows 2\nxllcorner 100.0\nyllcorner 200.0\ncellsize 10.0\nNODATA_value -9999\n-1 -2 -3\n-4 -9999 -6\n"
GRID = "3 2\n0 10 20\n0 5\n0 0 -50\n10 0 -51\n20 0 -52\n0 5 -50.5\n10 5 -51.5\n20 5 -52.5\n"
DEPTHS = "---- MoorDyn Bathymetry Input File ----\nnGridX 3\nnGridY 2\n 0 10 20\n0 50 51 52\n5 50.5 51.5 52.5\n"


def hills(columns: int, rows: int, seed: int, height: float = 3.0) -> Floats:
    """A grid with some hills: elevation, easting, northing."""
    chance = np.random.default_rng(seed)
    y, x = np.mgrid[0:rows, 0:columns] * 5.0
    level = -300.0 - 0.01 * x
    for _ in range(4):
        a, b, size = chance.uniform(0, 5.0 * columns), chance.uniform(0, 5.0 * rows), chance.uniform(5.0, 60.0)
        level += height * chance.normal() * np.exp(-((x - a) ** 2 + (y - b) ** 2) / size**2)
    return np.column_stack([level.ravel(), x.ravel(), y.ravel()])


def picture(path: Path, level: NDArray[np.generic], *, crs: str = "EPSG:32631", **band: tuple[object]) -> Path:
    """A GeoTIFF of cells of 5 m, with attributes of its one band."""
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    form = {"driver": "GTiff", "height": level.shape[0], "width": level.shape[1], "count": 1, "dtype": level.dtype}
    place = rasterio.Affine(5.0, 0.0, 0.0, 0.0, -5.0, 0.0)
    with rasterio.open(path, "w", transform=place, crs=crs, **form) as target:
        target.write(level, 1)
        for name, value in band.items():
            setattr(target, name, value)
    return path


ONES = np.ones((3, 4), dtype=np.float32)


def test_cells_of_esri_asc_are_at_their_middles_from_the_north(tmp_path: Path) -> None:
    (tmp_path / "bed.asc").write_text(ASC)
    expected = [[-1, 105, 215], [-2, 115, 215], [-3, 125, 215], [-4, 105, 205], [-6, 125, 205]]
    assert read_bed(tmp_path / "bed.asc", "esri-asc").tolist() == expected
    (tmp_path / "bed.asc").write_text(ASC.replace("llcorner", "llcenter"))
    assert read_bed(tmp_path / "bed.asc", "esri-asc")[0].tolist() == [-1, 100, 210]


@pytest.mark.parametrize("content", [GRID, DEPTHS])
def test_both_grids_of_moordyn(content: str, tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text(content)
    found = read_bed(tmp_path / "bed.txt", "moordyn-grid").tolist()
    assert sorted(found) == sorted([[-50 - i - 0.5 * j, 10.0 * i, 5.0 * j] for i in range(3) for j in range(2)])


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("bed.asc", "ncols 3\nnrows 2\n1 2 3\n", "not a seabed in the form esri-asc"),
        ("bed.asc", ASC.replace("-6\n", ""), "not a seabed in the form esri-asc"),
        ("bed.asc", "", "not a seabed in the form esri-asc"),
        ("bed.asc", ASC.replace("-1 -2 -3", "-9999 -9999 -9999"), "the grid has 2 points with a value"),
        ("bed.asc", "ncols 3\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n", "the points make no surface"),
        ("bed.tif", "no picture", "not a seabed in the form geotiff"),
    ],
)
def test_what_is_no_grid_is_named_and_nothing_is_written(name: str, content: str, message: str, tmp_path: Path) -> None:
    if name.endswith("tif"):
        pytest.importorskip("rasterio", reason="rasterio is not installed")
    (tmp_path / name).write_text(content)
    outcome = run("convert", str(tmp_path / name), "-o", str(tmp_path / "bed.keyxm"), "--within", "0.1")
    assert outcome.code == 1
    assert message in outcome.err
    assert [path.name for path in tmp_path.iterdir()] == [name]


@given(st.integers(2, 25), st.integers(2, 25), st.integers(0, 9999), st.floats(1e-3, 2.0))
def test_every_point_of_the_grid_is_within_the_bound(columns: int, rows: int, seed: int, within: float) -> None:
    points = hills(columns, rows, seed)
    kept = thinned(points, within)
    assert np.abs(differences(points, points[kept])).max() <= within
    assert len(np.unique(kept)) == len(kept) <= len(points)


def test_few_points_do_for_a_smooth_seabed(tmp_path: Path) -> None:
    points = hills(80, 60, 3)
    rows = "".join(f"{y!r} {z!r} {x!r}\n" for x, y, z in points.tolist())
    axes = [" ".join(map(repr, np.unique(points[:, axis]).tolist())) for axis in (1, 2)]
    (tmp_path / "bed.txt").write_text(f"80 60\n{axes[0]}\n{axes[1]}\n{rows}")
    bed = bed_deck(tmp_path / "bed.txt", "moordyn-grid", "bed.xyz", 0.05, (-300.0, 100.0, 50.0))
    assert bed.given == 4800
    assert bed.kept < 600
    assert 0.02 < bed.error <= 0.05
    read = np.array([line.split(",") for line in bed.points.splitlines()], dtype=np.float64)
    assert np.abs(differences(points - [-300.0, 100.0, 50.0], read)).max() == bed.error


def test_a_geotiff_becomes_a_deck_that_is_evaluated(tmp_path: Path) -> None:
    rasterio = pytest.importorskip("rasterio", reason="rasterio is not installed")
    level = hills(40, 30, 7)[:, 0].reshape(30, 40).astype(np.float32)
    level[0, 0] = -9999.0
    form = {"driver": "GTiff", "width": 40, "height": 30, "count": 1, "dtype": "float32", "nodata": -9999.0}
    place = rasterio.Affine(5.0, 0.0, 430000.0, 0.0, -5.0, 6500150.0)
    with rasterio.open(tmp_path / "bed.tif", "w", crs="EPSG:32631", transform=place, **form) as target:
        target.write(level, 1)
    out = tmp_path / "bed.keyxm"
    arguments = ("--within", "0.1", "--origin", "430000,6500000", "--datum", "-300")
    outcome = run("convert", str(tmp_path / "bed.tif"), "-o", str(out), *arguments)
    assert (outcome.code, outcome.out) == (0, "")
    assert "of 1199 points, largest difference 0." in outcome.err
    line = "*NODE\n 1, 0.0, 20.0, 20.0\n 2, 0.0, 180.0, 120.0\n*ELEMENT\n 1, 1, 2\n*ELASTIC SURFACE\n 5000.0\n"
    (tmp_path / "line.keyxm").write_text(out.read_text() + line)
    seabed = mudline.read(tmp_path / "line.keyxm").scene().contact().input.seabed
    row, column = np.indices(level.shape).astype(np.float64)
    inside = level > -9999.0
    assert seabed is not None
    found = seabed.elevation((2.5 + 5.0 * column)[inside], (147.5 - 5.0 * row)[inside])
    assert np.abs(found - (level[inside].astype(np.float64) + 300.0)).max() <= 0.1


def test_degrees_are_refused(tmp_path: Path) -> None:
    picture(tmp_path / "bed.tif", ONES, crs="EPSG:4326")
    outcome = run("convert", str(tmp_path / "bed.tif"), "-o", str(tmp_path / "bed.keyxm"), "--within", "1")
    assert outcome.code == 1
    assert "its coordinates are not in metres: project it" in outcome.err


@pytest.mark.parametrize(
    ("content", "line", "message"),
    [
        (
            ASC.replace("-5", "-5,5").replace("-4", "-4,5"),
            8,
            "'-4,5' is not a number: write a point for the decimal comma",
        ),
        (ASC.replace("-1 -2 -3", "-1 -2"), 7, "2 elevations, expected 3 as ncols says"),
        (ASC.replace("-4 -9999 -6\n", ""), 7, "1 row of elevations, expected 2 as nrows says"),
        (ASC.replace("cellsize 10.0\n", ""), 6, "cellsize missing in the header above this line"),
        (ASC.replace("nrows 2", "nrows two"), 2, "'two' is not a number"),
    ],
    ids=["comma", "columns", "rows", "header", "word"],
)
def test_a_fault_of_a_text_grid_has_its_line(content: str, line: int, message: str, tmp_path: Path) -> None:
    (tmp_path / "bed.asc").write_text(content)
    with pytest.raises(DeckError) as caught:
        read_bed(tmp_path / "bed.asc", "esri-asc")
    found = caught.value.diagnostics[0]
    assert (found.line, found.message) == (line, f"not a seabed in the form esri-asc: {message}")


@pytest.mark.parametrize("fill", ["-32768", "1e38", "-99999"])
def test_a_fill_value_that_nobody_declared_is_refused_with_its_cell(fill: str, tmp_path: Path) -> None:
    (tmp_path / "bed.asc").write_text(ASC.replace("-6", fill))
    with pytest.raises(DeckError, match=r"of 1 cell, first at easting 125, northing 205, seems to stand for no value"):
        read_bed(tmp_path / "bed.asc", "esri-asc")


def test_points_above_the_sea_are_told(tmp_path: Path) -> None:
    (tmp_path / "bed.asc").write_text(ASC.replace("-", ""))
    outcome = run("convert", str(tmp_path / "bed.asc"), "-o", str(tmp_path / "bed.keyxm"), "--within", "0.1")
    assert outcome.code == 0
    assert "5 of 5 points are above the sea: are they depths, not elevations?" in outcome.err


@pytest.mark.parametrize(
    ("scale", "offset", "unit", "first"),
    [(0.1, 0.0, "", -10.0), (0.01, -5.0, "metre", -6.0), (1.0, 0.0, "ft", -30.48), (1.0, 0.0, "cm", -1.0)],
)
def test_scale_offset_and_unit_of_a_band(scale: float, offset: float, unit: str, first: float, tmp_path: Path) -> None:
    level = np.full((3, 4), -100, dtype=np.int16)
    picture(tmp_path / "bed.tif", level, scales=(scale,), offsets=(offset,), units=(unit,))
    assert read_bed(tmp_path / "bed.tif", "geotiff")[:, 0] == pytest.approx([first] * 12, rel=1e-12)


def test_an_unknown_unit_of_a_band_is_refused(tmp_path: Path) -> None:
    picture(tmp_path / "bed.tif", ONES, units=("furlong",))
    with pytest.raises(DeckError, match="its elevations are in 'furlong': convert them to metres"):
        read_bed(tmp_path / "bed.tif", "geotiff")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("bed.asc", "-o", "bed.keyxm"), "give its largest error"),
        (("bed.asc", "-o", "bed.keyxm", "--within", "-1"), "give its largest error"),
        (("bed.asc", "-o", "bed.json", "--within", "1"), "give -o OUT.keyxm"),
        (("bed.asc", "--within", "1"), "give -o OUT.keyxm"),
        (("bed.asc", "-o", "bed.keyxm", "--within", "1", "--origin", "3"), "--origin '3'"),
        (("bed.asc", "-o", "a, b=c.keyxm", "--within", "1"), "a deck does not read this as the name of a file"),
        (("deck.keyxm", "-o", "x.json", "--within", "1"), "are for a seabed"),
    ],
)
def test_wrong_usage(arguments: tuple[str, ...], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bed.asc").write_text(ASC)
    outcome = run("convert", *arguments)
    assert outcome.code == 2
    assert message in outcome.err
    assert [path.name for path in tmp_path.iterdir()] == ["bed.asc"]


def test_a_picture_that_is_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    picture(tmp_path / "bed.tif", ONES)
    monkeypatch.setattr("mudline.tools.exporting.bathymetry.MOST_CELLS", 11)
    with pytest.raises(DeckError, match="cut out what lies around the line"):
        read_bed(tmp_path / "bed.tif", "geotiff")


def test_a_text_that_is_too_large_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "bed.asc").write_text(ASC)
    monkeypatch.setattr("mudline.tools.exporting.bathymetry.LARGEST_FILE", 10)
    with pytest.raises(DeckError, match="million bytes"):
        read_bed(tmp_path / "bed.asc", "esri-asc")
