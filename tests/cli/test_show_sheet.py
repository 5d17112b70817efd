"""`mudline show --sheet`: the properties of runs of elements, by worked numbers; as text, CSV, JSON and workbook."""

from __future__ import annotations

import csv
import math
from io import StringIO
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN
from tests.helpers.samples import SAMPLES

CATENARY, RISER = str(SAMPLES / "scr-vessel.keyxm"), str(SAMPLES / "imperial-riser.keyxi")


def rows(deck: str) -> list[dict[str, Any]]:
    found = run("show", deck, "--sheet", "--output-format", "json")
    assert found.code == 0
    given: list[dict[str, Any]] = found.json()["sheet"]
    return given


def test_a_steel_catenary_by_hand() -> None:
    """The wall has 0.0197616 m2 (10.75 in x 25.4 mm), displaces 0.0585558 m2 and holds 0.0387948 m2 of oil."""
    flowline, touchdown, straked = rows(CATENARY)
    wanted = {
        "first_element": 1,
        "last_element": 40,
        "elements": 40,
        "length": 200.0,
        "outer_diameter": 0.27305,
        "inner_diameter": 0.22225,
        "diameter_over_wall": 10.75,  # 0.27305 / 0.0254
        "mass": 155.12849,  # 7850 x 0.0197616
        "empty_weight": 933.01146,  # (155.12849 - 1025 x 0.0585558) x 9.81
        "contents": 820.0,
        "filled_mass": 186.94022,  # 155.12849 + 820 x 0.0387948
        "filled_weight": 1245.08452,  # 933.01146 + 31.81173 x 9.81
        "masses_at_nodes": 850.0,  # the valve; the rotary inertia is none
        "bending": 3.1690099e7,  # 207E9 pi / 64 (0.27305^4 - 0.22225^4)
        "axial": 4.0906495e9,  # 207E9 x 0.0197616
        "drag": 1.0,
        "added_mass": 1.0,
        "axial_friction": 0.35,
        "lateral_friction": 0.6,
    }
    assert {key: flowline[key] for key in wanted} == pytest.approx(wanted, rel=1e-7)
    assert (flowline["section"], flowline["law"], flowline["stiffness"]) == ("Flowline", "curve:Soft Clay", None)
    of_curves = {"mass": 155.1, "empty_weight": 932.73193, "bending": 4.0e5 / 0.0126, "axial": 8.2e6 / 0.002}
    assert {key: touchdown[key] for key in of_curves} == pytest.approx(of_curves, rel=1e-7)
    assert (straked["drag"], straked["law"], straked["axial_friction"]) == (1.6, None, None)


def test_an_imperial_riser_by_hand() -> None:
    """Its sections give mass and buoyancy diameter (1.05 and 1.5 ft); the stiffener is 1.9 ft wide."""
    riser, stiffener = rows(RISER)
    assert (riser["mass"], riser["bending"], riser["axial"]) == (3.6, 640_000.0, 1.2e8)
    assert riser["empty_weight"] == pytest.approx(60.419398, rel=1e-7)  # (3.6 - 1.9888 pi / 4 1.05^2) 32.174
    assert stiffener["empty_weight"] == pytest.approx(73.533687, rel=1e-7)  # (5.8 - 1.9888 pi / 4 1.5^2) 32.174
    assert riser["diameter_over_wall"] is None  # it is a flexible pipe that gives no Do
    assert (stiffener["outer_diameter"], stiffener["buoyancy_diameter"]) == (1.9, 1.5)
    assert (riser["contents"], riser["filled_weight"]) == (0.0, riser["empty_weight"])


FILLED = """\
$LOAD CASE
*BOUNDARY
 TYPE=CONSTANT
 1, 1
$LOAD CASE
*INTERNAL FLUID
 SET=ALL
 50.0, 1025.0
$LOAD CASE
*INTERNAL FLUID
 SET=Half
 0.0, 800.0
"""
HALVES = CLEAN.replace(" 1, 2\n*GEO", " 1, 2\n SET=Half\n 2\n*GEO")


