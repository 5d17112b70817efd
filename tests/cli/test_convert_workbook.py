"""`mudline convert` of tables: workbooks and CSV files with the headings of the manual."""

from __future__ import annotations

import datetime as dt
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from openpyxl import Workbook

import mudline
from mudline.basics.quantities import ELEMENTS, LINES
from mudline.model.results.forms import xlsx
from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN, CLEAN_WARNING

Rows = Sequence[Sequence[object]]
UNCALCULATED = "a formula that was never calculated: open the workbook in a spreadsheet program and save it"
CLAY: Rows = [("ratio", "force"), (0.0, 0.0), (0.1, 1200.5), (0.5, 10000)]
SAND: Rows = [("Force [N/m]", "Ratio"), (0, 0), (None, None), (5000.25, 0.3)]


def book(sheets: Mapping[str, Rows], name: str = "curves.xlsx") -> str:
    """Write a workbook into the current folder."""
    made = Workbook()
    del made["Sheet"]
    for title, rows in sheets.items():
        sheet = made.create_sheet(title)
        for row in rows:
            sheet.append(row)
    made.save(name)
    return name


def fault(rows: Rows, sheet: str = "Clay", *others: str) -> str:
    """What is said of a sheet, behind the name of the file; nothing may be written."""
    outcome = run("convert", book({sheet: rows}), "-o", "curves.keyxm", *others)
    assert (outcome.code, outcome.out, Path("curves.keyxm").exists()) == (1, "", False)
    assert outcome.err.startswith("curves.xlsx:")
    return outcome.err.partition("DAT001 ")[2].removesuffix("\n")


def test_each_sheet_is_a_curve(folder: Path) -> None:
    outcome = run(
        "convert", book({"Clay": CLAY, "Notes": [("from the lab",)], "Dense Sand": SAND}), "-o", "curves.keyxm"
    )
    assert (outcome.code, outcome.out) == (0, "")
    assert outcome.err == (
        "mudline: sheet Notes is left out: no headings of a keyword in its first row\n"
        "mudline: curves.xlsx -> curves.keyxm\n"
    )
    assert (folder / "curves.keyxm").read_text(encoding="utf-8") == (
        "$MODEL\n*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.1, 1200.5\n 0.5, 10000.0\n"
        " CURVE=Dense Sand\n 0.0, 0.0\n 0.3, 5000.25\n"
    )
    deck = mudline.read("curves.keyxm")
    (block,) = deck.sections[0].blocks
    for form in ("json", "yaml"):
        assert run("convert", "curves.xlsx", "-o", f"curves.{form}", "-q").code == 0
        again = mudline.read(f"curves.{form}")
        assert (again.sections[0].blocks, again.units) == ([block], "metric")


def test_a_column_names_the_curves(folder: Path) -> None:
    rows = [("curve", "ratio", "force [lbf/ft]"), ("b", 0.2, 9.0), ("a", 0, 0), ("B", 0, 0), ("a", 1, 2)]
    assert run("convert", book({"All": rows}), "--sorted", "-o", "curves.json", "-q").code == 0
    deck = mudline.read(folder / "curves.json")
    curves = next(deck.blocks("SEABED STIFFNESS"))[1].curves
    assert deck.units == "imperial"
    assert [(curve.name, curve.points.values.tolist()) for curve in curves] == [
        ("b", [[0.0, 0.0], [0.2, 9.0]]),
        ("a", [[0.0, 0.0], [1.0, 2.0]]),
    ]


MANUAL: Rows = [
    ("SEABED  Force (lbf/ft)", "embedment ratio", "Set Name"),
    (0, 0, None),
    (10, 0.5, None),
    (0, 0, "Flowline"),
    (3.5, 0.25, None),
    (7, 0.125, "flowline"),
]


