"""Decks linted, validated, evaluated and indexed by the workers of a cluster: what each is sent, its results in order.

The workers do what the processes of `--jobs` do, with the same functions; they read the decks themselves.
"""

from __future__ import annotations

import os
import shutil
import time
from collections import deque
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import asdict, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple

from mudline.cli import lint_run
from mudline.cli.cases import Case, MissingPositionsError, Order, PositionFiles, evaluate_case, failed
from mudline.cli.evaluate_inputs import EvaluateInputs
from mudline.cli.inputs import Input, Inputs
from mudline.cli.known_results import Kept
from mudline.cli.lint_run import Linted, Sendable, SettingsOf, Task, lint_orders, order_of
from mudline.cli.on_cluster import Keyed, OnCluster
from mudline.cli.result_files import beside
from mudline.cli.streams import reason
from mudline.cli.verdicts import Judged, Verdict, judge
from mudline.cli.view import Progress, View, wants_bar
from mudline.cluster import storage
from mudline.cluster.running import Made, Store, Work, row_of
from mudline.cluster.storage import local_copy, resolved
from mudline.diagnostics import Diagnostic
from mudline.files import is_url, recording_looks
from mudline.linting.cache import packed, unpacked
from mudline.linting.fixing import FileReport
from mudline.results.cases import CaseSummary

if TYPE_CHECKING:
    from mudline.archive.updating import Order as IndexOrder
    from mudline.archive.updating import Read, Update
    from mudline.cluster.scheduler import Scheduler

_UNREADABLE = "unreadable"
_OUTDATED = "outdated"
_CHUNKS = ".chunks-"
_RUNNING = "running"
"""A file in the folder of chunks of a run that has not ended."""
_LEFT = 86400.0
"""Seconds after which the chunks of a run are those of a killed one."""


def _as_worker_finds(file: Input, folder: str) -> Input:
    """A deck by the path that a worker can open, under the name that it is reported by."""
    return Input(file.name, resolved(file.path or "", folder))


def _packed(found: Sequence[Diagnostic]) -> dict[str, object]:
    return {"found": packed(found, {}), "of": [one.file for one in found]}


def _unpacked(result: dict[str, Any], file: str) -> list[Diagnostic]:
    found = unpacked(result["found"], file).found
    return [replace(one, file=name) for one, name in zip(found, result["of"], strict=True)]


def _read_again(inputs: Inputs, file: Input, found: Sequence[Diagnostic]) -> bytes | None:
    """The content of a deck whose lines are shown with its findings; None where it can no longer be read."""
    return inputs.content(file) if found else b""


def _in_order(
    cluster: OnCluster, command: str, work: Work, decks: Iterator[Keyed], inputs: Inputs, progress: Progress
) -> Generator[tuple[Input, dict[str, Any]], None, None]:
    """Each deck with its result, in order; those that could not be read or done are reported."""
    files = iter(inputs.files)
    with progress, closing(cluster.rows(command, work, decks, len(inputs.files), inputs)) as rows:
        for file, row in zip(files, rows, strict=True):
            if row is not None and _UNREADABLE in row.result:
                progress.hide()
                inputs.fail(f"{file.name}: {row.result[_UNREADABLE]}")
            elif row is not None:
                if row.result.get("found"):
                    progress.hide()
                yield file, row.result
            progress.advance()


# ------------------------------------------------------------------------------------------------------------- lint


class LintGiven(NamedTuple):
    """A deck for `lint_deck`, as processes are sent it, without its content; `folder` is the working folder."""

    order: lint_run.Order
    folder: str


def lint_deck(given: LintGiven) -> Made:
    """Lint a deck; run by a worker."""
    task, codes = given.order
    file = _as_worker_finds(task.file, given.folder)
    try:
        data = file.read()
    except OSError as error:
        return Made({_UNREADABLE: reason(error)}, lasting=False)
    (report,) = lint_orders([(task._replace(file=file, data=data), codes)])
    return Made(_packed(report.found), report.looked_at)


