"""Whether a deck has errors is one question: all commands that answer it agree."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN, ILLEGAL, UNUSED

COMMANDS = (
    ("lint", "--fail-on", "error"),
    ("validate",),
    ("evaluate",),
    ("show",),
    ("report", "-o", "page.html"),
)
LONE_NAMES = CLEAN.replace("*NODE", "*NODE;;").replace("*ELEMENT", "*ELEMENT;;").replace("$MODEL", "$MODEL;;")

OUTPUT = "*DATABASE\n TIME=ALL\n"


@pytest.mark.parametrize(
    ("deck", "code"),
    [
        (CLEAN, 0),
        (UNUSED, 0),
        (ILLEGAL, 1),
        (CLEAN.replace("*SEABED STIFFNESS", "*SEABED STIFFENSS"), 1),  # no curve
        (CLEAN.replace("*GEOMETRIC SETS", "*GEOMETRIC SET"), 1),  # no diameter
        (CLEAN.replace("*NODE", "*NODS"), 1),
        (CLEAN.replace("*SEABED STIFFNESS", "*SEABED STIFFENSS").replace("\n 0.1, ", "\n 0.l, "), 1),  # nor its rows
        (CLEAN.replace(" 1, 1, 2\n", " 1, ALL, 2\n"), 1),  # a label without braces
        (f"{CLEAN}$LOAD CASE\n{2 * OUTPUT}", 1),  # of what contact does not depend on
        (LONE_NAMES, 1),
    ],
    ids=[
        "clean",
        "warning",
        "error",
        "no-curve",
        "no-diameter",
        "no-nodes",
        "no-curve-nor-rows",
        "label",
        "of-output",
        "nothing-read",
    ],
)
def test_all_commands_agree_on_whether_a_deck_has_errors(
    deck: str, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("deck.keyxm").write_text(deck, encoding="utf-8")
    assert {name: run(name, *more, "deck.keyxm").code for name, *more in COMMANDS} == dict.fromkeys(
        (name for name, *_ in COMMANDS), code
    )
    found = run("validate", "deck.keyxm", "--output-format", "json").json()["decks"][0]
    assert len(found["findings"]) == found["errors"] + found["warnings"]


def test_a_deck_that_is_evaluated_in_spite_of_an_error_has_its_results_and_the_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("deck.keyxm").write_text(f"{CLEAN}$LOAD CASE\n{2 * OUTPUT}", encoding="utf-8")
    outcome = run("evaluate", "deck.keyxm", "-q", "-o", "results.csv")
    line = len(CLEAN.splitlines()) + 4
    assert outcome.code == 1
    assert "deck.keyxm has 1 error in spite of which it can be evaluated" in outcome.err
    assert f"deck.keyxm:{line}:1: error: TIM006" in outcome.err
    assert len(Path("results.csv").read_text(encoding="utf-8").splitlines()) > 2