def test_the_tables_of_the_manual() -> None:
    """A blank set continues the one above it, and in the first row means all elements."""
    nodes = [("Node", "X", "Y", "Z"), (1, 0, 0, None), (2, 0, 10.5, 1)]
    sections: list[Sequence[object]] = [
        ("set", "E", "G", "Do", "Di", "density", "A", "I", "J", "Dd"),
        ("Flowline", 2e11, 8e10, 0.3, 0.2, 7850),
    ]
    sections.append(("Riser", 2e11, 8e10, 0.3, 0.2, 7850, None, None, None, 0.4))
    outcome = run("convert", book({"One": MANUAL, "Two": nodes, "Three": sections}), "-o", "out.keyxm")
    assert (outcome.code, outcome.err) == (0, "mudline: curves.xlsx -> out.keyxm\n")
    assert Path("out.keyxm").read_text(encoding="utf-8") == (
        "$MODEL\n*EMBEDMENT\n SET=ALL\n 0.0, 0.0\n 0.5, 10.0\n"
        " SET=Flowline\n 0.0, 0.0\n 0.25, 3.5\n 0.125, 7.0\n"
        "*NODE\n 1, 0.0, 0.0\n 2, 0.0, 10.5, 1.0\n"
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=Flowline\n 200000000000.0, 80000000000.0, 0.3, 0.2, 7850.0\n"
        " SET=Riser\n 200000000000.0, 80000000000.0, 0.3, 0.2, 7850.0, , , , 0.4\n"
    )
    assert run("convert", "curves.xlsx", "--to", "json").json()["units"] == "imperial"


def test_curves_whose_abscissa_is_their_second_column() -> None:
    bending = [("Curve", "Moment [N m]", "Curvature"), ("Pipe", 0, 0), (None, 4e5, 0.01), (None, 6e5, 0.03)]
    outcome = run("convert", book({"Bending": [(row[0], row[1], row[2]) for row in bending]}), "--to", "keyword", "-q")
    assert "expected the unit Nm or lbfft, found 'N m'" not in outcome.err
    assert outcome.out == "$MODEL\n*MOMENT-CURVATURE\n CURVE=Pipe\n 0.0, 0.0\n 400000.0, 0.01\n 600000.0, 0.03\n"
    assert fault([*bending, (None, 7e5, 0.03)], "Bending").startswith("sheet Bending, cell B5: ")


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_csv_files(separator: str) -> None:
    lines = [("Set Name", "Embedment Ratio", "Seabed Force [N/m]"), ("", "0", "0"), ("", "1", "2.5E3"), ("A", "0", "0")]
    lines.append(("", "=[depth]", "7"))
    Path("soil.csv").write_text("".join(f"{separator.join(line)}\r\n" for line in lines), encoding="utf-8-sig")
    outcome = run("convert", "soil.csv", "--to", "keyword", "-q")
    assert outcome.out == ("$MODEL\n*EMBEDMENT\n SET=ALL\n 0.0, 0.0\n 1.0, 2500.0\n SET=A\n 0.0, 0.0\n =[depth], 7.0\n")


def test_faults_of_csv_files() -> None:
    for text, message in (
        (
            "curve;ratio;force\nA;0;0\n;0,5;3\n",
            "soil.csv:3:1: error: DAT001 column ratio: expected a number, found '0,5'",
        ),
        ("ratio,force\n0,0\n1,\n", "soil.csv:3:1: error: DAT001 column force: expected a number, found nothing\n"),
        ("ratio,force\n0,0\n0,5\n", "soil.csv:3:1: error: DAT001 column ratio: "),
        ("ratio,force\n", "soil.csv:1:1: error: DAT001 column ratio: "),
        ("", "soil.csv:1:1: error: DAT001 no table of a keyword: "),
        ("\0\x01\x02", "soil.csv:1:1: error: DAT001 "),
    ):
        Path("soil.csv").write_bytes(text.encode())
        outcome = run("convert", "soil.csv", "-o", "out.keyxm")
        assert (outcome.code, outcome.out, Path("out.keyxm").exists()) == (1, "", False)
        assert outcome.err.startswith(message)


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ((0.2, "abc"), "sheet Clay, cell B5: expected a number, found 'abc'"),
        (
            (0.2, "0,5"),
            "sheet Clay, cell B5: expected a number, found '0,5'; it is a text, format the cell as a number",
        ),
        ((None, 3.0), "sheet Clay, cell A5: expected a number, found nothing"),
        ((0.2, True), "sheet Clay, cell B5: expected a number, found True"),
        ((dt.date(2026, 1, 2), 1.0), "sheet Clay, cell A5: expected a number, found 2026-01-02 00:00:00"),
        (
            (0.2, "=B2*2"),
            f"sheet Clay, cell B5: expected a number, found {UNCALCULATED}",
        ),
        ((0.2, "#DIV/0!"), "sheet Clay, cell B5: expected a number, found '#DIV/0!'"),
    ],
)
def test_cells_without_numbers(row: Sequence[object], message: str) -> None:
    assert fault([*CLAY, row]) == message


