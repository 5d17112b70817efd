"""`mudline study`, with a report that was made before."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from unittest.mock import Mock

import pytest

from mudline.scene.model import Scene
from mudline.study import precision
from mudline.study.report import Column, StudyError, StudyOptions, StudyReport, StudyTable
from tests.cli.runner import run

SAMPLES = Path(__file__).parents[2] / "samples"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch, sample_report: StudyReport) -> None:
    """The command gets a report that was made before."""

    def study(found: Scene, options: StudyOptions) -> StudyReport:
        options.progress("smoothing")
        return replace(sample_report, title=f"Precision: {found.deck.file}", pictures=sample_report.pictures[:1])

    monkeypatch.setattr(precision, "run", study)


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
    assert text.count("\n\n") == 7
    assert text.startswith("curve,method,")


@pytest.mark.usefixtures("made")
def test_command_says_everything_or_little(tmp_path: Path) -> None:
    long = run("study", "precision", "-v").out
    assert "Closed forms sampled at points" in long
    assert "long tables" not in long
    quiet = run("study", "precision", "-q", "-o", tmp_path)
    assert (quiet.code, quiet.out, quiet.err) == (0, "", "")


@pytest.mark.usefixtures("made")
def test_command_says_what_is_missing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
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


def test_command_says_why_a_study_cannot_be_made(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(precision, "run", Mock(side_effect=StudyError("there is nothing to study")))
    outcome = run("study", "precision")
    assert (outcome.code, outcome.err) == (1, "mudline: built-in-sample.keyxm: there is nothing to study\n")
    monkeypatch.setattr(precision, "run", Mock(side_effect=ModuleNotFoundError("no", name="scipy.integrate")))
    assert "this study needs scipy: pip install 'mudline[study]'" in run("study", "precision").err
    monkeypatch.setattr(precision, "run", Mock(side_effect=ModuleNotFoundError("no", name="mudline.missing")))
    with pytest.raises(ModuleNotFoundError):
        run("study", "precision")


@pytest.mark.parametrize(
    ("study", "library"), [("precision", "scipy.integrate"), ("stability", "mpmath"), ("pruning", "scipy.interpolate")]
)
def test_libraries_are_looked_for_before_a_study_runs(
    monkeypatch: pytest.MonkeyPatch, study: str, library: str
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    monkeypatch.setattr(f"mudline.study.{study}.run", Mock(side_effect=AssertionError("it runs")))
    outcome = run("study", study, "-q")
    name = library.partition(".")[0]
    assert (outcome.code, outcome.err) == (1, f"mudline: this study needs {name}: pip install 'mudline[study]'\n")


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
