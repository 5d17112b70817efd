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
