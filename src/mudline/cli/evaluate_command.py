"""`mudline evaluate`: options, the files read besides the deck, the run, where its results go, and notes about them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import replace
from functools import partial
from math import isfinite
from pathlib import Path
from types import ModuleType
from typing import TypeVar, cast

import click
import numpy as np

from mudline.cli import DONE, FOUND, options, pictures
from mudline.cli.evaluate_text import print_comparison, print_evaluation, print_plan
from mudline.cli.inputs import GivenDeck, takes_deck
from mudline.cli.pictures import Pictures
from mudline.cli.streams import MOST_REPORTED, counted, emit, emit_json, notify, notify_missing, reason, writing
from mudline.cli.view import Progress, View, tracked, wants_bar
from mudline.contact import LawKind
from mudline.contact.columns import ElementTable
from mudline.contact.result import Part
from mudline.deck.model import Deck
from mudline.diagnostics import DeckError
from mudline.quantities import csv_lines
from mudline.results.against import Comparison, read_reference
from mudline.results.evaluation import Evaluation, Prepared, Tension, evaluate_scene, prepare
from mudline.results.forms import (
    Output,
    ResultConsumer,
    Sink,
    Together,
    form_module,
    form_names,
    plan_rows,
    table_path,
    text_form,
)
from mudline.results.lines import LineWatch
from mudline.results.panels import ANIMATIONS, PICTURES
from mudline.results.plot_data import PlotData
from mudline.results.totals import StepSummary
from mudline.results.warnings import ContactWarning, ContactWatch, caption
from mudline.scene.csv_file import ExternalElements, read_external
from mudline.scene.model import Scene, resolve
from mudline.scene.positions import Positions, read_positions
from mudline.short_repr import listed_numbers

MOST_ROWS = 40
"""Lines of a table on the terminal, unless more is asked for."""

_EXTRAS = {"parquet": ("pyarrow", "parquet"), "xlsx": ("xlsxwriter", "excel")}
"""By form: the library that writes it, and the extra that brings it."""
_Read = TypeVar("_Read")


@click.command("evaluate")
@click.option("--positions", metavar="FILE", help="Positions of the nodes: CSV, NPZ or NPY, one state or time steps.")
@click.option("--time-step", type=float, metavar="DT", help="Time between the steps of positions that have no times.")
@click.option("--elements", metavar="FILE", help="Elements as CSV, for decks whose elements come from *LINES.")
@click.option(
    "--tension",
    type=click.Choice(["keep", "cut"]),
    default="keep",
    show_default=True,
    help="Where a curve is negative in contact: keep the pull, or cut force and stiffness to 0.",
)
@click.option("--against", metavar="FILE", help="Compare with another program's element results, a CSV.")
@click.option(
    "-o",
    "--output",
    metavar=f"OUT.{'|'.join(form_names())}",
    help="Write the results; CSV and Parquet write OUT-nodes and OUT-summary beside it.",
)
@click.option(
    "--plot",
    "picture",
    metavar=f"FILE.{'|'.join(PICTURES)}",
    help="Draw the results (needs the extra mudline[plot]).",
)
@pictures.options
@click.option(
    "--animate", metavar=f"FILE.{'|'.join(ANIMATIONS)}", help="Draw the steps of a series as moving pictures."
)
@click.option("--plan", "plan_only", is_flag=True, help="Print what the deck needs and what is left out, and why.")
@click.option(
    "--table",
    type=click.Choice(["elements", "nodes", "summary"]),
    default="elements",
    show_default=True,
    help="Which rows text and CSV on standard output show; a line at a step is a row of the summary.",
)
@options.spreadsheet
@click.option(
    "--fail-on",
    type=click.Choice(["error", "warning"]),
    default="error",
    show_default=True,
    help="Exit with 1 for warnings about the results too.",
)
@options.output_format("text", "json", "csv")
@takes_deck
def command(
    *,
    deck: GivenDeck,
    positions: str | None,
    time_step: float | None,
    elements: str | None,
    tension: str,
    against: str | None,
    output: str | None,
    picture: str | None,
    panels: str | None,
    plot_elements: str | None,
    animate: str | None,
    plan_only: bool,
    table: str,
    spreadsheet: bool,
    fail_on: str,
    output_format: str,
    view: View,
) -> int:
    """Evaluate contact forces and stiffnesses of a deck, at its own coordinates or at positions from a file.

    Forces are per unit length, in the deck's units; reactions are the total force of the seabed on a node.
    """
    if spreadsheet and "csv" not in (output_format, _suffix(Path(output or ""))):
        raise click.UsageError(options.CSV_ONLY)
    wanted = Pictures.asked_for(picture, animate, panels, plot_elements, option="--plot")
    if not _has_library(_form(output)) or not wanted.has_library():
        return FOUND
    loaded = deck.load()
    pull = cast("Tension", tension)
    scene = _evaluable(loaded, _read(elements, read_external) if elements else None, pull)
    placed = _positions(positions, scene, time_step) if positions else None
    if plan_only:
        _plan(prepare(scene, placed, pull), output_format, view)
        return DONE
    evaluation = evaluate_scene(scene, placed, pull)
    reference = _read(against, lambda file: read_reference(file, evaluation)) if against else None
    comparison = None if reference is None else Comparison(evaluation, reference)
    drawing = wanted.data(partial(PlotData.of_evaluation, evaluation))
    if not view.quiet:
        _notify_before(evaluation, comparison)
    shown = "" if output else output_format
    most = None if view.verbose else MOST_ROWS
    digest = StepSummary(evaluation, most, table == "nodes") if shown == "text" else None
    lines = _line_watch(evaluation, shown or _form(output), most)
    slow, watch = _SlowSuction(), ContactWatch.of(evaluation)
    given = (comparison, drawing, digest, lines, slow, watch)
    consumers: list[ResultConsumer] = [one for one in given if one is not None]
    with _sink(evaluation, comparison, output, (shown, table), view, as_text=spreadsheet) as sink:
        _run(evaluation, [*consumers, sink], view, bar=shown in {"", "text"})
        warnings = watch.warnings()
        sink.finish(_behind(evaluation, warnings, comparison, lines))
    if drawing is not None:
        wanted.draw(drawing, caption(warnings), view)
    if not view.quiet:
        _notify_warnings(warnings)
        _notify_after(evaluation, slow, watch.note(), Path(output) if output else None)
    if digest is not None and lines is not None:
        print_evaluation(digest, lines, table, view)
    if comparison is not None and output_format == "text":
        print_comparison(comparison, view)
    return FOUND if warnings and fail_on == "warning" else DONE


def _line_watch(evaluation: Evaluation, form: str, most: int | None) -> LineWatch | None:
    """What keeps the rows of lines: all for JSON, the first ones for text; other forms have a table of them."""
    if form == "json":
        return LineWatch(evaluation, None)
    return LineWatch(evaluation, most) if form == "text" else None


def _behind(
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


def _evaluable(deck: Deck, external: ExternalElements | None, pull: Tension) -> Scene:
    """The scene of a deck; raises DeckError with the causes of what keeps it from being evaluated."""
    try:
        return resolve(deck, external).require_evaluable(pull)
    except DeckError as error:
        from mudline.linting.engine import named_causes  # noqa: PLC0415 - only where the deck is refused
        from mudline.linting.registry import rules  # noqa: PLC0415 - as above

        raise DeckError(named_causes(deck, error.diagnostics, rules())) from error


def _plan(prepared: Prepared, form: str, view: View) -> None:
    rows = plan_rows(prepared.model.plan)
    if form == "json":
        emit_json({"units": prepared.scene.units, "plan": rows})
    elif form == "csv":
        emit(csv_lines([("stage", "active", "why"), *(row.values() for row in rows)]))
    else:
        print_plan(prepared.model.plan, view)


def _positions(path: str, scene: Scene, time_step: float | None) -> Positions:
    """Positions of a scene's nodes; with `time_step` those without times get them."""
    positions = _read(path, lambda file: read_positions(file, scene.nodes))
    if time_step is None:
        return positions
    if not (isfinite(time_step) and time_step > 0.0):
        raise click.UsageError(f"--time-step is {time_step!r}: it must be greater than 0")
    if positions.time is None or positions.timed:
        what = "has times of its own" if positions.timed and positions.time is not None else "is one state"
        raise click.UsageError(f"--time-step is for positions without times: {path} {what}")
    return replace(positions, time=positions.time * time_step, timed=True)


