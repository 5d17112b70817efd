"""The input file of MoorDyn, read as MoorDyn reads it, and its seabed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mudline.tools.exporting import moordyn
from mudline.tools.exporting.line_model import LineModel
from mudline.tools.exporting.report import Outcome
from tests.tools.exporting.decks import BOTH, ELASTIC, WEIGHT, model_of, sample, text


def tables(content: str) -> dict[str, list[list[str]]]:
    """The rows of each section, without headings and units."""
    found: dict[str, list[list[str]]] = {}
    for part in content.split("--- ")[1:]:
        title, *rows = part.split("\n")
        found[title.removesuffix(" ---")] = [row.split() for row in rows if row]
    return {title: rows if title == "OPTIONS" else rows[2:] for title, rows in found.items()}


def written(model: LineModel) -> dict[str, list[list[str]]]:
    return tables(moordyn.write(model, "deck.txt")["deck.txt"])


def option(rows: list[list[str]], name: str) -> float:
    (value,) = (row[0] for row in rows if row[1] == name)
    return float(value)


def test_a_line_on_a_linear_seabed() -> None:
    found = written(model_of(text()))
    assert found["LINE TYPES"] == [["ALL", "0.1", "50.0", "100000000.0", "-1.0", "0.0", "1.2", "1.0", "0.0", "0.0"]]
    assert found["POINTS"] == [
        ["1", "Fixed", "0.0", "0.0", "-100.0", "0", "0", "0", "0"],
        ["2", "Fixed", "50.0", "0.0", "-100.0", "0", "0", "0", "0"],
    ]
    assert found["LINES"] == [["1", "ALL", "1", "2", "50.0", "10", "p"]]
    options = found["OPTIONS"]
    assert option(options, "kBot") == pytest.approx(20000.0 / 0.1)
    assert option(options, "cBot") == pytest.approx(2.0 * (20000.0 * 50.0) ** 0.5 / 0.1)
    assert option(options, "FrictionCoefficient") == 0.3
    assert (option(options, "WtrDnsty"), option(options, "WtrDpth"), option(options, "g")) == (1000.0, 100.0, 10.0)
    assert option(options, "dtM") == pytest.approx(0.4 * 5.0 / (1e8 / 50.0) ** 0.5, rel=0.05)


def test_lengths_that_differ_by_rounding_are_as_many_segments() -> None:
    model = model_of(text().replace("*ELEMENT\n", " 6, 0.0, 24.9993\n*ELEMENT\n", 1))
    assert written(model)["LINES"] == [["1", "ALL", "1", "2", "50.0", "10", "p"]]
    assert not [entry for entry in model.report.entries if entry.keyword == "*ELEMENT lengths"]


def test_sections_of_the_same_numbers_are_one_line_type() -> None:
    model = sample("scr-touchdown.keyxm")
    found = written(model)
    # Strakes give the upper riser another drag: 1.6 of its drag diameter 0.37305 is 2.186 of 0.27305.
    assert [(row[0], float(row[6])) for row in found["LINE TYPES"]] == [
        ("Flowline", 1.0),
        ("Upper_Riser", pytest.approx(1.6 * 0.37305 / 0.27305)),
    ]
    assert [row[1:4] + row[5:] for row in found["LINES"]] == [
        ["Flowline", "1", "3", "251", "p"],
        ["Upper_Riser", "3", "2", "40", "p"],
    ]
    lengths = [entry.effect for entry in model.report.entries if entry.keyword == "*ELEMENT lengths"]
    assert lengths == ["160 elements of 2 to 5 m: 251 segments of 1.99 m"]


def test_another_section_is_another_line_behind_a_free_point() -> None:
    sets = "*ELEMENT SETS\n SET=First\n GEN=1, 4\n SET=Second\n GEN=5, 10\n"
    sections = " OPTION=RIGID\n SET=First\n 2.0E11, 8.0E10, 0.1, 0.08, 7850.0\n"
    sections += " SET=Second\n 2.0E11, 8.0E10, 0.1, 0.0, 7850.0\n"
    model = model_of(text(sets=sets, sections=sections))
    found = written(model)
    assert [row[:6] for row in found["LINES"]] == [
        ["1", "First", "1", "3", "20.0", "4"],
        ["2", "Second", "3", "2", "30.0", "6"],
    ]
    assert found["POINTS"][2][:5] == ["3", "Free", "20.0", "0.0", "-100.0"]
    assert any(entry.keyword == "*GEOMETRIC SETS joints" for entry in model.report.lost)


def test_one_stiffness_stands_for_all_and_the_list_says_how_far_the_others_sink() -> None:
    sets = "*ELEMENT SETS\n SET=Soft\n GEN=1, 4\n"
    model = model_of(text(sets=sets, bed=ELASTIC + " SET=Soft\n STIFFNESS=5000.0\n"))
    assert option(written(model)["OPTIONS"], "kBot") == pytest.approx(2e5)
    entries = [entry for entry in model.report.entries if entry.keyword == "*SEABED PROPERTIES"]
    assert [entry.status for entry in entries] == [Outcome.CARRIED, Outcome.APPROXIMATED]
    assert (
        entries[1].effect == f"linear: 5 kN/m2; sinks {1e3 * WEIGHT / 2e4:.1f} mm here, as the target has one stiffness"
    )


def test_a_fixed_end_below_the_mudline_is_raised_and_listed() -> None:
    model = model_of(text().replace(" 11, 0.0, 50.0", " 11, -0.02, 50.0"))
    found = written(model)
    assert found["POINTS"][1][4] == "-100.0"
    raised = [entry.target for entry in model.report.entries if entry.keyword == "*NODE end"]
    assert raised == ["20 mm higher, on the mudline"]


def test_an_end_on_a_vessel_is_coupled() -> None:
    held = "".join(f" 1, {freedom}\n" for freedom in (1, 2, 3)) + " TYPE=VESSEL\n VESSEL=Semi\n 11, 1\n 11, 2\n 11, 3\n"
    assert [row[1] for row in written(model_of(text(held=held)))["POINTS"]] == ["Fixed", "Coupled"]


@pytest.mark.parametrize(
    "bed", ["SLOPING\n DIRECTION=30.0\n SLOPE=2.0", "2D\n FILE=bed.txt", "2D\n DIRECTION=10.0\n FILE=bed.txt"]
)
def test_the_grid_is_the_seabed_of_the_deck_below_the_line(bed: str, tmp_path: Path) -> None:
    (tmp_path / "bed.txt").write_text("-500, 1.0\n0, 0.0\n20, -0.5\n500, 0.5\n")
    model = model_of(text(bed=f"{ELASTIC}*SEABED PROFILE\n TYPE={bed}\n"), folder=tmp_path)
    files = moordyn.write(model, "my deck.v2.txt")
    assert list(files) == ["my deck.v2.txt", "my_deck_v2-seabed.txt"]
    head, xs, ys, *rows = files["my_deck_v2-seabed.txt"].splitlines()
    x, y = (np.array(line.split(), dtype=np.float64) for line in (xs, ys))
    points = np.array([row.split() for row in rows], dtype=np.float64)
    assert head == f"{len(x)} {len(y)}"
    assert len(points) == len(x) * len(y)
    assert model.levels(points[:, 0], points[:, 1]) == pytest.approx(points[:, 2])
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PROFILE")
    assert entry.status is (Outcome.APPROXIMATED if "10.0" in bed else Outcome.CARRIED)
    assert ["my_deck_v2-seabed.txt", "SeafloorFile"] in tables(files["my deck.v2.txt"])["OPTIONS"]


def test_planes_are_a_grid_with_its_error() -> None:
    planes = "*SEABED PLANES\n PLANE=A\n POINT=0.0, 0.0, 0.0\n SLOPE=1.0\n BOUNDS=-500.0, 30.05, -50.0, 50.0\n"
    planes += " PLANE=B\n POINT=0.0, 30.05, 0.0\n SLOPE=-3.0\n BOUNDS=30.05, 500.0, -50.0, 50.0\n"
    model = model_of(text(bed=ELASTIC + planes, held=BOTH))
    moordyn.write(model, "a.txt")
    (entry,) = (entry for entry in model.report.entries if entry.keyword == "*SEABED PLANES")
    assert entry.status is Outcome.APPROXIMATED
    assert float(entry.effect.split()[-2]) < 0.3
