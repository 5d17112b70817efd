"""Rules made up for tests: each looks for a pattern in the text and repairs it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Repair, Severity, Span
from mudline.linting.rule import LintContext, Rule


def replacing(
    pattern: str, text: str, *, code: str = "TST001", kind: str = "safe", severity: Severity = Severity.WARNING
) -> Rule:
    """A rule that finds a pattern and puts a text (a template of `re`) in its place."""
    name = Code(code, f"made-{code.lower()}", severity)

    def check(context: LintContext) -> Iterator[Problem]:
        if context.text is None:
            return
        for match in re.finditer(pattern, context.text.source.unified, re.MULTILINE):
            span = Span(*match.span())
            yield Problem(name, "replace this", span, repair=Repair(kind, "replace", ((span, match.expand(text)),)))

    return Rule(name, check, "A title.", "A reason.", "", "", (1, 1), "deck.keyxm", "utf-8", off=False)
