"""`evaluate` refuses exactly the decks with a finding that blocks, with its code, line and message."""

from __future__ import annotations

import json
from functools import cache

import pytest
from hypothesis import given

from mudline.checks.context import LintContext
from mudline.checks.engine import LintSettings, lint_bytes, problems_in
from mudline.checks.fixing import lint_one
from mudline.checks.registry import rules
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError, Severity
from mudline.model.scene.model import resolve
from tests.checks.legality import Outcome, deck, outcome
from tests.helpers.builders.documents import Values, document


@cache
def outcome_of(seed: int) -> Outcome:
    """The outcome of a random deck."""
    return outcome(deck(seed).encode())


@pytest.mark.untraced
@pytest.mark.parametrize("first", range(0, 100, 50))
def test_decks_about_a_pipe_on_a_seabed(first: int) -> None:
    for seed in range(first, first + 50):
        assert outcome_of(seed).agrees, (seed, outcome_of(seed))


@given(document())
def test_documents_of_all_keywords(values: Values) -> None:
    found = outcome(json.dumps(values).encode(), "deck.json")
    assert found.agrees, found


@pytest.mark.untraced
def test_random_decks_are_neither_all_blocked_nor_all_evaluated() -> None:
    found = [outcome_of(seed) for seed in range(100)]
    evaluated = sum(not one.blocking and not one.refused for one in found)
    assert 20 <= evaluated <= 80


CUTOFF = (
    "$MODEL\n*NODE\n 1, -0.05, 0.0\n 2, -0.05, 10.0\n*ELEMENT\n 1, 1, 2\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n"
    " STIFFNESS=50000.0\n*SEABED SUCTION\n SET=ALL\n FORCE=5, 0.2\n DEPTH=0.3, 0.2\n CUTOFF=0.001, 0.5\n"
)


def refused_with(text: str) -> list[str]:
    with pytest.raises(DeckError) as caught:
        resolve(load_bytes(text.encode(), "deck.keyxm")).contact()
    return [one.code for one in caught.value.diagnostics]


def test_neither_a_comment_nor_a_severity_nor_a_dialect_changes_what_blocks() -> None:
    assert refused_with(CUTOFF) == ["EXT004"]
    suppressed = CUTOFF.replace("$MODEL\n", "$MODEL\nC mudline: ignore-file EXT004\n")
    assert "EXT004" not in {one.code for one in lint_bytes(suppressed.encode(), "deck.keyxm", rules())}
    assert refused_with(suppressed) == ["EXT004"]
    mild = LintSettings(tuple(rules()), severities={"EXT004": Severity.INFO})
    (found,) = [one for one in lint_one("deck.keyxm", CUTOFF.encode(), mild).found if one.code == "EXT004"]
    assert (found.severity, found.blocks) == (Severity.INFO, True)
    for one in lint_bytes(CUTOFF.encode(), "deck.keyxm", rules(), dialect="flexcom"):
        assert (one.code, one.blocks) in {("SBD018", False), ("STB001", False), ("EXT004", True)}


def test_a_curve_that_is_cut_blocks_nothing() -> None:
    text = CUTOFF.replace("0.001", "0.2").replace("=50000.0", "=Pull") + (
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3, 0.265, 7850.0\n"
        "*SEABED STIFFNESS\n CURVE=Pull\n 0.0, 0.0\n 0.2, -50.0\n 0.5, 4200.0\n"
    )
    assert refused_with(text) == ["EXT006"]
    scene = resolve(load_bytes(text.encode(), "deck.keyxm"))
    assert scene.require() is scene
    assert scene.contact(tension="cut").evaluate().contact.all()


def test_a_rule_that_advises_never_blocks() -> None:
    context = LintContext(load_bytes(CUTOFF.encode(), "deck.keyxm"), dialect="flexcom")
    chosen = [rule for rule in rules() if rule.check is not None and not rule.blocks]
    assert {problem.blocking.value for problem in problems_in(context, chosen)} == {"never"}
