"""`mudline diff` of two folders."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.builders.decks import BAD_NUMBER, CLEAN
from tests.cli.conftest import Place
from tests.cli.runner import assert_fits, run

CHANGED = CLEAN.replace("1000.0", "1200.0")
LAYOUT = CLEAN.replace("0.1, 1000.0", "1e-1, 1.0E3")


@pytest.fixture
def folders(place: Place) -> None:
    """A deck of each kind: changed, equal but for layout, removed, added."""
    place(CLEAN, "old/a/changed.keyxm")
    place(CHANGED, "new/a/changed.keyxm")
    place(CLEAN, "old/equal.keyxm")
    place(LAYOUT, "new/equal.keyxm")
    place(CLEAN, "old/gone.keyxm")
    place(CLEAN, "new/here.keyxm")
    place("no deck", "new/readme.txt")


@pytest.mark.usefixtures("folders")
def test_text() -> None:
    ran = run("diff", "old", "new")
    assert (ran.code, ran.err) == (1, "")
    assert ran.out == (
        "--- old/a/changed.keyxm\n+++ new/a/changed.keyxm\ncurves\n  ~ Clay/0.1: 1000.0 -> 1200.0  (line -25 +25)\n"
        "- gone.keyxm: only in the first folder\n"
        "+ here.keyxm: only in the second folder\n"
        "4 decks: 1 changed, 1 added, 1 removed, 1 equal\n"
    )


@pytest.mark.usefixtures("folders")
def test_more_and_less_text() -> None:
    assert "= equal.keyxm: no difference\n" in run("diff", "-v", "old", "new").out
    quiet = run("diff", "-q", "old", "new").out
    assert "+++ new/a/changed.keyxm" in quiet
    assert "decks" not in quiet


@pytest.mark.usefixtures("folders")
@pytest.mark.parametrize("spelt", ["old", "old/", "./old"])
def test_the_path_of_a_folder_may_be_spelt_in_any_way(spelt: str) -> None:
    ran = run("diff", spelt, "old")
    assert (ran.code, ran.out) == (0, "3 decks: 3 equal\n")


@pytest.mark.usefixtures("folders")
def test_the_working_folder_is_one_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir("new")
    assert run("diff", "../old", ".").out.endswith("4 decks: 1 changed, 1 added, 1 removed, 1 equal\n")


@pytest.mark.usefixtures("folders")
def test_json() -> None:
    ran = run("diff", "old", "new", "--output-format", "json")
    found = ran.json()
    assert_fits(found, "diff")
    assert (ran.code, found["equivalent"]) == (1, False)
    assert found["summary"] == {"changed": 1, "added": 1, "removed": 1, "equal": 1, "failed": 0}
    assert [(one["deck"], one["status"]) for one in found["decks"]] == [
        ("a/changed.keyxm", "changed"),
        ("equal.keyxm", "equal"),
        ("gone.keyxm", "removed"),
        ("here.keyxm", "added"),
    ]
    assert [one["after"] for one in found["decks"][0]["differences"]] == [1200.0]


def test_a_deck_that_cannot_be_read(place: Place) -> None:
    place(CLEAN, "old/deck.keyxm")
    place(BAD_NUMBER, "new/deck.keyxm")
    ran = run("diff", "old", "new")
    assert (ran.code, ran.out) == (1, "! deck.keyxm: cannot be compared\n1 deck: 1 cannot be compared\n")
    assert ran.err.startswith("new/deck.keyxm:6:11: error: SYN002")
    found = run("diff", "old", "new", "--output-format", "json").json()
    assert_fits(found, "diff")
    assert found["decks"][0]["why"].startswith("new/deck.keyxm:6:11: SYN002")


def test_folders_without_a_deck(folder: Path, place: Place) -> None:
    for name in ("one", "two"):
        (folder / name).mkdir()
    assert run("diff", "one", "two").code == 2
    place(CLEAN, "two/deck.keyxm")
    ran = run("diff", "one", "two")
    assert (ran.code, ran.out) == (1, "+ deck.keyxm: only in the second folder\n1 deck: 1 added\n")


@pytest.mark.usefixtures("folders")
def test_a_folder_and_a_deck_are_not_compared() -> None:
    ran = run("diff", "old", "new/here.keyxm")
    assert ran.code == 2
    assert "give two decks or two folders" in ran.err


@pytest.mark.usefixtures("folders")
def test_a_tolerance_holds_for_all_decks() -> None:
    assert "1 added, 1 removed, 2 equal" in run("diff", "old", "new", "--tolerance", "0.5").out


@pytest.mark.usefixtures("folders")
def test_what_a_gitignore_hides(folder: Path) -> None:
    for name in ("old", "new"):
        (folder / name / ".gitignore").write_text("a/\n", encoding="utf-8")
    assert run("diff", "old", "new").out.endswith("3 decks: 1 added, 1 removed, 1 equal\n")
    assert "1 changed" in run("diff", "old", "new", "--no-gitignore").out


@pytest.mark.skipif(os.name != "posix", reason="the null device has another name")
def test_the_null_device_is_an_empty_deck(place: Place) -> None:
    """As git gives it for a file that is new."""
    for words in ((os.devnull, place()), ("deck.keyxm", os.devnull)):
        ran = run("diff", *words)
        assert ran.code == 1
        assert "units" not in ran.out
