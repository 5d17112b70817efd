"""Runs that are killed while they write, others at the same time, and files that change under them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from mudline.cli import DONE, WRONG_USAGE
from mudline.cli.inputs import Input
from tests.cli.kills import DECK
from tests.cli.runner import ROOT, run
from tests.helpers.processes import TIMEOUT

pytestmark = pytest.mark.skipif(os.name == "nt", reason="there are no such signals")

OLD = DECK.format(depth=100.0, filling="").replace("*OCEAN", "*ELEMENT_SET\n SET=A\n*OCEAN")
COMMANDS = {
    "format": ("format",),
    "fix": ("lint", "--fix", "--unsafe-fixes", "--exit-zero"),
    "set": ("set", "OCEAN.density=1030"),
    "migrate": ("migrate",),
}


@pytest.mark.slow
@pytest.mark.parametrize("tool", ["kills --decks 2", "together --decks 8"])
def test_killed_runs_and_runs_at_the_same_time_harm_nothing(tool: str) -> None:
    words = [sys.executable, "-m", *f"tests.cli.{tool}".split()]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=TIMEOUT, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_a_file_that_somebody_else_writes_meanwhile_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(OLD, encoding="utf-8")
    read = Input.read
    times = 0

    def changing(file: Input) -> bytes:
        nonlocal times
        times += 1
        data = read(file)
        return data if times == 1 else data + b"C theirs\n"

    monkeypatch.setattr(Input, "read", changing)
    before = deck.read_bytes()
    outcome = run(*COMMANDS[name], str(deck))
    assert outcome.code == WRONG_USAGE
    assert "it has changed during the run" in outcome.err
    assert deck.read_bytes() == before
    monkeypatch.undo()
    assert run(*COMMANDS[name], str(deck)).code in {DONE, 1}
    assert deck.read_bytes() != before


def test_a_file_that_has_the_new_content_already_is_done(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(OLD, encoding="utf-8")
    run("format", str(deck))
    new = deck.read_bytes()
    contents = iter([OLD.encode(), new])
    monkeypatch.setattr(Input, "read", lambda _: next(contents))
    outcome = run("format", str(deck))
    assert (outcome.code, outcome.err) == (DONE, "1 file reformatted\n")
    assert deck.read_bytes() == new
