"""`mudline evaluate --summary-only`: a long series in bounded memory, a stopped run goes on."""

from __future__ import annotations

import os
from collections.abc import Generator
from contextlib import ExitStack, closing
from dataclasses import dataclass, replace
from hashlib import blake2b
from pathlib import Path
from time import monotonic

import click

from mudline.cli import DONE, FOUND
from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.evaluate_one import MOST_ROWS, notify_before, notify_slow, notify_warnings
from mudline.cli.evaluate_text import print_series
from mudline.cli.inputs import STDIN, GivenDeck, Input
from mudline.cli.known_results import plugins_in_use
from mudline.cli.result_files import form_of_file, has_library
from mudline.cli.streams import emit, notify, reason, writing
from mudline.cli.view import Progress, View, wants_bar
from mudline.contact import ContactState
from mudline.contact.tables import restored_state, state_arrays
from mudline.deck.loading import load_bytes
from mudline.files import recording_looks
from mudline.results.checkpoint import About, Checkpoint, CheckpointError, FileMark, Reached, sampled_digest
from mudline.results.evaluation import Evaluation
from mudline.results.forms import Tables, form_module, plan_rows, table_path, tables_as_text
from mudline.results.series import SeriesSummary, series_tables
from mudline.running.remembered import program, state

SAVED_EVERY = 10.0
"""Seconds between two checkpoints."""


@dataclass(frozen=True, slots=True)
class SeriesOptions:
    """How a series is summarised and where the summary goes; `chunk` is the steps of a process at a time, or None."""

    output: str | None
    table: str
    output_format: str
    spreadsheet: bool
    fail_on: str
    chunk: int | None
    jobs: int
    no_cache: bool

    def has_library(self) -> bool:
        """Whether the library for the files is installed; reports it if not. Raises click.UsageError."""
        form = form_of_file(self.output)
        return not form or has_library(form)


@dataclass(frozen=True)
class Order:
    """What is evaluated, as another process can be given it; `key` stands for all of it."""

    key: str
    file: Input
    data: bytes
    units: str | None
    positions: str
    inputs: EvaluateInputs

    def __hash__(self) -> int:
        return hash(self.key)

    def evaluation(self) -> Evaluation:
        """The deck at its positions. Raises DeckError, click.ClickException."""
        deck = load_bytes(self.data, self.file.name, units=self.units, folder=self.file.folder)
        return self.inputs.evaluation(deck, self.positions)


def evaluate_series(
    given: GivenDeck, inputs: EvaluateInputs, positions: str | None, options: SeriesOptions, view: View
) -> int:
    """Summarise a series, print or write the summary; returns the exit code.

    Raises DeckError, click.ClickException: also for the checkpoint of another run.
    """
    if not options.has_library():
        return FOUND
    if positions is None:
        raise click.UsageError("--summary-only is for time steps: give a series with --positions")
    data, name = given.content()
    file = Input(name, None if given.path == STDIN else given.path)
    order = Order("", file, data, given.units, positions, inputs)
    with recording_looks() as looked_at:
        mark = _mark(positions)
        evaluation = order.evaluation()
    if evaluation.time is None:
        raise click.UsageError(f"--summary-only is for time steps: {positions} holds one state")
    about = _about(order, [*looked_at, *([inputs.elements] if inputs.elements else [])])
    order = replace(order, key=repr(about))
    summary = SeriesSummary(evaluation)
    checkpoint = None if options.output is None else Checkpoint(Path(options.output), about)
    if not view.quiet:
        notify_before(evaluation, None)
    _Run(order, evaluation, summary, checkpoint, mark).finish(options, view)
    warnings = summary.watch.warnings()
    more = {
        "plan": plan_rows(evaluation.model.plan),
        "positions": "file",
        "warnings": [one.row() for one in warnings],
    }
    tables = replace(series_tables(summary, more), as_text=options.spreadsheet)
    written = _write(tables, options)
    if checkpoint is not None:
        checkpoint.remove()
    if not view.quiet:
        notify_warnings(warnings)
        notify_slow(evaluation, summary.slow)
        for table, path in written.items():
            notify(f"{file.name if table == 'elements' else table} -> {path.as_posix()}")
    if not written and options.output_format == "text":
        print_series(summary.step_summary(), summary.line_watch(None if view.verbose else MOST_ROWS), view)
    return FOUND if warnings and options.fail_on == "warning" else DONE


