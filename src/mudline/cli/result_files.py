"""Files of results: their forms, the libraries that these need, and the tables next to that of the elements."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path

import click

from mudline.basics.files import suffix_of
from mudline.cli.streams import View, require, tracked, writing
from mudline.model.results.against import ResultComparison
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.forms import (
    FORMS,
    FileContent,
    FormError,
    ResultOutput,
    ResultTables,
    Sink,
    Writer,
    contents_of,
    form_module,
    table_path,
    tables_of,
)


def is_installed(form: str) -> bool:
    """Return True if the library for a form of files is installed."""
    try:
        form_module(form)
    except ImportError:
        return False
    return True


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
    synced: bool = True,
) -> Iterator[Sink]:
    """Open the result file of an evaluation by its suffix, or several files; they appear only when all is written.

    Files whose digest is recorded need not be `synced`, as a lost file is recognised by it. Raises click.ClickException
    if the form has no place for all rows.
    """
    tables = tables_of(evaluation, suffix_of(path))
    with _opened(path, contents_of(evaluation, tables), view, synced=synced) as writer:
        yield Sink(evaluation, tables, writer, suffix_of(path), comparison)


def beside(path: Path) -> dict[str, Path]:
    """Return the files of the further tables next to that of the elements, by the names of the tables."""
    return {table: table_path(path, table) for table in FORMS[suffix_of(path)].beside}


def write_tables(tables: ResultTables, path: Path) -> dict[str, Path]:
    """Write tables into a file, or several. Return the further files by the names of their tables.

    Raises click.ClickException as `result_files` does.
    """
    with _opened(path, tables.contents, View(quiet=True), synced=True) as writer:
        tables.write(writer)
    return _further(path, tables.contents)


def _further(path: Path, contents: FileContent) -> dict[str, Path]:
    _, *others = contents.rows
    return {table: table_path(path, table) for table in others} if beside(path) else {}


@contextmanager
def _opened(path: Path, contents: FileContent, view: View, *, synced: bool) -> Iterator[Writer]:
    """Open a file and further files next to it, and yield their writer."""
    with ExitStack() as stack:
        streams = [
            stack.enter_context(writing(file, synced=synced)) for file in (path, *_further(path, contents).values())
        ]
        output = ResultOutput(suffix_of(path), contents, streams, path.parent, stack, partial(tracked, view=view))
        try:
            writer = output.writer()
        except FormError as error:
            raise click.ClickException(f"{path.as_posix()}: {error}") from error
        yield writer
