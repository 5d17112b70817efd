"""`mudline index`: decks into an archive, in this process or in others."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator, Sequence
from contextlib import closing, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import click

from mudline.cli import DONE, WRONG_USAGE, on_cluster, options
from mudline.cli.inputs import Inputs, collect_any_form
from mudline.cli.lint_run import SettingsOf, checked_settings
from mudline.cli.processes import Effort, pays, pool, submitted
from mudline.cli.streams import counted, notify, notify_missing, reason
from mudline.cli.view import Progress, View, wants_bar
from mudline.cluster import storage
from mudline.files import is_url
from mudline.linting.configuration import Given

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from mudline.archive.updating import Order, Read, Update
    from mudline.cluster.scheduler import Scheduler

TRIED = 0.2
"""Seconds of reading by which the remaining work is estimated."""
_DECKS = 50
_BYTES = 500_000
_AHEAD = 3
"""Parts for each process that are sent ahead."""
_FIRST = 5
"""Decks that are read at a time before other processes are started."""
LIBRARIES = ("duckdb", "pyarrow")
EXTRA = "archive"


def lacks_libraries(command: str) -> bool:
    """Whether a library of the extra is not installed; that is reported."""
    missing = [name for name in LIBRARIES if find_spec(name) is None]
    if missing:
        notify_missing(f"mudline {command}", " and ".join(missing), EXTRA)
    return bool(missing)


@options.command("index")
@options.paths
@click.option("-o", "--output", required=True, metavar="ARCHIVE", help="The folder of the archive; made if missing.")
@click.option("--check", is_flag=True, help="Compare contents, of decks and of the archive, not only sizes and dates.")
@click.option("--prune", is_flag=True, help="Also drop decks outside PATHS whose files are no longer there.")
@click.option("--config", metavar="FILE", help="Use this configuration for all decks, not the nearest one of each.")
@click.option("--isolated", is_flag=True, help="Use no configuration file.")
@click.option(
    "--jobs",
    type=click.IntRange(min=0),
    default=0,
    metavar="N",
    help="Use at most N processes, when that pays; 0 (default): one for each processor.",
)
@on_cluster.options
@options.every_file
@options.units
@options.common
def command(
    *,
    paths: tuple[str, ...],
    output: str,
    check: bool,
    prune: bool,
    config: str | None,
    isolated: bool,
    jobs: int,
    scheduler: Scheduler | None,
    every_file: bool,
    units: str | None,
    view: View,
) -> int:
    """Bring decks into an archive, which mudline query answers questions about.

    PATHS are decks, or directories (searched for *.keyx, *.keyxm, *.keyxi, *.das, and for JSON and YAML files that
    begin as decks do), or URLs of either. Decks that have not changed are not read again; those that are no longer
    there are dropped. Needs pip install 'mudline[archive]'.
    """
    if lacks_libraries("index"):
        return WRONG_USAGE
    if "-" in paths:
        raise click.UsageError("standard input cannot be archived: give files or directories")
    output = _folder(output)
    inputs = collect_any_form(paths, "", gitignore=not every_file, urls=True)
    listed = inputs.code == 0
    settings = checked_settings(config, Given(units=units), "none", isolated=isolated, fail_on=None)
    from mudline.archive.store import Archive, ArchiveError  # noqa: PLC0415 - an extra
    from mudline.archive.updating import Update  # noqa: PLC0415 - an extra

    folder = Path(output)
    try:
        update = Update(Archive.made(folder), check, storage.exists)
        for problem in update.archive.damaged.values():
            notify(problem)
        if scheduler is None:
            _index(inputs, settings.of, update, Effort(jobs), view)
        else:
            from mudline.cli.cluster_decks import index_on_cluster  # noqa: PLC0415 - few runs use a cluster

            index_on_cluster(inputs, settings.of, update, scheduler, view)
        update.remove_gone(_folders(paths, listed=listed), everywhere=prune)
        update.finish()
    except ArchiveError as error:
        raise click.ClickException(str(error)) from error
    except OSError as error:
        raise click.ClickException(f"{folder.as_posix()}: cannot be written: {reason(error)}") from error
    if not view.quiet:
        _notify_counts(update, folder)
    return max(inputs.code, DONE)


def _folder(output: str) -> str:
    try:
        output = storage.as_path(output)
    except OSError as error:
        raise click.UsageError(f"-o {output}: {reason(error)}") from error
    if is_url(output):
        raise click.UsageError(f"-o {output}: an archive is a folder, not a URL: give the path of a folder")
    return output


def _folders(paths: Sequence[str], *, listed: bool) -> list[str]:
    """The folders whose decks are all known now; of those at URLs only if everything was `listed`."""
    found = []
    for path in paths:
        with suppress(OSError):
            given = storage.as_path(path)
            if (listed and storage.is_folder(given)) if is_url(given) else os.path.isdir(given):  # noqa: PTH112 - as in inputs
                found.append(given)
    return found


def _index(inputs: Inputs, settings_of: SettingsOf, update: Update, effort: Effort, view: View) -> None:
    """Read the decks that are to be read; what has been read is written, also when the run is interrupted."""
    with Progress(len(inputs.files), view, shown=wants_bar(view)) as progress:
        orders = _orders(inputs, settings_of, update, progress)
        try:
            with closing(_read(orders, inputs, effort)) as found:
                for read in found:
                    update.take(read)
        except BaseException:
            update.flush()
            raise


def _orders(inputs: Inputs, settings_of: SettingsOf, update: Update, progress: Progress) -> Iterator[Order]:
    """The decks that have changed; what cannot be read is reported, and stays in the archive as it was."""
    from mudline.archive.known import looked  # noqa: PLC0415 - an extra

    for file in inputs.files:
        path = file.path or file.name
        settings = settings_of(file)
        try:
            now = looked(*file.size_and_date())
            order = None
            if not update.is_unchanged(path, now, settings):
                order = update.order(path, file.read(), now, settings)
        except OSError as error:
            progress.hide()
            inputs.fail(f"{file.name}: {reason(error)}")
        else:
            if order is not None:
                yield order
        progress.advance()


def _read(orders: Iterator[Order], inputs: Inputs, effort: Effort) -> Generator[Read, None, None]:
    """What the decks gave, in their order. Processes are used once that pays."""
    from mudline.archive.updating import read_decks  # noqa: PLC0415 - an extra

    spent, done = 0.0, 0
    for part in _parts(orders, _FIRST):
        start = time.perf_counter()
        read = read_decks(part)
        spent, done = spent + time.perf_counter() - start, done + len(part)
        yield read
        if spent >= TRIED:
            break
    else:
        return
    if not pays(spent / done * (len(inputs.files) - done), effort):
        yield from map(read_decks, _parts(orders, _DECKS))
        return
    with pool(effort.processes, "read decks", "mudline.archive.updating") as executor:
        yield from _ahead(_parts(orders, _DECKS), executor, _AHEAD * effort.processes)


def _ahead(parts: Iterable[list[Order]], executor: Executor, most: int) -> Iterator[Read]:
    """What the parts gave in order, while the processes work on `most` of them."""
    from mudline.archive.updating import read_decks  # noqa: PLC0415 - an extra

    waiting: deque[Future[Read]] = deque()
    for part in parts:
        waiting.append(submitted(executor, read_decks, part))
        if len(waiting) > most:
            yield waiting.popleft().result()
    while waiting:
        yield waiting.popleft().result()


def _parts(orders: Iterator[Order], most: int) -> Iterator[list[Order]]:
    """Decks that are read together: few enough that no process waits long."""
    part: list[Order] = []
    size = 0
    for one in orders:
        part.append(one)
        size += len(one.data)
        if len(part) >= most or size >= _BYTES:
            yield part
            part, size = [], 0
    if part:
        yield part


def _notify_counts(update: Update, folder: Path) -> None:
    found = update.counts
    named = {"new": found.new, "changed": found.changed, "moved": found.moved, "unchanged": found.unchanged}
    words: Sequence[str] = [f"{count} {name}" for name, count in (named | {"gone": found.gone}).items() if count]
    total = counted(sum(named.values()), "deck")
    notify(f"{total}{': ' if words else ''}{', '.join(words)} -> {folder.as_posix()}")
