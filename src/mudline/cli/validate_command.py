"""`mudline validate`: which decks are legal, with how many warnings, in a table, JSON or CSV. No text is kept."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Generator, Iterable, Iterator
from contextlib import closing
from dataclasses import asdict, fields
from textwrap import indent

from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import Inputs, collect_any_form
from mudline.cli.streams import emit, reason
from mudline.cli.verdicts import Judged, Order, Total, Verdict, judge_order
from mudline.cli.view import Progress, View, wants_bar
from mudline.linting.output.json import as_object
from mudline.quantities import csv_lines
from mudline.running.executors import Pool, executor, in_order
from mudline.syntax.source import Source

_COUNTS = ("errors", "warnings", "sections", "keywords", "curves", "elements")


@options.command("validate")
@options.paths
@options.output_format("text", "json", "csv")
@options.running
@options.every_file
@options.stdin_name
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output_format: str,
    jobs: int,
    scheduler: str | None,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Validate decks: print the errors of each, then a table with a row per deck.

    A deck is legal when no rule of severity error finds anything, and when it has a section at all. Warnings are
    counted in its verdict, those about a pipe without a seabed under it among them; -v prints them too.

    PATHS are decks, directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that begin
    as decks do), URLs of either, or - for standard input. Of many decks -q shows the table without the errors.
    """
    inputs = collect_any_form(paths, stdin_name, gitignore=not every_file, urls=True)
    total = Total()
    shown = wants_bar(view) and (output_format == "text" or not sys.stdout.isatty())
    progress = Progress(len(inputs.files), view, shown=shown)
    with executor(jobs, scheduler) as pool, closing(_judged(pool, inputs, units, total, view, progress)) as judged:
        if output_format == "json":
            _print_json(judged, total)
        elif output_format == "csv":
            emit(csv_lines([[field.name for field in fields(Verdict)]]))
            for one in judged:
                emit(csv_lines([asdict(one.verdict).values()]))
        else:
            _print_text(judged, total, view)
    return max(inputs.code, DONE if total.legal == total.decks else FOUND)


# --------------------------------------------------------------------------------------------------------- judging


def _judged(
    pool: Pool, inputs: Inputs, units: str | None, total: Total, view: View, progress: Progress
) -> Generator[Judged, None, None]:
    """Each deck that can be read; all are counted. The bar is hidden while a deck with errors is printed."""
    orders = _orders(inputs, units, total, view, progress)
    with progress, closing(in_order(pool, judge_order, orders, len(inputs.files))) as results:
        for data, made in results:
            if made is not None and data is not None:
                verdict, found = made
                total.add(verdict)
                if found:
                    progress.hide()
                yield Judged(verdict, found, data)
            progress.advance()


def _orders(
    inputs: Inputs, units: str | None, total: Total, view: View, progress: Progress
) -> Iterator[tuple[bytes | None, Order | None]]:
    """The content of each file and what is sent of it; None for one that cannot be read."""
    here = os.getcwd()  # noqa: PTH109 - sent as text
    for file in inputs.files:
        try:
            data = file.read()
        except OSError as error:
            total.unreadable += 1
            progress.hide()
            inputs.fail(f"{file.name}: {reason(error)}")
            yield None, None
        else:
            yield data, Order(data, file, units, view.verbose, here)


# ---------------------------------------------------------------------------------------------------------- output


def _print_json(judged: Iterable[Judged], total: Total) -> None:
    """Print one object; its decks are written when they are judged."""
    mark = '{\n "decks": ['
    for one in judged:
        row = {**asdict(one.verdict), "findings": [as_object(each) for each in one.found]}
        emit([mark, "\n", indent(json.dumps(row, indent=1, ensure_ascii=False), "  ")])
        mark = ","
    end = "\n ]" if mark == "," else f"{mark}]"
    emit([end, ',\n "total": ', indent(json.dumps(asdict(total), indent=1), " ").lstrip(), "\n}\n"])


def _print_text(judged: Iterable[Judged], total: Total, view: View) -> None:
    """Print the errors of each deck at once; the table, whose widths all rows decide, at the end."""
    verdicts = []
    for verdict, found, data in judged:
        verdicts.append(verdict)
        if found and not view.quiet:
            view.printer().findings(found, Source.from_bytes(data, verdict.file), following=view.verbose)
    if verdicts:
        printer = view.printer()
        rows = [
            [(each.verdict, _style(good=each.legal)), *(getattr(each, name) for name in _COUNTS), each.file]
            for each in verdicts
        ]
        printer.table("Decks", ("verdict", *_COUNTS, "file"), rows, left=("verdict", "file"))
        printer.line((str(total), _style(good=total.legal == total.decks and not total.unreadable)))


def _style(*, good: bool) -> str:
    return "green" if good else "bold red"
