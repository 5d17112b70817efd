"""Many decks: evaluated here or in other processes, or taken over from an earlier run; a row for each, worst first."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

import click

from mudline.cli import DONE, FOUND
from mudline.cli.cases import (
    SUMMARY,
    Case,
    Done,
    MissingPositionsError,
    Order,
    PositionFiles,
    evaluate_case,
    failed,
    named_cases,
    print_cases,
    slashed,
)
from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.inputs import Input, Inputs
from mudline.cli.known_results import Kept, KnownResults
from mudline.cli.processes import Effort, pays, pool, submitted
from mudline.cli.result_files import is_installed
from mudline.cli.streams import MOST_REPORTED, counted, emit, emit_json, notify, reason, write_text, writing
from mudline.cli.view import Progress, View, wants_bar
from mudline.cluster import storage
from mudline.cluster.scheduler import Scheduler
from mudline.files import is_url, remove_left
from mudline.quantities import CASES, csv_lines
from mudline.results.cases import CaseSummary, worst_first, write_parquet

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

CHUNKS = ".mudline-chunks"
"""The folder below that of the results in which workers note what is done."""

TRIED = 0.05
"""Seconds of evaluating by which the remaining work is estimated."""

_AHEAD = 4
"""Decks for each process that are sent ahead."""


@dataclass(frozen=True, slots=True)
class BatchOptions:
    """The options of a run over many decks; `form` is that of the files of results in the folder `output`."""

    inputs: EvaluateInputs
    units: str | None
    output: str
    form: str
    summary_only: bool
    output_format: str
    fail_on: str
    jobs: int
    no_cache: bool
    scheduler: Scheduler | None = None


class Task(NamedTuple):
    """A deck, what is known of it, if anything, and else the order to evaluate it; `key` is its key in the folder."""

    case: Case
    key: str = ""
    order: Order | None = None
    known: Kept | None = None


def evaluate_batch(decks: Inputs, options: BatchOptions, view: View) -> int:
    """Evaluate decks, print a row for each and write their results; returns the exit code.

    Raises click.ClickException: options that fit no deck, a folder that cannot be written to.
    """
    placed = PositionFiles(options.inputs.positions)
    placed.check()
    if not decks.files:
        return decks.code
    common, cases = named_cases(_once(decks.files), options.form)
    with Progress(len(cases), view, shown=wants_bar(view)) as progress:
        evaluated = _on_cluster if options.scheduler else _here
        rows, taken = evaluated(decks, cases, placed, options, progress)
    ranked = worst_first(one.row for one in rows)
    written = _write_summary(ranked, options.output)
    if not view.quiet:
        _notify_warnings(rows)
        _notify_written(rows, taken, options.output, written)
    if options.output_format == "json":
        emit_json([row.row() for row in ranked])
    elif options.output_format == "csv":
        emit(_csv(ranked))
    else:
        print_cases(ranked, common, {case.file.name: case.inside for case in cases}, view)
    failing = any(row.failed or (row.warnings and options.fail_on == "warning") for row in ranked)
    return max(decks.code, FOUND if failing else DONE)


def _once(files: Iterable[Input]) -> list[Input]:
    """Each file once, by whatever names it was given."""
    found: dict[str, Input] = {}
    for file in files:
        found.setdefault(os.path.abspath(file.path or file.name), file)  # noqa: PTH100 - links stay what they are called
    return list(found.values())


def _spelled(options: BatchOptions) -> str:
    """The options on which results depend besides the files."""
    return repr((options.inputs, options.units, options.form, options.summary_only))


# ------------------------------------------------------------------------------------------------- evaluating decks


def _here(
    decks: Inputs, cases: Sequence[Case], placed: PositionFiles, options: BatchOptions, progress: Progress
) -> tuple[list[Kept], int]:
    """What the decks gave, evaluated on this machine, and how many were taken over from an earlier run."""
    folder = Path(options.output)
    known = KnownResults(folder, _spelled(options))
    rows: list[Kept] = []
    taken = 0
    with _folder(folder, cases, known):
        tasks = _tasks(decks, cases, placed, options, known)
        with closing(_evaluated(tasks, len(cases), Effort(options.jobs))) as results:
            for task, done in results:
                rows.append(done.kept)
                taken += task.known is not None and not done.kept.row.failed
                progress.advance()
                if task.known is None:
                    _remember(known, task, done)
    return rows, taken


def _on_cluster(
    decks: Inputs, cases: Sequence[Case], placed: PositionFiles, options: BatchOptions, progress: Progress
) -> tuple[list[Kept], int]:
    """As `_here`, evaluated by the workers of a cluster; what is done is noted below the results."""
    from mudline.cli.cluster_decks import EvaluateGiven, evaluated_on_cluster  # noqa: PLC0415 - few runs use a cluster
    from mudline.cli.on_cluster import OnCluster  # noqa: PLC0415 - as above

    if options.scheduler is None:
        raise ValueError("no scheduler is given")
    place = storage.join(options.output, CHUNKS)
    cluster = OnCluster(options.scheduler, place, options.no_cache)
    here = os.getcwd()  # noqa: PTH109 - sent as text
    given = EvaluateGiven(cases[0], placed, options.inputs, options.output, options.units, options.summary_only, here)
    rows: list[Kept] = []
    words = f"{_spelled(options)} {options.output} {placed}"
    for one in evaluated_on_cluster(decks, cases, given, words, cluster):
        rows.append(one)
        progress.advance()
    return rows, cluster.taken


def _tasks(
    decks: Inputs, cases: Sequence[Case], placed: PositionFiles, options: BatchOptions, known: KnownResults
) -> Iterator[Task]:
    """What is to do for each deck; a deck that cannot be read has failed."""
    inputs, folder = options.inputs, options.output
    for case in cases:
        try:
            data, positions = case.file.read(), placed.of(case)
        except OSError as error:
            decks.fail(f"{case.file.name}: {reason(error)}")
            yield Task(case, known=failed(case.file.name, reason(error)))
            continue
        except MissingPositionsError as error:
            yield Task(case, known=failed(case.file.name, str(error)))
            continue
        others = [path for path in (positions, inputs.elements) if path]
        key = known.key(case.file.name, data, others)
        found = None if options.no_cache else known.find(key, case.result)
        order = Order(case.file, data, positions, case.result, folder, inputs, options.units, options.summary_only)
        yield Task(case, key, order, found)


def _evaluated(tasks: Iterator[Task], count: int, effort: Effort) -> Generator[tuple[Task, Done], None, None]:
    """Each deck in its order with what it gave. Processes are used once that pays."""
    spent, done = 0.0, 0
    for number, task in enumerate(tasks):
        start = time.perf_counter()
        made = _done(task)
        if task.order is not None and task.known is None:
            spent, done = spent + time.perf_counter() - start, done + 1
        yield task, made
        if done and spent >= TRIED and pays(spent / done * (count - number - 1), effort):
            break
    else:
        return
    with pool(effort.processes, "evaluated decks", __name__) as executor:
        yield from _ahead(tasks, executor, _AHEAD * effort.processes)


def _ahead(tasks: Iterator[Task], executor: Executor, most: int) -> Iterator[tuple[Task, Done]]:
    """The decks in order, while the processes work on `most` of them."""
    waiting: deque[tuple[Task, Future[Done] | None]] = deque()
    for task in tasks:
        order = None if task.known is not None else task.order
        waiting.append((task, None if order is None else submitted(executor, evaluate_case, order)))
        if len(waiting) > most:
            first, made = waiting.popleft()
            yield first, made.result() if made else _done(first)
    for first, made in waiting:
        yield first, made.result() if made else _done(first)


def _done(task: Task) -> Done:
    if task.known is not None or task.order is None:
        return Done(task.known or failed(task.case.file.name, "not evaluated"))
    return evaluate_case(task.order)


# ----------------------------------------------------------------------------------------------------- the folder


@contextmanager
def _folder(folder: Path, cases: Sequence[Case], known: KnownResults) -> Iterator[None]:
    """The folder of results while decks are evaluated: what is done is listed, also when the run is interrupted."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise click.ClickException(f"{folder.as_posix()}: cannot be created: {reason(error)}") from error
    try:
        yield
    except BaseException:
        for place in {(folder / case.result).parent for case in cases}:
            remove_left(str(place))  # of processes that were ended
        raise
    finally:
        try:
            known.save()
        except OSError as error:
            notify(f"{folder.as_posix()}: the list of results cannot be written: {reason(error)}")