def test_contents_by_load_case(place: Place) -> None:
    """Empty, flooded, then oil below the mudline in one half, whose middle is 0.1 m above it: that half is empty."""
    first, second = rows(place(HALVES + FILLED))
    assert [(one["first_element"], one["contents"]) for one in (first, second)] == [(1, 1025.0), (2, 0.0)]
    flooded = 1025.0 * 9.81 * 3.14159265 / 4 * 0.46**2
    empty = first["empty_weight"]
    assert empty == pytest.approx(348.178, rel=1e-5)
    for row, filled in ((first, empty + flooded), (second, empty)):
        assert row["contents_load_case_1"] == 0.0
        assert row["weight_load_case_1"] == empty
        assert (row["contents_load_case_2"], row["weight_load_case_2"]) == pytest.approx((1025.0, empty + flooded))
        assert row["filled_weight"] == pytest.approx(filled)


def test_rows_of_static_embedment_with_contents_are_those_of_elements_that_are_full(place: Place) -> None:
    place(HALVES + FILLED)
    found = run("show", "deck.keyxm", "--output-format", "json").json()["static_embedment"]
    assert [(row["filled"], row["element"]) for row in found] == [(False, 1), (True, 1)]
    assert found[1]["weight"] == pytest.approx(348.178 + 1025.0 * 9.81 * math.pi / 4 * 0.46**2, rel=1e-5)


def test_masses_at_labelled_nodes_and_without_weight(place: Place) -> None:
    """Half of a mass belongs to each element at its node; the end of the line has one element."""
    masses = "*LABEL\n TYPE=NODE\n 3, LABEL=Top\n*MASS\n 2, 100.0\n {Top}, 40.0, TYPE=NO WEIGHT MASS\n"
    found = rows(
        place(
            HALVES.replace("*SEABED PROPERTIES", masses + "*SEABED PROPERTIES").replace(
                "SET=Pipe\n ST", "SET=Half\n ST"
            )
        )
    )
    assert [one["masses_at_nodes"] for one in found] == [50.0, 90.0]


def test_gaps_stand_out(place: Place) -> None:
    bare = HALVES.replace(" SET=Pipe\n 207", " SET=Half\n 207").replace("SET=Pipe\n STIFFNESS", "SET=Half\n STIFFNESS")
    pipe = run("show", place(bare), "--sheet").out.partition("Sheet: mass")[0]
    assert [line.split()[:2] for line in pipe.splitlines()[-3:-1]] == [["1", "none"], ["2", "Half"]]
    colored = run("show", "deck.keyxm", "--sheet", "--color", "always").out
    assert colored.count("\x1b[1;33mnone") == 6  # a section and a law of one, Cd and Ca of both


def test_what_the_weights_leave_out(place: Place) -> None:
    text = run("show", place(CLEAN + "*COATINGS\n 1\n")).out
    embedment, sheet = text.partition("Sheet: pipe")[::2]
    assert embedment.endswith("weights without *COATINGS\n\n")
    assert "weights without *COATINGS\n" in sheet
    assert "weights without" not in run("show", place(CLEAN)).out


def test_a_run_ends_where_a_line_does(place: Place) -> None:
    two = CLEAN.replace(" 3, 0.3, 20.0\n", " 3, 0.3, 20.0\n 4, 0.3, 40.0\n").replace(" 2, 2, 3\n", " 2, 3, 4\n")
    assert [(one["first_element"], one["length"]) for one in rows(place(two))] == [(1, 10.0), (2, 20.0)]


