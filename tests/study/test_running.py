"""Running a study part by part: what is written when, what is taken from the folder, what an interruption leaves."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from matplotlib.figure import Figure

import mudline as mudline_package
from mudline.scene.model import Scene
from mudline.study import SAMPLE_TEXT, precision, sample_scene
from mudline.study.pages import Tables
from mudline.study.pictures import Picture
from mudline.study.report import Column, Omission, Section, StudyError, StudyOptions, StudyReport, StudyTable
from mudline.study.running import RUN_TIME, Part, Study, digest, known_parts
from tests.builders.scenes import legal_scene
from tests.cli.runner import assert_fits
from tests.cli.runner import run as mudline

Measure = Callable[[Scene, StudyOptions], Section]


def draw(figure: Figure) -> None:
    figure.add_subplot().plot([0, 1], [0, 1])


class Counter:
    """A study of three parts that counts how often each is run, and may be interrupted in one of them."""

    def __init__(self) -> None:
        self.ran: list[str] = []
        self.interrupts = ""
        parts = tuple(Part(name, self._measure(name), weight) for name, weight in (("a", 1.0), ("b", 2.0), ("c", 1.0)))
        self.study = Study("precision", "Counted: {deck}", parts, self._page, self._advice, order=("c", "a"))

    def _measure(self, name: str) -> Measure:
        def run(_: Scene, options: StudyOptions) -> Section:
            for _item in options.each("xy", lambda letter: f"{name}{letter}"):
                if self.interrupts == name:
                    raise KeyboardInterrupt
            self.ran.append(name)
            table = StudyTable(name, "T", (Column("n"), Column("x", "m")), [(len(self.ran), None)], brief=name != "c")
            return Section((table,), [Picture(name, "P", draw, (2.0, 2.0))], ["note"], [Omission(name, "so")])

        return run

    @staticmethod
    def _page(tables: Tables) -> str:
        return " ".join(tables.row(name).text("n") for name in "abc") + "\n"

    @staticmethod
    def _advice(tables: Tables) -> str:
        return f"use {tables.row('b').text('n')}"

    def run(self, folder: Path | None, only: str = "", *, full: bool = False) -> StudyReport:
        return self.study.run(sample_scene(), StudyOptions(full, only=tuple(only), folder=folder))


def names(folder: Path) -> set[str]:
    return {path.name.removeprefix("precision") for path in folder.iterdir()}


def test_everything_is_in_the_report_and_in_the_folder(tmp_path: Path) -> None:
    counter = Counter()
    report = counter.run(tmp_path)
    assert [table.name for table in report.tables] == ["c", "a", "b", "machine"]
    assert (report.page, report.advice, report.notes) == ("1 2 3\n", "use 2", ("note",))
    assert [omission.what for omission in report.omissions] == ["a", "b", "c"]
    report.write(tmp_path)
    assert {".json", ".md", "-a.csv", "-a.png", "-c.csv", "-machine.csv"} < names(tmp_path)
    whole = json.loads((tmp_path / "precision.json").read_bytes())
    assert_fits(whole, "study")
    assert (whole["advice"], whole["title"]) == ("use 2", "Counted: built-in-sample.keyxm")
    assert [part["name"] for part in whole["parts"]] == ["a", "b", "c"]
    about = Tables.read(tmp_path, "precision")
    assert about.row("machine", what="deck").text("value") == "built-in-sample.keyxm"
    assert about.row("machine", what=RUN_TIME).number("value") >= 0.0


def test_an_interrupted_study_goes_on(tmp_path: Path) -> None:
    counter = Counter()
    counter.interrupts = "b"
    with pytest.raises(KeyboardInterrupt):
        counter.run(tmp_path)
    assert names(tmp_path) == {".json", "-a.csv", "-a.png"}
    assert_fits(json.loads((tmp_path / "precision.json").read_bytes()), "study")
    counter.interrupts = ""
    report = counter.run(tmp_path)
    assert counter.ran == ["a", "b", "c"]
    assert report.page == "1 2 3\n"
    assert [table.brief for table in report.tables] == [False, True, True, False]
    assert (tmp_path / "precision-a.png").read_bytes() == report.pictures[0].png()
    again = counter.run(tmp_path)
    assert counter.ran == ["a", "b", "c"] * 2
    assert again.page == "4 5 6\n"


def test_other_options_and_missing_pictures_are_measured_anew(tmp_path: Path) -> None:
    counter = Counter()
    counter.run(tmp_path, "a")
    counter.run(tmp_path, full=True)
    assert counter.ran == ["a", "a", "b", "c"]
    counter.run(tmp_path, "a")
    (tmp_path / "precision-a.png").unlink()
    counter.run(tmp_path)
    assert counter.ran[4:] == ["a", "a", "b", "c"]


def test_one_part_is_run_and_the_others_are_kept(tmp_path: Path) -> None:
    counter = Counter()
    alone = counter.run(None, "b")
    assert ([table.name for table in alone.tables], alone.page, alone.advice) == (["b", "machine"], "", "use 1")
    counter.run(tmp_path)
    report = counter.run(tmp_path, "b")
    assert counter.ran == ["b", "a", "b", "c", "b"]
    assert (report.page, report.advice) == ("2 5 4\n", "use 5")


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("$MODEL\n*NODE\n 1, 0.0, 0.0, 0.0\n", r"give one with \*ELEMENT"),
        ("$LOAD CASE\n*RESTART\n LAST=nowhere\n*TIME\n STEP=FIXED\n 0.0, 9.0, 0.1, 2.0\n", "nowhere"),
    ],
)
def test_a_deck_without_elements_is_refused(tmp_path: Path, text: str, cause: str) -> None:
    path = tmp_path / "deck.keyxm"
    path.write_text(text, encoding="utf-8")
    counter = Counter()
    with pytest.raises(StudyError, match=f"nothing to study: .*{cause}"):
        counter.study.run(mudline_package.read(path).scene(), StudyOptions())
    assert counter.ran == []


def test_shares_rise_to_the_whole() -> None:
    shares: list[float] = []
    words: list[str] = []
    Counter().study.run(sample_scene(), StudyOptions(progress=words.append, advance=shares.append))
    assert words == ["ax", "ay", "bx", "by", "cx", "cy"]
    assert shares == [0.0, 0.125, 0.25, 0.25, 0.5, 0.75, 0.75, 0.875, 1.0]


def test_the_digest_knows_deck_lines_and_options() -> None:
    texts = (SAMPLE_TEXT, SAMPLE_TEXT.replace("450.0", "451.0"), "C\n" + SAMPLE_TEXT)
    found = {digest("precision", legal_scene(text), StudyOptions()) for text in texts}
    assert len(found) == 3
    assert digest("precision", legal_scene(SAMPLE_TEXT), StudyOptions()) in found
    assert digest("precision", legal_scene(SAMPLE_TEXT), StudyOptions(full=True)) not in found


@pytest.mark.parametrize("text", ["", "[]", '{"key": "k"}', '{"key": "k", "parts": [{}], "pictures": [3]}'])
def test_a_damaged_file_has_no_parts(tmp_path: Path, text: str) -> None:
    (tmp_path / "precision.json").write_text(text, encoding="utf-8")
    assert known_parts(tmp_path, "precision", "k") == {}


def test_command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    counter = Counter()
    monkeypatch.setattr(precision, "STUDY", counter.study)
    monkeypatch.setattr(precision, "run", counter.study.run)
    wrong = mudline("study", "precision", "--only", "a,d")
    assert wrong.code == 2
    assert "precision has no part 'd': its parts are a, b, c" in wrong.err
    counter.interrupts = "c"
    stopped = mudline("study", "precision", "-o", tmp_path, "--only", "b, c")
    assert stopped.code == 130
    assert stopped.err.endswith(f"goes on with what is finished in {tmp_path.as_posix()}\n")
    counter.interrupts = ""
    outcome = mudline("study", "precision", "-o", tmp_path)
    assert outcome.code == 0
    assert outcome.out.startswith("use 1\n")
    assert "mudline: precision: b: finished before, taken from the folder\n" in outcome.err
    assert (tmp_path / "precision.md").read_text(encoding="utf-8") == "2 1 3\n"


def test_a_terminal_shows_a_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.setenv("TERM", "xterm")
    counter = Counter()
    monkeypatch.setattr(precision, "STUDY", counter.study)
    monkeypatch.setattr(precision, "run", counter.study.run)
    outcome = mudline("study", "precision", "--only", "a", terminal=True)
    assert outcome.code == 0
    assert re.search(r"ay .*\x1b\[0m.* 50%", outcome.err)
    assert "mudline: precision:" not in outcome.err
    assert mudline("study", "precision", "--only", "a", "-q", terminal=True).err == ""