def lint_on_cluster(
    inputs: Inputs, settings_of: SettingsOf, cluster: OnCluster, view: View
) -> Generator[Linted, None, None]:
    """As `lint_all`: each file that can be read with its content and report; the content is b"" without findings."""
    progress = Progress(len(inputs.files), view, shown=wants_bar(view))
    decks = _lint_decks(inputs, settings_of)
    with closing(_in_order(cluster, "lint", lint_deck, decks, inputs, progress)) as results:
        for file, result in results:
            found = _unpacked(result, file.name)
            data = _read_again(inputs, file, found)
            if data is not None:
                yield file, data, FileReport(file.name, tuple(found))


def _lint_decks(inputs: Inputs, settings_of: SettingsOf) -> Iterator[Keyed]:
    sendable: dict[int, Sendable] = {}
    words: dict[int, str] = {}
    folder = os.getcwd()  # noqa: PTH109 - sent as text
    for file in inputs.files:
        settings = settings_of(file)
        order = order_of(Task(file, b"", settings), sendable)
        if id(settings) not in words:
            severities = sorted((code, one.value) for code, one in settings.severities.items())
            words[id(settings)] = repr((order[1], settings.units, settings.dialect, severities))
        yield file, words[id(settings)], LintGiven(order, folder)


# --------------------------------------------------------------------------------------------------------- validate


class ValidateGiven(NamedTuple):
    """A deck for `validate_deck`; `folder` is the command's working folder."""

    file: Input
    units: str | None
    verbose: bool
    folder: str


def validate_deck(given: ValidateGiven) -> Made:
    """Validate a deck; run by a worker."""
    file = _as_worker_finds(given.file, given.folder)
    try:
        data = file.read()
    except OSError as error:
        return Made({_UNREADABLE: reason(error)}, lasting=False)
    with recording_looks() as looked_at:
        verdict, found = judge(data, file, given.units, verbose=given.verbose)
    return Made({"verdict": asdict(verdict), **_packed(found)}, tuple(looked_at))


def validated_on_cluster(
    inputs: Inputs, units: str | None, cluster: OnCluster, progress: Progress, *, verbose: bool
) -> Generator[Judged, None, None]:
    """Each deck that can be read with its verdict and errors; its content is b"" without any."""
    folder = os.getcwd()  # noqa: PTH109 - sent as text
    words = repr((units, verbose))
    decks = ((file, words, ValidateGiven(file, units, verbose, folder)) for file in inputs.files)
    with closing(_in_order(cluster, "validate", validate_deck, decks, inputs, progress)) as results:
        for file, result in results:
            found = _unpacked(result, file.name)
            data = _read_again(inputs, file, found)
            if data is not None:
                yield Judged(Verdict(**result["verdict"]), found, data)


# --------------------------------------------------------------------------------------------------------- evaluate


class EvaluateGiven(NamedTuple):
    """A deck for `evaluate_deck`; `output` is the folder or URL of its results, `folder` the working folder."""

    case: Case
    placed: PositionFiles
    inputs: EvaluateInputs
    output: str | None
    units: str | None
    summary_only: bool
    folder: str


def evaluate_deck(given: EvaluateGiven) -> Made:
    """Evaluate a deck and write its results; run by a worker. Raises OSError where they cannot be written to a URL."""
    file = _as_worker_finds(given.case.file, given.folder)
    case = replace(given.case, file=file)
    try:
        data, positions = file.read(), given.placed.from_folder(given.folder).of(case)
    except OSError as error:
        return Made({_UNREADABLE: reason(error)}, lasting=False)
    except MissingPositionsError as error:
        return Made(_row(failed(file.name, _as_given(str(error), given))), lasting=False)
    elements = given.inputs.elements and resolved(given.inputs.elements, given.folder)
    with local_copy(positions) as near, local_copy(elements) as near_elements, _near(given) as output:
        inputs = replace(given.inputs, elements=near_elements)
        done = evaluate_case(Order(file, data, near, case.result, output, inputs, given.units, given.summary_only))
        copies = {near, near_elements} - {positions, elements}
        read = [os.path.abspath(path) for path in done.read if path not in copies]  # noqa: PTH100 - as `look` does
        read += [path for path in (positions, elements) if path and is_url(path)]
        written = [str(path) for path in done.written]
        if given.output and is_url(given.output) and output is not None:
            written = [_uploaded(path, output, given.output) for path in written]
    if done.kept.row.failed:
        row = _row(failed(file.name, _as_given(done.kept.row.reason or "", given)))
        return Made({**row, _OUTDATED: _files_of(case, given.output)}, lasting=False)
    return Made(_row(done.kept), (*read, *written))


