"""Forms that only decks of the older program have: read in a .das deck, and errors in one of the manual's."""

from __future__ import annotations

import pytest

from mudline.language.deck.loading import dump
from mudline.model.scene.model import resolve
from tests.helpers.builders.scenes import deck_of

MODEL = (
    "$ANALYSIS\n*UNITS\n UNITS=METRIC\n$MODEL\n*NODE\n 1, 0.0, 0.0\n 2, 5.0, 0.0\n*ELEMENT\n 1, 1, 2\n"
    "*VESSEL\n VESSEL=Rig\n INITIAL POSITION=5.0, 0.0, 0.0\n"
)
FORMS = {
    "offset": ("$LOAD CASE\n*OFFSET\n VESSEL=Rig\n OPTION=DIST\n OFFSET=0.0, 12.0, 3.0\n", "16:2 SYN004"),
    "operators": ("$LOAD CASE\n*RAO\n VESSEL=Rig\n FIRSTRAO=YES\n", "16:2 SYN004"),
    "fluid": ("$LOAD CASE\n*INTERNAL FLUID\n SET=ALL\n 5.0, 1100.0, 2.0E5, 0.0, 0.0, 1\n", "16:2 SYN003"),
    "current": (
        "$LOAD CASE\n*CURRENT\n TYPE=PIECEWISE LINEAR, OPTION=DESCENDING\n 0, 1, 0\n 9, 0, 0\n",
        "15:32 SYN005",
    ),
    "sections": (
        "*GEOMETRIC SETS\n SET=ALL\n 1.0E7, 1.0E7, 5.0E6, 1.0E9, 200.0, 4.0, 0.4, 0.5, 0.5, 0.5, 0.5, 1.0, , 3.0, 4\n",
        "15:2 SYN003",
    ),
}


@pytest.mark.parametrize("lines", [lines for lines, _ in FORMS.values()], ids=FORMS)
def test_a_form_that_such_decks_have_is_no_fault_there(lines: str) -> None:
    deck = deck_of(MODEL + lines, "deck.das")
    assert [*deck.problems, *resolve(deck).problems] == []
    assert dump(deck_of(dump(deck, "keyword"), "deck.das"), "keyword") == dump(deck, "keyword")
    assert dump(deck_of(dump(deck, "json"), "deck.json"), "keyword") == dump(deck, "keyword")


@pytest.mark.parametrize(("lines", "place"), FORMS.values(), ids=FORMS)
@pytest.mark.parametrize("suffix", ["keyx", "keyxm", "KEYXI"])
def test_it_is_an_error_in_a_deck_of_the_manual(lines: str, place: str, suffix: str) -> None:
    deck = deck_of(MODEL + lines, f"deck.{suffix}")
    first, *_ = deck.diagnose(deck.problems)
    assert (f"{first.line}:{first.column} {first.code}", first.severity.value) == (place, "error")
    assert len(deck.problems) == 1
