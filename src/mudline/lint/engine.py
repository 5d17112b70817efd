"""Running rules over decks."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError, Diagnostic
from mudline.lint.context import LintContext
from mudline.lint.registry import Rule


def lint_deck(deck: Deck, chosen: Sequence[Rule]) -> list[Diagnostic]:
    """All findings of the chosen rules, in the order of the file."""
    context = LintContext(deck)
    return deck.diagnose([problem for rule in chosen for problem in rule.check(context)])


def lint_bytes(data: bytes, name: str, chosen: Sequence[Rule], *, units: str | None = None) -> list[Diagnostic]:
    """All findings in a file's content; a JSON or YAML file that holds no deck gives the reasons."""
    try:
        deck = load_bytes(data, name, units=units)
    except DeckError as error:
        return list(error.diagnostics)
    return lint_deck(deck, chosen)
