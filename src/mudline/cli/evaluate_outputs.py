"""Where the results of `mudline evaluate` go: files and standard output, a few steps at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import BinaryIO, Protocol, cast

import click

from mudline.cli import result_files
from mudline.cli.options import View
from mudline.cli.progress import Progress, wants_bar
from mudline.cli.streams import emit, encoded, notify, notify_missing, writing
from mudline.linting.output.visible import visible
from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.formats import TextForm
from mudline.results.plot_data import PlotData

PICTURES = ("png", "svg")

_PLOT = "mudline.results.evaluation_plot"
_EXTRAS = {"parquet": ("pyarrow", "parquet"), "png": ("matplotlib", "plot"), "svg": ("matplotlib", "plot")}
"""By form: the library that draws or writes it, and the extra that brings it."""

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


class ResultFile(Protocol):
    """The module of a form of result files.

    `SUMMARY` says in the documentation what is in it; where it is `BESIDE`, the nodes go to a second file.
    """

    SUMMARY: str
    BESIDE: bool

    def opened(
        self, evaluation: Evaluation, elements: ElementTable, streams: list[BinaryIO], folder: Path, view: View
    ) -> AbstractContextManager[Sink]:
        """Return what takes the results and writes them into one or two files of `folder`."""


@dataclass(frozen=True, slots=True)
class Written:
    """Output by two functions: for some steps, and for what comes after the last step."""

    take: Callable[[Part], None]
    finish: Callable[[More], None] = lambda _: None


def as_text(form: TextForm, write: Callable[[Iterator[str]], None]) -> Written:
    """Text, in pieces that `write` gets."""
    return Written(lambda part: write(form.body(part)), lambda more: write(form.tail(more)))


def together(consumers: Sequence[ResultConsumer]) -> Written:
    """Several tables, or none; a table has nothing after the last step."""

    def take(part: Part) -> None:
        for consumer in consumers:
            consumer.take(part)

    return Written(take)


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
    if form not in _EXTRAS:
        return True
    try:
        import_module(_PLOT) if form in PICTURES else result_file(form)
    except ImportError:
        notify_missing(f".{form}", *_EXTRAS[form])
        return False
    return True


def draw(data: PlotData, path: Path, view: View) -> None:
    """Draw the results that were collected."""
    with writing(path) as stream:
        import_module(_PLOT).draw(data, path.suffix.lower().removeprefix("."), stream, visible)
    if not view.quiet:
        notify(f"plot -> {path.as_posix()}")


def result_forms() -> list[str]:
    """Return the forms of result files, found without importing one."""
    return sorted(found.name for found in iter_modules(result_files.__path__))


def result_file(form: str) -> ResultFile:
    """Return the module of a form of result files; raises ImportError without the library that it needs."""
    return cast("ResultFile", import_module(f"{result_files.__name__}.{form}"))


def printed(form: TextForm) -> Sink:
    """Standard output."""
    return as_text(form, emit)


@contextmanager
def files(evaluation: Evaluation, elements: ElementTable, path: Path, view: View) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or two files; they exist when all is written, or not at all."""
    form = result_file(path.suffix.lower().removeprefix("."))
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one)) for one in (path, *([beside(path)] if form.BESIDE else []))]
        yield stack.enter_context(form.opened(evaluation, elements, streams, path.parent, view))


def text_into(stream: BinaryIO) -> Callable[[Iterator[str]], None]:
    """Return what writes pieces of text into a file."""
    return lambda pieces: stream.writelines(map(encoded, pieces))


def run(evaluation: Evaluation, consumers: Sequence[ResultConsumer], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar and wants_bar(view)) as progress:
        for part in evaluation.parts():
            for consumer in consumers:
                consumer.take(part)
            for _ in range(part.count):
                progress.advance()
