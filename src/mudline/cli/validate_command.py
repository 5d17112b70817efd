"""Command `mudline validate`: errors and warnings of decks, in a table, JSON or CSV."""

from __future__ import annotations

import json
import sys
from collections.abc import Generator, Iterable, Iterator
from contextlib import closing
from dataclasses import asdict, dataclass, field
from textwrap import indent

import click

from mudline.basics.display import DisplayTable, number, text
from mudline.basics.outside import refusing_outside
from mudline.basics.quantities import csv_lines
from mudline.basics.short_repr import counted
from mudline.checks.configuration import refuses_outside
from mudline.checks.output.json import as_object
from mudline.checks.verdict import Verdict, judge_content
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import GivenDecks, Input, Inputs, many_files, takes_decks
from mudline.cli.lint_report import print_findings
from mudline.cli.streams import emit, json_rows
from mudline.cli.view import View
from mudline.language.deck.searching import is_in_any_form
from mudline.language.diagnostics import Coverage, Diagnostic
from mudline.language.syntax.source import Source

_COLUMNS = (
    text("verdict", lambda verdict: (verdict.short, _style(good=verdict.ok))),
    number("warn-\nings", "warnings"),
    number("sec-\ntions", "sections"),
    number("keywords\nread", lambda verdict: _read(verdict.keywords)),
    number("curves", "curves"),
    number("ele-\nments", "elements"),
    text("file", "file", whole=True),
)


@options.command("validate")
@options.output_format("text", "json", "csv")
@options.output_option(
    "--fail-on",
    type=click.Choice(["error", "warning", "unread"]),
    default="error",
    help="Exit with 1 for decks with errors (default), also for decks with warnings, or also for decks that are not "
    "read completely.",
)
@options.no_outside
@options.jobs
@takes_decks()
def command(*, decks: GivenDecks, output_format: str, fail_on: str, no_outside: bool, jobs: int, view: View) -> int:
    """Validate decks: print the errors of each, then a table with a row for each deck.

    A file without any section has an error. Warnings are those of lint, and those about a pipe without a seabed below
    it. With -v and in JSON, warnings are listed too. If not all keywords of a deck could be read, the verdict gives
    their number.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that begin
    as decks do), or - for standard input. With -q, only the table is shown.
    """
    inputs = decks.collect(is_in_any_form)
    total, listing = ValidationTotal(), view.verbose or output_format == "json"
    bar = output_format == "text" or not sys.stdout.isatty()
    with closing(_judged(inputs, (decks.units, no_outside, listing), total, view, jobs, bar=bar)) as judged:
        if output_format == "json":
            _print_json(judged, total)
        elif output_format == "csv":
            emit(csv_lines(_csv(verdict for verdict, _, _ in judged)))
        else:
            _print_text(judged, total, view)
    failing = {"error": False, "warning": total.warnings > 0, "unread": not total.keywords.whole}[fail_on]
    return max(inputs.code, FOUND if failing or total.ok < total.decks else DONE)


# -------------------------------------------------------------------------------------------------------- verdicts


@dataclass(slots=True)
class ValidationTotal:
    """Counts of a run; files that could not be read are not among the decks."""

    decks: int = 0
    ok: int = 0
    errors: int = 0
    warnings: int = 0
    unreadable: int = 0
    keywords: Coverage = field(default_factory=Coverage)

    def add(self, verdict: Verdict) -> None:
        """Count a deck."""
        self.decks += 1
        self.ok += verdict.ok
        self.errors += verdict.errors
        self.warnings += verdict.warnings
        self.keywords.add(verdict.keywords)

    def __str__(self) -> str:
        """Return the total for a reader, without counts of zero."""
        faulty, decks = self.decks - self.ok, counted(self.decks, "deck")
        counts = [
            counted(self.errors, "error") if self.errors else "",
            counted(self.warnings, "warning") if self.warnings else "",
            f"{counted(self.unreadable, 'file')} unreadable" if self.unreadable else "",
        ]
        head = (
            f"{faulty} of {decks} {'has' if faulty == 1 else 'have'} errors"
            if faulty
            else f"no errors found in {decks}"
        )
        rest = ", ".join(filter(None, counts))
        return head + (f": {rest}" if rest else "")


Judged = tuple[Verdict, list[Diagnostic], bytes]
"""Verdict on a deck, its errors (also warnings, if asked for), and its content, which is not kept."""


def judge_file(
    file: Input, data: bytes, units: str | None, no_outside: bool, listing: bool
) -> tuple[Verdict, list[Diagnostic]]:
    """Return the verdict on a deck and its errors, with `listing` also its warnings. Runs in any process."""
    with refusing_outside(lambda folder: no_outside or refuses_outside(folder)):
        verdict, errors, warnings = judge_content(data, file.name, units, file.folder)
    return verdict, sorted([*errors, *warnings], key=lambda finding: finding.sort_key) if listing else errors


# ------------------------------------------------------------------------------------------------------- all files


def _judged(
    inputs: Inputs, options: tuple[str | None, bool, bool], total: ValidationTotal, view: View, jobs: int, *, bar: bool
) -> Generator[Judged, None, None]:
    """Yield and count each readable deck."""

    def prepared(file: Input) -> tuple[bytes, tuple[Input, bytes, str | None, bool, bool]]:
        data = file.read()
        return data, (file, data, *options)

    with closing(many_files(inputs, prepared, judge_file, view, jobs=jobs, bar=bar)) as results:
        for data, result in results:
            if result is not None:
                verdict, findings = result
                total.add(verdict)
                yield verdict, findings, data
    total.unreadable = len(inputs.undone)


# ---------------------------------------------------------------------------------------------------------- output


def _print_json(judged: Iterable[Judged], total: ValidationTotal) -> None:
    """Print one JSON object; each deck is written as soon as it is judged."""
    rows = ({**verdict.row(), "findings": [as_object(each) for each in findings]} for verdict, findings, _ in judged)
    texts = (indent(json.dumps(row, indent=1, ensure_ascii=False), "  ").lstrip() for row in rows)
    emit(json_rows({}, "decks", texts))
    emit([",", json.dumps({"total": asdict(total)}, indent=1, ensure_ascii=False).removeprefix("{"), "\n"])


def _print_text(judged: Iterable[Judged], total: ValidationTotal, view: View) -> None:
    """Print the errors of each deck at once, and the table at the end, as all rows determine its widths."""
    verdicts = []
    for verdict, findings, data in judged:
        verdicts.append(verdict)
        if findings and not view.quiet:
            print_findings(view, findings, Source.from_bytes(data, verdict.file))
    if verdicts:
        printer = view.printer()
        printer.table(DisplayTable("Decks", _COLUMNS, verdicts))
        printer.line((str(total), _style(good=total.ok == total.decks and not total.unreadable)))
        if not total.keywords.whole:
            printer.line(printer.visible(total.keywords.sentence()))


def _read(words: Coverage) -> int | str:
    """Return the number of keywords read, and of all if they differ."""
    return words.total if words.whole else f"{words.read} of {words.total}"


def _csv(verdicts: Iterable[Verdict]) -> Iterator[list[object]]:
    """Yield the headings of a table without nesting, and its rows; keywords are counts."""
    yield [*(name for name in Verdict("", 0).row() if name != "keywords"), "keywords", "read", "partly"]
    for verdict in verdicts:
        words, row = verdict.keywords, verdict.row()
        del row["keywords"]
        yield [*row.values(), words.total, words.read, sum(words.partly.values())]


def _style(*, good: bool) -> str:
    return "green" if good else "bold red"