def test_headings_and_curves_that_do_not_fit() -> None:
    assert fault([("ratio", "kN"), (0, 0)]) == (
        "sheet Clay, cell A1: a column ratio and none headed force: *SEABED STIFFNESS needs both, in the first row"
    )
    assert fault([("hello",), (0, 0)]) == "no table of a keyword: expected the headings of its page in the first row"
    assert fault([("ratio", "force", "force")]).startswith("sheet Clay, cell C1: a second column force: ")
    assert fault([("ratio", "force [kN/m]")]) == "sheet Clay, cell B1: expected the unit N/m or lbf/ft, found 'kN/m'"
    assert fault([*CLAY, (0.1, 7.0)]).startswith("sheet Clay, cell A5: ")
    assert fault(CLAY[:2]).startswith("sheet Clay, cell A1: ")
    assert fault([("curve", "ratio", "force"), (None, 0, 0), ("a", 1, 1)]) == (
        "sheet Clay, cell A2: expected the name of a curve, found nothing"
    )
    assert fault([(*CLAY[0], "source"), (0, 0, "lab"), (1, 1, None)]) == (
        "sheet Clay, cell C1: *SEABED STIFFNESS has no column 'source': it has CURVE, Embedment Ratio, Seabed Force; "
        "leave others out"
    )
    assert fault([*CLAY, (1, 2, "lab")]) == (
        "sheet Clay, cell C5: a value in a column without a heading: give it one, or remove it"
    )
    assert (
        fault([("node", "x"), (1, 0)])
        == "sheet Clay, cell A1: a column node and none headed y: *NODE needs both, in the first row"
    )
    assert fault([("curve", "ratio", "force"), ("a\nb", 0, 0), (None, 1, 1)]) == (
        "sheet Clay, cell A2: a line end in a cell: a name is on one line"
    )
    assert fault([("curve", "ratio", "force"), ("a,b=", 0, 0), (None, 1, 1)]).startswith("sheet Clay, cell A2: ")


def test_a_name_twice_and_two_systems() -> None:
    named = [("curve", "ratio", "force"), ("clay", 0, 0), ("clay", 1, 1)]
    outcome = run("convert", book({"Clay": CLAY, "More": named}), "-o", "out.keyxm")
    assert "sheet More, cell A2: the curve 'clay' is also on the sheet Clay: rename one" in outcome.err
    imperial = [("ratio", "force [lbf/ft]"), (0, 0), (1, 1)]
    outcome = run("convert", book({"Feet": imperial, "Sand": SAND}), "-o", "out.keyxm")
    assert "the headings have different units: imperial on 'Feet' and metric on 'Sand'" in outcome.err


