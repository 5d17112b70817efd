"""Rules on the terminal: the list, and the page of one."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill, indent

from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import print_table
from mudline.linting.output.text import STYLES
from mudline.linting.output.visible import visible_lines
from mudline.linting.plugins import origin
from mudline.linting.rule import Rule

_PAGE = 100
_COLUMNS = ("code", "severity", "name", "finds")


def print_rules(rules: Sequence[Rule], color: str) -> None:
    """A line a rule: code, severity, name, what it finds."""
    rows = [(rule.code.code, rule.code.severity.value, rule.code.slug, _finds(rule)) for rule in rules]
    styles = {severity.value: style for severity, style in STYLES.items()}
    print_table(console(color), f"{len(rows)} rules", _COLUMNS, rows, left=_COLUMNS, styles=styles, whole=_COLUMNS[:3])


def _finds(rule: Rule) -> str:
    """What a rule finds, and the package that it comes from if that is another than mudline."""
    package = origin(rule.code.code)
    return rule.title if package == "mudline" else f"{rule.title} [{package}]"


def print_rule(rule: Rule, color: str) -> None:
    """What a rule finds and why, with a bad and a good deck."""
    printer = console(color)
    severity = rule.code.severity
    width = min(printer.width, _PAGE)
    head = ((rule.code.code, "bold"), f" {rule.code.slug} (", (severity.value, STYLES[severity]), ")")
    printer.print(Text.assemble(*head))
    line, column = rule.place
    bad = f"Bad (found at line {line}, column {column}):"
    paragraphs = [fill(text, width) for text in (rule.title, *rule.why.split("\n\n"))]
    decks = [visible_lines(indent(deck, "    ").rstrip("\n")) for deck in (rule.bad, rule.good)]
    for paragraph in (*filter(None, paragraphs), *_from(rule), bad, decks[0], "Good:", decks[1]):
        printer.print(Text(f"\n{paragraph}"))


def _from(rule: Rule) -> list[str]:
    package = origin(rule.code.code)
    return [] if package == "mudline" else [f"A rule of {package}."]
