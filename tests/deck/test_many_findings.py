"""A file of another kind has as many faults as lines: only the first of each kind are told."""

from __future__ import annotations

from collections import Counter

import pytest

from mudline.deck.loading import load_bytes
from mudline.limits import MOST_REPORTED


@pytest.mark.untraced
@pytest.mark.parametrize(
    ("code", "text"),
    [
        ("SYN007", "*OCEAN\n"),
        ("SYN008", "*TIME\n"),
        ("SYN009", "*NOBODY KNOWS\n"),
        ("SYN010", "$NOBODY KNOWS\n"),
        ("SYN011", "$MODEL\nstray\n"),
    ],
)
def test_the_first_are_told_and_then_that_there_are_more(code: str, text: str) -> None:
    head = "$MODEL\n" if code in ("SYN008", "SYN009") else ""
    deck = load_bytes((head + text * (MOST_REPORTED + 500)).encode(), "deck.keyxm")
    told = [problem for problem in deck.problems if problem.code.code == code]
    assert len(told) == MOST_REPORTED + 1
    assert told[-1].message.startswith("and more")
    assert Counter(problem.code.code for problem in deck.problems)[code] == len(told)


@pytest.mark.untraced
def test_a_thousand_are_all_told() -> None:
    deck = load_bytes(("$MODEL\n" + "*NOBODY KNOWS\n" * MOST_REPORTED).encode(), "deck.keyxm")
    assert len(deck.problems) == MOST_REPORTED
