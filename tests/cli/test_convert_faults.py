"""`mudline convert --keep-faults`: blocks that cannot be read are carried as their lines."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import BAD_NUMBER, CLEAN


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_there_and_back(place: Place, folder: Path, form: str) -> None:
    deck = BAD_NUMBER.replace("207.0E9, 79.6E9", "207000000000.0, 79600000000.0")
    there = run("convert", place(deck), "--keep-faults", "-o", f"out.{form}")
    assert (there.code, there.out) == (0, "")
    assert there.err.splitlines() == [
        "mudline: deck.keyxm:4: *NODE is carried as its lines: it has errors",
        f"mudline: deck.keyxm -> out.{form}",
    ]
    assert run("validate", f"out.{form}").code == 1
    assert run("convert", f"out.{form}", "-o", "back.keyxm").code == 1
    assert run("convert", f"out.{form}", "--keep-faults", "-q", "-o", "back.keyxm").err == ""
    assert (folder / "back.keyxm").read_text(encoding="utf-8") == deck


def test_a_value_out_of_range_is_carried(place: Place) -> None:
    deck = CLEAN.replace(" 100.0, 1025.0, 9.81", " -100.0, 1025.0, 9.81")
    assert run("convert", place(deck), "--to", "json").code == 1
    document = run("convert", place(deck), "--to", "json", "--keep-faults").json()
    assert document["sections"][0]["blocks"][0] == {"keyword": "OCEAN", "lines": [" -100.0, 1025.0, 9.81"]}


def test_a_deck_without_faults_is_the_same(place: Place) -> None:
    outcome = run("convert", place(), "--to", "json", "--keep-faults")
    assert (outcome.output, outcome.err) == (run("convert", place(), "--to", "json").output, "")


def test_what_cannot_be_carried(place: Place) -> None:
    assert run("convert", place(), "--to", "json", "--keep-faults", "--anonymous").code == 2
    conflict = CLEAN.replace("*ELEMENT\n", "<<<<<<< ours\n*ELEMENT\n=======\n>>>>>>> theirs\n")
    outcome = run("convert", place(conflict), "--to", "json", "--keep-faults")
    assert (outcome.code, outcome.out) == (1, "")
    assert "merge" in outcome.err