def _read(path: str, read: Callable[[Path], _Read]) -> _Read:
    try:
        return read(Path(path))
    except OSError as error:
        raise click.ClickException(f"{path}: {reason(error)}") from error


# --------------------------------------------------------------------------------------------- where the results go


def _form(output: str | None) -> str:
    """The form of a file of results by its suffix, "" without a file; raises click.UsageError."""
    if output is None:
        return ""
    form = _suffix(Path(output))
    if form not in (known := form_names()):
        forms = ", ".join(f".{name}" for name in known[:-1])
        raise click.UsageError(f"{output}: results are written as {forms} or .{known[-1]}")
    return form


def _suffix(path: Path) -> str:
    return path.suffix.lower().removeprefix(".")


def _has_library(form: str) -> bool:
    """Whether the library for a form of files is installed; reports it if not."""
    if form not in _EXTRAS:
        return True
    try:
        form_module(form)
    except ImportError:
        notify_missing(f".{form}", *_EXTRAS[form])
        return False
    return True


def _sink(
    evaluation: Evaluation,
    comparison: Comparison | None,
    output: str | None,
    shown: tuple[str, str],
    view: View,
    *,
    as_text: bool,
) -> AbstractContextManager[Sink]:
    """Where the rows go: files, standard output (a form and a table), or nowhere."""
    elements = evaluation.element_table(None if comparison is None else comparison.others)
    if output:
        return _files(evaluation, elements, Path(output), view, as_text=as_text)
    if shown[0] in {"json", "csv"}:
        tables = {"nodes": evaluation.node_table, "summary": evaluation.line_table}
        rows = tables[shown[1]]() if shown[0] == "csv" and shown[1] in tables else elements
        return nullcontext(text_form(shown[0], as_text=as_text)(evaluation, rows, emit))
    return nullcontext(Together())


