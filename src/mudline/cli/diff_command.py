"""Command `mudline diff`: two decks, or the decks of two folders in pairs of the same name."""

from __future__ import annotations

import json
import math
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import asdict
from itertools import accumulate, groupby

import click
import numpy as np

from mudline.api import Deck, public
from mudline.api.commands import diff, diff_matrix
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.quantities import csv_lines
from mudline.basics.short_repr import counted
from mudline.checks.configuration import Configured
from mudline.checks.output import visible
from mudline.cli import DONE, FOUND, options
from mudline.cli.inputs import STDIN, GivenDeck, Input, Inputs, many_files
from mudline.cli.streams import emit, json_rows, notify_diagnostics
from mudline.cli.view import Part, View
from mudline.editing.comparison.decks import ComparedDeck, Comparison, DeckPair, DeckStatus, compare_pair, paired
from mudline.editing.comparison.matrix import MATRIX_FORMAT, matrix_table, value_text
from mudline.editing.comparison.model import Difference, Value, spans_of, text_of
from mudline.language.deck.loading import load_bytes

FORMAT = "mudline-diff/1"
FOLDER_FORMAT = "mudline-diff-folders/1"

_NUMBERED = ("nodes", "elements")
_FEW = 4
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}


_NOT_COMPARED = "cannot be compared"
_OF_DECKS = {
    DeckStatus.ADDED: ("+", "green", "only in the second folder"),
    DeckStatus.REMOVED: ("-", "red", "only in the first folder"),
    DeckStatus.FAILED: ("!", "red", _NOT_COMPARED),
}


@options.command("diff")
@click.argument("before", metavar="A")
@click.argument("others", metavar="B...", nargs=-1, required=True)
@options.flag("--matrix", help="Compare decks B... with A: a row for each value, a column for each deck.")
@options.option(
    "--tolerance",
    type=click.FloatRange(min=0, max=1),
    default=0.0,
    show_default=True,
    metavar="REL",
    help="Ignore differences of numbers up to this value, relative to the larger number.",
)
@options.flag("--strict", help="Also list differences of spelling in superseded keywords; the exit code is then 1.")
@options.output_format("text", "json", "markdown", "csv")
@options.every_file
@options.stdin_name
@options.units
@options.jobs
@options.common
def command(
    *,
    before: str,
    others: tuple[str, ...],
    matrix: bool,
    tolerance: float,
    strict: bool,
    output_format: str,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    jobs: int,
    view: View,
) -> int:
    """Compare two decks, or the decks of two folders, semantically, whatever their formats, layout and order.

    A and B are decks in keyword text, JSON or YAML, of which one may be - for standard input. Of two folders, decks
    with the same relative path are compared. The exit code is 0 if all decks mean the same, as a deck and its migrated
    form do. It is 1 if something differs, was added or removed, or a deck cannot be read. With --matrix, B... are a
    family of load cases, each compared with A.
    """
    if [before, *others].count(STDIN) > 1:
        raise click.UsageError("only one of the decks can come from standard input")
    if not math.isfinite(tolerance):
        raise click.UsageError("--tolerance: expected a number from 0 to 1")
    if matrix:
        if output_format == "markdown":
            raise click.UsageError("--output-format markdown: --matrix is printed as text, json or csv")
        decks = [GivenDeck(path, stdin_name, units).load() for path in (before, *others)]
        return _print_matrix(decks, tolerance, strict=strict, output_format=output_format, view=view)
    if len(others) > 1 or output_format == "csv":
        raise click.UsageError("more than two decks, and CSV, are for --matrix")
    (after,) = others
    folders = [os.path.isdir(path) for path in (before, after)]  # noqa: PTH112 - Path raises for a long name
    if any(folders) and not all(folders):
        for path in (before, after):
            if path != STDIN and not os.path.exists(path):  # noqa: PTH110 - as above
                raise click.ClickException(f"{path}: no such file or directory")
        raise click.UsageError("one of A and B is a folder, the other is not: give two decks or two folders")
    if all(folders):
        try:
            pairs = paired(before, after, Configured().takes, gitignore=not every_file)
        except FileNotFoundError:
            raise click.ClickException(f"{before}, {after}: no deck in these folders") from None
        results, code = _compared(pairs, (tolerance, strict, units), view, jobs)
        return max(code, _print_folders((before, after), tolerance, results, output_format, view))
    first, second = _pair(before, after, stdin_name, units)
    comparison = diff(first, second, tolerance=tolerance, strict=strict)
    if output_format == "json":
        head = {
            "format": FORMAT,
            "before": first.file,
            "after": second.file,
            "tolerance": tolerance,
            "equivalent": comparison.equivalent,
            "spelling_differences": len(comparison.spelling),
        }
        emit([*json_rows(head, "differences", _in_lines(map(asdict, comparison.differences))), "\n}\n"])
    else:
        names = ("", "") if view.quiet or output_format == "markdown" else (first.file, second.file)
        lines = difference_lines(*names, comparison, view)
        _print_lines((first.file, second.file), lines, summary_of(comparison), output_format, view)
    return FOUND if comparison.differences else DONE


