"""`mudline migrate` through the command line."""

from __future__ import annotations

from pathlib import Path
from unittest.mock import patch

import pytest

from mudline.editing.migration.migrating import MigrationDifference, Verification
from mudline.language.deck.loading import load_bytes, load_path
from tests.cli.conftest import Place
from tests.cli.runner import SAMPLES, run
from tests.editing.migration.test_migrating import MIGRATED, SAMPLE
from tests.helpers.builders.decks import CLEAN

PROFILE = CLEAN.partition("*SEABED")[0] + "*RIGID SURFACE\n 0.3\n 0, 0\n 10, 1\n"


def test_in_place(place: Place) -> None:
    outcome = run("migrate", place(SAMPLE))
    assert outcome.code == 0
    assert outcome.out == ""
    assert outcome.err == "mudline: deck.keyxm: 1 *ELASTIC SURFACE, 1 *EMBEDMENT -> deck.keyxm\n"
    assert Path("deck.keyxm").read_text(encoding="utf-8") == MIGRATED


def test_to_another_file_in_another_form(place: Place) -> None:
    name = place(SAMPLE)
    assert run("migrate", name, "-o", "new.json").code == 0
    assert Path(name).read_text(encoding="utf-8") == SAMPLE
    assert load_path(Path("new.json")).sections == load_bytes(MIGRATED.encode(), "deck.keyxm").sections
    assert run("migrate", place(MIGRATED), "-o", "same.keyxm").code == 0
    assert Path("same.keyxm").read_text(encoding="utf-8") == MIGRATED


def test_standard_input() -> None:
    encoded = b"\xef\xbb\xbf" + SAMPLE.replace("old", "b\xf6se").encode()
    assert run("migrate", "-", stdin=encoded).output == b"\xef\xbb\xbf" + MIGRATED.replace("old", "b\xf6se").encode()
    assert run("migrate", "-", stdin=SAMPLE.encode()).out == MIGRATED
    assert run("migrate", "-", stdin=MIGRATED.encode()).out == MIGRATED
    outcome = run("migrate", "-", stdin=PROFILE.encode())
    assert (outcome.code, outcome.out) == (1, "")
    assert "give the deck as a file" in outcome.err
    assert list(Path().iterdir()) == []


def test_standard_output(place: Place) -> None:
    name = place(SAMPLE)
    assert run("migrate", name, "-o", "-").out == MIGRATED
    assert Path(name).read_text(encoding="utf-8") == SAMPLE
    outcome = run("migrate", place(PROFILE), "-o", "-")
    assert (outcome.code, outcome.out, "standard output has no folder: leave -o out" in outcome.err) == (1, "", True)
    assert list(Path().iterdir()) == [Path(name)]


def test_diff_writes_nothing(place: Place) -> None:
    name = place(PROFILE)
    outcome = run("migrate", "--diff", name)
    assert outcome.code == 0
    assert "-*RIGID SURFACE\n" in outcome.out
    assert "+ FILE=deck-profile.txt\n" in outcome.out
    assert "--- /dev/null\n+++ deck-profile.txt\n@@ -0,0 +1,3 @@\n+C Y, elevation" in outcome.out
    assert Path(name).read_text(encoding="utf-8") == PROFILE
    assert [path.name for path in Path().iterdir()] == ["deck.keyxm"]


def test_a_profile_is_written_beside_the_new_deck(place: Place) -> None:
    Path("out").mkdir()
    outcome = run("migrate", place(PROFILE), "-o", "out/new.keyxm")
    assert outcome.err == "mudline: deck.keyxm: 1 *RIGID SURFACE -> out/new.keyxm, out/deck-profile.txt\n"
    assert Path("out/deck-profile.txt").read_text(encoding="utf-8").endswith("0.0, 0.0\n10.0, 1.0\n")
    assert [one["code"] for one in run("lint", "out/new.keyxm", "--output-format", "json").json()] == ["GEO017"]
    place("C other\n0, 0\n", "deck-profile.txt")
    run("migrate", "deck.keyxm")
    assert "FILE=deck-profile-2.txt" in Path("deck.keyxm").read_text(encoding="utf-8")
    assert Path("deck-profile.txt").read_text(encoding="utf-8") == "C other\n0, 0\n"


