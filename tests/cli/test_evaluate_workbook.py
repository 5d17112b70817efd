"""`mudline evaluate -o out.xlsx`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import openpyxl
import pytest

from mudline.quantities import ELEMENTS, LINES
from mudline.results.forms import xlsx
from tests.builders.decks import CLEAN, CLEAN_WARNING
from tests.cli.conftest import Place
from tests.cli.runner import run

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


def test_a_late_fault_leaves_nothing(place: Place, folder: Path) -> None:
    values = np.repeat(np.array([[[-0.1, 0, 0], [-0.1, 10, 0], [0.3, 20, 0]]]), 5000, axis=0)
    values[-1, 0, 0] = np.nan
    np.save(folder / "p.npy", values)
    outcome = run("evaluate", place(), "--positions", "p.npy", "-o", "out.xlsx")
    assert (outcome.code, "position" in outcome.err) == (1, True)
    assert sorted(path.name for path in folder.iterdir()) == ["deck.keyxm", "p.npy"]


def test_without_xlsxwriter(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(name: str) -> None:
        raise ImportError(name)

    monkeypatch.setattr("mudline.cli.result_files.form_module", missing)
    outcome = run("evaluate", place(), "-o", "out.xlsx")
    assert (outcome.code, outcome.err) == (1, "mudline: .xlsx needs xlsxwriter: pip install 'mudline[excel]'\n")
