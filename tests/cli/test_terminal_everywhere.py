"""Nothing that a deck says acts on a terminal, whichever command shows it, on standard output or standard error."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import Outcome, run
from tests.tools.archive.trial import deck

HOSTILE = "\x1b[31m\x9b31m\x07\x08\x7f\u202e\u2066\u2028"
"""Escape and control sequences, a bell, a backspace, overrides of the direction of a text, a line separator."""
NAME = f"Cl{HOSTILE}ay"
SET = f"T{HOSTILE}DZ"

SOUND = deck(f"a {HOSTILE} line", curve=NAME).replace("TDZ", SET)
"""A deck that is evaluated, with such names, labels and comments."""
LEGACY = SOUND.partition("*SEABED STIFFNESS")[0] + f"*EMBEDMENT\n SET={SET}\n 0.0, 0.0\n 0.1, 1.0\n"
UNSOUND = SOUND + f"*FOO{HOSTILE}BAR\n$X{HOSTILE}Y\n*ELEMENT SETS\n SET=B{HOSTILE}\n a{HOSTILE}b\n SET={SET}\n 77\n"
UNKNOWN = SOUND.replace(f"STIFFNESS={NAME}", f"STIFFNESS=W{HOSTILE}rong")
PARAMETER = SOUND.replace("$MODEL", f"*PARAMETER\n depth, 500.0, T{HOSTILE}\n$MODEL").replace(" 500.0,", " =[depth],")
VARIED = SOUND + f"$VARIATIONS\n*VARIATION\n NAME=V{HOSTILE}, PARAMETER=p{HOSTILE}\n 1.0, 2.0\n"
DECKS = {"sound": SOUND, "legacy": LEGACY, "unsound": UNSOUND, "unknown": UNKNOWN, "param": PARAMETER, "varied": VARIED}

COMMANDS = [
    "lint DECK",
    "lint DECK -v",
    "lint DECK --output-format concise",
    "lint DECK --fix",
    "lint DECK --fix --unsafe-fixes --diff",
    "lint DECK --statistics",
    "validate DECK",
    "validate DECK -v",
    "validate DECK clean.keyxm",
    "format DECK --diff",
    "format DECK --check",
    "format DECK",
    "convert DECK --to json",
    "convert DECK --to keyword",
    "convert DECK -o out.yaml",
    "set 'OCEAN.depth=3' DECK --diff",
    "set 'SEABED PROPERTIES[set=Nothing].stiffness=3' DECK",
    "expand DECK -o out",
    "diff DECK clean.keyxm",
    "diff clean.keyxm DECK",
    "diff DECK DECK",
    "migrate DECK --diff",
    "migrate DECK",
    "show DECK",
    "show DECK -v",
    "curves DECK",
    "curves DECK -v",
    "curves DECK --at 0.05",
    "evaluate DECK",
    "evaluate DECK -v",
    "evaluate DECK --plan",
    "evaluate DECK -o out.csv",
    "batch DECK clean.keyxm -o out --jobs 1",
    "batch DECK -o out --jobs 1 -v",
    "report DECK -o out.html",
    "index DECK -o out --jobs 1 -v",
    "study DECK --only pruning",
    "config DECK",
]
SLOW = ("batch", "report", "study")
"""Commands that take seconds, or draw a bar on a terminal, which is made of control characters."""


@pytest.fixture(autouse=True)
def no_color(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without colours of our own, on a terminal that draws no bar."""
    assert folder.is_dir()
    monkeypatch.setenv("NO_COLOR", "1")


def assert_harmless(outcome: Outcome) -> None:
    for text in (outcome.out, outcome.err):
        assert [char for char in text if not (char.isprintable() or char in "\n\t")] == []
    assert "Traceback" not in outcome.err


@pytest.mark.covered
@pytest.mark.slow
@pytest.mark.parametrize("line", COMMANDS)
def test_no_command_lets_a_deck_act_on_the_terminal(place: Place, line: str) -> None:
    name, *_ = words = shlex.split(line)
    if name == "index":
        pytest.importorskip("duckdb")
    place(deck(), "clean.keyxm")
    for deck_name in ("sound", "unsound") if name in SLOW else DECKS:
        path = place(DECKS[deck_name], f"{deck_name}.keyxm")
        outcome = run(*(path if word == "DECK" else word for word in words), terminal=name not in SLOW)
        assert "Usage:" not in outcome.err, outcome.err
        assert_harmless(outcome)


@pytest.mark.parametrize("name", DECKS)
def test_a_file_name_does_not_act_on_the_terminal_either(place: Place, folder: Path, name: str) -> None:
    path = place(DECKS[name], f"d\x1b[31m\u202e{name}.keyxm")
    for line in ("lint", "validate", "show", "curves", "evaluate", "format", "migrate", "diff clean.keyxm", "nothing"):
        place(deck(), "clean.keyxm")
        assert_harmless(run(*line.split(), path, terminal=True))
    (folder / "gone").mkdir()
    assert_harmless(run("lint", f"gone/{HOSTILE}", f"--{HOSTILE}", terminal=True))
