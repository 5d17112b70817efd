"""A `*KEYWORD` line that is missing is told where it was to stand, and nothing that follows from it."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.language.diagnostics import Severity

SAMPLES = Path(__file__).parents[2] / "samples"
DECKS = ("full-cycle.keyxm", "imperial-riser.keyxi", "legacy-flowline.keyxm", "scr-touchdown.keyxm", "scr-vessel.keyxm")
UNSEEN = {
    "LOAD": "behind TYPE=CONSTANT of *BOUNDARY its rows are as good",
    "NODE SPRING": "its row is kept by *DRAG CHAIN, and rows alone tell no keyword",
    "NON LINEAR STATIC": "three numbers",
    "OCEAN": "also that a current needs it",
    "STANDARD OUTPUT": "its lines are passed through in any case",
}
"""Keywords whose missing line is not told, or not alone, and why; as is that of the first keyword of a section."""


@pytest.mark.parametrize("name", DECKS)
def test_a_missing_keyword_line_is_one_finding_at_its_place(name: str) -> None:
    lines = (SAMPLES / name).read_text(encoding="utf-8").split("\n")
    marked = [at for at, line in enumerate(lines) if line.startswith(("*", "$"))]
    heads = [at for above, at in pairwise(marked) if lines[above][0] == lines[at][0] == "*"]
    heads = [at for at in heads if lines[at][1:] not in UNSEEN]
    assert len(heads) >= 7
    for at in heads:
        data = "\n".join([*lines[:at], *lines[at + 1 :]]).encode()
        found = lint_bytes(data, name, select(), folder=SAMPLES)
        told = [each.line - at for each in found if each.severity is not Severity.INFO]
        assert len(told) == 1, (lines[at], told)
        assert 0 <= told[0] <= 3, (lines[at], told)  # behind comments


SLIPS = {
    "the first node of a range": ("scr-vessel.keyxm", " GEN=1, 61\n", " GEN=x, 61\n", {"SYN002", "REF006"}),
    "the last element of a range": ("legacy-flowline.keyxm", "GEN=1, 60", "GEN=1, 6x", {"SYN002", "REF005"}),
    "a whole number with a letter behind it": ("slope-friction.keyxm", " 32, -0.109672", " 3x, -0.109672", {"SYN002"}),
    "a bound of a plane": ("slope-friction.keyxm", "-100.0, 60.0", "-100.0, 60.x", {"SYN002"}),
    "a step in time": ("scr-vessel.keyxm", " 0.0, 1200.0, 0.1", " 0.0, 1200.0, O.x", {"SYN002"}),
}


@pytest.mark.parametrize(("name", "right", "wrong", "codes"), SLIPS.values(), ids=SLIPS)
def test_little_follows_from_a_letter_in_a_number(name: str, right: str, wrong: str, codes: set[str]) -> None:
    text = (SAMPLES / name).read_text(encoding="utf-8")
    assert right in text
    found = lint_bytes(text.replace(right, wrong, 1).encode(), name, select(), folder=SAMPLES)
    told = [each for each in found if each.severity is not Severity.INFO]
    assert {each.code for each in told} == codes
    assert len(told) <= 3
    assert not any("UNKNOWN" in each.message or "nan" in each.message.split() for each in told)


VESSEL = "$MODEL\n*VESSEL\n VESSEL=Semi\n 1000.0, 904.6, 0.0, 0.0\n"


@pytest.mark.parametrize("rest", ["", "*OCEAN\n 1000.0, 1025.0, 9.81\n"])
def test_a_row_in_place_of_the_missing_line_is_one_finding(rest: str) -> None:
    found = lint_bytes((VESSEL + rest).encode(), "deck.keyxm", select())
    assert [(each.code, each.line) for each in found] == [("SYN001", 4)]


def test_a_row_that_is_cut_off_in_place_of_the_missing_line_is_also_told_to_be_incomplete() -> None:
    found = lint_bytes(VESSEL.removesuffix("\n").encode(), "deck.keyxm", select())
    assert [(each.code, each.line) for each in found] == [("SYN001", 4), ("SYN014", 4)]


@pytest.mark.parametrize("lines", [" GEN=1, 4S\n", " 1, 2, 3, 4S\n"])
def test_nothing_follows_from_a_set_whose_elements_could_not_be_read(lines: str) -> None:
    deck = (
        "$MODEL\n*NODE\n 1, -0.05, 0.0\n 5, -0.05, 40.0\n GEN=1, 5\n*ELEMENT\n 1, 1, 2\n GEN=1, 4\n"
        f"*ELEMENT SETS\n SET=Flowline\n{lines}"
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=Flowline\n 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"
        "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.5, 5000.0\n 1.0, 9000.0\n"
        "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"
    )
    found = lint_bytes(deck.encode(), "deck.keyxm", select())
    assert [(each.code, each.line) for each in found if each.severity is not Severity.INFO] == [("SYN002", 11)]
