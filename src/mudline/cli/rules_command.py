"""`mudline rules`."""

from __future__ import annotations

import json
from typing import Any

import click

from mudline.cli import options
from mudline.cli.exits import DONE
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.linting.plugins import origin
from mudline.linting.registry import UnknownRule, rules, select
from mudline.linting.rule import Rule


@click.command("rules")
@click.argument("code", required=False)
@options.output_format("text", "json")
@options.common
def command(*, code: str | None, output_format: str, view: View) -> int:
    """List the rules, or explain those that CODE (a code, a prefix or a slug) names."""
    try:
        chosen = select([code]) if code else rules()
    except UnknownRule as error:
        raise click.UsageError(str(error)) from error
    if output_format == "json":
        emit([json.dumps([_object(rule) for rule in chosen], indent=1, ensure_ascii=False), "\n"])
    elif code and len(chosen) == 1:
        printing("rules").print_rule(chosen[0], view.color)
    else:
        printing("rules").print_rules(chosen, view.color)
    return DONE


def _object(rule: Rule) -> dict[str, Any]:
    return {
        "code": rule.code.code,
        "slug": rule.code.slug,
        "severity": rule.code.severity.value,
        "title": rule.title,
        "why": rule.why,
        "bad": rule.bad,
        "good": rule.good,
        "origin": origin(rule.code.code),
    }