@contextmanager
def _files(evaluation: Evaluation, elements: ElementTable, path: Path, view: View, *, as_text: bool) -> Iterator[Sink]:
    """The file of an evaluation by its suffix, or two files; they exist when all is written, or not at all."""
    form = form_module(_suffix(path))
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one)) for one in (path, *_beside(path, form))]
        output = Output(evaluation, elements, streams, path.parent, partial(tracked, view=view), as_text)
        yield stack.enter_context(form.opened(output))


def _beside(path: Path, form: ModuleType) -> list[Path]:
    """The files of the other tables beside that of the elements."""
    return [table_path(path, table) for table in form.BESIDE]


def _run(evaluation: Evaluation, consumers: Sequence[ResultConsumer], view: View, *, bar: bool) -> None:
    """Evaluate a few steps at a time and pass them on, with a bar on a terminal."""
    with Progress(evaluation.steps, view, shown=bar and wants_bar(view)) as progress:
        for part in evaluation.parts():
            for consumer in consumers:
                consumer.take(part)
            for _ in range(part.count):
                progress.advance()


# ----------------------------------------------------------------------------------------------------------- notes


def _notify_before(evaluation: Evaluation, comparison: Comparison | None) -> None:
    """Report what is left out, and what is guessed."""
    missing = len(evaluation.present) - len(evaluation.nodes)
    if missing:
        notify(f"no positions for {counted(missing, 'node')}: {counted(evaluation.skipped, 'element')} left out")
    if evaluation.lengths_from_positions:
        notify(f"the length of {counted(evaluation.lengths_from_positions, 'element')} comes from the first positions")
    if rigid := int((evaluation.scene.law == LawKind.RIGID).sum()):
        notify(f"{counted(rigid, 'element')} on a rigid seabed: a constraint, whose reaction is not evaluated")
    for stage, why in evaluation.model.input.left_out.items():
        notify(f"{stage}: {why}")
    if comparison is not None:
        _notify_unmatched(comparison)


class _SlowSuction:
    """Counts the steps at which suction is pulled at velocities below REGULARISATION."""

    def __init__(self) -> None:
        self.steps = 0
        self.element: int | None = None

    def take(self, part: Part) -> None:
        """Look at some steps."""
        slow = part.result.regularised
        if slow is None or not slow.any():
            return
        self.steps += int(slow.any(axis=1).sum())
        if self.element is None:
            self.element = int(np.argwhere(slow)[0, 1])


def _notify_warnings(warnings: Sequence[ContactWarning]) -> None:
    """Report what is doubtful in the results."""
    for one in warnings[:MOST_REPORTED]:
        notify(f"warning: {one}")
    if len(warnings) > MOST_REPORTED:
        notify(f"{len(warnings) - MOST_REPORTED} more warnings: JSON has all")


def _notify_after(evaluation: Evaluation, slow: _SlowSuction, note: str, written: Path | None) -> None:
    """Report which positions these are, where suction is less than its power law gives, and the files written."""
    if note:
        notify(note)
    if slow.element is not None:
        number = int(evaluation.scene.element_ids[slow.element])
        when = f"at {slow.steps} of {counted(evaluation.steps, 'step')}, element {number} first"
        notify(f"suction is pulled slower than REGULARISATION {when}: the force there is less than alpha v^n")
    if written is None:
        return
    form = form_module(_suffix(written))
    for table, file in zip(form.BESIDE, _beside(written, form), strict=True):
        notify(f"{table} -> {file.as_posix()}")
    notify(f"{evaluation.scene.deck.file} -> {written.as_posix()}")


def _notify_unmatched(comparison: Comparison) -> None:
    """Report what is in one of the results only."""
    file = comparison.reference.file
    for numbers, thing, where in (
        (comparison.reference.unknown.tolist(), "element", f"of {file} not in the deck"),
        (comparison.missing.tolist(), "evaluated element", f"not in {file}"),
        (comparison.reference.lost_times.tolist(), "time", f"of {file} not evaluated"),
        (comparison.reference.missing_times.tolist(), "evaluated time", f"not in {file}"),
    ):
        if numbers:
            notify(f"{counted(len(numbers), thing)} {where}: {listed_numbers(numbers)}")
