"""Command `mudline rules`."""

from __future__ import annotations

import re
from textwrap import fill, indent
from typing import Any

import click

from mudline.basics.display import DisplayTable
from mudline.basics.display import text as text_column
from mudline.checks.output import visible_lines
from mudline.checks.pages import origin
from mudline.checks.registry import UnknownRule, rules, select
from mudline.cli import DONE, options
from mudline.cli.lint_report import STYLES
from mudline.cli.streams import emit_json, refusing
from mudline.cli.view import View
from mudline.language.rules import Rule

_PAGE = 100
"""Width of the page of a rule, in columns."""


@options.command("rules")
@click.argument("code", required=False, shell_complete=options.complete_rules)
@options.output_format("text", "json")
@options.common
def command(*, code: str | None, output_format: str, view: View) -> int:
    """List the rules, or explain the rules that CODE (a code, a prefix or a slug) names."""
    with refusing(UnknownRule):
        chosen = select([code]) if code else rules()
    if output_format == "json":
        emit_json([_object(rule) for rule in chosen])
    elif code and len(chosen) == 1:
        _print_rule(chosen[0], view)
    else:
        columns = (
            text_column("code", lambda rule: rule.code.code),
            text_column("severity", _severity),
            text_column("name", lambda rule: rule.code.slug),
            text_column("finds", lambda rule: rule.page.title + _package(rule, " [{}]")),
        )
        view.printer().table(DisplayTable(f"{len(chosen)} rules", columns, chosen))
    return DONE


def _object(rule: Rule) -> dict[str, Any]:
    return {
        "code": rule.code.code,
        "slug": rule.code.slug,
        "severity": rule.code.severity.value,
        "title": rule.page.title,
        "why": rule.page.why,
        "bad": rule.page.bad,
        "good": rule.page.good,
        "origin": origin(rule.code.code),
    }


def _severity(rule: Rule) -> tuple[str, str]:
    """Return the severity of a rule, and its style."""
    severity = rule.code.severity
    return severity.value, STYLES[severity]


def _package(rule: Rule, words: str) -> str:
    """Return the package of a rule in words; "" for mudline."""
    package = origin(rule.code.code)
    return "" if package == "mudline" else words.format(package)


def _print_rule(rule: Rule, view: View) -> None:
    """Print title and reason of a rule, with a bad and a good deck."""
    printer = view.printer()
    width = min(printer.width, _PAGE)
    printer.line((rule.code.code, "bold"), f" {rule.code.slug} (", _severity(rule), ")", fold=False)
    line, column = rule.page.place
    bad, good = (visible_lines(indent(deck, "    ").rstrip("\n")) for deck in (rule.page.bad, rule.page.good))
    texts = [rule.page.title, *re.split(r"\n\n|\n(?=\* )", rule.page.why)]  # also each item of a list
    for paragraph in (
        *(fill(" ".join(it.split()), width, subsequent_indent="  " * it.startswith("* ")) for it in texts if it),
        *filter(None, [_package(rule, "A rule of {}.")]),
        f"Bad (found at line {line}, column {column}):",
        bad,
        "Good:",
        good,
    ):
        printer.line(f"\n{paragraph}", fold=False)
