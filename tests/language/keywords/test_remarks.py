"""Remarks behind the data of a line: one finding a line says that there are none."""

from __future__ import annotations

from unittest.mock import patch

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck
from mudline.language.keywords.text import advice_on, remark_of
from tests.helpers.growth import FOURFOLD, TWOFOLD, call_growth, growth

ADVICE = "a line cannot end with a comment; put it on a line of its own, after C and a space"
DECK = """\
$MODEL
*OCEAN
 110.0, 1025.0, 9.81
*NODE
 1, 0.0, 0.0
 2, 0.0, 25.0
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.2191, 0.1905, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=85000.0
"""


def told(text: str) -> list[tuple[str, int, int, str]]:
    return [(one.code, one.line, one.column, one.message) for one in lint_bytes(text.encode(), "a.keyxm", select())]


@pytest.mark.parametrize(
    ("line", "remark", "code"),
    [
        (" 110.0, 1025.0, 9.81", "! depth, density, gravity", "SYN002"),
        (" 110.0, 1025.0, 9.81", "!", ""),
        (" 2, 0.0, 25.0", "# end", "SYN002"),
        (" 2, 0.0, 25.0", "// a, b, c, d, e", "SYN003"),
        (" 1, 1, 2", "; the only one", "SYN002"),
        (" 1, 1, 2", "! a, b, c, d", "SYN002"),
        (" TYPE=ELASTIC", "-- clay", "SYN005"),
        (" 207.0E9, 79.6E9, 0.2191, 0.1905, 7850.0", "! E, G, Do, Di, density", "SYN002"),
    ],
)
def test_a_remark_is_one_finding(line: str, remark: str, code: str) -> None:
    found = told(DECK.replace(f"{line}\n", f"{line}   {remark}\n", 1))
    here = [(one, column, message) for one, number, column, message in found if DECK.split("\n")[number - 1] == line]
    if code:
        assert here == [(code, len(line) + 4, f"{remark!r} is read as data: {ADVICE}")]
    else:
        assert ADVICE not in here[0][2]


def test_names_with_remarks_are_told_so() -> None:
    found = told(DECK.replace(" SET=ALL\n STIFF", " SET=ALL  ! everything\n STIFF"))
    assert ("REF001", 15, 6, f"set 'ALL  ! everything' is not defined: {ADVICE}") in found
    found = told(DECK.replace("85000.0", "Clay ! soft"))
    assert ("REF002", 16, 12, f"curve 'Clay ! soft' is not defined: {ADVICE}") in found


@pytest.mark.parametrize("line", ["! all", "Pipe #2", "a!b", '"a ! b"', "{a ! b}", "=[a ! b]", "Pipe ! 2", "Pipe"])
def test_what_is_no_remark(line: str) -> None:
    assert remark_of(line) == ""
    assert advice_on(line) == ""


@pytest.mark.untraced
def test_very_many_faults_on_a_line_take_no_time() -> None:
    def loaded(data: bytes) -> Deck:
        return load_bytes(data, "a.keyxm")

    def faults(count: int) -> bytes:
        line = " ! ".join(["x, "] * count).replace("x", "1", 1)
        return f"$MODEL\n*ELEMENT SETS\n SET=A\n 1, {line}\n".encode()

    with patch("mudline.language.keywords.text.remark_of", wraps=remark_of) as looked_for:
        loaded(faults(100))
    assert looked_for.call_count == 1
    assert call_growth(loaded, faults(500), faults(1_000)) < TWOFOLD
    assert growth(loaded, faults(2_500), faults(10_000)) < FOURFOLD
    assert len(loaded(faults(5_000)).problems) == 1
