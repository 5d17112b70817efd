"""A run over many items: sent to workers in chunks of about a second, handed back in order; what is done stays done.

A worker leaves the results of a chunk as a file, a row of JSON for each item. The file is named by a digest of its
content: a chunk that is done twice is there once, and a damaged file is none.
"""

from __future__ import annotations

import errno
import json
import math
import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from functools import cached_property
from hashlib import blake2b
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any, NamedTuple

from mudline import __version__
from mudline.cluster import storage
from mudline.cluster.scheduler import ClusterError, workers_of

if TYPE_CHECKING:
    from distributed import Client, Future

TARGET = 1.0
"""Seconds that a chunk should take: much longer than to send it, much shorter than to wait for it."""

LONGEST_ALONE = 60.0
"""Seconds after which a run without any worker ends."""

RETRIES = 2
"""Times that a chunk is tried again whose results could not be written, or whose answer was lost."""

_FIRST = 4
_LARGEST = 2000
_GROWTH = 4
_AHEAD = 3
"""Chunks for each thread of a worker that are sent ahead."""
_SUFFIX = ".jsonl"
_DIGEST = 20


# --------------------------------------------------------------------------------------------------- what a worker does


class Made(NamedTuple):
    """What work gave: anything that JSON holds, and the files on which it depends or that it has written.

    What is not `lasting`, such as that a file could not be read, is not taken over by a later run.
    """

    result: Any
    files: tuple[str, ...] = ()
    lasting: bool = True


Work = Callable[[Any], Made]
"""A function of a module, by whose name a worker finds it, of anything that can be pickled."""


class Item(NamedTuple):
    """What is to be done: its key, which two items share only if their results are equal, and what `Work` takes."""

    key: str
    given: object


class Chunk(NamedTuple):
    """Items for one worker, what to do with each, and where the results go."""

    command: str
    work: Work
    items: tuple[Item, ...]
    store: str
    version: str = __version__


class Finished(NamedTuple):
    """What travels back from a worker: the name of the file with the results, how many, and the seconds they took."""

    file: str
    rows: int
    failed: int
    seconds: float


class WrongVersionError(Exception):
    """The worker has another version of mudline than the command."""


def run_chunk(chunk: Chunk) -> Finished:
    """Do a chunk and write its results; run by a worker.

    A fault in one item is its result. Raises OSError where the results cannot be written, and WrongVersionError.
    """
    if chunk.version != __version__:
        raise WrongVersionError(f"a worker has mudline {__version__}, the command {chunk.version}")
    start = time.perf_counter()
    rows = [_row(chunk.work, item) for item in chunk.items]
    body = b"".join(json.dumps(row, separators=(",", ":")).encode("ascii") + b"\n" for row in rows)
    name = f"{chunk.command}-{_digest(body)}{_SUFFIX}"
    storage.write(storage.join(chunk.store, name), body)
    failed = sum("failed" in row for row in rows)
    return Finished(name, len(rows), failed, time.perf_counter() - start)


def _row(work: Work, item: Item) -> dict[str, object]:
    try:
        made = work(item.given)
    except Exception as error:  # noqa: BLE001 - reported as the result; the other decks of the chunk are still done
        return {"key": item.key, "failed": f"{type(error).__name__}: {error}"}
    row: dict[str, object] = {"key": item.key, "result": made.result}
    if made.files:
        row["files"] = {path: storage.mark(path) for path in made.files}
    return row if made.lasting else {**row, "once": True}


def _digest(body: bytes) -> str:
    return blake2b(body, digest_size=_DIGEST).hexdigest()


# ------------------------------------------------------------------------------------------------------------ results


class Row(NamedTuple):
    """The result of an item, or why it has none."""

    result: Any
    failed: str = ""


@dataclass(frozen=True, slots=True)
class Store:
    """The folder or URL with the files of results."""

    place: str

    def rows_of(self, name: str) -> list[bytes]:
        """The rows of a file; raises OSError, and ValueError for a file whose content is not what it was written with.

        OSError is also raised for a file that is not there.
        """
        body = storage.read(storage.join(self.place, name))
        if not name.endswith(f"-{_digest(body)}{_SUFFIX}"):
            raise ValueError(f"{storage.join(self.place, name)}: damaged: its name is not the digest of its content")
        return body.splitlines()

    def known(self, command: str) -> dict[str, tuple[bytes, ...]]:
        """The rows that earlier runs of a command left, by their keys; damaged files are passed over. Raises OSError.

        Only what still holds is worth taking over: `still_holds` says so of a row.
        """
        found: dict[str, tuple[bytes, ...]] = {}
        for name in storage.names_in(self.place):
            if name.startswith(f"{command}-") and name.endswith(_SUFFIX):
                for key, line in self._keyed(name):
                    found[key] = (*found.get(key, ()), line)
        return found

    def files(self, command: str) -> dict[str, set[str]]:
        """The files that these rows depend on or name as written, with the marks that they had then. Raises OSError."""
        found: dict[str, set[str]] = {}
        for line in (line for lines in self.known(command).values() for line in lines):
            for path, mark in json.loads(line).get("files", {}).items():
                found.setdefault(path, set()).add(mark)
        return found

    def _keyed(self, name: str) -> Iterator[tuple[str, bytes]]:
        try:
            rows = self.rows_of(name)
        except ValueError:
            return
        for line in rows:
            row = json.loads(line)
            if "failed" not in row and "once" not in row:
                yield row["key"], line


