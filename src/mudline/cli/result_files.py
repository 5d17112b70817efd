"""Files of results: their forms, the libraries that these need, and the tables next to that of the elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from functools import partial
from importlib.util import find_spec
from pathlib import Path

import click

from mudline.basics.files import suffix_of
from mudline.cli.streams import refusing, require, writing
from mudline.cli.view import View, tracked
from mudline.model.results.against import ResultComparison
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.forms import (
    FORMS,
    TABLES,
    FileContent,
    FormError,
    ResultOutput,
    ResultTables,
    Sink,
    Writer,
)
from mudline.model.results.series import SeriesSink


def is_installed(form: str) -> bool:
    """Return True if the library for a form of files is installed."""
    return not FORMS[form].library or find_spec(FORMS[form].library) is not None


def require_library(form: str) -> None:
    """End the command if the library for a form of files is missing."""
    if FORMS[form].library:
        require(f".{form}", FORMS[form].extra, FORMS[form].library)


@contextmanager
def result_files(
    evaluation: Evaluation,
    path: Path,
    view: View,
    comparison: ResultComparison | None = None,
    *,
    summary_only: bool = False,
    synced: bool = True,
) -> Iterator[Sink | SeriesSink]:
    """Open the result file of an evaluation by its suffix, or several files; they appear only when all is written.

    Files whose digest is recorded need not be `synced`, as a lost file is recognised by it. Raises click.ClickException
    if the form has no place for all rows.
    """
    with ExitStack() as stack:
        writer = partial(_writer, path, stack, view, synced=synced)
        yield SeriesSink(evaluation, writer) if summary_only else Sink(evaluation, suffix_of(path), writer, comparison)


def beside(path: Path, tables: Sequence[str] = TABLES) -> dict[str, Path]:
    """Return the files of all tables but the first next to its file, by their names; empty if one file holds all."""
    further = tables[1:] if FORMS[suffix_of(path)].separate else ()
    return {table: path.with_name(f"{path.stem}-{table}{path.suffix}") for table in further}


def write_tables(tables: ResultTables, path: Path) -> None:
    """Write tables into a file, or several. Raises click.ClickException as `result_files` does."""
    with ExitStack() as stack:
        tables.write(partial(_writer, path, stack, View(quiet=True), synced=True))


def _writer(path: Path, stack: ExitStack, view: View, contents: FileContent, *, synced: bool) -> Writer:
    """Open a file and further files next to it, which `stack` closes, and return their writer."""
    files = (path, *beside(path, [*contents.rows]).values())
    streams = [stack.enter_context(writing(file, synced=synced)) for file in files]
    output = ResultOutput(suffix_of(path), contents, streams, path.parent, stack, partial(tracked, view=view))
    with refusing(FormError, before=f"{path.as_posix()}: ", kind=click.ClickException):
        return output.writer()
