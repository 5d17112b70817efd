"""Files of results: their forms, the libraries that these need, and the tables beside that of the elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import click

from mudline.cli.streams import notify_missing, writing
from mudline.cli.view import View, tracked
from mudline.contact.columns import ElementTable
from mudline.files import suffix_of
from mudline.results.against import Comparison
from mudline.results.evaluation import Evaluation
from mudline.results.forms import Output, Sink, Tables, form_module, form_names, table_path
from mudline.results.lines import LineWatch
from mudline.results.warnings import ContactWarning

_EXTRAS = {"parquet": ("pyarrow", "parquet"), "xlsx": ("xlsxwriter", "excel")}
"""By form: the library that writes it, and the extra that brings it."""


def form_of_file(path: str | None) -> str:
    """The form of a file of results by its suffix, "" without a file; raises click.UsageError."""
    if path is None:
        return ""
    form = suffix_of(path)
    if form not in (known := form_names()):
        forms = ", ".join(f".{name}" for name in known[:-1])
        raise click.UsageError(f"{path}: unknown file format: give a name ending in {forms} or .{known[-1]}")
    return form


def is_installed(form: str) -> bool:
    """Whether the library for a form of files is installed."""
    try:
        form_module(form)
    except ImportError:
        return False
    return True


def has_library(form: str) -> bool:
    """Whether the library for a form of files is installed; reports it if not."""
    if form not in _EXTRAS or is_installed(form):
        return True
    notify_missing(f".{form}", *_EXTRAS[form])
    return False


@contextmanager
def result_files(
    evaluation: Evaluation, elements: ElementTable, path: Path, view: View, *, synced: bool = True
) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or several files; they exist when all is written, or not at all.

    Files with a digest of their content, by which a lost one is found, need not be `synced`.
    """
    form = form_module(suffix_of(path))
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one, synced=synced)) for one in (path, *beside(path).values())]
        output = Output(evaluation, elements, streams, path.parent, partial(tracked, view=view))
        yield stack.enter_context(form.opened(output))


def beside(path: Path) -> dict[str, Path]:
    """The files of the other tables beside that of the elements, by the names of the tables."""
    form = form_module(suffix_of(path))
    return {table: table_path(path, table) for table in form.BESIDE}


def write_tables(tables: Tables, path: Path) -> dict[str, Path]:
    """Write tables into a file, or several; returns those beside it by the names of the tables."""
    form = form_module(suffix_of(path))
    _, *others = tables.columns
    found = {table: table_path(path, table) for table in others} if form.BESIDE else {}
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one)) for one in (path, *found.values())]
        form.write_tables(tables, streams, path.parent)
    return found


def line_watch(evaluation: Evaluation, form: str, most: int | None) -> LineWatch | None:
    """What keeps the rows of lines: all for JSON, the first ones for text; other forms have a table of them."""
    if form == "json":
        return LineWatch(evaluation, None)
    return LineWatch(evaluation, most) if form == "text" else None


def behind(
    evaluation: Evaluation,
    warnings: Sequence[ContactWarning],
    comparison: Comparison | None,
    lines: LineWatch | None,
) -> dict[str, object]:
    """What JSON has behind the results."""
    found: dict[str, object] = {
        "summary": [] if lines is None else [row.row() for row in lines.rows],
        "positions": "deck" if evaluation.own_positions else "file",
        "warnings": [one.row() for one in warnings],
    }
    return found if comparison is None else {**found, "against": comparison.summary()}
