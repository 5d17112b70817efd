"""`mudline validate`."""

from __future__ import annotations

import json
from dataclasses import asdict

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import Input, collect
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.verdict import Verdict
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError, Diagnostic, Severity
from mudline.linting.context import LintContext
from mudline.linting.output.json_objects import as_object
from mudline.linting.registry import rules
from mudline.results.csv_lines import csv_lines
from mudline.syntax.source import Source


@click.command("validate")
@options.paths
@options.output_format("text", "json", "csv")
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output_format: str,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Say of each deck whether it is legal and complete: its errors, then a table with a row per deck.

    A deck is legal when no rule of severity error finds anything, and when it has a section at all.
    """
    inputs = collect(paths, stdin_name)
    judged: list[tuple[Verdict, list[Diagnostic]]] = []
    for file, data in inputs.contents():
        verdict, found = _judge(data, file, units)
        judged.append((verdict, found))
        if output_format == "text" and not view.quiet and found:
            printing("lint").print_findings(found, Source.from_bytes(data, file.name), view.color)
    _tell(judged, output_format, view)
    return max(inputs.code, DONE if all(verdict.verdict == "legal" for verdict, _ in judged) else FOUND)


def _judge(data: bytes, file: Input, units: str | None) -> tuple[Verdict, list[Diagnostic]]:
    try:
        deck = load_bytes(data, file.name, units=units, folder=file.folder)
    except DeckError as error:
        return Verdict(file.name, 0, 0, 0, 0, len(error.diagnostics), "illegal"), list(error.diagnostics)
    context = LintContext(deck)
    problems = [problem for rule in rules() for problem in rule.check(context)]
    found = deck.diagnose([problem for problem in problems if problem.weight is Severity.ERROR])
    return _verdict(deck, context, len(found)), found


def _verdict(deck: Deck, context: LintContext, errors: int) -> Verdict:
    keywords = sum(len(section.blocks) for section in deck.sections)
    curves, elements = len(context.scene.laws.curves), len(context.scene.element_ids)
    verdict = "illegal" if errors else "legal" if deck.sections else "empty"
    return Verdict(deck.file, len(deck.sections), keywords, curves, elements, errors, verdict)


def _tell(judged: list[tuple[Verdict, list[Diagnostic]]], form: str, view: View) -> None:
    verdicts = [verdict for verdict, _ in judged]
    total = {"decks": len(verdicts), "legal": sum(verdict.verdict == "legal" for verdict in verdicts)}
    if form == "json":
        rows = [{**asdict(verdict), "findings": [as_object(found) for found in errors]} for verdict, errors in judged]
        emit([json.dumps({"decks": rows, "total": total}, indent=1, ensure_ascii=False), "\n"])
    elif form == "csv":
        emit(csv_lines([Verdict.__dataclass_fields__, *(asdict(verdict).values() for verdict in verdicts)]))
    elif verdicts:
        printing("validate").print_verdicts(verdicts, total, view.color)
