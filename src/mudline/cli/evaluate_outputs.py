"""Where the results of `mudline evaluate` go: files and standard output, a few steps at a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from importlib import import_module
from pathlib import Path

import click

from mudline.cli.options import View
from mudline.cli.progress import Progress, wants_bar
from mudline.cli.result_files import ResultConsumer, Sink, as_text, result_file
from mudline.cli.streams import emit, notify, notify_missing, writing
from mudline.linting.output import visible
from mudline.results.columns import ElementTable
from mudline.results.evaluation import Evaluation
from mudline.results.formats import TextForm
from mudline.results.plot_data import PlotData

PICTURES = ("png", "svg")

_PLOT = "mudline.results.evaluation_plot"
_EXTRAS = {"parquet": ("pyarrow", "parquet"), "png": ("matplotlib", "plot"), "svg": ("matplotlib", "plot")}
"""By form: the library that draws or writes it, and the extra that brings it."""


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


def run(evaluation: Evaluation, consumers: Sequence[ResultConsumer], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar and wants_bar(view)) as progress:
        for part in evaluation.parts():
            for consumer in consumers:
                consumer.take(part)
            for _ in range(part.count):
                progress.advance()