def test_csv_and_workbook_have_the_same_values(tmp_path: Path) -> None:
    text = run("show", CATENARY, "--output-format", "csv").out
    table = list(csv.DictReader(StringIO(text)))
    assert [row["section"] for row in table] == ["Flowline", "Touchdown", "Straked"]
    assert {row["units"] for row in table} == {"metric"}
    assert run("show", CATENARY, "-o", "sheet.xlsx").code == 0
    book = openpyxl.load_workbook(tmp_path / "sheet.xlsx")["sheet"]
    head, units, *cells = ([cell.value for cell in row] for row in book.iter_rows())
    assert dict(zip(head, units, strict=True))["empty_weight"] == "[N/m]"
    assert [float(row["filled_weight"]) for row in table] == [row[head.index("filled_weight")] for row in cells]
    assert cells[2][head.index("law")] is None


def test_the_load_case_of_the_contents_is_named_where_others_have_others(place: Place) -> None:
    """Case 2 floods the pipe, case 3 fills one half with oil only up to the mudline: the other half keeps its water."""
    deck = place(HALVES + FILLED)
    text = run("show", deck, "--sheet").out
    assert text.count("load case 3") == 3  # contents, mass and weight
    for command in ("evaluate", "show", "report"):
        options = ("-o", "out.html", "--sections", "model,contact") if command == "report" else ()
        outcome = run(command, deck, *options)
        words = Path("out.html").read_text(encoding="utf-8") if options else outcome.out
        assert "weights with the contents of load case 3" in words
    assert run("evaluate", deck, "--output-format", "json").json()["contents_case"] == 3
    assert run("batch", deck, "-o", "out", "--output-format", "json").json()[0]["contents_case"] == 3


def test_contents_that_are_not_read_are_not_zero(place: Place) -> None:
    (row,) = rows(place(CLEAN + "$LOAD CASE\n*DRILLING MUD\n 525.0, 1400.0\n"))
    assert (row["contents"], row["filled_mass"], row["filled_weight"]) == (None, None, None)
    text = run("show", "deck.keyxm", "--sheet").out
    assert "not read" in text
    assert "unknown" in text


def test_a_pipe_without_a_wall_has_no_stiffness_and_weight(place: Place) -> None:
    deck = place(CLEAN.replace("0.5, 0.46, 7850.0", "0.46, 0.5, 7850.0"))
    outcome = run("show", deck, "--sheet", "--output-format", "json")
    (row,) = outcome.json()["sheet"]
    assert (row["outer_diameter"], row["inner_diameter"], outcome.code) == (0.46, 0.5, 1)
    of_the_wall = ("diameter_over_wall", "mass", "empty_weight", "filled_mass", "filled_weight", "bending", "axial")
    assert {row[key] for key in of_the_wall} == {None}


def test_diameters_of_drag_and_buoyancy_where_they_differ(place: Place) -> None:
    rigid = "207.0E9, 79.6E9, 0.5, 0.46, 7850.0"
    assert rigid in CLEAN
    (row,) = rows(place(CLEAN.replace(rigid, rigid + ", , , , 0.7, 0.5")))
    assert (row["drag_diameter"], row["buoyancy_diameter"]) == (0.7, None)
    assert row["diameter_over_wall"] == pytest.approx(0.5 / 0.02)
    flexible = CLEAN.replace("OPTION=RIGID", "OPTION=FLEXIBLE").replace(
        rigid, "1.0E5, 1.0E5, 1.0E5, 5.0E8, 150.0, 0.5, 0.2, 0.35, 0.32"
    )
    (row,) = rows(place(flexible))
    assert (row["outer_diameter"], row["buoyancy_diameter"], row["diameter_over_wall"]) == (0.35, 0.32, None)
    oil = "$LOAD CASE\n*INTERNAL FLUID\n SET=ALL\n 50.0, 900.0\n"
    (row,) = rows(place(CLEAN.replace("OPTION=RIGID", "OPTION=MOORING").replace(rigid, "5.0E8, 180.0, 0.2") + oil))
    assert row["contents"] is None  # it has no bore
    assert row["filled_weight"] == row["empty_weight"]
