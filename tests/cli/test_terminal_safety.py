"""Nothing that a deck holds acts on a terminal, whatever command prints it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.runner import Outcome, run
from tests.helpers.builders.decks import UNUSED

HOSTILE = {
    "escape": "\x1b[31m\x1b]0;gone\x07\x1b[2J",
    "c1": "\x9b31m",
    "controls": "\x08\x7f\x00",
    "bidi": "\u202e\u2066\u200f",
}
HELD = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n 1, 2\n 1, 3\n 3, 1\n 3, 2\n 3, 3\n"
PRINTING = {
    "lint": "lint {deck}",
    "lint diff": "lint {deck} --fix --diff --unsafe-fixes",
    "lint statistics": "lint {deck} --statistics",
    "validate": "validate {deck}",
    "format diff": "format {deck} --diff",
    "convert": "convert {deck} --to yaml",
    "set": "set OCEAN.depth=2 {deck} --diff",
    "expand": "expand {deck} -o {folder}/out",
    "diff": "diff {deck} {other}",
    "migrate": "migrate {deck} --diff",
    "show": "show {deck}",
    "curves": "curves {deck} -v",
    "evaluate": "evaluate {deck} -v",
    "batch": "batch {deck} {other} -o {folder}/out",
    "index": "index {deck} -o {folder}/archive",
    "study": "study {deck} --only stability",
    "report": "report {deck} -o {folder}/report.html",
    "export": "export {deck} --to orcaflex -o {folder}/x.yml",
    "config": "config {deck}",
}


@pytest.mark.covered
@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
@pytest.mark.parametrize("command", PRINTING)
def test_what_is_printed_of_a_deck_is_harmless(
    tmp_path: Path, command: str, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TERM", "dumb")  # no bar of progress, which moves the cursor
    whole = (UNUSED + HELD).replace("Sand", f"S{text}and").replace("Clay", f"Cl{text}ay").replace("Pipe", f"P{text}ipe")
    outcomes: list[Outcome] = []
    for broken in (False, True):
        folder = tmp_path / ("broken" if broken else "whole")
        folder.mkdir()
        deck, other = folder / "deck.keyxm", folder / "other.keyxm"
        deck.write_text(f"C {text}\n{whole}" + f"*FOO{text}BAR\n$X{text}Y\n" * broken, encoding="utf-8")
        other.write_text(whole.replace("1000.0", "2000.0").replace("Sand", "Silt") + f"C {text}\n", encoding="utf-8")
        given = {"deck": deck, "other": other, "folder": folder}
        words = [word.format(**given) for word in PRINTING[command].split(" ")]
        outcomes.append(run(*words, "--color", "never", terminal=True))
    for outcome in outcomes:
        assert outcome.code in {0, 1, 2}
        shown = outcome.out + outcome.err
        assert not [char for char in shown if not char.isprintable() and char != "\n"], repr(shown)