def test_a_deck_that_would_change_its_meaning_is_left_as_it_is(place: Place) -> None:
    name = place(SAMPLE)
    verdict = Verification(
        12, 4, 100, 8, (MigrationDifference("element 3", "force at depth 0.1: 1.0 before, 2.0 after"),)
    )
    with patch("mudline.editing.migration.migrating.verify", return_value=verdict):
        outcome = run("migrate", "--verify", name)
    assert outcome.code == 1
    assert outcome.err == (
        "mudline: deck.keyxm: element 3: force at depth 0.1: 1.0 before, 2.0 after\n"
        "mudline: deck.keyxm: left unchanged: 1 difference between the old deck and the new one\n"
    )
    assert Path(name).read_text(encoding="utf-8") == SAMPLE


def test_a_refused_deck_does_not_stop_the_others(place: Place) -> None:
    place(SAMPLE, "b.keyxm")
    bad = place(SAMPLE.replace("*EMBEDMENT\n", "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=7\n*EMBEDMENT\n"), "a.keyxm")
    outcome = run("migrate", ".")
    assert outcome.code == 1
    assert f"{bad}:" in outcome.err
    assert "MIG001" in outcome.err
    assert Path("b.keyxm").read_text(encoding="utf-8") == MIGRATED


CHILD = "$MODEL\n*EMBEDMENT\n SET=7\n 0, 0\n 1, 300\n$LOAD CASE\n*RESTART\n LAST={}\n"


@pytest.mark.parametrize("given", [["."], ["base.keyxm"], ["base.keyxm", "sub/child.keyxm"]])
def test_a_deck_that_another_one_continues_with_its_own_seabed_is_kept(given: list[str], place: Place) -> None:
    place(SAMPLE, "base.keyxm")
    child = "sub/child.keyxm" if "sub/child.keyxm" in given else "child.keyxm"
    place(CHILD.format("../base" if "/" in child else "base"), child)
    outcome = run("migrate", *given)
    assert outcome.code == 1
    assert f"{child} continues this deck and has seabed keywords of its own" in outcome.err
    assert Path("base.keyxm").read_text(encoding="utf-8") == SAMPLE


def test_elements_of_a_deck_that_continues_one_keep_its_stiffness(place: Place) -> None:
    bed = "*ELASTIC SURFACE\n 1e4\n*EMBEDMENT\n SET=Pipe\n 0, 0\n 1, 5\n"
    text = CLEAN.partition("*SEABED")[0] + bed
    place(text, "base.keyxm")
    assert run("migrate", "base.keyxm", "-o", "alone.keyxm").code == 0
    assert " STIFFNESS=1e4\n" not in Path("alone.keyxm").read_text(encoding="utf-8")
    place("$MODEL\n*NODE\n 9, 0.3, 30.0\n*ELEMENT\n 9, 3, 9\n$LOAD CASE\n*RESTART\n LAST=base\n", "child.keyxm")
    assert run("migrate", "base.keyxm", "-o", "more.keyxm").code == 0
    assert " SET=ALL\n STIFFNESS=1e4\n SET=Pipe\n" in Path("more.keyxm").read_text(encoding="utf-8")


@pytest.mark.parametrize("sample", sorted(path.name for path in SAMPLES.glob("*.keyx*")))
def test_samples(sample: str, place: Place) -> None:
    """Every sample is migrated with a proof, or has nothing to migrate."""
    text = (SAMPLES / sample).read_bytes()
    outcome = run("migrate", "--verify", place(text, sample))
    assert outcome.code == 0
    if b"*EMBEDMENT" in text or b"SURFACE" in text:
        assert "are bitwise equal" in outcome.err
    else:
        assert Path(sample).read_bytes() == text
