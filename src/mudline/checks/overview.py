"""Contents of a deck, as far as it can be read: its summary, the sheet of its elements, and its errors."""

from __future__ import annotations

from typing import Any, NamedTuple

from mudline.checks.context import LintContext
from mudline.checks.engine import all_findings, errors_of, of_base
from mudline.language.deck.model import Deck
from mudline.language.diagnostics import Diagnostic
from mudline.model.results.summary import summarise
from mudline.model.scene.sheet import Sheet, sheet_of


class Overview(NamedTuple):
    """Overview of a deck.

    Attributes:
        summary: sections, keywords, counts, sets, curves, diameters and laws, as `mudline show --output-format json`.
        sheet: `columns` by key, with heading and unit, and in `rows` the values of each run of elements with the same
            properties, by the same keys.
        errors: reasons why the deck is not legal; summary and sheet may lack parts because of them.
    """

    summary: dict[str, Any]
    sheet: Sheet
    errors: list[Diagnostic]


def overview(deck: Deck) -> Overview:
    """Return the overview of a deck; never raises for its content."""
    context = LintContext(deck)
    scene = context.scene
    errors = [*errors_of(all_findings(context)), *(problem for problem in scene.errors() if of_base(deck, problem))]
    return Overview(summarise(scene), sheet_of(scene), scene.deck.diagnose(errors))
