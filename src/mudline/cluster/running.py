"""A run over many items: sent to workers in chunks of about a second, handed back in order; what is done stays done."""

from __future__ import annotations

import errno
import math
import time
from collections import deque
from collections.abc import Generator, Iterable, Iterator
from concurrent.futures import CancelledError
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING

from mudline.cluster.scheduler import ClusterError, workers_of
from mudline.cluster.work import Chunk, Finished, Item, Row, Store, Work, row_of, run_chunk, still_holds

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
    """One job on a cluster; `taken` counts the rows of an earlier run, `done` all that are finished."""

    client: Client
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

    def rows(self) -> Generator[Row, None, None]:
        """The row of each item, in order. Ends with what is in flight cancelled; raises ClusterError, OSError."""
        known = {} if self.job.fresh else self.job.store.known(self.job.command)
        self._threads = max(1, sum(workers_of(self.client).values()))
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