def test_a_workbook_that_unpacks_to_too_much(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mudline.model.scene.workbook.LARGEST_FILE", 1000)
    Workbook().save(folder / "large.xlsx")
    outcome = run("convert", folder / "large.xlsx", "-o", folder / "o.keyxm")
    assert outcome.code == 1
    assert "unpacks to more than 1000 bytes" in outcome.err


def test_files_that_are_not_workbooks(folder: Path) -> None:
    for data in (b"", b"ratio,force\n0,0\n", Path(book({"Clay": CLAY})).read_bytes()[:-200]):
        (folder / "curves.xlsx").write_bytes(data)
        outcome = run("convert", "curves.xlsx", "-o", "out.keyxm")
        assert (outcome.code, (folder / "out.keyxm").exists()) == (1, False)
        assert "DAT001 not a workbook that can be read: " in outcome.err
    assert run("convert", "nowhere.xlsx", "-o", "out.keyxm").code == 2
    outcome = run("convert", "curves.xls", "-o", "out.keyxm")
    assert (outcome.code, "save it as .xlsx" in outcome.err) == (2, True)


# ----------------------------------------------------------------------------------------- mudline evaluate -o out.xlsx


NAMED = CLEAN.replace("Pipe", "@SUM(A1)").replace("Clay", "https://x.org")


@pytest.fixture
def steps(folder: Path) -> str:
    """Positions of three steps."""
    rest = np.array([[-0.1, 0, 0], [-0.1, 10, 0], [0.3, 20, 0]])
    np.savez(folder / "p.npz", positions=rest + 0.01 * np.arange(3)[:, None, None], time=np.array([0.5, 1.0, 2.5]))
    return "p.npz"


def test_sheets_headings_and_values(place: Place, folder: Path) -> None:
    outcome = run("evaluate", place(), "-o", "out.xlsx")
    assert (outcome.code, outcome.out) == (0, "")
    assert outcome.err == f"{CLEAN_WARNING}mudline: deck.keyxm -> out.xlsx\n"
    assert sorted(path.name for path in folder.iterdir()) == ["deck.keyxm", "out.xlsx"]
    book = openpyxl.load_workbook("out.xlsx")
    assert book.sheetnames == ["elements", "nodes", "summary"]
    names, units, first, *others = book["elements"].iter_rows(values_only=True)
    assert names == tuple(ELEMENTS)
    found = dict(zip(names, zip(units, first, strict=True), strict=True))
    assert (found["depth"], found["stiffness"]) == (("[m]", 0.1), ("[N/m2]", 10000.0))
    assert (found["contact"], found["law"], found["state"]) == ((None, True), (None, "curve:Clay"), (None, None))
    assert len(others) == 1
    assert {sheet.freeze_panes for sheet in book} == {"B3"}
    assert [cell.value for cell in book["summary"][1]] == list(LINES)
    widths = [book["elements"].column_dimensions[letter].width for letter in "ABO"]
    assert widths[0] < widths[2]


def test_names_are_texts_and_no_formulas(place: Place) -> None:
    assert run("evaluate", place(NAMED), "-o", "out.xlsx", "-q").code == 0
    sheet = openpyxl.load_workbook("out.xlsx")["elements"]
    cells = {head.value: cell for head, cell in zip(sheet[1], sheet[3], strict=True)}
    assert (cells["set"].value, cells["set"].data_type) == ("@SUM(A1)", "s")
    assert (cells["law"].value, cells["law"].hyperlink) == ("curve:https://x.org", None)
    assert sheet["A3"].data_type == "n"


def test_more_rows_than_a_sheet_holds(place: Place, steps: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(xlsx, "SHEET_ROWS", 10)
    (folder / "out.xlsx").write_bytes(b"old")
    outcome = run("evaluate", place(), "--positions", steps, "-o", "out.xlsx")
    assert outcome.code == 2
    assert outcome.err == (
        "mudline: out.xlsx: 9 rows of nodes: a sheet of a workbook holds 8; write .parquet instead\n"
    )
    assert (folder / "out.xlsx").read_bytes() == b"old"
    assert sorted(path.name for path in folder.iterdir()) == ["deck.keyxm", "out.xlsx", "p.npz"]
