"""`mudline diff`."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterator, Sequence
from dataclasses import asdict

import click

from mudline.cli import DONE, FOUND, options
from mudline.cli.diff_folders import ComparedDeck, Comparing, Folders, Status
from mudline.cli.diff_output import difference_lines, folder_lines, of_decks, of_folders, summary_of
from mudline.cli.inputs import STDIN, refuses_bad_decks
from mudline.cli.streams import emit
from mudline.cli.view import View
from mudline.comparison.model import Difference
from mudline.comparison.superseded import Comparison

FORMAT = "mudline-diff/1"
FOLDER_FORMAT = "mudline-diff-folders/1"


@click.command("diff")
@click.argument("before", metavar="A")
@click.argument("after", metavar="B")
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, max=1),
    default=0.0,
    show_default=True,
    metavar="REL",
    help="Ignore differences of numbers up to this one, relative to the larger number.",
)
@click.option("--strict", is_flag=True, help="List differences of spelling in superseded keywords too: exit code 1.")
@options.output_format("text", "json", "markdown")
@options.every_file
@options.stdin_name
@options.units
@options.common
@refuses_bad_decks
def command(
    *,
    before: str,
    after: str,
    tolerance: float,
    strict: bool,
    output_format: str,
    every_file: bool,
    stdin_name: str,
    units: str | None,
    view: View,
) -> int:
    """Compare two decks semantically, whatever their formats, layout and order; or the decks of two folders.

    A and B are decks in keyword text, JSON or YAML, of which one may be - for standard input; or folders, whose decks
    are compared in pairs of the same relative path. The exit code is 0 when all mean the same, as a deck and its
    migrated form do, and 1 when something differs, was added or removed, or a deck cannot be read.
    """
    if before == after == STDIN:
        raise click.UsageError("only one of the decks can come from standard input")
    if not math.isfinite(tolerance):
        raise click.UsageError("--tolerance: expected a number from 0 to 1")
    comparing = Comparing(tolerance, strict, units)
    folders = [os.path.isdir(path) for path in (before, after)]  # noqa: PTH112 - Path raises for a long name
    if any(folders):
        if not all(folders):
            raise click.UsageError("one of A and B is a folder, the other is not: give two decks or two folders")
        return _print_folders(Folders(before, after, comparing, not every_file), output_format, view)
    first, second = comparing.files(before, after, stdin_name)
    comparison = comparing.decks(first, second)
    if output_format == "json":
        emit(_json(first.file, second.file, tolerance, comparison))
    elif output_format == "markdown":
        emit(of_decks(first.file, second.file, comparison, view))
    else:
        view.printer().lines(difference_lines(first.file, second.file, comparison, view))
        if not view.quiet:
            view.printer().lines([summary_of(comparison)])
    return FOUND if comparison.differences else DONE


def _print_folders(folders: Folders, output_format: str, view: View) -> int:
    if output_format == "json":
        emit(_folders_json(folders))
    elif output_format == "markdown":
        emit(of_folders(folders, view))
    else:
        view.printer().lines(folder_lines(folders, view))
    return folders.code


# ------------------------------------------------------------------------------------------------------------ JSON


def _json(before: str, after: str, tolerance: float, comparison: Comparison) -> list[str]:
    """A difference on a line."""
    head = {
        "format": FORMAT,
        "before": before,
        "after": after,
        "tolerance": tolerance,
        "equivalent": not comparison.differences,
        "spelling_differences": len(comparison.spelling),
    }
    start = json.dumps(head, indent=1, ensure_ascii=False).removesuffix("\n}")
    return [start, ',\n "differences": ', *_listed(comparison.differences), "\n}\n"]


def _listed(differences: Sequence[Difference]) -> Iterator[str]:
    for i, one in enumerate(differences):
        yield f"{',' if i else '['}\n  {json.dumps(asdict(one), ensure_ascii=False, allow_nan=False)}"
    yield "\n ]" if differences else "[]"


def _folders_json(folders: Folders) -> Iterator[str]:
    """A deck on a line."""
    head = {
        "format": FOLDER_FORMAT,
        "before": folders.before,
        "after": folders.after,
        "tolerance": folders.comparing.tolerance,
    }
    yield json.dumps(head, indent=1, ensure_ascii=False).removesuffix("\n}") + ',\n "decks": ['
    comma = ""
    for one in folders.compared():
        yield f"{comma}\n  {json.dumps(_of_deck(one), ensure_ascii=False, allow_nan=False)}"
        comma = ","
    counts = {status.value: folders.counts[status] for status in Status}
    end = {"equivalent": folders.counts.total() == folders.counts[Status.EQUAL], "summary": counts}
    yield ("\n ]" if comma else "]") + "," + json.dumps(end, indent=1, ensure_ascii=False).removeprefix("{") + "\n"


def _of_deck(one: ComparedDeck) -> dict[str, object]:
    return {
        "deck": one.name,
        "status": one.status.value,
        "why": one.why or None,
        "spelling_differences": len(one.comparison.spelling),
        "differences": [asdict(each) for each in one.comparison.differences],
    }
