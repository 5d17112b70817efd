"""The whole precision study, and the command, with short ladders."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest

from mudline.deck.loading import load_bytes
from mudline.scene.model import Scene, resolve
from mudline.scene.sections import surroundings
from mudline.study import precision
from mudline.study.errors import StudyError
from mudline.study.options import StudyOptions
from mudline.study.precision import curves as curve_study
from mudline.study.precision import running
from mudline.study.precision.cases import reference_drop
from mudline.study.precision.smoothing import PUBLISHED, at_rest, impacts, weightless
from mudline.study.report import Column, StudyReport, StudyTable
from mudline.study.sample import TEXT, sample_scene
from tests.cli.runner import run

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.fixture(autouse=True)
def short(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(running, "LADDER", (0.5, 10.0))
    monkeypatch.setattr(running, "FINE_LADDER", (0.3,))
    monkeypatch.setattr(curve_study, "POINTS", (3, 10))
    monkeypatch.setattr(curve_study, "_TIMED", 1000)
    monkeypatch.setattr(curve_study, "_CHECKED", 50)


def scene(text: str, name: str = "deck.keyxm") -> Scene:
    return resolve(load_bytes(text.encode(), name)).require()


@pytest.fixture(scope="module")
def sample_report() -> StudyReport:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(running, "LADDER", (1.0,))
        patch.setattr(curve_study, "_TIMED", 1000)
        patch.setattr(curve_study, "_CHECKED", 50)
        report = running.run(sample_scene(), StudyOptions())
    return replace(report, pictures=report.pictures[:1])


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch, sample_report: StudyReport) -> None:
    """The command gets a report that was made before."""

    def study(found: Scene, options: StudyOptions) -> StudyReport:
        options.progress("smoothing")
        return replace(sample_report, title=f"Precision: {found.deck.file}")

    monkeypatch.setattr(precision, "run", study)


def test_report_of_the_sample(tmp_path: Path) -> None:
    told: list[str] = []
    report = running.run(sample_scene(), StudyOptions(progress=told.append))
    assert [table.name for table in report.tables] == [
        "curves",
        "backbones",
        "cases",
        "goals",
        "steps",
        "smoothing",
        "impacts",
    ]
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference", "drop-curve", "drop-linear", "pull", "drag"]
    assert len(report.tables[4].rows) == 5 * 9 * 2
    assert all(len(row) == len(table.columns) for table in report.tables for row in table.rows)
    assert any("omega dt 10" in omission.what for omission in report.omissions)
    assert any("time integration" in words for words in told)
    files = {path.name for path in report.write(tmp_path)}
    pictures = {
        f"precision-{name}.png" for name in ("curves", "backbones", "drop", "pull-drag", "run-time", "smoothing")
    }
    assert pictures <= files
    assert json.loads((tmp_path / "precision.json").read_text(encoding="utf-8"))["study"] == "precision"


def test_deck_with_less() -> None:
    text = TEXT.replace(" STIFFNESS=Soft Clay\n FRICTION=0.35, 0.60, 0.003, 0.150\n", " STIFFNESS=20.0E3\n")
    text = text.replace("*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.25, 7850.0\n", "")
    text = text.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    text = text.replace(
        "*SEABED STIFFNESS\n CURVE=Soft Clay\n",
        "*SEABED STIFFNESS\n CURVE=Soft Clay\n 0, 0\n 0.3, 9\n CURVE=Second\n 0, 0\n 0.3, 7\n CURVE=Third\n",
    )
    report = running.run(scene(text), StudyOptions())
    assert "curve Third" in {omission.what for omission in report.omissions}
    assert any("mass of the pipe is not known" in note for note in report.notes)
    assert any("no known weight" in note for note in report.notes)
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference", "drop-linear", "pull", "drag"]
    full = running.run(scene(text), StudyOptions(full=True))
    assert "curve Third" not in {omission.what for omission in full.omissions}


def test_deck_without_a_law() -> None:
    report = running.run(
        scene("$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n 2, 0.0, 1.0, 0.0\n*ELEMENT\n 1, 1, 2\n"), StudyOptions()
    )
    assert any("only the reference case was run" in note for note in report.notes)
    assert [row[0] for row in report.tables[2].rows] == ["drop-reference"]
    assert "curves" not in {picture.name for picture in report.pictures}


@pytest.mark.parametrize("stiffness", ["1.0E-300", "1.0E300", "1.0E-3", "1.0E15"])
def test_extreme_decks_end_in_reasons(stiffness: str) -> None:
    report = running.run(scene(TEXT.replace("50.0E3", stiffness)), StudyOptions())
    assert report.tables[2].rows


@pytest.mark.parametrize("point", ["1.0E-290, 450.0", "0.01, 1.0E15", "0.01, 1.0E-300", "0.01, -450.0", "1.0E9, 450.0"])
def test_extreme_curves_end_in_reasons(point: str) -> None:
    text = TEXT.replace("*SEABED SUCTION\n SET=Clay\n COHESION=5.0E3\n", "")
    report = running.run(scene(text.replace("0.01,  450.0", point)), StudyOptions())
    assert report.tables[0].rows
    assert json.loads(report.json())["study"] == "precision"


def test_imperial_deck() -> None:
    deck = SAMPLES / "imperial-riser.keyxi"
    found = resolve(load_bytes(deck.read_bytes(), deck.name)).require()
    around = surroundings(found.deck)
    assert 32.0 < around.gravity < 32.4
    assert 1.9 < around.density < 2.1
    report = running.run(found, StudyOptions())
    assert report.tables[4].rows


def test_mass_and_weight_of_the_sample() -> None:
    found = sample_scene()
    area = np.pi / 4 * (0.3**2 - 0.25**2)
    assert found.mass_per_length == pytest.approx(np.full(10, 7850 * area))
    weight = (7850 * area - 1025 * np.pi / 4 * 0.3**2) * 9.81
    assert found.submerged_weight == pytest.approx(np.full(10, weight))


def test_smoothing_reproduces_published_iterations() -> None:
    rows = {row.half_width: row for row in at_rest(PUBLISHED, np.array([0.0, 1e-6, 1e-4, 1e-3, 1e-2]))}
    tries = {width: (row.from_above, row.from_below) for width, row in rows.items()}
    assert tries == {0.0: (2, 1), 1e-6: (2, 1), 1e-4: (7, 6), 1e-3: (9, 8), 1e-2: (10, 9)}
    depths = [row.penetration for row in rows.values()]
    assert depths == pytest.approx(
        [9.999800004e-6, 9.999800004e-6, -3.6752122431e-5, -7.9984009590e-4, -9.3616510978e-3], rel=1e-9
    )


def test_smoothing_lessens_the_gain_at_impact() -> None:
    rows = [row for row in impacts(weightless(reference_drop())) if (row.scheme, row.omega_dt) == ("newmark", 0.5)]
    kinked, widest = rows[0].rebound, rows[-1].rebound
    assert kinked is not None
    assert widest is not None
    assert widest < 0.2 * kinked
    assert rows[-1].iterations > rows[0].iterations


@pytest.mark.usefixtures("made")
def test_command(tmp_path: Path) -> None:
    outcome = run("study", "precision", "-o", tmp_path / "out")
    assert outcome.code == 0
    assert "Curve evaluation against exact rational arithmetic" in outcome.out
    assert "long tables are not shown here" in outcome.out
    assert "mudline: precision: smoothing" in outcome.err
    assert "files -> " in outcome.err
    assert (tmp_path / "out" / "precision-curves.png").exists()


@pytest.mark.usefixtures("made")
def test_command_as_json_and_csv() -> None:
    whole = run("study", "precision", SAMPLES / "scr-touchdown.keyxm", "--output-format", "json", "-q")
    assert (whole.code, whole.err) == (0, "")
    assert whole.json()["title"] == "Precision: " + (SAMPLES / "scr-touchdown.keyxm").as_posix()
    text = run("study", "precision", "--output-format", "csv", "-q").out
    assert text.count("\n\n") == 6
    assert text.startswith("curve,method,")


@pytest.mark.usefixtures("made")
def test_command_says_everything_or_little(tmp_path: Path) -> None:
    long = run("study", "precision", "-v").out
    assert "Closed forms sampled at points" in long
    assert "long tables" not in long
    quiet = run("study", "precision", "-q", "-o", tmp_path)
    assert (quiet.code, quiet.out, quiet.err) == (0, "", "")


@pytest.mark.usefixtures("made")
def test_command_tells_what_is_missing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    outcome = run("study", "precision", "-q", "-o", tmp_path)
    assert outcome.code == 1
    assert outcome.err == "mudline: this study needs matplotlib: pip install 'mudline[study]'\n"


@pytest.mark.usefixtures("made")
def test_command_refuses_bad_places_and_decks(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.write_text("", encoding="utf-8")
    outcome = run("study", "precision", "-q", "-o", file)
    assert outcome.code == 2
    assert "cannot be written" in outcome.err
    assert run("study", "precision", SAMPLES / "broken.keyxm").code == 1
    assert run("study", "precision", tmp_path / "missing.keyxm").code == 2
    assert run("study", "guessing").code == 2


def test_command_tells_why_a_study_cannot_be_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "run", Mock(side_effect=StudyError("there is nothing to study")))
    outcome = run("study", "precision")
    assert (outcome.code, outcome.err) == (1, "mudline: built-in-sample.keyxm: there is nothing to study\n")
    monkeypatch.setattr(precision, "run", Mock(side_effect=ModuleNotFoundError("no", name="scipy.integrate")))
    assert "this study needs scipy: pip install 'mudline[study]'" in run("study", "precision").err
    monkeypatch.setattr(precision, "run", Mock(side_effect=ModuleNotFoundError("no", name="mudline.missing")))
    with pytest.raises(ModuleNotFoundError):
        run("study", "precision")


def test_command_shows_every_kind_of_cell(monkeypatch: pytest.MonkeyPatch) -> None:
    cells = [("a", True, 0.25, None), ("b", False, float("nan"), 3)]
    columns = (Column("name"), Column("right"), Column("size", "m"), Column("count"))
    monkeypatch.setattr(
        precision, "run", lambda *_: StudyReport("precision", "T", (StudyTable("t", "Cells", columns, cells),))
    )
    lines = run("study", "precision", "-q").out.splitlines()
    assert lines[0] == "Cells"
    assert lines[-3].split() == ["a", "yes", "0.25"]
    assert lines[-2].split() == ["b", "no", "3"]