def _as_given(why: str, given: EvaluateGiven) -> str:
    """A reason with paths from the working folder of the command, as they were given."""
    relative = [path for path in (given.placed.given, given.inputs.elements) if path and not Path(path).is_absolute()]
    return why.replace(f"{given.folder}{os.sep}", "") if relative else why


@contextmanager
def _near(given: EvaluateGiven) -> Iterator[str | None]:
    """The folder of results on this machine: a temporary one where they go to a URL."""
    if given.output is None or not is_url(given.output):
        yield None if given.output is None else resolved(given.output, given.folder)
        return
    with TemporaryDirectory(prefix="mudline-") as folder:
        yield folder


def _uploaded(path: str, folder: str, url: str) -> str:
    """The URL that a file of results now has."""
    target = storage.join(url, Path(path).relative_to(folder).as_posix())
    storage.write(target, Path(path).read_bytes())
    return target


def _files_of(case: Case, output: str | None) -> list[str]:
    """The files of results that a deck has if it does not fail."""
    if output is None:
        return []
    path = Path(case.result)
    return [storage.join(output, one.as_posix()) for one in (path, *beside(path).values())]


def _row(kept: Kept) -> dict[str, Any]:
    return {"row": kept.row.row(), "warnings": kept.warnings}


def evaluated_on_cluster(
    decks: Inputs, cases: Sequence[Case], given: EvaluateGiven, words: str, cluster: OnCluster
) -> Generator[Kept, None, None]:
    """The row of each case in order, as `given` says of the first; `words` are the options that results depend on.

    Files of results that a deck no longer gives are removed, unless they were changed.
    """
    before: dict[str, set[str]] | None = None
    keyed = ((case.file, f"{words} {case.result}", given._replace(case=case)) for case in cases)
    with closing(cluster.rows("evaluate", evaluate_deck, keyed, len(cases), decks)) as rows:
        for case, row in zip(cases, rows, strict=True):
            if row is None:
                yield failed(case.file.name, "not done: the reason is on standard error")
            elif (why := row.result.get(_UNREADABLE)) is not None:
                decks.fail(f"{case.file.name}: {why}")
                yield failed(case.file.name, why)
            else:
                if outdated := row.result.get(_OUTDATED):
                    before = cluster.files_before("evaluate") if before is None else before
                    _remove_unchanged(outdated, before)
                warnings = tuple((code, text) for code, text in row.result["warnings"])
                yield Kept(CaseSummary.of_row(row.result["row"]), warnings)


def _remove_unchanged(paths: Sequence[str], before: Mapping[str, set[str]]) -> None:
    for path in paths:
        marks = before.get(path) or before.get(path if is_url(path) else os.path.abspath(path), set())  # noqa: PTH100 - links stay
        if storage.mark(path) in marks - {""}:
            with suppress(OSError):
                storage.remove(path)


# ---------------------------------------------------------------------------------------------------------------- index


class IndexGiven(NamedTuple):
    """A deck for `index_deck`, without its content; `folder` is the working folder of the command."""

    file: Input
    order: IndexOrder
    folder: str


def index_deck(given: IndexGiven) -> Made:
    """Read a deck and give its tables, or why it cannot be read; run by a worker."""
    from mudline.archive.known import looked  # noqa: PLC0415 - an extra
    from mudline.archive.updating import read_decks  # noqa: PLC0415 - an extra

    path = resolved(given.order.path, given.folder)
    try:
        file = Input(given.file.name, path)
        now, data = looked(*file.size_and_date()), file.read()
    except OSError as error:
        return Made({_UNREADABLE: reason(error)}, lasting=False)
    return Made({"place": given.order.place, "tables": read_decks([given.order.having(path, data, now)]).packed()})


