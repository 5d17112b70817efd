"""Decks read into an archive by the workers of a cluster.

Workers leave what they read as chunks in a folder beside the batches of the archive, from which the command brings it
in: it alone writes batches, as without a cluster, so that a chunk that is done twice is in the archive once.
"""

from __future__ import annotations

import os
import shutil
import time
from collections import deque
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import NamedTuple

from mudline.archive.known import looked
from mudline.archive.updating import Order, Read, Update, read_decks
from mudline.cli.inputs import Input, Inputs
from mudline.cli.lint_run import SettingsOf
from mudline.cli.on_cluster import Keyed, OnCluster
from mudline.cli.streams import reason
from mudline.cli.view import Progress, View, wants_bar
from mudline.cluster.scheduler import Scheduler
from mudline.cluster.work import Made, Store, resolved, row_of

_CHUNKS = ".chunks-"
_RUNNING = "running"
"""A file in the folder of chunks of a run that has not ended."""
_LEFT = 86400.0
"""Seconds after which the chunks of a run are those of a killed one."""


class IndexGiven(NamedTuple):
    """A deck for `index_deck`, without its content; `folder` is the working folder of the command."""

    file: Input
    order: Order
    folder: str


def index_deck(given: IndexGiven) -> Made:
    """Read a deck and give its tables, or why it cannot be read; run by a worker."""
    path = resolved(given.order.path, given.folder)
    try:
        file = Input(given.file.name, path)
        now, data = looked(*file.size_and_date()), file.read()
    except OSError as error:
        return Made({"unreadable": reason(error)})
    return Made({"place": given.order.place, "tables": read_decks([given.order.having(path, data, now)]).packed()})


def index_on_cluster(inputs: Inputs, settings_of: SettingsOf, update: Update, scheduler: Scheduler, view: View) -> None:
    """Read the decks that have changed; what has come back is written, also when the run is interrupted."""
    sent: deque[IndexGiven] = deque()
    taken: set[str] = set()
    with Progress(len(inputs.files), view, shown=wants_bar(view)) as progress, _chunks(update.archive.folder) as place:
        decks = _decks(inputs, settings_of, update, progress, sent)
        cluster = OnCluster(scheduler, place, verbose=view.verbose)
        try:
            with closing(cluster.rows("index", index_deck, decks, len(inputs.files), inputs)) as rows:
                for row in rows:
                    file, order, _ = sent.popleft()
                    if row is None:
                        update.not_read(order)
                    elif (why := row.result.get("unreadable")) is not None:
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
    for lines in Store(place).known("index").values():
        result = row_of(lines[0]).result
        if "tables" in result and result["place"] not in taken:
            yield Read.of_packed(result["tables"], 1)


def _decks(
    inputs: Inputs, settings_of: SettingsOf, update: Update, progress: Progress, sent: deque[IndexGiven]
) -> Iterator[Keyed]:
    """The decks that workers are to read. Only one whose size the archive knows is opened here, to compare it."""
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
