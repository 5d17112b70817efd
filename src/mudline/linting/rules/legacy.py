"""Superseded keywords."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule

LEG001 = Code("LEG001", "superseded-keyword", Severity.INFO)

_SUCCESSORS = {
    "EMBEDMENT": "*SEABED STIFFNESS and STIFFNESS= of *SEABED PROPERTIES",
    "ELASTIC SURFACE": "*SEABED PROPERTIES and *SEABED PROFILE",
    "RIGID SURFACE": "*SEABED PROPERTIES and *SEABED PROFILE",
}


@rule(LEG001)
def superseded_keyword(context: LintContext) -> Iterator[Problem]:
    """The keyword is superseded by a newer one.

    It is still legal and means what it meant. The newer keywords say more (profiles, friction by set), and new decks
    are written with them.

    Bad:
        $MODEL
        *NODE
         1, 0.0, 0.0
         2, 0.0, 10.0
        *ELEMENT
         1, 1, 2
        *ELASTIC SURFACE
         50000.0, 0.3, 0.5

    Good:
        $MODEL
        *NODE
         1, 0.0, 0.0
         2, 0.0, 10.0
        *ELEMENT
         1, 1, 2
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.5

    Finds: 7:1
    """
    for keyword, successor in _SUCCESSORS.items():
        for where, _ in context.deck.blocks(keyword):
            yield Problem(LEG001, f"*{keyword} is superseded by {successor}", where=where)
