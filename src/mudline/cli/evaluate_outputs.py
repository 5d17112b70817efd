"""Where the results of `mudline evaluate` go: files and standard output, a few steps at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import BinaryIO, Protocol, cast

import click

from mudline.cli import result_files
from mudline.cli.lazy import drawing
from mudline.cli.options import View
from mudline.cli.progress import Progress, looked_at
from mudline.cli.streams import emit, encoded
from mudline.cli.terminal import tell
from mudline.cli.writing import writing
from mudline.linting.output.visible import visible
from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation, Part
from mudline.results.formats import TextForm
from mudline.results.plot_data import PlotData

PICTURES = ("png", "svg")

More = Mapping[str, object]
"""What is known only behind the last step, by its key in JSON."""


class Taker(Protocol):
    """Takes the results of a few steps after the other."""

    def take(self, part: Part) -> None:
        """Some steps."""


class Sink(Taker, Protocol):
    """A file or standard output."""

    def finish(self, more: More) -> None:
        """What stands behind the last step."""


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


class Written:
    """Text, written as it is spelled by `write`."""

    def __init__(self, form: TextForm, write: Callable[[Iterator[str]], None]) -> None:
        self._form, self._write = form, write

    def take(self, part: Part) -> None:
        """Write some steps."""
        self._write(self._form.body(part))

    def finish(self, more: More) -> None:
        """Write the end."""
        self._write(self._form.tail(more))


class Several:
    """Two tables, each in a file of its own."""

    def __init__(self, *takers: Taker) -> None:
        self._takers = takers

    def take(self, part: Part) -> None:
        """Write some steps of each."""
        for taker in self._takers:
            taker.take(part)

    def finish(self, more: More) -> None:
        """A table has no place for more."""
        del more


def form_of(output: str | None, known: Sequence[str]) -> str:
    """The form of a file by its suffix, "" for no file; raises click.UsageError."""
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
    """Whether the library for a form of files is there; says what to do if not."""
    if form not in _EXTRAS:
        return True
    try:
        drawing("evaluation") if form in PICTURES else result_file(form)
    except ImportError:
        library, extra = _EXTRAS[form]
        tell(f".{form} needs {library}: pip install 'mudline[{extra}]'")
        return False
    return True


def draw(data: PlotData, path: Path, view: View) -> None:
    """Draw what was gathered."""
    with writing(path) as stream:
        drawing("evaluation").draw(data, path.suffix.lower().removeprefix("."), stream, visible)
    if not view.quiet:
        tell(f"plot -> {path.as_posix()}")


def result_forms() -> list[str]:
    """Return the forms of result files, found without importing one."""
    return sorted(found.name for found in iter_modules(result_files.__path__))


def result_file(form: str) -> ResultFile:
    """Return the module of a form of result files; raises ImportError without the library that it needs."""
    return cast("ResultFile", import_module(f"{result_files.__name__}.{form}"))


_EXTRAS = {"parquet": ("pyarrow", "parquet"), "png": ("matplotlib", "plot"), "svg": ("matplotlib", "plot")}
"""By form: what draws or writes it, and the extra that brings it."""


def printed(form: TextForm) -> Sink:
    """Standard output."""
    return Written(form, emit)


@contextmanager
def files(evaluation: Evaluation, elements: ElementTable, path: Path, view: View) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or two files; they are there when all is written, or not at all."""
    form = result_file(path.suffix.lower().removeprefix("."))
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one)) for one in (path, *([beside(path)] if form.BESIDE else []))]
        yield stack.enter_context(form.opened(evaluation, elements, streams, path.parent, view))


def text_into(stream: BinaryIO) -> Callable[[Iterator[str]], None]:
    """Return what writes pieces of text into a file."""
    return lambda pieces: stream.writelines(map(encoded, pieces))


def run(evaluation: Evaluation, takers: Sequence[Taker], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and hand them on, with a bar while somebody looks on."""
    with Progress(evaluation.steps, view, shown=bar and looked_at(view)) as progress:
        for part in evaluation.parts():
            for taker in takers:
                taker.take(part)
            for _ in range(part.count):
                progress.advance()
