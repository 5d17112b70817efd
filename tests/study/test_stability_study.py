"""The study as a whole: tables, notes, omissions, pictures."""

from __future__ import annotations

import json

import pytest

from mudline.deck.loading import load_bytes
from mudline.scene.model import resolve
from mudline.study.options import StudyOptions
from mudline.study.report import StudyReport
from mudline.study.sample import TEXT
from mudline.study.schemes.catalogue import SCHEMES
from mudline.study.stability import run, whole
from mudline.study.stability.ladder.cells import cells
from mudline.study.stability.ladder.judging import judge
from mudline.study.stability.ladder.verdict import Judgement, Verdict

TABLES = ["contacts", "critical-steps", "landings", "newton-cycles", "release", "ladder", "ladder-cells"]


@pytest.fixture(scope="module")
def told() -> list[str]:
    return []


@pytest.fixture(scope="module")
def report(told: list[str]) -> StudyReport:
    return run(None, StudyOptions(progress=told.append))


def test_the_sample_is_studied_where_there_is_no_deck(report: StudyReport, told: list[str]) -> None:
    assert [table.name for table in report.tables] == TABLES
    assert [picture.name for picture in report.pictures] == ["critical-steps", "landings", "ladder"]
    assert report.omissions == ()
    assert told[0] == "steps on curve:Soft Clay on Clay"
    assert told[-1] == "ladder of extremes"
    assert json.loads(report.json())["study"] == "stability"


def test_the_notes_say_what_follows(report: StudyReport) -> None:
    step, runs, agree, never, cycles = report.notes[:5]
    assert "swings with 29.74 rad/s: give implicit schemes a step of 0.0168 s or less" in step
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


def test_a_deck_without_mass_or_suction_is_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(whole, "cells", lambda: cells()[:3])
    monkeypatch.setattr(whole, "suction_cells", list)
    monkeypatch.setattr(whole, "BY_CHANCE", 5)
    text = TEXT.partition("*SEABED CONTACT")[0].replace("7850.0", "0.0")
    told: list[str] = []
    found = run(
        resolve(load_bytes(text.encode(), "deck.keyx", units="user")), StudyOptions(full=True, progress=told.append)
    )
    assert found.notes[0].startswith("No contact of this deck has a frequency")
    assert {one.what for one in found.omissions} >= {"release of suction", "linear on Sand"}
    assert "force/length2" in found.tables[0].columns[2].unit
    assert told[-1] == "5 decks by chance"
    assert [picture.name for picture in found.pictures] == ["landings", "ladder"]


def test_only_the_fastest_contacts_are_stepped_by_default(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(whole, "MOST_CONTACTS", 1)
    monkeypatch.setattr(whole, "cells", lambda: cells()[:3])
    monkeypatch.setattr(whole, "suction_cells", list)
    monkeypatch.setattr(whole, "SCHEMES", {})
    found = run(None, StudyOptions())
    assert [(one.what, one.reason[:18]) for one in found.omissions] == [("linear on Sand", "not stepped: slowe")]


def test_a_segment_too_narrow_to_swing_in_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(whole, "cells", lambda: cells()[:3])
    monkeypatch.setattr(whole, "suction_cells", list)
    monkeypatch.setattr(whole, "SCHEMES", {})
    text = TEXT.replace(" 0.02,  640.0\n", " 0.0100000000001,  640.0\n")
    found = run(resolve(load_bytes(text.encode(), "deck.keyxm")), StudyOptions())
    assert [tuple(one) for one in found.omissions] == [
        ("curve:Soft Clay on Clay", "not stepped: a small swing there is lost in rounding")
    ]


def test_what_is_not_sound_stands_in_the_notes(monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = Judgement("softness", "1E9", Verdict.WRONG, 3, 99.0, 8.0, "the force is off")
    monkeypatch.setattr(whole, "cells", lambda: cells()[:3])
    monkeypatch.setattr(whole, "judge", lambda cell: wrong if cell.value == "1E-2" else judge(cell))
    monkeypatch.setattr(whole, "suction_cells", list)
    monkeypatch.setattr(whole, "SCHEMES", {})
    found = run(None, StudyOptions())
    assert found.notes[-1] == "softness 1E9: WRONG: the force is off"
    assert found.notes[-2].startswith("2 of 3 cells")
    assert {table.name: table for table in found.tables}["ladder"].rows[-1][5] == 1
