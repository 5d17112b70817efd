"""Names that are given twice: vessels, lines, bodies, vectors."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.rules import rule
from mudline.scene.names import THINGS, repeated

REF020 = Code("REF020", "repeated-name", Severity.WARNING)


@rule(REF020)
def repeated_name(context: LintContext) -> Iterator[Problem]:
    """Two vessels, or two other things of one kind, have one name.

    The language does not say which of them a name means then. Names are case-insensitive. Choose another name, or keep
    one of them. Sets and curves have rules of their own.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0
        - VESSEL=fpso
        + VESSEL=Tanker
          INITIAL POSITION=1005.0, 250.0, 0.0

    Finds: 5:9
    """
    return repeated(context.scene.context, THINGS, REF020)
