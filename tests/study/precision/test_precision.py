"""The whole precision study, with short ladders."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mudline.scene.sections import surroundings
from mudline.study import SAMPLE_TEXT, precision
from mudline.study.report import StudyOptions, StudyReport
from tests.builders.scenes import legal_scene

SAMPLES = Path(__file__).parents[3] / "samples"


pytestmark = pytest.mark.usefixtures("short")


def test_report_of_the_sample(sample_report: StudyReport, sample_progress: list[str], tmp_path: Path) -> None:
    report = sample_report
    assert [table.name for table in report.tables] == [
        "curves",
        "backbones",
        "cases",
        "advice",
        "goals",
        "orders",
        "steps",
        "smoothing",
        "impacts",
        "machine",
    ]
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference", "drop-curve", "drop-linear", "pull", "drag"]
    steps = [row[2] for row in report.tables[6].rows]
    assert steps.count(0.5) == steps.count(10.0) == 5 * 9
    assert len(steps) == 5 * 9 * 2 + 5  # on the pull five schemes are within 1 % at 0.5: the next step is tried
    assert all(len(row) == len(table.columns) for table in report.tables for row in table.rows)
    assert any("omega dt 10" in omission.what for omission in report.omissions)
    assert any("time integration" in words for words in sample_progress)
    files = {path.name for path in report.write(tmp_path)}
    pictures = {
        f"precision-{name}.png"
        for name in ("curves", "backbones", "drop", "pull-drag", "work", "run-time", "smoothing")
    }
    assert pictures <= files
    assert json.loads((tmp_path / "precision.json").read_text(encoding="utf-8"))["study"] == "precision"


def test_deck_with_less() -> None:
    text = SAMPLE_TEXT.replace(" STIFFNESS=Soft Clay\n FRICTION=0.35, 0.60, 0.003, 0.150\n", " STIFFNESS=20.0E3\n")
    text = text.replace("*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.25, 7850.0\n", "")
    text = text.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    text = text.replace(
        "*SEABED STIFFNESS\n CURVE=Soft Clay\n",
        "*SEABED STIFFNESS\n CURVE=Soft Clay\n 0, 0\n 0.3, 9\n CURVE=Second\n 0, 0\n 0.3, 7\n CURVE=Third\n",
    )
    report = precision.run(legal_scene(text), StudyOptions())
    assert "curve Third" in {omission.what for omission in report.omissions}
    assert any("mass of the pipe is not known" in note for note in report.notes)
    assert any("submerged weight of the pipe is not known" in note for note in report.notes)
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference", "drop-linear", "pull"]
    drag = next(omission for omission in report.omissions if omission.what.startswith("drag along"))
    assert drag.reason == "friction: no springs at 4 nodes: they follow the submerged weight, which is not known"
    full = precision.run(legal_scene(text), StudyOptions(full=True))
    assert "curve Third" not in {omission.what for omission in full.omissions}


def test_deck_without_a_law() -> None:
    report = precision.run(
        legal_scene("$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n 2, 0.0, 1.0, 0.0\n*ELEMENT\n 1, 1, 2\n"), StudyOptions()
    )
    assert "Only the reference case was run: no element has a seabed law." in report.notes
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference"]
    assert "curves" not in {picture.name for picture in report.pictures}


@pytest.mark.untraced
@pytest.mark.parametrize("stiffness", ["1.0E-300", "1.0E300", "1.0E-3", "1.0E15"])
def test_extreme_decks_end_in_reasons(stiffness: str) -> None:
    report = precision.run(legal_scene(SAMPLE_TEXT.replace("50.0E3", stiffness)), StudyOptions())
    assert report.tables[2].rows


@pytest.mark.untraced
@pytest.mark.parametrize("point", ["1.0E-290, 450.0", "0.01, 1.0E15", "0.01, 1.0E-300", "0.01, -450.0", "1.0E9, 450.0"])
def test_extreme_curves_end_in_reasons(point: str) -> None:
    text = SAMPLE_TEXT.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    report = precision.run(legal_scene(text.replace("0.01,  450.0", point)), StudyOptions())
    assert report.tables[0].rows
    assert json.loads(report.json())["study"] == "precision"


def test_imperial_deck() -> None:
    deck = SAMPLES / "imperial-riser.keyxi"
    found = legal_scene(deck.read_text(encoding="utf-8"), deck.name)
    around = surroundings(found.deck)
    assert 32.0 < around.gravity < 32.4
    assert 1.9 < around.density < 2.1
    report = precision.run(found, StudyOptions())
    assert report.tables[6].rows
    rest = next(table for table in report.tables if table.name == "smoothing")
    assert rest.columns[1] == ("half width h", "ft")
    floating = next(row for row in rest.rows if row[2] == pytest.approx(1e-3 / 9.9998e-6, rel=1e-4))
    assert floating[1] == pytest.approx(1e-3 / 0.3048)
    assert floating[3] == pytest.approx(-7.9984e-4 / 0.3048, rel=1e-4)
    assert "with h = 0.0033 ft on this stiff seabed by 0.0026 ft" in report.page
