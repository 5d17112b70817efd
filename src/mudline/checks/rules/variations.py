"""Decks of variations: faults that keep them from being expanded."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mudline.checks.context import LintContext, of_variations
from mudline.language.diagnostics import Blocks, Code, DeckError, Problem, Severity
from mudline.language.rules import rule

REF023 = Code("REF023", "cannot-expand", Severity.WARNING)


@rule(REF023)
def cannot_expand(context: LintContext) -> Iterator[Problem]:
    """The decks that *VARIATION and *COMBINATIONS describe cannot be written.

    Parameters of one variation have different numbers of values, two decks would have one name, or a file cannot be
    added: `mudline expand` refuses the deck. Misspelt names of parameters, variations and keywords have their own
    rules. If one of them reports the deck, or the deck has errors, this rule reports nothing.

    Example:
         $PREPROCESSOR
         *PARAMETERS
          Offset, 0.0
          Period, 8.0
         *VARIATION
          NAME=Sea
          PARA=Offset, VALUE=-10.0, 0.0, 10.0
        - PARA=Period, VALUE=8.0, 10.0
        + PARA=Period, VALUE=8.0, 10.0, 12.0
         *COMBINATIONS
          DIRECTORY=Runs
          DESCRIPTION=All, FILENAME=T%Period%

    Finds: 6:2
    """
    named = context.written("COMBINATIONS", "PREPROCESSOR")
    if not named or any(problem.code.severity is Severity.ERROR for problem in context.deck.problems):
        return
    if any(True for _ in of_variations(context.deck)):
        return
    from mudline.editing.variations.planning import plan_faults  # noqa: PLC0415 - few decks have combinations

    try:
        faults = plan_faults(context.deck)
    except DeckError:  # reported elsewhere
        return
    for problem in {problem.where: problem for problem in reversed(faults)}.values():  # the first of a place
        yield replace(problem, code=REF023, blocks=Blocks.NEVER)