def _print_matrix(decks: Sequence[Deck], tolerance: float, *, strict: bool, output_format: str, view: View) -> int:
    """Print the differences of the other decks from the first."""
    rows = diff_matrix(decks[0], decks[1:], tolerance=tolerance, strict=strict)
    names = [deck.file for deck in decks]
    if output_format == "json":
        head = {"format": MATRIX_FORMAT, "decks": names, "tolerance": tolerance}
        emit([*json_rows(head, "rows", _in_lines(map(asdict, rows))), "\n}\n"])
    elif output_format == "csv":
        emit(csv_lines([["group", "value", *names], *([row.group, row.where, *_cells(row.values)] for row in rows)]))
    elif rows:
        table = matrix_table(rows, _short(names)).first(view.most)
        view.printer().table(table)
    if output_format == "text" and not view.quiet:
        view.printer().line(f"{counted(len(rows), 'value')} differ" if rows else "no difference")
    return FOUND if rows else DONE


def _cells(values: Iterable[Value]) -> Iterator[object]:
    """Yield values for CSV: None is an empty field, several values are in brackets."""
    return (value_text(value) if isinstance(value, list) else value for value in values)


def _short(names: Sequence[str]) -> list[str]:
    """Return file names relative to their common folder."""
    folder = os.path.commonpath(names) if len({os.path.isabs(name) for name in names}) == 1 else ""  # noqa: PTH117
    return [os.path.relpath(name, folder) if folder and name != folder else name for name in names]


def _pair(before: str, after: str, stdin_name: str, units: str | None) -> tuple[Deck, Deck]:
    """Return the decks of two files; the null device, by which git denotes a missing file, is an empty deck.

    An empty deck has the units of the deck that exists.
    """
    decks = [None if path == os.devnull else GivenDeck(path, stdin_name, units).load() for path in (before, after)]
    there = next((deck.units for deck in decks if deck), units)
    empty = public(load_bytes(b"", os.devnull, form="keyword", units=there))
    first, second = (deck or empty for deck in decks)
    return first, second


def _compared(
    pairs: Sequence[DeckPair], options: tuple[float, bool, str | None], view: View, jobs: int
) -> tuple[list[ComparedDeck], int]:
    """Compare the decks of two folders, and report what fails. Return the results, and an exit code for unread files.

    A pair fails if a deck cannot be read or has errors, or if the program fails.
    """
    inputs = Inputs([Input(pair.before or pair.name, pair.before) for pair in pairs])
    due, done = iter(pairs), dict[DeckPair, ComparedDeck]()

    def prepared(_: Input) -> tuple[DeckPair, tuple[DeckPair, float, bool, str | None]]:
        pair = next(due)
        return pair, (pair, *options)

    with closing(many_files(inputs, prepared, compare_pair, view, jobs=jobs)) as results:
        for pair, deck in results:
            if deck is not None:
                done[pair] = deck
                notify_diagnostics(deck.errors)
                if deck.unread is not None:
                    inputs.fail(deck.why)
    return [
        done.get(pair) or ComparedDeck(pair.name, DeckStatus.FAILED, crash=inputs.undone[file])
        for file, pair in zip(inputs.files, pairs, strict=True)
    ], inputs.code


