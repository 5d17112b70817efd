"""Where the results of `mudline evaluate` go: files and standard output, a few steps at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from importlib import import_module
from pathlib import Path
from typing import BinaryIO, Protocol

import click

from mudline.cli.options import View
from mudline.cli.progress import Progress, wants_bar
from mudline.cli.streams import emit, encoded, notify, notify_missing, writing
from mudline.linting.output.visible import visible
from mudline.results.columns import ElementTable, NodeTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.formats import CsvForm, JsonForm, TextForm
from mudline.results.npz_file import NpzFile
from mudline.results.plot_data import PlotData

RESULTS = ("csv", "json", "npz", "parquet")
PICTURES = ("png", "svg")
TABLES = (".csv", ".parquet")
"""Suffixes of files with one table: nodes go to a second one."""

_PARQUET = "mudline.results.parquet_file"
_PLOT = "mudline.results.evaluation_plot"
_LIBRARIES = {
    "parquet": ("pyarrow", "parquet", _PARQUET),
    "png": ("matplotlib", "plot", _PLOT),
    "svg": ("matplotlib", "plot", _PLOT),
}
"""By form: its library, the extra that brings it, and the module that needs it, which is imported when it is used."""

More = Mapping[str, object]
"""What is known only after the last step, by its key in JSON."""


class ResultConsumer(Protocol):
    """Takes the results of a few steps at a time."""

    def take(self, part: Part) -> None:
        """Take some steps."""


class Sink(ResultConsumer, Protocol):
    """A file or standard output."""

    def finish(self, more: More) -> None:
        """Write what comes after the last step."""


class Written:
    """Text of a form, passed to `write`."""

    def __init__(self, form: TextForm, write: Callable[[Iterator[str]], None]) -> None:
        self._form, self._write = form, write

    def take(self, part: Part) -> None:
        """Write some steps."""
        self._write(self._form.body(part))

    def finish(self, more: More) -> None:
        """Write the end."""
        self._write(self._form.tail(more))


class Packed:
    """An archive, packed when all results are there."""

    def __init__(self, archive: NpzFile, stream: BinaryIO, view: View) -> None:
        self._archive, self._stream, self._view = archive, stream, view

    def take(self, part: Part) -> None:
        """Keep some steps."""
        self._archive.take(part)

    def finish(self, more: More) -> None:
        """Pack the arrays; an archive has no place for more."""
        del more
        with Progress(self._archive.count, self._view, shown=wants_bar(self._view)) as progress:
            self._archive.write(self._stream, progress.advance)


class Several:
    """Two tables, each in a file of its own."""

    def __init__(self, *consumers: ResultConsumer) -> None:
        self._consumers = consumers

    def take(self, part: Part) -> None:
        """Write some steps of each."""
        for consumer in self._consumers:
            consumer.take(part)

    def finish(self, more: More) -> None:
        """A table has no place for more."""
        del more


def form_of(output: str | None, known: Sequence[str]) -> str:
    """The form of a file by its suffix, "" without a file; raises click.UsageError."""
    if output is None:
        return ""
    form = Path(output).suffix.lower().removeprefix(".")
    if form not in known:
        what = "a plot is a" if known is PICTURES else "results are written as"
        raise click.UsageError(f"{output}: {what} {', '.join(f'.{name}' for name in known[:-1])} or .{known[-1]}")
    return form


def beside(path: Path) -> Path:
    """The file of the nodes beside that of the elements."""
    return path.with_name(f"{path.stem}-nodes{path.suffix}")


def has_library(form: str) -> bool:
    """Whether the library for a form of files is installed; reports it if not."""
    if form not in _LIBRARIES:
        return True
    library, extra, module = _LIBRARIES[form]
    try:
        import_module(module)
    except ImportError:
        notify_missing(f".{form}", library, extra)
        return False
    return True


def draw(data: PlotData, path: Path, view: View) -> None:
    """Draw the results that were collected."""
    with writing(path) as stream:
        import_module(_PLOT).draw(data, path.suffix.lower().removeprefix("."), stream, visible)
    if not view.quiet:
        notify(f"plot -> {path.as_posix()}")


def printed(form: TextForm) -> Sink:
    """Standard output."""
    return Written(form, emit)


@contextmanager
def files(evaluation: Evaluation, elements: ElementTable, path: Path, view: View) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or two files; they exist when all is written, or not at all."""
    suffix, nodes = path.suffix.lower(), NodeTable(evaluation)
    with ExitStack() as opened:
        stream = opened.enter_context(writing(path))
        if suffix == ".json":
            yield Written(JsonForm(evaluation, elements), _to(stream))
        elif suffix == ".npz":
            archive = opened.enter_context(NpzFile(evaluation, [elements, nodes], path.parent))
            yield Packed(archive, stream, view)
        else:
            second = opened.enter_context(writing(beside(path)))
            pairs = ((elements, stream), (nodes, second))
            if suffix == ".csv":
                yield Several(*(Written(CsvForm(evaluation, table), _to(into)) for table, into in pairs))
            else:
                make = import_module(_PARQUET).ParquetFile
                yield Several(*(opened.enter_context(make(evaluation, table, into)) for table, into in pairs))


def _to(stream: BinaryIO) -> Callable[[Iterator[str]], None]:
    return lambda pieces: stream.writelines(map(encoded, pieces))


def run(evaluation: Evaluation, consumers: Sequence[ResultConsumer], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar and wants_bar(view)) as progress:
        for part in evaluation.parts():
            for consumer in consumers:
                consumer.take(part)
            for _ in range(part.count):
                progress.advance()
