"""Decks with the largest and the smallest numbers are right to the last roundings, or refused with a line."""

from __future__ import annotations

import pytest

from tests.contact.exact import BOUND
from tests.contact.extreme_decks import FAMILIES, Verdict, judge


@pytest.mark.parametrize("family", FAMILIES)
def test_every_deck_is_right_within_its_bound_or_refused_with_a_line(family: str) -> None:
    values, deck = FAMILIES[family]
    found = [judge(family, value, deck(value)) for value in values]
    assert not [one for one in found if one.verdict is Verdict.WRONG]
    assert any(one.verdict is Verdict.RIGHT for one in found)
    assert 0.0 < max(one.error for one in found) <= BOUND


@pytest.mark.parametrize(
    ("family", "value", "message"),
    [
        ("linear stiffness", "1E309", "line 14: SYN002"),
        ("curve: forces", "1E309", "line 18: SYN002"),
        ("mobilisation length", "5E-324", "line 3: RUN001"),
    ],
)
def test_refusals_name_the_line_of_the_number(family: str, value: str, message: str) -> None:
    assert judge(family, value, FAMILIES[family][1](value)).message.startswith(message)
