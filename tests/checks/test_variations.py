"""Decks of variations that cannot be expanded: told by the linter, once a place, and never of a deck that can be."""

from __future__ import annotations

from tests.checks.findings import found, messages

DECK = """$PREPROCESSOR
*PARAMETERS
 Offset, 0.0
 Period, 8.0
*VARIATION
 NAME=Sea
 PARA=Offset, VALUE=-10.0, 0.0, 10.0
 PARA=Period, VALUE=8.0, 10.0, 12.0
*COMBINATIONS
 DIRECTORY=Runs
 DESCRIPTION=All, FILENAME=T%Period%
"""


def test_a_deck_that_can_be_expanded() -> None:
    assert found(DECK, "REF023") == []
    assert found(DECK.partition("*COMBINATIONS")[0].replace(", 12.0", ""), "REF023") == []


def test_parameters_of_a_variation_with_different_numbers_of_values() -> None:
    assert found(DECK.replace(", 12.0", ""), "REF023") == [("REF023", 6, 2)]
    assert "PARA=Offset has 3, PARA=Period has 2" in messages(DECK.replace(", 12.0", ""), "REF023")[0]


def test_decks_of_one_name_are_told_once() -> None:
    assert found(DECK.replace("T%Period%", "T"), "REF023") == [("REF023", 11, 2)]


def test_a_misspelt_name_is_told_by_its_own_rule_alone() -> None:
    assert found(DECK.replace("PARA=Period", "PARA=Priod"), "REF023") == []