def _print_folders(
    folders: tuple[str, str], tolerance: float, decks: Sequence[ComparedDeck], output_format: str, view: View
) -> int:
    """Print the differences of the decks of two folders, and return the exit code."""
    counts = Counter(deck.status for deck in decks)
    if output_format == "json":
        emit(_folders_json(folders, tolerance, decks, counts))
    else:
        names = {**{status: status.value for status in DeckStatus}, DeckStatus.FAILED: _NOT_COMPARED}
        parts = [f"{counts[status]} {names[status]}" for status in DeckStatus if counts[status]]
        summary = f"{counted(len(decks), 'deck')}: {', '.join(parts)}"
        _print_lines(folders, folder_lines(decks, view), summary, output_format, view)
    return DONE if counts[DeckStatus.EQUAL] == len(decks) else FOUND


# ------------------------------------------------------------------------------------------------------------ JSON


def _in_lines(rows: Iterable[Mapping[str, object]]) -> Iterator[str]:
    """Yield each row as a line of JSON."""
    return (json.dumps(row, ensure_ascii=False, allow_nan=False) for row in rows)


def _folders_json(
    folders: tuple[str, str], tolerance: float, decks: Sequence[ComparedDeck], counts: Mapping[DeckStatus, int]
) -> Iterator[str]:
    head = {"format": FOLDER_FORMAT, "before": folders[0], "after": folders[1], "tolerance": tolerance}
    rows = (
        {
            "deck": deck.name,
            "status": deck.status.value,
            "why": deck.why or None,
            "spelling_differences": len(deck.comparison.spelling),
            "differences": [asdict(each) for each in deck.comparison.differences],
        }
        for deck in decks
    )
    yield from json_rows(head, "decks", _in_lines(rows))
    summary = {status.value: counts[status] for status in DeckStatus}
    end = {"equivalent": counts[DeckStatus.EQUAL] == len(decks), "summary": summary}
    yield "," + json.dumps(end, indent=1, ensure_ascii=False).removeprefix("{") + "\n"


# ------------------------------------------------------------------------------------------------------ for people


def _print_lines(names: tuple[str, str], lines: Iterable[Part], summary: str, output_format: str, view: View) -> None:
    """Print differences and their summary, as lines or in Markdown."""
    if output_format == "markdown":
        emit(markdown(*names, summary, lines, view))
    else:
        view.lines([line] for line in (lines if view.quiet else [*lines, summary]))


def difference_lines(before: str, after: str, comparison: Comparison, view: View) -> Iterator[Part]:
    """Yield the differences of two decks by group, below the names of the decks unless these are empty."""
    if comparison.differences and before:
        yield visible(f"--- {before}"), "bold"
        yield visible(f"+++ {after}"), "bold"
    for group, members in groupby(comparison.differences, key=lambda difference: difference.group):
        differences = list(members)
        yield visible(group), "cyan"
        if not view.verbose:
            ranges, differences = _as_ranges(group, differences)
            for kind, text in ranges:
                mark, style = _MARKS[kind]
                yield f"  {mark} {text}", style
        most = len(differences) if view.verbose else SHOWN_ROWS
        for difference in differences[:most]:
            mark, style = _MARKS[difference.kind]
            yield f"  {mark} {visible(_described(difference))}", style
        if len(differences) > most:
            yield f"  and {len(differences) - most} more (-v shows all)"


def folder_lines(decks: Iterable[ComparedDeck], view: View) -> Iterator[Part]:
    """Yield the differences of the decks of two folders."""
    for deck in decks:
        if deck.status is DeckStatus.CHANGED:
            yield from difference_lines(deck.before, deck.after, deck.comparison, view)
        elif deck.status is DeckStatus.EQUAL:
            if view.verbose:
                yield visible(f"= {deck.name}: {summary_of(deck.comparison)}")
        else:
            mark, style, words = _OF_DECKS[deck.status]
            yield visible(f"{mark} {deck.name}: {words}"), style


