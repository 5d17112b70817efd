"""`mudline lint`."""

from __future__ import annotations

import click

from mudline.cli import options
from mudline.cli.exits import DONE, FOUND
from mudline.cli.inputs import Input, Inputs, collect
from mudline.cli.lazy import printing
from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.cli.terminal import tell
from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.engine import lint_bytes
from mudline.linting.output.concise import concise
from mudline.linting.output.json_objects import json_array, json_lines
from mudline.linting.output.statistics import statistics_lines
from mudline.linting.selection import UnknownRule, select
from mudline.syntax.source import Source

_PLAIN = {"concise": concise, "json": json_array, "jsonl": json_lines}
_CODES = "CODE[,CODE...]"


def _words(given: tuple[str, ...]) -> list[str]:
    return [word for text in given for word in text.split(",") if word.strip()]


@click.command("lint")
@options.paths
@click.option(
    "--select", "chosen", multiple=True, metavar=_CODES, help="Run these rules only: codes, prefixes or slugs."
)
@click.option("--extend-select", "also", multiple=True, metavar=_CODES, help="Run these rules too.")
@click.option("--ignore", "ignored", multiple=True, metavar=_CODES, help="Leave these rules out.")
@click.option(
    "--fail-on",
    type=click.Choice([severity.value for severity in (Severity.ERROR, Severity.WARNING, Severity.INFO)]),
    default=Severity.WARNING.value,
    show_default=True,
    help="Exit with 1 for findings of this severity or worse.",
)
@options.output_format("text", "concise", "json", "jsonl")
@click.option("--statistics", is_flag=True, help="Count the findings of each rule instead of listing them.")
@click.option("--exit-zero", is_flag=True, help="Exit with 0 whatever is found.")
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    chosen: tuple[str, ...],
    also: tuple[str, ...],
    ignored: tuple[str, ...],
    fail_on: str,
    output_format: str,
    statistics: bool,
    exit_zero: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Find faults in decks: all findings of every file in one run.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi and *.das) or - for standard input.
    """
    try:
        rules = select(_words(chosen), _words(ignored), _words(also))
    except UnknownRule as error:
        raise click.UsageError(str(error)) from error
    inputs = collect(paths, stdin_name)
    report = _Report(output_format, view, statistics=statistics)
    for file, data in inputs.contents():
        report.add(file, data, lint_bytes(data, file.name, rules, units=units, folder=file.folder))
    report.finish()
    return _exit_code(inputs, report.found, Severity(fail_on), exit_zero=exit_zero)


def _exit_code(inputs: Inputs, found: list[Diagnostic], limit: Severity, *, exit_zero: bool) -> int:
    failing = not exit_zero and any(diagnostic.severity.rank >= limit.rank for diagnostic in found)
    return max(inputs.code, FOUND if failing else DONE)


class _Report:
    """Findings told as they come for people, together for programs."""

    def __init__(self, form: str, view: View, *, statistics: bool) -> None:
        self.form = form
        self.view = view
        self.statistics = statistics
        self.found: list[Diagnostic] = []
        self.files = 0

    def add(self, file: Input, data: bytes, found: list[Diagnostic]) -> None:
        """The findings of one file."""
        self.files += 1
        self.found += found
        if self.form == "text" and found and not self.view.quiet and not self.statistics:
            printing("lint").print_findings(found, Source.from_bytes(data, file.name), self.view.color)
        if self.view.verbose:
            tell(f"{file.name}: {len(found)} finding{'s' * (len(found) != 1)}")

    def finish(self) -> None:
        """What stands at the end."""
        found = sorted(self.found, key=lambda diagnostic: diagnostic.sort_key)
        if self.statistics:
            emit(statistics_lines(found))
        elif self.form in _PLAIN or self.view.quiet:
            emit(_PLAIN.get(self.form, concise)(found))
        elif not found and self.files:
            click.echo(f"No findings in {self.files} file{'s' * (self.files != 1)}.")
        elif found:
            printing("lint").print_summary(found, self.files, self.view.color)
