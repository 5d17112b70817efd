"""The questions of docs/archive.md, each on decks whose answers are known."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN
from tests.tools.archive.trial import ask, deck, index, write

PAGE = Path(__file__).parents[3] / "docs" / "archive.md"
_QUESTION = re.compile(r"### ([^\n]+)\n(?:(?!###).)*?```sql\n(.*?)```", re.DOTALL)
QUESTIONS = dict(_QUESTION.findall(PAGE.read_text(encoding="utf-8")))
"""The SQL of the page by its headings."""

LEGACY = """\
*EMBEDMENT
 SET=TDZ
 0.0, 0.0
 0.1, 1200.0
 0.5, 3000.0
"""


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("place")
    plain = deck()
    decks = write(
        folder / "decks",
        a=plain,
        b=deck("another title", depth=600.0),
        copy=plain.replace("C a line\n", "C comments and layout only\n").replace(" 1, 1, 2\n", "   1,1,2\n"),
        far=deck(depth=700.0, curve="Gravel", force=90000.0).replace("SET=TDZ\n 1\n", "SET=TDZ\n 1\n SET=Idle\n 2\n"),
        old=plain.partition("*SEABED STIFFNESS")[0] + "*ELASTIC SURFACE\n 20000.0\n" + LEGACY,
        rough=plain.replace("STIFFNESS=50000.0\n", "STIFFNESS=50000.0\n FRICTION=0.3, 0.5\n").replace(
            "STIFFNESS=Clay\n", "STIFFNESS=Clay\n FRICTION=0.3, 0.5\n"
        ),
    )
    (decks / "imperial.keyxi").write_text(deck(curve="Mud", force=7000.0), encoding="utf-8")
    write(decks, unused=CLEAN + " CURVE=Silt\n 0.0, 0.0\n 0.1, 1.0\n")
    index(decks, archive=folder / "archive")
    return folder / "archive"


def rows(archive: Path, name: str) -> list[dict[str, Any]]:
    return ask(archive, QUESTIONS[name])


def test_stiffest_curves(archive: Path) -> None:
    found = rows(archive, "Stiffest curves")[:2]
    assert [(one["file"], one["name"], one["steepest"]) for one in found] == [
        ("decks/imperial.keyxi", "Mud", 70000.0),
        ("decks/far.keyxm", "Gravel", 900000.0),
    ]


def test_same_curve(archive: Path) -> None:
    (found,) = rows(archive, "Same curve")
    assert found == {
        "curves": 5,
        "decks": 5,
        "points": 3,
        "units": "metric",
        "names": "Clay, TDZ",
        "first_file": "decks/a.keyxm",
    }


def test_unused(archive: Path) -> None:
    found = {(one["file"], one["thing"], one["name"]) for one in rows(archive, "Unused")}
    assert found == {("decks/far.keyxm", "set", "Idle"), ("decks/unused.keyxm", "curve", "Silt")}


def test_legacy(archive: Path) -> None:
    (found,) = rows(archive, "Legacy keywords")
    assert found == {"file": "decks/old.keyxm", "blocks": 2, "keywords": "ELASTIC SURFACE, EMBEDMENT", "first_line": 19}


def test_findings_by_rule(archive: Path) -> None:
    found = rows(archive, "Findings by rule")
    linted = run("lint", archive.parent / "decks", "--isolated", "--output-format", "json").json()
    counts = {code: sum(one["code"] == code for one in linted) for code in {one["code"] for one in linted}}
    assert {one["code"]: one["findings"] for one in found} == counts
    assert "REF003" in counts
    assert [one["findings"] for one in found] == sorted(counts.values(), reverse=True)


def test_near_duplicates(archive: Path) -> None:
    found = {
        one["differ_in"]: (one["decks"], one["first_file"], one["second_file"])
        for one in rows(archive, "Near duplicates")
    }
    assert found["*OCEAN"] == (3, "decks/a.keyxm", "decks/b.keyxm")
    assert found["layout and comments"] == (2, "decks/a.keyxm", "decks/copy.keyxm")
    assert found["*SEABED PROPERTIES"] == (3, "decks/a.keyxm", "decks/copy.keyxm")
    assert len(found) == 3


@pytest.mark.parametrize("name", QUESTIONS)
def test_a_question_about_an_empty_archive(name: str, tmp_path: Path) -> None:
    decks = write(tmp_path / "decks", a=deck())
    index(decks, archive=tmp_path / "empty")
    (decks / "a.keyxm").unlink()
    assert index(decks, "--prune", archive=tmp_path / "empty").code == 2  # there is no deck
    assert rows(tmp_path / "empty", name) == []
