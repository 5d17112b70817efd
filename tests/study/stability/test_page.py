"""The page of the stability study: limits that are not above what was found, and lines with their file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

import mudline
from mudline.study import SAMPLE_TEXT
from mudline.study.pages import Tables
from mudline.study.report import StudyOptions
from mudline.study.stability import deck_steps, run
from mudline.study.stability.page import page
from tests.builders.scenes import legal_scene

DOCS = Path(__file__).parents[3] / "docs" / "studies"


@pytest.fixture(scope="module")
def tables() -> Tables:
    return Tables.read(DOCS, "stability")


def cells_of(text: str, start: str) -> list[list[str]]:
    """The cells of the lines of tables that begin so."""
    lines = [line for line in text.splitlines() if line.startswith(f"| {start} | ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_a_restart_names_the_file_of_each_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    monkeypatch.setattr(deck_steps, "LANDING_SCHEMES", ("newmark",))
    (tmp_path / "static.keyxm").write_text(SAMPLE_TEXT, encoding="utf-8")
    path = tmp_path / "dynamic.keyxm"
    path.write_text("$LOAD CASE\n*RESTART\n LAST=static\n*TIME\n STEP=FIXED\n 0.0, 9.0, 0.01, 2.0\n", encoding="utf-8")
    report = run(mudline.read(path).scene(), StudyOptions(only=("steps",)))
    assert "because of curve:Soft Clay on Clay (line 32 of static.keyxm)" in report.advice
    assert "because of suction damping on Clay (line 43 of static.keyxm): above it" in report.advice
    texts = {path.stem.removeprefix("stability-"): path.read_text("utf-8") for path in DOCS.glob("stability-*.csv")}
    texts |= {table.name: "".join(table.csv()) for table in report.tables}
    text = page(Tables(texts))
    assert "| suction damping on Clay | 43 of static.keyxm | 1 |" in text
    assert "| central difference | 0.000309 | suction damping on Clay | 43 of static.keyxm |" in text
    assert "from ratio 0 to 0.01 (line 32 of static.keyxm)" in text


def test_steps_on_the_page_are_not_above_the_critical_ones(tables: Tables) -> None:
    text = page(tables)
    for row in tables.rows("contacts"):
        (cells,) = cells_of(text, row.text("contact"))
        for cell, scheme in zip(cells[-3:], ("central-difference", "velocity-verlet", "rk4"), strict=True):
            exact = row.number(f"critical step, {scheme} [s]")
            assert 0.99 * exact < float(cell) <= exact
    for row in tables.rows("deck-steps", **{"deck file": ""}):
        step = row.number("critical step [s]")
        if step > 0.0:
            assert 0.99 * step < float(cells_of(text, row.text("scheme"))[0][1]) <= step
    (limit,) = tables.rows("landing-limits", scheme="Newmark")
    shown = math.floor(1e3 * limit.number("landings within 1 % [-]")) / 1e3
    assert f"one percent needs `omega dt` = {shown:g} on a linear seabed" in text


def test_extremes_are_those_of_all_landings_tried(tables: Tables) -> None:
    text = page(tables)
    for scheme in ("Newmark", "HHT (-0.3)", "generalised-alpha (0.5)", "generalised-alpha (0)"):
        cells = cells_of(text, scheme)[-1]
        largest = [row.number("largest [-]") for row in tables.rows("landings", scheme=scheme)]
        largest += [row.number("largest [-]") for row in tables.rows("landing-envelopes", scheme=scheme)]
        assert float(cells[-1]) == pytest.approx(max(largest), abs=1e-5)
        assert float(cells[-1]) >= max(largest)


def test_the_end_of_the_search_is_no_limit(tables: Tables) -> None:
    text = page(tables)
    assert cells_of(text, "generalised-alpha (0)")[-1][1:4] == ["-", "all tried", "0.179"]
    assert cells_of(text, "backward Euler")[0][4] == "all tried (0.096)"


def test_what_is_left_out_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    monkeypatch.setattr(deck_steps, "LANDING_SCHEMES", ("newmark",))
    monkeypatch.setattr(deck_steps, "_MOST_STEPS", 380)  # a landing on the clay takes 401 steps, on the sand 346
    springs = "*P-Y\n TYPE=USER\n SET=Clay\n DEPTH=0.0\n 0.0, 0.0\n 4000.0, 0.01\n$LOAD CASE"
    report = run(legal_scene(SAMPLE_TEXT.replace("$LOAD CASE", springs)), StudyOptions(only=("steps",)))
    assert [tuple(one) for one in report.omissions] == [
        ("curve:Soft Clay on Clay", "no landings: one would take more than 380 steps, its stiffest part is so narrow"),
        ("*P-Y", "left out of all steps: the evaluator has no springs of this keyword"),
    ]
    assert "because of friction on Sand (deck line 28): omega dt is 0.5 there" in report.advice


def test_the_explicit_step_resolves_springs_and_landings_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without suction the critical step of friction, 0.065 s, is four times the step that resolves it."""
    monkeypatch.setattr(deck_steps, "STEPPED", ())
    monkeypatch.setattr(deck_steps, "LANDING_SCHEMES", ("newmark", "velocity-verlet"))
    text = SAMPLE_TEXT.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    text = text.replace(" STIFFNESS=Soft Clay\n", " STIFFNESS=1.0E4\n").partition("*SEABED STIFFNESS")[0]
    report = run(legal_scene(f"{text}$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n"), StudyOptions(only=("steps",)))
    assert report.advice.startswith("Use Newmark with a step of 0.0163 s or less, because of friction on Sand")
    assert "central difference needs 0.0163 s or less, because of friction on Sand" in report.advice
    assert report.advice.endswith("omega dt is 0.5 there.")