def _remember(known: KnownResults, task: Task, done: Done) -> None:
    if done.kept.row.failed:
        known.drop(task.case.result)
    else:
        known.put(task.key, task.case.result, done.kept, done.read, done.written)


def _write_summary(rows: Sequence[CaseSummary], folder: str) -> str:
    """Write the rows of all decks: in Parquet where that is installed, else as CSV. Returns the path or the URL."""
    if is_url(folder):
        with TemporaryDirectory(prefix="mudline-") as near:
            path = Path(_write_summary(rows, near))
            target = storage.join(folder, path.name)
            try:
                storage.write(target, path.read_bytes())
            except OSError as error:
                raise click.ClickException(f"{target}: cannot be written: {reason(error)}") from error
        return target
    if is_installed("parquet"):
        path = Path(folder, f"{SUMMARY}.parquet")
        with writing(path) as stream:
            write_parquet(rows, stream)
    else:
        path = Path(folder, f"{SUMMARY}.csv")
        write_text(path, _csv(rows))
    return path.as_posix()


def _csv(rows: Sequence[CaseSummary]) -> Iterator[str]:
    return csv_lines([CASES, *(row.row().values() for row in rows)])


# ---------------------------------------------------------------------------------------------------------- notes


def _notify_warnings(rows: Sequence[Kept]) -> None:
    """Report each warning once, with the first deck that has it and how many others do."""
    decks: dict[str, list[str]] = {}
    for one in rows:
        for code, text in dict(one.warnings).items():
            decks.setdefault(code, []).append(text)
    for texts in list(decks.values())[:MOST_REPORTED]:
        more = f" ({counted(len(texts) - 1, 'more deck')})" if len(texts) > 1 else ""
        notify(f"warning: {texts[0]}{more}")


def _notify_written(rows: Sequence[Kept], taken: int, folder: str | None, summary: str | None) -> None:
    """Report how many results were taken over, and where they are."""
    if folder is None or summary is None:
        return
    done = sum(not one.row.failed for one in rows)
    notify(f"results of {counted(done, 'deck')} -> {slashed(folder)}, {taken} taken over from an earlier run")
    notify(f"summary -> {summary}")
