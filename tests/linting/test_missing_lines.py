"""A `*KEYWORD` line that is missing is told where it was to stand, and nothing that follows from it."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.diagnostics import Severity
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select

SAMPLES = Path(__file__).parents[2] / "samples"
DECKS = ("full-cycle.keyxm", "imperial-riser.keyxi", "legacy-flowline.keyxm", "scr-touchdown.keyxm", "scr-vessel.keyxm")
UNSEEN = {
    "LOAD": "behind TYPE=CONSTANT of *BOUNDARY its rows are as good",
    "NODE SPRING": "its row is kept by *DRAG CHAIN, and rows alone tell no keyword",
    "NON LINEAR STATIC": "three numbers",
    "OCEAN": "also that a current needs it",
    "STANDARD OUTPUT": "its lines are passed through in any case",
}
"""Keywords whose missing line is not told, or not alone, and why."""


@pytest.mark.parametrize("name", DECKS)
def test_a_missing_keyword_line_is_one_finding_at_its_place(name: str) -> None:
    lines = (SAMPLES / name).read_text(encoding="utf-8").split("\n")
    heads = [at for at, line in enumerate(lines) if line.startswith("*") and line[1:] not in UNSEEN]
    assert len(heads) >= 8
    for at in heads:
        data = "\n".join([*lines[:at], *lines[at + 1 :]]).encode()
        found = lint_bytes(data, name, select(), folder=SAMPLES)
        told = [each.line - at for each in found if each.severity is not Severity.INFO]
        assert len(told) == 1, (lines[at], told)
        assert 0 <= told[0] <= 3, (lines[at], told)  # behind comments
