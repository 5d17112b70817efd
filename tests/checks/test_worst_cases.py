"""Decks that are made to take long: the work of each grows as the deck does, or is refused with its limit."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import rules
from mudline.language.syntax import source
from tests.helpers.growth import TWOFOLD, call_growth

NAME = "deck.keyxm"
NODES = "$MODEL\n*NODE\n 1, 0.0, 0.0\n"


def linted(text: str) -> list[str]:
    return [found.code for found in lint_bytes(text.encode(), NAME, rules())]


def lines(start: str, line: str) -> Callable[[int], str]:
    return lambda count: start + "".join(line.replace("#", str(at)) for at in range(count))


MANY = {
    "unknown keywords": lines("$MODEL\n", "*FOO\n 1, 2\n"),
    "unknown sections": lines("", "$FOO#\n"),
    "curves": lines("$MODEL\n*SEABED STIFFNESS\n", " CURVE=c#\n 0.0, 0.0\n 0.1, 5.0\n"),
    "faults": lines("$MODEL\n*NODE\n", " x#, 1.0, 2.0\n"),
    "lines of words": lines("$MODEL\n*NODE\n", "words#\n"),
    "strings that do not end": lines("$MODEL\n*NODE\n", '"\n'),
    "comments for the linter": lines("$MODEL\n", "C mudline: ignore SYN003\n"),
    "equations": lines("$MODEL\n*NODE\n", " #, =[1 + 1], 0.0\n"),
    "equations without a value": lines("$MODEL\n*NODE\n", " #, =[p#], 0.0\n"),
    "restarts": lines("$LOAD CASE\n", "*RESTART\n LAST=deck#\n"),
    "generated nodes": lines(NODES, " GEN=1, 2000000000\n"),
    "nodes of one number": lines("$MODEL\n*NODE\n", " 1, 0.0, 0.0\n"),
    "sets of one name": lines(f"{NODES}*ELEMENT SETS\n", " SET=a\n 1\n"),
}
"""Lines that are repeated; # is the number of each."""


@pytest.mark.untraced
@pytest.mark.parametrize("kind", MANY)
def test_work_grows_as_the_lines_do(kind: str) -> None:
    assert call_growth(linted, MANY[kind](700), MANY[kind](1_400)) < TWOFOLD


LONG: dict[str, Callable[[int], str]] = {
    "letters": lambda count: "x" * count,
    "blanks": lambda count: " " * count + "x",
    "blanks in words": lambda count: "a " * count + "=",
    "commas": lambda count: "," * count,
    "strings": lambda count: '"' * count,
    "brackets": lambda count: "=[" * count,
    "nested equations": lambda count: f"=[{'(' * count}1{')' * count}]",
    "labels": lambda count: "{" * count + "}",
    "digits": lambda count: "9" * count,
    "signs": lambda count: "1e+" * count,
    "points": lambda count: "1." * count,
    "settings": lambda count: "A=" * count,
    "controls": lambda count: "\x01" * count + "*",
}


@pytest.mark.untraced
@pytest.mark.parametrize(
    "start", [" 1, ", "*", "C mudline: ignore[", "p, "], ids=["row", "head", "comment", "parameter"]
)
@pytest.mark.parametrize("kind", LONG)
def test_work_grows_as_a_line_does(kind: str, start: str) -> None:
    def text(count: int) -> str:
        section = "$PREPROCESSOR\n*PARAMETERS\n" if start == "p, " else "$MODEL\n*NODE\n"
        return f"{section}{start}{LONG[kind](count)}\n"

    assert call_growth(linted, text(10_000), text(20_000)) < TWOFOLD


@pytest.mark.parametrize(
    ("limit", "value", "text"),
    [
        ("LARGEST_DECK", 20, NODES),
        ("MOST_LINES", 2, NODES),
        ("MOST_WORDED", 2, "$MODEL\r*NODE\r 1, 2.0, 3.0\rC a comment\r"),
        ("LONGEST_LINE", 10, f"{NODES} {'1, ' * 10}\n"),
    ],
)
def test_what_would_fill_the_memory_is_refused(
    limit: str, value: int, text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(source, "MOST_WORDED", 2)
    assert not [code for code in linted(f"{NODES} 2, 0.0, 1.0\n") if code == "SYN012"]
    monkeypatch.setattr(source, limit, value)
    (found,) = lint_bytes(text.encode(), NAME, rules())
    assert (found.code, f"more than {value} " in found.message) == ("SYN012", True)


def test_a_long_row_of_strings_has_a_place() -> None:
    assert linted(NODES + " 1, " + '"' * 200_000 + "\n")