def still_holds(line: bytes) -> bool:
    """Whether the files that a row depends on or names as written are what they were."""
    files = json.loads(line).get("files", {})
    return all(storage.mark(path) == was for path, was in files.items())


def row_of(line: bytes) -> Row:
    """A row as it was written."""
    row = json.loads(line)
    return Row(row.get("result"), row.get("failed", ""))


# -------------------------------------------------------------------------------------------------------------- the run


@dataclass
class Pace:
    """How many items make a chunk, from the rate at which a thread did those before."""

    items: float = 0.0
    seconds: float = 0.0
    _last: int = _FIRST

    def took(self, items: int, seconds: float) -> None:
        """Count a chunk; older ones count less and less."""
        self.items = 0.8 * self.items + items
        self.seconds = 0.8 * self.seconds + seconds

    def size(self, left: int, threads: int) -> int:
        """Items of the next chunk: of TARGET seconds, but so few at the end that all threads end together."""
        if not self.seconds:
            return _FIRST
        wanted = TARGET * self.items / self.seconds
        share = max(left / (2 * threads), wanted / 2)
        self._last = max(1, min(math.ceil(min(wanted, share)), _LARGEST, _GROWTH * self._last))
        return self._last


@dataclass
class Job:
    """What is to be done: `count` items at most, each by `work`, of a command whose name the files of results bear.

    Rows that an earlier run left in the store are taken over unless the run is `fresh`.
    """

    command: str
    work: Work
    items: Iterable[Item]
    count: int
    store: Store
    fresh: bool = False


@dataclass(eq=False)
class _Part:
    """Items that were sent together; `finished` or `failed` once that is known, `lost` with their worker so often."""

    items: list[Item]
    future: Future[Finished] | None = None
    finished: Finished | None = None
    failed: str = ""
    lost: int = 0

    @property
    def settled(self) -> bool:
        return self.finished is not None or bool(self.failed)


@dataclass
class _Piece:
    """Items in their order, with the rows that are known; the others are in the parts."""

    known: list[bytes | None] = field(default_factory=list)
    parts: list[_Part] = field(default_factory=list)


