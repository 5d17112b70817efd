"""Decks on their way into an archive: which of them are to be read, reading them, and batches of what was read."""

from __future__ import annotations

import time
import zlib
from base64 import b64decode, b64encode
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa

from mudline.archive.chunk import ArrowTable, Chunk, schema_of, together
from mudline.archive.contents import add_deck
from mudline.archive.database import write_views
from mudline.archive.known import Known, Looked, depends_on, digest_of, key_of, start_of
from mudline.archive.store import VIEWS, Archive, compact
from mudline.archive.tables import FILES
from mudline.files import is_url, recording_looks
from mudline.linting.engine import LintSettings
from mudline.linting.registry import rules
from mudline.linting.rule import Rule

DECKS = 2000
"""Decks of a batch at most."""
BYTES = 64_000_000
"""Bytes of a batch in memory from which on it is written."""
SECONDS = 20.0
"""Time after which what was read is written."""


class Order(NamedTuple):
    """A deck to read: its place in the archive, its path, its content with size, date and key, and how to lint it.

    It can be sent to another process: the settings are without their rules, which `codes` names; `start` is their
    digest.
    """

    place: str
    path: str
    data: bytes
    now: Looked
    content: str
    key: str
    settings: LintSettings
    codes: tuple[str, ...]
    start: str

    def having(self, path: str, data: bytes, now: Looked) -> Order:
        """The same with another content, which was read from this path: size, date and key are those of it."""
        content = digest_of(data)
        return self._replace(path=path, data=data, now=now, content=content, key=key_of(self.start, path, content))


class Read(NamedTuple):
    """What some decks gave: the tables that have rows, and how many decks there are."""

    tables: dict[str, ArrowTable]
    decks: int

    def packed(self) -> dict[str, str]:
        """The tables as text by their names, for JSON."""
        return {name: _packed(table) for name, table in self.tables.items()}

    @classmethod
    def of_packed(cls, tables: dict[str, str], decks: int) -> Read:
        """Of what `packed` gave; raises ValueError for anything else."""
        return cls({name: _unpacked(text) for name, text in tables.items()}, decks)


def _packed(table: ArrowTable) -> str:
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as stream:
        stream.write_table(table)
    return b64encode(zlib.compress(sink.getvalue(), 1)).decode("ascii")


def _unpacked(text: str) -> ArrowTable:
    try:
        data = zlib.decompress(b64decode(text))
    except zlib.error as error:
        raise ValueError(str(error)) from error
    with pa.ipc.open_stream(data) as stream:
        return stream.read_all()


def read_decks(orders: Sequence[Order]) -> Read:
    """Read decks: what a process does with its part. Never raises for content."""
    chunk = Chunk()
    for one in orders:
        began = time.time()
        path = Path(one.path)
        with recording_looks() as looked_at:
            number = chunk.decks
            folder = None if is_url(one.path) else path.parent
            add_deck(chunk, one.data, path.name, replace(one.settings, rules=_named(one.codes)), folder)
        file = (one.place, *one.now, one.content, one.key, depends_on(looked_at, one.path, began), 0)
        chunk.rows[FILES.name].append((number, *file))
    return Read(chunk.finished(), chunk.decks)


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    return tuple(rule for rule in rules() if rule.code.code in codes)


@dataclass
class Counts:
    """How many decks a run has found in each state."""

    new: int = 0
    changed: int = 0
    moved: int = 0
    unchanged: int = 0
    gone: int = 0