def _write(tables: Tables, options: SeriesOptions) -> dict[str, Path]:
    """Write the tables to files, or as text to standard output; the files by the names of the tables."""
    if options.output is None:
        if options.output_format != "text":
            emit(tables_as_text(tables, options.output_format, options.table))
        return {}
    path = Path(options.output)
    form = form_module(form_of_file(options.output))
    first, *others = tables.columns
    paths = {first: path, **({table: table_path(path, table) for table in others} if form.BESIDE else {})}
    with ExitStack() as stack:
        streams = [stack.enter_context(writing(one)) for one in paths.values()]
        form.write_tables(tables, streams, path.parent)
    return {**{table: paths[table] for table in paths if table != first}, first: path}


# ------------------------------------------------------------------------------------------- on what results depend


def _about(order: Order, read: list[str]) -> About:
    """What a summary depends on: a run with the same may be taken up."""
    files = sorted({os.path.abspath(path) for path in read})  # noqa: PTH100 - links stay what they are called
    try:
        positions = sampled_digest(Path(order.positions))
    except OSError as error:
        raise click.ClickException(f"{order.positions}: {reason(error)}") from error
    return {
        "mudline": _digest(program(), *(f"{path} {state(path)}" for path in plugins_in_use())),
        "the deck": _digest(order.file.name, order.data),
        "a file of the deck": _digest(*(f"{path} {state(path)}" for path in files)),
        "the positions": positions,
        "an option": _digest(repr((order.inputs, order.units))),
    }


def _digest(*parts: str | bytes) -> str:
    digest = blake2b(digest_size=16)
    for part in parts:
        data = part.encode("utf-8", "surrogatepass") if isinstance(part, str) else part
        digest.update(b"%d " % len(data) + data)
    return digest.hexdigest()


def _mark(path: str) -> FileMark:
    try:
        return FileMark.of(path)
    except OSError as error:
        raise click.ClickException(f"{path}: {reason(error)}") from error


# ---------------------------------------------------------------------------------------------------------- the run


class _Run:
    """A run over the steps of a series, which may begin where an earlier one has stopped."""

    def __init__(
        self,
        order: Order,
        evaluation: Evaluation,
        summary: SeriesSummary,
        checkpoint: Checkpoint | None,
        mark: FileMark,
    ) -> None:
        self._order, self._evaluation, self._summary = order, evaluation, summary
        self._checkpoint, self._mark = checkpoint, mark
        self._state: ContactState | None = None
        self._done = 0

    def finish(self, options: SeriesOptions, view: View) -> None:
        """Evaluate all steps that are not done yet. Raises DeckError, click.ClickException."""
        if options.no_cache and self._checkpoint is not None:
            self._checkpoint.remove()
        self._take_up(view)
        steps = self._evaluation.steps
        due = monotonic() + SAVED_EVERY
        advanced = self._advanced()
        with closing(advanced), Progress(steps - self._done, view, shown=wants_bar(view)) as progress:
            for done in advanced:
                progress.advance(done - self._done)
                self._done = done
                if _mark(self._order.positions) != self._mark:
                    what = "the file has changed while it was read: wait until it is written, and try again"
                    raise click.ClickException(f"{self._order.positions}: {what}")
                if self._checkpoint is not None and done < steps and monotonic() >= due:
                    self._save(self._checkpoint)
                    due = monotonic() + SAVED_EVERY

    def _take_up(self, view: View) -> None:
        """Go on from the checkpoint of an earlier run, if there is one."""
        if self._checkpoint is None:
            return
        path = self._checkpoint.path.as_posix()
        try:
            reached = self._checkpoint.read()
            if reached is None:
                return
            if self._evaluation.model.plan.history:
                model, nodes = self._evaluation.model, len(self._evaluation.present)
                self._state = restored_state(reached.state, model.initial_state(), nodes)
            self._summary.add(reached.kept)
        except OSError as error:
            raise click.ClickException(f"{path}: {reason(error)}") from error
        except CheckpointError as error:
            raise click.ClickException(f"{path} {error}. Delete it, or begin again with --no-cache") from error
        self._done = reached.done
        if not view.quiet:
            notify(f"goes on at step {reached.done} of {self._evaluation.steps}: {path}")

    def _save(self, checkpoint: Checkpoint) -> None:
        behind = {} if self._state is None else state_arrays(self._state)
        try:
            checkpoint.write(Reached(self._done, self._summary.arrays(), behind))
        except OSError as error:
            raise click.ClickException(f"{checkpoint.path.as_posix()}: cannot be written: {reason(error)}") from error

    def _advanced(self) -> Generator[int, None, None]:
        """The numbers of steps done so far, as they come."""
        history = self._evaluation.model.plan.history
        for part, behind in self._evaluation.resumed(range(self._done, self._evaluation.steps), self._state):
            self._summary.take(part)
            self._state = behind if history else None
            yield part.start + part.count
