"""STY010: comments that hide nothing."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Problem
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.suppression import STY010, suppressions


@rule(STY010)
def unused_suppression(context: LintContext) -> Iterator[Problem]:
    """A suppression comment that suppresses nothing.

    It was written for a finding that is no longer there, or names no rule; the next fault of that kind would be hidden
    without anybody having looked at it. Only rules that run are judged: with `--ignore CRV005` a comment for CRV005 is
    not unused. The fix removes the code, or the comment when it names nothing else.

    Example:
         $MODEL
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
          0.1, 1200.0
        -C mudline: ignore CRV0O5 -- remoulded, see the survey
        +C mudline: ignore CRV005 -- remoulded, see the survey
          0.5, 900.0
          1.0, 2000.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 6:19
    """
    found = suppressions(context.deck)
    if found is not None:
        yield from found.unknown()
