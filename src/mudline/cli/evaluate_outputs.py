"""Where the results of `mudline evaluate` go: files and standard output, a few steps at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
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


@dataclass(frozen=True, slots=True)
class Sink:
    """Where results are written: `take` writes some steps, `finish` what comes after the last step."""

    take: Callable[[Part], None]
    finish: Callable[[More], None]


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


def nowhere() -> Sink:
    """No output."""
    return _together([])


def printed(form: TextForm) -> Sink:
    """Standard output."""
    return _text(form, emit)


@contextmanager
def files(evaluation: Evaluation, elements: ElementTable, path: Path, view: View) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or two files; they exist when all is written, or not at all."""
    suffix, nodes = path.suffix.lower(), NodeTable(evaluation)
    with ExitStack() as opened:
        stream = opened.enter_context(writing(path))
        if suffix == ".json":
            yield _text(JsonForm(evaluation, elements), _to(stream))
        elif suffix == ".npz":
            archive = opened.enter_context(NpzFile(evaluation, [elements, nodes], path.parent))
            yield Sink(archive.take, lambda _: _pack(archive, stream, view))
        else:
            pairs = ((elements, stream), (nodes, opened.enter_context(writing(beside(path)))))
            if suffix == ".csv":
                yield _together([_text(CsvForm(evaluation, table), _to(into)) for table, into in pairs])
            else:
                make = import_module(_PARQUET).ParquetFile
                yield _together([opened.enter_context(make(evaluation, table, into)) for table, into in pairs])


def _text(form: TextForm, write: Callable[[Iterator[str]], None]) -> Sink:
    return Sink(lambda part: write(form.body(part)), lambda more: write(form.tail(more)))


def _to(stream: BinaryIO) -> Callable[[Iterator[str]], None]:
    return lambda pieces: stream.writelines(map(encoded, pieces))


def _together(consumers: Sequence[ResultConsumer]) -> Sink:
    """Several tables, which have nothing after the last step."""

    def take(part: Part) -> None:
        for consumer in consumers:
            consumer.take(part)

    return Sink(take, lambda _: None)


def _pack(archive: NpzFile, stream: BinaryIO, view: View) -> None:
    with Progress(archive.count, view, shown=wants_bar(view)) as progress:
        archive.write(stream, progress.advance)


def run(evaluation: Evaluation, consumers: Sequence[ResultConsumer], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar and wants_bar(view)) as progress:
        for part in evaluation.parts():
            for consumer in consumers:
                consumer.take(part)
            for _ in range(part.count):
                progress.advance()
