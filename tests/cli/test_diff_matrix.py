"""`mudline diff --matrix`: what differs in a family of decks."""

from __future__ import annotations

import csv
from io import StringIO
from typing import Any

import pytest

from tests.cli.conftest import Place
from tests.cli.runner import run
from tests.helpers.builders.decks import CLEAN

WAVY = CLEAN + "$LOAD CASE\n*WAVE-REGULAR\n 4.0, 9.0, 0.0\n*TIME\n STEP=FIXED\n 0.0, 10.0, 0.1\n"


@pytest.fixture
def family(place: Place) -> list[str]:
    """Three load cases: another amplitude, another amplitude and step, and no times."""
    high, both = WAVY.replace("4.0, 9.0", "6.0, 9.0"), WAVY.replace("4.0, 9.0", "8.0, 9.0").replace("0.1\n", "0.05\n")
    texts = {"base": WAVY, "high": high, "both": both, "still": WAVY.partition("*TIME")[0]}
    return [place(text, f"{name}.keyxm") for name, text in texts.items()]


def matrix(*decks: str) -> dict[str, list[Any]]:
    ran = run("diff", *decks, "--matrix", "--output-format", "json")
    found = ran.json()
    assert (ran.code, found["format"], found["decks"]) == (int(bool(found["rows"])), "mudline-diff-matrix/1", [*decks])
    return {row["where"].removeprefix(row["group"]): row["values"] for row in found["rows"]}


def test_a_row_a_value_and_a_column_a_deck(family: list[str]) -> None:
    found = matrix(*family)
    assert found == {
        "/waves/1/wave/amplitude": [4.0, 6.0, 8.0, 4.0],
        "/fixed/increment": [0.1, 0.1, 0.05, None],
        "/step": ["FIXED", "FIXED", "FIXED", None],
        "/fixed/start": [0.0, 0.0, 0.0, None],
        "/fixed/end": [10.0, 10.0, 10.0, None],
    }


def test_text_marks_what_a_deck_does_not_give(family: list[str]) -> None:
    ran = run("diff", *family, "--matrix")
    assert ran.code == 1
    head, _, *lines = ran.out.splitlines()
    assert head.split() == ["value", *family]
    assert any(line.endswith(" -") and "0.05" in line for line in lines)
    assert lines[-1] == "5 values differ"


def test_csv(family: list[str]) -> None:
    head, *rows = csv.reader(StringIO(run("diff", *family[:3], "--matrix", "--output-format", "csv").out))
    assert head == ["group", "value", *family[:3]]
    assert sorted(row[2:] for row in rows) == [["0.1", "0.1", "0.05"], ["4.0", "6.0", "8.0"]]


def test_elements_that_differ_in_other_runs_have_rows_of_their_own(place: Place) -> None:
    """The heavy set is element 1 in the base, both elements in the second deck, and element 2 in the third."""
    parts = "*ELEMENT SETS\n SET=Pipe\n 1, 2\n SET=Heavy\n {}\n"
    heavy = " SET=Pipe\n 207.0E9, 79.6E9, 0.5, 0.46, 7850.0\n SET=Heavy\n 207.0E9, 79.6E9, 0.5, 0.40, 7850.0\n"
    text = CLEAN.replace(" SET=Pipe\n 207.0E9, 79.6E9, 0.5, 0.46, 7850.0\n", heavy)
    sets = CLEAN[CLEAN.index("*ELEMENT SETS") : CLEAN.index("*GEOMETRIC")]
    decks = [
        place(text.replace(sets, parts.format(one)), f"deck{at}.keyxm") for at, one in enumerate(("1", "1, 2", "2"))
    ]
    found = {name: values for name, values in matrix(*decks).items() if name.endswith("/Di")}
    assert found == {
        "elements 2/sections/rigid/Di": [0.46, 0.4, 0.4],
        "elements 1/sections/rigid/Di": [0.4, 0.4, 0.46],
    }


@pytest.mark.parametrize(
    "given", [["--output-format", "csv"], ["deck.keyxm"], ["--matrix", "--output-format", "markdown"]]
)
def test_wrong_usage(place: Place, given: list[str]) -> None:
    assert run("diff", place(), place(), *given).code == 2