def summary_of(comparison: Comparison) -> str:
    """Return the number of differences, and of those of spelling."""
    count, spelling = len(comparison.differences), len(comparison.spelling)
    if not spelling:
        return counted(count, "difference") if count else "no difference"
    beside = f"{counted(spelling, 'difference')} of spelling in superseded keywords"
    return f"{counted(count, 'difference')}, and {beside} (--strict lists them)" if count else f"equivalent: {beside}"


def _as_ranges(group: str, differences: Sequence[Difference]) -> tuple[list[tuple[str, str]], list[Difference]]:
    """Return long ranges of nodes or elements that only one deck has, by kind, and the differences left."""
    listed: list[tuple[str, str]] = []
    left = list(differences)
    for kind in ("removed", "added") if group in _NUMBERED else ():
        numbers = [number for change in differences if change.kind == kind and (number := _number(change)) is not None]
        if len(numbers) >= _FEW:
            ranges = text_of(spans_of(np.array(numbers, dtype=np.int64)))
            listed.append((kind, f"{ranges}: {len(numbers)} {group}"))
            left = [change for change in left if change.kind != kind or _number(change) is None]
    return listed, left


def _number(difference: Difference) -> int | None:
    """Return the number of a node or an element; None for one with a label."""
    last = difference.where.rpartition("/")[2]
    return int(last) if last.lstrip("-").isdecimal() else None


def _described(difference: Difference) -> str:
    """Return a difference without its group: its values, and its lines in both decks as `-12 +14`."""
    if difference.kind == "changed":
        values = f": {value_text(difference.before)} -> {value_text(difference.after)}"
    else:
        value = difference.after if difference.kind == "added" else difference.before
        values = "" if value is None else f": {value_text(value)}"
    numbers = (("-", difference.before_line), ("+", difference.after_line))
    lines = " ".join(f"{side}{line}" for side, line in numbers if line is not None)
    return difference.where.removeprefix(f"{difference.group}/") + values + (f"  (line {lines})" if lines else "")


# ------------------------------------------------------------------------------------------------------------- Markdown

COMMENT_LETTERS = 60_000
"""Characters of a Markdown comment: GitHub accepts 65,536. Further lines are left out without -v."""


def markdown(before: str, after: str, summary: str, lines: Iterable[Part], view: View) -> list[str]:
    """Return a heading with both names and the result, and the lines of the text, which GitHub and GitLab colour.

    All text of a deck stands in code, where it cannot become links, mentions or HTML.
    """
    head = f"### Differences of decks\n\n{code(before)} → {code(after)}: **{summary}**\n"
    texts = [(line if isinstance(line, str) else line[0]).removeprefix("  ") for line in lines]
    sizes = accumulate(len(text) + 1 for text in texts)
    kept = len(texts) if view.verbose else sum(len(head) + size <= COMMENT_LETTERS for size in sizes)
    more = "" if kept == len(texts) else "\n*The rest does not fit here: `mudline diff -v` prints all.*\n"
    return [head, f"\n{fenced(texts[:kept])}" if texts else "", more]


def code(text: str) -> str:
    """Return a text as inline code, in marks longer than any in the text."""
    shown = visible(text)
    mark = "`" * (1 + _longest_run([shown]))
    blank = " " if "`" in shown else ""
    return f"{mark}{blank}{shown}{blank}{mark}" if shown else ""


def fenced(lines: Sequence[str]) -> str:
    """Return lines unchanged, in a fence longer than any in them."""
    fence = "`" * max(3, 1 + _longest_run(lines))
    return "\n".join([f"{fence}diff", *lines, fence, ""])


def _longest_run(lines: Sequence[str]) -> int:
    """Return the length of the longest run of backticks."""
    return max((len(run) for line in lines for run in re.findall(r"`+", line)), default=0)
