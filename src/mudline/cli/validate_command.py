"""`mudline validate`."""

from __future__ import annotations

import sys

import click

from mudline.cli import options
from mudline.cli.deck_files import collect_any_form
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import Input
from mudline.cli.options import View
from mudline.cli.progress import Progress, looked_at
from mudline.cli.terminal import reason
from mudline.cli.verdict import Total, Verdict
from mudline.cli.verdict_forms import report
from mudline.deck.loading import load_bytes
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError, Diagnostic, Severity
from mudline.linting.context import LintContext
from mudline.linting.engine import problems_in
from mudline.linting.registry import rules


@click.command("validate")
@options.paths
@options.output_format("text", "json", "csv")
@options.every_file
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output_format: str,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Say of each deck whether it is legal and complete: its errors, then a table with a row per deck.

    A deck is legal when no rule of severity error finds anything, and when it has a section at all.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that begin
    as decks do) or - for standard input. Of many decks -q shows the table without the errors.
    """
    inputs = collect_any_form(paths, stdin_name, gitignore=not every_file)
    total = Total()
    shown = looked_at(view) and (output_format == "text" or not sys.stdout.isatty())
    with Progress(len(inputs.files), view, shown=shown) as progress:
        told = report(output_format, view, progress)
        for file in inputs.files:
            try:
                data = file.read()
            except OSError as error:
                total.unreadable += 1
                with progress.hidden():
                    inputs.fail(f"{file.name}: {reason(error)}")
            else:
                verdict, found = _judge(data, file, units)
                total.add(verdict)
                told.add(verdict, found, data)
            progress.advance()
    told.finish(total)
    return max(inputs.code, DONE if total.legal == total.decks else FOUND)


def _judge(data: bytes, file: Input, units: str | None) -> tuple[Verdict, list[Diagnostic]]:
    try:
        deck = load_bytes(data, file.name, units=units, folder=file.folder)
    except DeckError as error:
        return Verdict(file.name, 0, 0, 0, 0, len(error.diagnostics), "illegal"), list(error.diagnostics)
    context = LintContext(deck)
    problems = problems_in(context, rules())
    found = deck.diagnose([problem for problem in problems if problem.weight is Severity.ERROR])
    return _verdict(deck, context, len(found)), found


def _verdict(deck: Deck, context: LintContext, errors: int) -> Verdict:
    keywords = sum(len(section.blocks) for section in deck.sections)
    curves, elements = len(context.scene.laws.curves), len(context.scene.element_ids)
    verdict = "illegal" if errors else "legal" if deck.sections else "empty"
    return Verdict(deck.file, len(deck.sections), keywords, curves, elements, errors, verdict)
