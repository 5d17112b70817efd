"""`mudline validate` on folders of decks in any form, with a bar on a terminal."""

from __future__ import annotations

import csv
import os
import sys
from pathlib import Path
from unittest.mock import patch

import pytest

from mudline.__main__ import main
from mudline.cli import view
from mudline.cli.inputs import Input
from tests.cli.conftest import Place
from tests.cli.runner import Outcome, Stream, assert_fits, run
from tests.helpers.builders.decks import CLEAN, ILLEGAL

TOTAL = "4 of 7 decks have errors: 4 errors, 2 warnings, 1 file unreadable"


@pytest.fixture
def decks(place: Place, folder: Path) -> str:
    """Three decks without errors in three forms, four with, one that is gone; and files that are not decks."""
    place(CLEAN, "decks/a/good.keyxm")
    place(run("convert", "decks/a/good.keyxm", "--to", "json").output, "decks/b.json")
    place(run("convert", "decks/a/good.keyxm", "--to", "yaml").output, "decks/a/c.YML")
    place(ILLEGAL, "decks/bad.keyxm")
    place(bytes(range(128, 256)), "decks/bytes.das")
    place('{"format": "mudline-deck/1", ', "decks/cut.json")
    place("", "decks/empty.keyx")
    place('{"name": "other"}', "decks/package.json")
    place("- 1\n", "decks/list.yaml")
    place("text", "decks/README.md")
    (folder / "decks/gone.keyxm").symlink_to("nowhere")
    os.mkfifo(folder / "decks/pipe.keyxm")
    return "decks"


@pytest.fixture
def _bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """A bar from the first deck on, as in a long run."""
    monkeypatch.setattr(view, "DELAY", 0.0)
    monkeypatch.setattr(view, "_PAUSE", 0.0)
    monkeypatch.delenv("CI", raising=False)


def on_error_only(*arguments: str, code: int = 2) -> Outcome:
    """Run with standard error on a terminal and standard output in a file."""
    out, err = Stream("utf-8", terminal=False), Stream("utf-8", terminal=True)
    with patch.object(sys, "stdout", out), patch.object(sys, "stderr", err):
        assert main([*arguments]) == code
    return Outcome(code, out.content(), err.content())


def verdicts(outcome: Outcome) -> dict[str, str]:
    return {row["file"]: row["verdict"] for row in csv.DictReader(outcome.out.splitlines())}


def test_decks_in_any_form_are_found(decks: str) -> None:
    outcome = run("validate", decks, "--output-format", "csv")
    assert outcome.code == 2
    assert outcome.err == "mudline: decks/gone.keyxm: no such file or directory\n"
    assert verdicts(outcome) == {
        "decks/a/c.YML": "no errors",
        "decks/a/good.keyxm": "no errors",
        "decks/b.json": "no errors",
        "decks/bad.keyxm": "1 error",
        "decks/bytes.das": "1 error",
        "decks/cut.json": "1 error",
        "decks/empty.keyx": "1 error",
    }


def test_total_counts_all(decks: str) -> None:
    outcome = run("validate", decks)
    assert outcome.out.splitlines()[-1] == TOTAL
    found = run("validate", decks, "--output-format", "json").json()
    assert_fits(found, "validate")
    keywords = {"total": 28, "read": 28, "partly": {}, "unread": {}}
    assert found["total"] == {
        "keywords": keywords,
        "decks": 7,
        "ok": 3,
        "errors": 4,
        "warnings": 2,
        "unreadable": 1,
    }


def test_decks_are_told_when_they_are_judged(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    """What was told of the first deck is there when the second one is read, and nothing holds its findings."""
    names = [place(ILLEGAL, "a.keyxm"), place(ILLEGAL, "b.keyxm")]
    there: list[str] = []
    stream = Stream("utf-8", terminal=False)
    read = Input.read

    def watched(file: Input) -> bytes:
        there.append(stream.content().decode())
        return read(file)

    monkeypatch.setattr(Input, "read", watched)
    with patch.object(sys, "stdout", stream):
        main(["validate", *names, "--output-format", "json"])
    assert there[0] == ""
    assert "REF001" in there[1]


# ---------------------------------------------------------------------------------------------------------------- bar


@pytest.mark.usefixtures("_bar")
def test_bar_is_on_standard_error_only(decks: str) -> None:
    outcome = on_error_only("validate", decks)
    assert "8/8" in outcome.err
    assert outcome.out == run("validate", decks).out


@pytest.mark.usefixtures("_bar")
@pytest.mark.parametrize(("name", "value"), [("CI", "true"), ("TERM", "dumb")])
def test_no_bar_where_nobody_looks(decks: str, name: str, value: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(name, value)
    assert on_error_only("validate", decks).err == "mudline: decks/gone.keyxm: no such file or directory\n"


def test_colours_are_those_of_the_verdicts(place: Place) -> None:
    out = run("validate", place(), place(ILLEGAL, "bad.keyxm"), "-q", "--color", "always").out
    assert "\x1b[32mno errors\x1b[0m" in out
    assert "\x1b[1;31m1 error\x1b[0m" in out
