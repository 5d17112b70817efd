"""A rewriting that would change more than it may is refused, and what a migration and its proof say of themselves."""

from __future__ import annotations

import math

import pytest

from mudline.editing.migration import migrating
from mudline.editing.migration.migrating import Verification, migrate, verify
from mudline.editing.migration.rewriting import MigrationRewriter
from mudline.language.diagnostics import DeckError, Span
from mudline.language.syntax.edits import TextEdit
from mudline.model.curves import ForceCurve
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of

SURFACE = "C stiff\n*ELASTIC SURFACE\n 1e4, 0.3, 0.5\n"
TEXT = f"{PIPE_WITH_SETS}*OCEAN\n 500.0, 1025.0, 9.81\n{SURFACE}$LOAD CASE\n*ANALYSIS TYPE\n TYPE=STATIC\n"


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        ("1025.0", "1000.0", "*OCEAN/density would change"),
        ("TYPE=STATIC", "TYPE=DYNAMIC", "$LOAD CASE *ANALYSIS TYPE/type would change"),
        ("C stiff", "", "the comment ' stiff' would be lost or read as data"),
    ],
)
def test_a_rewriting_that_changes_more_is_refused(
    monkeypatch: pytest.MonkeyPatch, old: str, new: str, fault: str
) -> None:
    rewrite = MigrationRewriter.rewrite

    def wrong(rewriter: MigrationRewriter) -> tuple[list[TextEdit], dict[str, bytes]]:
        edits, files = rewrite(rewriter)
        start = TEXT.index(old)
        return [*edits, TextEdit(Span(start, start + len(old)), new)], files

    assert migrate(deck_of(TEXT)).replaced == {"ELASTIC SURFACE": 1}
    monkeypatch.setattr(MigrationRewriter, "rewrite", wrong)
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(TEXT))
    line = TEXT[: TEXT.index("*ELASTIC")].count("\n") + 1
    assert [(one.code, one.line, one.column) for one in caught.value.diagnostics] == [("MIG001", line, 1)]
    assert caught.value.diagnostics[0].message == f"the deck is left unchanged: {fault}"


def test_elements_that_would_lie_on_another_seabed_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(migrating, "edited_bytes", lambda *_: TEXT.replace("ELASTIC SURFACE", "RIGID SURFACE").encode())
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(TEXT))
    assert caught.value.diagnostics[0].message == "the deck is left unchanged: *ELASTIC SURFACE would change"


def test_the_proof_says_how_much_it_compared() -> None:
    """Ten depths of an element with each diameter; of a curve six at and beside points, three within, four beyond."""
    assert verify(migrate(deck_of(TEXT))) == Verification(12, 2, 2 * 10, 0, ())
    curved = verify(migrate(deck_of(TEXT.replace("9.81\n", "9.81\n*EMBEDMENT\n 0, 0\n 1, 5\n"))))
    assert curved == Verification(12, 2, 2 * (10 + 6 + 3 + 4), 0, ())


def test_a_curve_is_compared_within_its_segments_and_far_beyond_its_ends() -> None:
    ratios = migrating._ratios(ForceCurve([(1.0, 0.0), (2.0, 7.0), (4.0, 9.0)])).tolist()
    beside = [math.nextafter(point, side) for point in (1.0, 2.0, 4.0) for side in (-math.inf, math.inf)]
    within = [1.25, 1.5, 1.75, 2.5, 3.0, 3.5]
    assert sorted(ratios) == sorted([1.0, 2.0, 4.0, *beside, *within, -2.0, -29.0, 7.0, 34.0])


def test_a_deck_without_elements_is_proved_by_representatives() -> None:
    verdict = verify(migrate(deck_of("$MODEL\n*LINES\n LINE=Riser\n 1, 2\n*ELASTIC SURFACE\n 1e4\n")))
    assert (verdict.elements, verdict.kinds) == (0, 0)
    assert verdict.positions == 10 * verdict.representatives > 0