def index_on_cluster(inputs: Inputs, settings_of: SettingsOf, update: Update, scheduler: Scheduler, view: View) -> None:
    """Read the decks that have changed; what has come back is written, also when the run is interrupted.

    Workers leave what they read as chunks in a folder beside the batches of the archive. The command alone writes
    batches, as without a cluster, so that a chunk that is done twice is in the archive once.
    """
    from mudline.archive.updating import Read  # noqa: PLC0415 - an extra

    sent: deque[IndexGiven] = deque()
    taken: set[str] = set()
    with Progress(len(inputs.files), view, shown=wants_bar(view)) as progress, _chunks(update.archive.folder) as place:
        decks = _index_decks(inputs, settings_of, update, progress, sent)
        cluster = OnCluster(scheduler, place, verbose=view.verbose)
        try:
            with closing(cluster.rows("index", index_deck, decks, len(inputs.files), inputs)) as rows:
                for row in rows:
                    file, order, _ = sent.popleft()
                    if row is None:
                        update.not_read(order)
                    elif (why := row.result.get(_UNREADABLE)) is not None:
                        progress.hide()
                        inputs.fail(f"{file.name}: {why}")
                        update.not_read(order)
                    else:
                        taken.add(order.place)
                        update.take(Read.of_packed(row.result["tables"], 1))
                    progress.advance()
        except BaseException:
            for read in _rest(place, taken):
                update.take(read)
            update.flush()
            raise


def _rest(place: str, taken: set[str]) -> Iterator[Read]:
    """What workers have left that has not been taken: later decks may be done before earlier ones."""
    from mudline.archive.updating import Read  # noqa: PLC0415 - an extra

    for lines in Store(place).known("index").values():
        result = row_of(lines[0]).result
        if "tables" in result and result["place"] not in taken:
            yield Read.of_packed(result["tables"], 1)


def _index_decks(
    inputs: Inputs, settings_of: SettingsOf, update: Update, progress: Progress, sent: deque[IndexGiven]
) -> Iterator[Keyed]:
    """The decks that workers are to read. Only one whose size the archive knows is opened here, to compare it."""
    from mudline.archive.known import looked  # noqa: PLC0415 - an extra

    folder = os.getcwd()  # noqa: PTH109 - sent as text
    for file in inputs.files:
        path = file.path or file.name
        settings = settings_of(file)
        order = None
        try:
            now = looked(*file.size_and_date())
            if not update.is_unchanged(path, now, settings):
                if update.may_know(now):
                    order = update.order(path, file.read(), now, settings)
                else:
                    order = update.unread_order(path, now, settings)
        except OSError as error:
            progress.hide()
            inputs.fail(f"{file.name}: {reason(error)}")
        if order is None:
            progress.advance()
            continue
        sent.append(IndexGiven(file, order._replace(data=b""), folder))
        yield file, order.start, sent[-1]


@contextmanager
def _chunks(archive: Path) -> Iterator[str]:
    """A folder of the archive for the chunks of this run; it is removed with the block, and so are those left over."""
    _remove_left(archive)
    place = archive / f"{_CHUNKS}{os.urandom(8).hex()}"
    place.mkdir()  # not that of tempfile, which lets in no workers of other users
    (place / _RUNNING).touch()
    try:
        yield str(place)
    finally:
        shutil.rmtree(place, ignore_errors=True)
        _remove_left(archive)


def _remove_left(archive: Path) -> None:
    """Remove the chunks of runs that were killed, and those that a worker finished after its run had ended."""
    for folder in archive.glob(f"{_CHUNKS}*"):
        with suppress(OSError):
            is_late = not (folder / _RUNNING).exists() and any(folder.iterdir())
            if is_late or time.time() - folder.stat().st_mtime > _LEFT:
                shutil.rmtree(folder, ignore_errors=True)
