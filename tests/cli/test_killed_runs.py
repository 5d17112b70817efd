"""Runs that are killed while they rewrite many files, and files that change under them."""

from __future__ import annotations

import os
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mudline.cli import DONE, WRONG_USAGE
from mudline.cli.inputs import Input
from tests.cli.runner import run

pytestmark = pytest.mark.skipif(os.name == "nt", reason="there are no such signals")

DECKS = 40
DECK = "$MODEL\n*NODE\n{rows}*ELEMENT_SET\n SET=A\n"
OLD = DECK.format(rows="".join(f"{number},0.0,  {number}.0\n" for number in range(1, 400)))
COMMANDS = {
    "format": ("format", "."),
    "fix": ("lint", "--fix", "--unsafe-fixes", "--exit-zero", "."),
    "set": ("set", "OCEAN.density=1030", "."),
}


def written(folder: Path, text: str) -> None:
    for number in range(DECKS):
        (folder / f"deck{number}.keyxm").write_text(text, encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_after_a_kill_each_file_is_old_or_new(tmp_path: Path, name: str) -> None:
    old = OLD if name != "set" else f"{OLD}*OCEAN\n 100.0, 1025.0, 9.81\n"
    written(tmp_path, old)
    words = [sys.executable, "-m", "mudline", *COMMANDS[name], "--jobs", "1"] if name == "fix" else []
    words = words or [sys.executable, "-m", "mudline", *COMMANDS[name]]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, check=False)
    assert done.returncode in {0, 1}, done.stderr
    (new,) = {path.read_text(encoding="utf-8") for path in tmp_path.glob("*.keyxm")}
    assert new != old
    chance = random.Random(name)  # noqa: S311 - no secret
    for _ in range(4):
        written(tmp_path, old)
        with subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            while process.poll() is None and (tmp_path / "deck0.keyxm").read_text(encoding="utf-8") == old:
                time.sleep(0.001)
            time.sleep(chance.random() * 0.05)
            process.kill()  # a run that has ended by now is looked at all the same
            process.wait()
        texts = {path.read_text(encoding="utf-8") for path in tmp_path.glob("*.keyxm")}
        assert texts <= {old, new}
    assert subprocess.run(words, cwd=tmp_path, capture_output=True, check=False).returncode in {0, 1}
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(f"deck{number}.keyxm" for number in range(DECKS))


@pytest.mark.parametrize("name", COMMANDS)
def test_a_file_that_somebody_else_writes_meanwhile_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(f"{OLD}*OCEAN\n 100.0, 1025.0, 9.81\n", encoding="utf-8")
    read = Input.read
    times = 0

    def changing(file: Input) -> bytes:
        nonlocal times
        times += 1
        data = read(file)
        return data if times == 1 else data + b"C theirs\n"

    monkeypatch.setattr(Input, "read", changing)
    before = deck.read_bytes()
    words = [str(deck) if word == "." else word for word in COMMANDS[name]]
    outcome = run(*words)
    assert outcome.code == WRONG_USAGE
    assert "it has changed during the run" in outcome.err
    assert deck.read_bytes() == before
    monkeypatch.undo()
    assert run(*words).code in {DONE, 1}
    assert deck.read_bytes() != before
