"""Decks of other programs are said to be such."""

from __future__ import annotations

from tests.helpers.builders.scenes import faults

DEEPLINES = "*SOIL\n 1 0.3 0.5\n*TRENCH 1 0.0 0.0 0.1\n 2 3.0 4.0\n*LINE\n 1 2 3\n"


def test_a_deck_of_deeplines_is_recognised() -> None:
    (told,) = faults(DEEPLINES)
    assert told.startswith("1:1 SYN007 this seems to be a deck of DeepLines: it has *SOIL and no $SECTION")


def test_spaced_rows_of_two_keywords_are_enough() -> None:
    (told,) = faults("*NODE\n 1 0.0 0.0\n*ELEMENT\n 1 1 2\n")
    assert told.startswith("1:1 SYN007 this seems to be a deck of DeepLines: it has *NODE and no $SECTION")


def test_other_decks_are_not_taken_for_one() -> None:
    assert "DeepLines" not in "".join(faults(f"$MODEL\n{DEEPLINES}"))
    assert "DeepLines" not in "".join(faults(DEEPLINES.replace("0.3 0.5", "0.3, 0.5")))
    assert "DeepLines" not in "".join(faults("*NODE\n 1 2 3\n"))


def test_the_mark_of_a_common_ancestor_is_a_merge_conflict() -> None:
    (told,) = faults("$MODEL\n*OCEAN\n 500, 1025, 9.81\n||||||| base\n 400, 1025, 9.81\n")
    assert told.startswith("4:1 SYN018 a merge conflict is not solved")