@dataclass
class Update:
    """A run that brings decks into an archive. Raises ArchiveError for damaged files, OSError where it cannot write.

    `check` compares contents where size and date of a file are as they were, too; `is_at_url` is that of Known.
    """

    archive: Archive
    check: bool = False
    is_at_url: Callable[[str], bool] = bool
    counts: Counts = field(default_factory=Counts)
    seen: set[str] = field(default_factory=set)
    _arrived: Counter[str] = field(default_factory=Counter)
    _read: list[Read] = field(default_factory=list)
    _links: list[tuple[object, ...]] = field(default_factory=list)
    _starts: dict[int, tuple[str, LintSettings, tuple[str, ...], LintSettings]] = field(default_factory=dict)
    _decks: int = 0
    _bytes: int = 0
    _due: float = 0.0
    _wrote: bool = False

    def __post_init__(self) -> None:
        if self.check:
            self.archive.verified()
        self.known = Known(self.archive, self.is_at_url)
        self._due = time.monotonic() + SECONDS

    def is_unchanged(self, path: str, now: Looked, settings: LintSettings) -> bool:
        """Whether a deck is known as it is, by its size and date; counts it if so."""
        place = self.known.place(path)
        if self.check or not self.known.unchanged(place, path, now, self._start(settings)[0]):
            return False
        self.seen.add(place)
        self.counts.unchanged += 1
        return True

    def order(self, path: str, data: bytes, now: Looked, settings: LintSettings) -> Order | None:
        """What is to be read of a deck with this content; None where that is known. The deck is counted."""
        start, plain, codes, _ = self._start(settings)
        place = self.known.place(path)
        if place in self.seen:
            return None
        self.seen.add(place)
        if self.known.unchanged(place, path, now, start, data):
            self.counts.unchanged += 1
            return None
        content = digest_of(data)
        key = key_of(start, path, content)
        same = self.known.same_content(key, path)
        if same is not None:
            self._links.append((same.deck, place, *now, content, key, same.depends, 0))
        if place in self.known.files:
            self.counts.changed += 1
        else:
            self._arrived[key] += 1
            self.counts.new += 1
        return None if same is not None else Order(place, path, data, now, content, key, plain, codes, start)

    def may_know(self, now: Looked) -> bool:
        """Whether a file of this size may have a content that the archive has; else nobody needs to compare it."""
        return now.bytes in self.known.sizes

    def unread_order(self, path: str, now: Looked, settings: LintSettings) -> Order | None:
        """As `order`, for a file with an unknown size that others read; `not_read` is called where they cannot."""
        start, plain, codes, _ = self._start(settings)
        place = self.known.place(path)
        if place in self.seen:
            return None
        self.seen.add(place)
        if place in self.known.files:
            self.counts.changed += 1
        else:
            self.counts.new += 1
        return Order(place, path, b"", now, "", "", plain, codes, start)

    def not_read(self, order: Order) -> None:
        """Take back the count of a deck that could not be read after all; it stays as it was."""
        if order.place in self.known.files:
            self.counts.changed -= 1
        else:
            self.counts.new -= 1
            if order.key:
                self._arrived[order.key] -= 1

    def _start(self, settings: LintSettings) -> tuple[str, LintSettings, tuple[str, ...], LintSettings]:
        found = self._starts.get(id(settings))
        if found is None:
            codes = tuple(rule.code.code for rule in settings.rules)
            found = (start_of(settings), replace(settings, rules=()), codes, settings)
            self._starts[id(settings)] = found
        return found

    def take(self, read: Read) -> None:
        """Take what was read; a batch is written when enough has come together."""
        self._read.append(read)
        self._decks += read.decks
        self._bytes += sum(table.nbytes for table in read.tables.values())
        if self._decks >= DECKS or self._bytes >= BYTES or time.monotonic() > self._due:
            self.flush()

    def flush(self) -> None:
        """Write what has been taken and not yet written."""
        if self._read or self._links:
            now = self.known.latest = max(time.time_ns(), self.known.latest + 2)
            read, self._read = self._read, []
            self._decks = self._bytes = 0
            links, self._links = self._links, []
            tables = together([one.tables for one in read], [one.decks for one in read])
            if FILES.name in tables:
                tables[FILES.name] = _written(tables[FILES.name], now)
            self.archive.write(tables, _written(_rows(links), now))
            self._wrote = True
        self._due = time.monotonic() + SECONDS

    def remove_gone(self, folders: Sequence[str], *, everywhere: bool) -> None:
        """Drop the decks that are no longer found below folders, or, `everywhere`, whose files are gone."""
        for place in self.known.gone(folders, self.seen, everywhere=everywhere):
            key = self.known.files[place].key
            if self._arrived[key]:
                self._arrived[key] -= 1
                self.counts.new -= 1
                self.counts.moved += 1
            else:
                self.counts.gone += 1
            self._links.append((None, place, *[None] * 5, 0))

    def finish(self) -> None:
        """Write the rest, make small batches one, and write the views again; the archive is in order after that."""
        self.flush()
        if self._wrote:
            compact(self.archive)
        damaged = bool(self.archive.damaged)
        self.archive.drop_damaged()
        self.archive.tidy()
        if self._wrote or damaged or not (self.archive.folder / VIEWS).exists():
            write_views(self.archive)


def _rows(rows: list[tuple[object, ...]]) -> ArrowTable:
    schema = schema_of(FILES)
    columns = list(zip(*rows, strict=True)) if rows else [() for _ in schema]
    return pa.Table.from_arrays(
        [pa.array(list(column), kind.type) for column, kind in zip(columns, schema, strict=True)], schema=schema
    )


def _written(files: ArrowTable, now: int) -> ArrowTable:
    at = len(files.schema) - 1
    return files.set_column(at, files.schema.field(at), pa.array([now] * files.num_rows, pa.int64()))
