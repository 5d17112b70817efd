"""Numbers as word processors write them: told with the character, and repaired."""

from __future__ import annotations

import pytest

from mudline import from_keyword
from mudline.checks import registry
from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import lint_one
from mudline.language.diagnostics import DeckError, Severity

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
        ("\u201c2.0\u201d", "2.0", "U+201C"),
        ("\u201e\u22120.02\u201c", "-0.02", "U+201E"),
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


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("7.0+2", "if +2 is its exponent, write 7.0E+2 for x"),
        ("-.5-103", "if -103 is its exponent, write -.5E-103 for x"),
        ("7+2", "expected a number or an equation =[...] for x"),
        ("****", "asterisks stand for a number too wide for its column, write x itself"),
    ],
)
def test_a_number_as_other_programs_print_it(written: str, told: str) -> None:
    assert messages(DECK.format("500.0", written, "")) == [f"5:5 {written!r} is not a number: {told}"]


def told_by_every_command(deck: str) -> list[str]:
    """The messages of errors, which are the same where the deck is linted and where it is only read."""
    with pytest.raises(DeckError) as refused:
        from_keyword(deck)
    read = [one.message for one in refused.value.diagnostics]
    settings = LintSettings(registry.select())
    linted = [
        one.message for one in lint_one("deck.keyxm", deck.encode(), settings).found if one.severity is Severity.ERROR
    ]
    assert linted == read
    return read


@pytest.mark.parametrize(
    ("row", "meant"),
    [
        (" 1 -0.02, 0.0", "1, -0.02"),
        (" 1, -0.02 0.0", "-0.02, 0.0"),
        (" 1, -0.02 0.0,", "-0.02, 0.0"),
        (" 1, -0.02 0.0, 4.0", "-0.02, 0.0"),
    ],
)
def test_a_missing_comma_is_one_finding(row: str, meant: str) -> None:
    deck = DECK.format("500.0", "-0.02", "").replace(" 1, -0.02, 0.0", row)
    assert told_by_every_command(deck) == [
        f"a comma is missing between {' and '.join(meant.split(', '))}: write {meant}"
    ]
    report = lint_one("deck.keyxm", deck.encode(), LintSettings(registry.select(), fixing=Fixing.UNSAFE))
    assert (report.changed or b"").decode().splitlines()[4].startswith(" 1, -0.02, 0.0")


def test_blanks_that_are_no_missing_comma() -> None:
    grouped = DECK.format("500.0", "1 000", "")
    assert messages(grouped) == ["5:5 '1 000' is not a number because its digits are grouped: write 1000 for x"]
    too_many = DECK.format("500.0", "-0.02 1.0 2.0 3.0", "")
    assert messages(too_many)[0].startswith("5:5 '-0.02 1.0 2.0 3.0' is not a number")


def test_a_first_value_that_is_missing_has_its_place_behind_the_blanks() -> None:
    assert messages("$MODEL\n*OCEAN\n   , 1025.0, 9.81\n") == [
        "3:4 depth is missing: expected a number or an equation =[...]"
    ]
