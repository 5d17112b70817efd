"""The ladder on the laws of a user's deck: what is taken from it, how it is scaled, and its part of the page."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import mudline
from mudline.study import SAMPLE_TEXT, sample_scene, scene_of
from mudline.study.pages import Tables
from mudline.study.report import StudyOptions
from mudline.study.stability import ladder, own_laws
from mudline.study.stability.families import RANDOM, all_cells, judge
from mudline.study.stability.judging import Judgement, Verdict
from mudline.study.stability.ladder import ladder_part
from mudline.study.stability.own_laws import is_own, own_cells, times
from mudline.study.stability.paths import PathCell
from mudline.study.stability.pull_out import SuctionCell, suction_cells

SAMPLES = Path(__file__).parents[3] / "samples"


def test_numbers_keep_their_digits() -> None:
    assert times("1234.5678", 300) == "1.2345678E+303"
    assert float(times("5e-324", 300)) == 5e-24
    assert times("", 5) == ""


@pytest.mark.parametrize("name", ["slope-friction", "full-cycle", "built-in"])
def test_the_laws_of_samples_are_right_at_the_extremes(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr(own_laws, "POWERS", (-300, 300))
    monkeypatch.setattr(own_laws, "MOST_CONTACTS", 2 if name == "built-in" else 1)
    scene = sample_scene() if name == "built-in" else mudline.read(SAMPLES / f"{name}.keyxm").scene()
    cells, omissions = own_cells(scene)
    assert {is_own(cell.family) for cell in cells} == {True}
    assert [one for one in map(judge, cells) if one.verdict not in {Verdict.RIGHT, Verdict.RIGHT_UNTIL_REFUSED}] == []
    left_out = {one.what for one in omissions}
    assert left_out == ({"ladder on trenches", "ladder on 2 more contacts"} if name == "slope-friction" else set())


def test_what_a_deck_has_is_in_its_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_laws, "POWERS", (0,))
    cells, _ = own_cells(mudline.read(SAMPLES / "slope-friction.keyxm").scene())
    deck = next(cell.deck for cell in cells if isinstance(cell, PathCell))
    assert (deck.slope, deck.direction, deck.point) == ("-3.0", "0.0", ("0.0", "60.0", "0.0"))
    assert deck.coefficients == ("0.35", "0.65")
    assert [float(spring) for spring in deck.springs] == [50000.0, 20000.0]
    assert deck.criterion == "BOX"
    assert deck.smoothing
    cells, _ = own_cells(mudline.read(SAMPLES / "full-cycle.keyxm").scene())
    assert [cell.force for cell in cells if isinstance(cell, SuctionCell)]
    deck = next(cell.deck for cell in cells if isinstance(cell, PathCell))
    assert (float(deck.unloading), len(deck.curve), deck.mobilisation) == (250000.0, 10, None)


def test_nodal_springs_are_scaled_and_a_rigid_seabed_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(own_laws, "POWERS", (100,))
    text = SAMPLE_TEXT.replace(" SMOOTHING=AUTO\n", " NODAL STIFFNESS=4.0E4\n SMOOTHING=0.01\n")
    cells, _ = own_cells(scene_of(text, "deck.keyxm"))
    deck = next(cell.deck for cell in cells if isinstance(cell, PathCell) and cell.family == "nodal on Sand: forces")
    assert (deck.nodal, deck.smoothing) == ("4.00000E+104", "0.01")
    rigid = SAMPLE_TEXT.partition("*SEABED PROPERTIES")[0] + "*SEABED PROPERTIES\n TYPE=RIGID\n SET=ALL\n"
    cells, omissions = own_cells(scene_of(rigid, "deck.keyxm"))
    assert (cells, [one.what for one in omissions]) == ([], ["ladder on the deck's own laws"])


# ------------------------------------------------------------------------------------------------------------ the page


@pytest.fixture
def tables(monkeypatch: pytest.MonkeyPatch) -> Tables:
    """The tables of a ladder of a few rungs."""
    monkeypatch.setattr(own_laws, "POWERS", (0,))
    monkeypatch.setattr(own_laws, "MOST_CONTACTS", 1)
    monkeypatch.setattr(ladder, "RANDOM_DECKS", 4)
    some = [one for one in all_cells() if one.value in {"1E0", "1E309"}]
    monkeypatch.setattr(ladder, "all_cells", lambda: some)
    monkeypatch.setattr(ladder, "suction_cells", lambda: suction_cells()[-3:])
    section = ladder.study_ladder(scene_of(SAMPLE_TEXT, "deck.keyxm"), StudyOptions(full=True))
    return Tables({table.name: "".join(table.csv()) for table in section.tables})


def test_every_number_of_the_page_is_one_of_its_tables(tables: Tables) -> None:
    text = ladder_part(tables)
    rows = tables.rows("ladder")
    fixed = [row for row in rows if not is_own(row.text("family")) and row.text("family") != RANDOM]
    assert f"{sum(int(row.text('cells')) for row in fixed)} decks in {len(fixed)} families" in text
    assert "nothing in between was found" in text
    assert "by `RUN001` and `SYN002`." in text
    assert "| curve:Soft Clay on Clay: forces | 1 | 1 | 0 | 0 | 0 |" in text
    assert "Of 4 random decks that combine all of these" in text


def test_the_page_names_what_is_wrong() -> None:
    rows = [Judgement("softness", "1E9", Verdict.WRONG, 3, 99.0, 8.0, "the force is off")]
    made = {one.name: "".join(one.csv()) for one in (ladder.BY_FAMILY.table([rows]), ladder.BY_CELL.table(rows))}
    text = ladder_part(Tables(made))
    assert "**1 decks are neither right nor refused with a line: softness 1E9.**" in text
    assert "The deck has no law that can be scaled." in text
    assert "`--full` adds 4000 random decks" in text


def test_the_published_page_is_made_of_its_tables() -> None:
    docs = SAMPLES.parent / "docs" / "studies"
    assert ladder_part(Tables.read(docs, "stability")).rstrip() in (docs / "stability.md").read_text(encoding="utf-8")


def test_the_prose_has_no_numbers() -> None:
    text = Path(ladder.__file__).with_name("ladder.md").read_text(encoding="utf-8")
    for left in (r"`[^`]*`", r"\{\w+\}", r"\]\([^)]*\)", r"\b[\w-]*[A-Za-z][\w-]*"):
        text = re.sub(left, "", text)
    assert [line for line in text.splitlines() if re.search(r"\d", line)] == []
