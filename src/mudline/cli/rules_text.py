"""The list of rules on the terminal."""

from __future__ import annotations

from collections.abc import Iterable

from rich.text import Text

from mudline.cli.console import console
from mudline.lint.output.text import STYLES
from mudline.lint.registry import Rule


def print_rules(rules: Iterable[Rule], color: str) -> None:
    """A line a rule: code, severity, slug, what it finds."""
    printer = console(color)
    for rule in rules:
        severity = rule.code.severity
        words = ((f"{severity.value:<8}", STYLES[severity]), f"{rule.code.slug:<26}", rule.title)
        printer.print(Text.assemble((rule.code.code, "bold"), "  ", *words))
