"""Numbers that semicolons separate, as a spreadsheet writes them where commas are decimal: told, and repaired."""

from __future__ import annotations

import pytest

from mudline.checks import registry
from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import lint_one

CLEAN = """\
$MODEL
*OCEAN
 350.0, 1025.0, 9.81
*NODE
 1, -0.02, 0.0
 2, -0.02, 5.0
*ELEMENT
 1, 1, 2
*ELEMENT SETS
 SET=Line
 GEN=1, 1
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.1, 1200.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Line
 STIFFNESS=Clay
 FRICTION=0.45, 0.7
"""
MESSAGE = "the numbers are separated by semicolons: write commas between them"


@pytest.mark.parametrize("decimal", [".", ","])
def test_each_block_is_told_once(decimal: str) -> None:
    deck = CLEAN.replace(",", ";").replace(".", decimal)
    found = lint_bytes(deck.encode(), "deck.keyxm", registry.select())
    told = [one for one in found if one.message.startswith(MESSAGE)]
    assert {one.line for one in told} >= {3, 5, 8, 11, 14, 20}
    assert {one.code for one in told} == {"SYN003"}


def test_the_repair_writes_commas() -> None:
    report = lint_one(
        "deck.keyxm", CLEAN.replace(",", ";").encode(), LintSettings(registry.select(), fixing=Fixing.UNSAFE)
    )
    assert report.changed == CLEAN.encode()


def test_semicolons_in_names_are_names() -> None:
    deck = CLEAN.replace("Clay", "Clay; 2").replace("Line", "1; 2")
    assert MESSAGE not in {one.message for one in lint_bytes(deck.encode(), "deck.keyxm", registry.select())}
