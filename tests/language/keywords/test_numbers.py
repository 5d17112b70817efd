"""Numbers as word processors write them: told with the character, and repaired."""

from __future__ import annotations

import pytest

from mudline.checks import registry
from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import lint_one

DECK = "$MODEL\n*OCEAN\n {}, 1025.0, 9.81\n*NODE\n 1, {}, 0.0\n 2, -0.02, 5.0\n*ELEMENT\n 1, 1, 2\n{}"
LAW = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS={}\n"


def messages(text: str) -> list[str]:
    return [
        f"{one.line}:{one.column} {one.message}" for one in lint_bytes(text.encode(), "deck.keyxm", registry.select())
    ]


@pytest.mark.parametrize(
    ("written", "plain", "character"),
    [
        ("\u22120.02", "-0.02", "U+2212"),
        ("\u20130.02", "-0.02", "U+2013"),
        ("1.5\u20113", "", ""),
        ("-0.02\xa0", "-0.02", "U+00A0"),
        ("\uff11\uff12.5", "12.5", "U+FF11"),
        ("2.0E\u22125", "2.0E-5", "U+2212"),
        ("10\u2075", "", ""),
        ("\xbd", "", ""),
        ("\u22120.0O2", "", ""),
    ],
)
def test_a_number_of_a_word_processor(written: str, plain: str, character: str) -> None:
    (found,) = messages(DECK.format("500.0", written, ""))
    if plain:
        assert found == f"5:5 {written!r} is not a number, as it has the character {character}: write {plain} for x"
    else:
        assert found.startswith(f"5:5 {written!r} is not a number: expected a number")


def test_its_repair_leaves_a_legal_deck() -> None:
    deck = DECK.format("500.0\xa0", "\u22120.02", LAW.format("\uff12.0E5"))
    assert len(messages(deck)) == 3
    report = lint_one("deck.keyxm", deck.encode(), LintSettings(registry.select(), fixing=Fixing.UNSAFE))
    assert report.changed == DECK.format("500.0", "-0.02", LAW.format("2.0E5")).encode()
    assert report.found == ()
