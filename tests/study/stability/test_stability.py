"""The study as a whole: tables, notes, omissions, pictures."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest

from mudline.scene.model import Scene
from mudline.study import SAMPLE_TEXT, sample_scene
from mudline.study.motion import Scheme
from mudline.study.report import StudyOptions, StudyReport
from mudline.study.schemes import SCHEMES
from mudline.study.stability import critical, ladder, landings, run, statics
from mudline.study.stability.critical import Contact, Measured
from mudline.study.stability.judging import Cell, Judgement, Verdict, judge
from mudline.study.stability.ladder import all_cells
from mudline.study.stability.landings import Landing
from mudline.study.stability.statics import CycleCount
from tests.builders.scenes import legal_scene

pytestmark = pytest.mark.usefixtures("_shared")

TABLES = ["contacts", "critical-steps", "landings", "newton-cycles", "release", "ladder", "ladder-cells", "machine"]


@pytest.fixture(scope="module")
def progress() -> list[str]:
    return []


@pytest.fixture(scope="module")
def _shared(landed: list[Landing], cycles: list[CycleCount]) -> Iterator[None]:
    """What does not depend on the deck is not computed again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(landings, "landings", lambda: landed)
        patch.setattr(statics, "cycle_counts", lambda: cycles)
        yield


@pytest.fixture(scope="module")
def report(
    progress: list[str], measured: dict[tuple[str, str], Measured], judged: dict[tuple[str, str], Judgement]
) -> StudyReport:
    """The study of the sample; what the tests of its parts need too is not computed again."""

    def measure(_scene: Scene, contact: Contact, scheme: Scheme) -> Measured:
        return measured[contact.name, scheme.name]

    def verdict(cell: Cell) -> Judgement:
        return judged[cell.family, cell.value]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(critical, "measure", measure)
        patch.setattr(ladder, "judge", verdict)
        return run(sample_scene(), StudyOptions(progress=progress.append))


def test_the_sample_is_studied(report: StudyReport, progress: list[str]) -> None:
    assert [table.name for table in report.tables] == TABLES
    assert [picture.name for picture in report.pictures] == ["critical-steps", "landings", "ladder"]
    assert report.omissions == ()
    assert progress[0] == "steps on curve:Soft Clay on Clay"
    assert progress[-1] == "ladder of extremes"
    assert json.loads(report.json())["study"] == "stability"


def test_the_notes_say_what_follows(report: StudyReport) -> None:
    step, runs, agree, never, cycles = report.notes[:5]
    assert "oscillates at 29.74 rad/s: use a step of 0.0168 s or less in implicit schemes" in step
    assert runs.startswith("22 of 22 runs")
    assert agree.startswith("33 of 33 landings")
    assert never.endswith(f"{SCHEMES['generalised-alpha-0'].title}, backward Euler.")
    assert "goes 1, -5, 15, -5, 15, -5, 15, ... without end" in cycles
    assert cycles.endswith("0.05: 3 iterations.")


def test_rows_are_as_wide_as_their_tables(report: StudyReport) -> None:
    for table in report.tables:
        assert table.rows
        assert {len(row) for row in table.rows} == {len(table.columns)}


def test_pictures_are_drawn(report: StudyReport) -> None:
    for picture in report.pictures:
        assert picture.png().startswith(b"\x89PNG")


def test_a_deck_without_mass_or_suction_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(ladder, "RANDOM_DECKS", 5)
    text = SAMPLE_TEXT.partition("*SEABED CONTACT")[0].replace("7850.0", "0.0")
    progress: list[str] = []
    found = run(legal_scene(text, "deck.keyx", "user"), StudyOptions(full=True, progress=progress.append))
    assert found.notes[0].startswith("No contact of this deck has a frequency")
    assert {one.what for one in found.omissions} >= {"release of suction", "linear on Sand"}
    assert "force/length2" in found.tables[0].columns[2].unit
    assert progress[-1] == "5 random decks"
    assert [picture.name for picture in found.pictures] == ["landings", "ladder"]


def test_only_the_fastest_contacts_are_stepped_by_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(critical, "MOST_CONTACTS", 1)
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(critical, "SCHEMES", {})
    found = run(sample_scene(), StudyOptions())
    assert [(one.what, one.reason[:18]) for one in found.omissions] == [("linear on Sand", "not stepped: slowe")]


def test_a_segment_too_narrow_to_oscillate_in_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(critical, "SCHEMES", {})
    text = SAMPLE_TEXT.replace(" 0.02,  640.0\n", " 0.0100000000001,  640.0\n")
    found = run(legal_scene(text), StudyOptions())
    assert [tuple(one) for one in found.omissions] == [
        ("curve:Soft Clay on Clay", "not stepped: a small oscillation there is below rounding")
    ]


def test_unacceptable_verdicts_are_in_the_notes(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = Judgement("softness", "1E9", Verdict.WRONG, 3, 99.0, 8.0, "the force is off")
    monkeypatch.setattr(ladder, "all_cells", lambda: all_cells()[:3])
    monkeypatch.setattr(ladder, "judge", lambda cell: wrong if cell.value == "1E-2" else judge(cell))
    monkeypatch.setattr(ladder, "suction_cells", list)
    monkeypatch.setattr(critical, "SCHEMES", {})
    found = run(sample_scene(), StudyOptions())
    assert found.notes[-1] == "softness 1E9: WRONG: the force is off"
    assert found.notes[-2].startswith("2 of 3 cells")
    assert {table.name: table for table in found.tables}["ladder"].rows[-1][5] == 1