@dataclass
class Run:
    """One job on a cluster, to which `connect` gives a client; it is called when there is something to send.

    `taken` counts the rows of an earlier run, `done` all that are finished.
    """

    connect: Callable[[], Client]
    job: Job
    address: str
    taken: int = 0
    done: int = 0
    _pace: Pace = field(default_factory=Pace)
    _queue: SimpleQueue[_Part] = field(default_factory=SimpleQueue)
    _waiting: deque[_Piece] = field(default_factory=deque)
    _flying: set[_Part] = field(default_factory=set)
    _threads: int = 1
    _alone_since: float | None = None

    @cached_property
    def client(self) -> Client:
        """The client of the cluster, which is connected when this is first asked for."""
        client = self.connect()
        self._threads = max(1, sum(workers_of(client).values()))
        return client

    def rows(self) -> Generator[Row, None, None]:
        """The row of each item, in order. Ends with what is in flight cancelled; raises ClusterError, OSError."""
        known = {} if self.job.fresh else self.job.store.known(self.job.command)
        try:
            for piece in self._pieces(known):
                self._waiting.append(piece)
                while len(self._flying) >= _AHEAD * self._threads:
                    self._settle(self._next())
                yield from self._ready()
            while self._waiting:
                if not _is_ready(self._waiting[0]):
                    self._settle(self._next())
                yield from self._ready()
        finally:
            self._cancel()

    def _pieces(self, known: dict[str, tuple[bytes, ...]]) -> Iterator[_Piece]:
        """The items in pieces that hold one chunk each, which is sent."""
        piece, wanted, orders = _Piece(), self._pace.size(self.job.count, self._threads), list[Item]()
        left = self.job.count
        for item in self.job.items:
            left -= 1
            line = next(filter(still_holds, known.get(item.key, ())), None)
            if line is not None:
                piece.known.append(line)
                self.taken += 1
            else:
                piece.known.append(None)
                orders.append(item)
            if len(orders) >= wanted or len(piece.known) >= _LARGEST:
                yield self._sent(piece, orders)
                piece, wanted, orders = _Piece(), self._pace.size(left, self._threads), []
        if piece.known:
            yield self._sent(piece, orders)

    def _sent(self, piece: _Piece, orders: list[Item]) -> _Piece:
        if orders:
            piece.parts.append(self._send(_Part(orders)))
        return piece

    def _send(self, part: _Part) -> _Part:
        chunk = Chunk(self.job.command, self.job.work, tuple(part.items), self.job.store.place)
        part.future = self.client.submit(run_chunk, chunk, pure=False, retries=RETRIES)
        self._flying.add(part)
        part.future.add_done_callback(lambda _: self._queue.put(part))
        return part

    # ------------------------------------------------------------------------------------------------ what came back

    def _next(self) -> _Part:
        """A part that is finished or has failed."""
        while True:
            try:
                return self._queue.get(timeout=1.0)
            except Empty:
                self._check_alive()

    def _check_alive(self) -> None:
        workers = {} if self.client.status != "running" else _answered(self.client)
        if workers is None or self.client.status != "running":
            raise self._gone()
        if workers:
            self._alone_since, self._threads = None, sum(workers.values())
        elif self._alone_since is None:
            self._alone_since = time.monotonic()
        elif time.monotonic() - self._alone_since > LONGEST_ALONE:
            raise ClusterError(f"{self.address}: no worker is left: start one with dask worker; {self._kept()}")

    def _gone(self) -> ClusterError:
        return ClusterError(f"{self.address}: the scheduler has gone away; {self._kept()}")

    def _kept(self) -> str:
        return f"{self.done} of {self.job.count} are done: the same command with -o goes on from there"

    def _settle(self, part: _Part) -> None:
        """Note what became of a part: halves of one that ended its workers are tried by themselves."""
        self._flying.discard(part)
        future, part.future = part.future, None
        if future is None:
            return
        if future.status == "finished":
            try:
                part.finished = future.result()
            except (OSError, CancelledError):  # of the connection
                self._send_again(part)
                return
            self.done += part.finished.rows
            self._pace.took(part.finished.rows, part.finished.seconds)
        elif future.status == "error":
            self._fail(part, future.exception())
        else:
            self._send_again(part)

    def _send_again(self, part: _Part) -> None:
        """Send a part whose answer was lost: with its worker, unless the scheduler is gone too."""
        part.lost += 1
        if part.lost > RETRIES or self.client.status != "running" or _answered(self.client) is None:
            raise self._gone()
        self._send(part)

    def _fail(self, part: _Part, error: BaseException) -> None:
        from distributed import KilledWorker  # noqa: PLC0415 - few runs use a cluster

        if not isinstance(error, KilledWorker):
            part.failed = f"{type(error).__name__}: {error}"
        elif len(part.items) == 1:
            part.failed = "each worker that tried it ended, perhaps out of memory"
        else:
            half = len(part.items) // 2
            piece = next(one for one in self._waiting if part in one.parts)
            at = piece.parts.index(part)
            piece.parts[at : at + 1] = [self._send(_Part(part.items[:half])), self._send(_Part(part.items[half:]))]

    def _ready(self) -> Iterator[Row]:
        while self._waiting and _is_ready(self._waiting[0]):
            piece = self._waiting.popleft()
            rows = (row for part in piece.parts for row in self._rows_of(part))
            for line in piece.known:
                yield row_of(line) if line is not None else next(rows)

    def _rows_of(self, part: _Part) -> Iterator[Row]:
        if part.finished is None:
            yield from (Row(None, part.failed) for _ in part.items)
            return
        try:
            lines = self.job.store.rows_of(part.finished.file)
        except OSError as error:
            if error.errno != errno.ENOENT:
                raise
            place = self.job.store.place
            message = f"{place}: a worker's results are not there: give -o a folder or URL that all machines share"
            raise ClusterError(message) from error
        yield from map(row_of, lines)

    def _cancel(self) -> None:
        futures = [part.future for part in self._flying if part.future is not None]
        if futures and self.client.status == "running":
            self.client.cancel(futures, force=True)


def _is_ready(piece: _Piece) -> bool:
    return all(part.settled for part in piece.parts)


def _answered(client: Client) -> dict[str, int] | None:
    """The workers, or None where the scheduler no longer answers."""
    try:
        return workers_of(client)
    except (OSError, TimeoutError, RuntimeError):
        return None
