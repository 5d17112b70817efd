"""Decks on their way into an archive: which of them are known, reading the others, and the tables with all of them.

Rows are kept by what they were made from: a content with its form, the settings, the program, and the files that the
deck names. A file only says whose rows are its own, so that a moved or copied deck is not read again.
"""

from __future__ import annotations

import json
import os
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa
import pyarrow.compute as pc

from mudline.archive.contents import Rows, number_of, rows_of
from mudline.archive.database import write_views
from mudline.archive.store import VIEWS, Archive, escaped, table_of
from mudline.archive.tables import FILES, TABLES
from mudline.files import recording_looks
from mudline.linting.engine import LintSettings
from mudline.linting.registry import plugin_files, rules
from mudline.linting.rule import Rule
from mudline.running.remembered import changed_since, program, state

DECKS = 2000
"""Decks that have been read from which on they are written."""
SECONDS = 20.0
"""Time after which what was read is written."""
NEW = 2_000_000_000
"""Nanoseconds within which a second change of a file may leave its date as it is."""
_DIGEST = 16


class Looked(NamedTuple):
    """A file as it was just before it was read: its size, and its date or -1 where that is too new to trust."""

    bytes: int
    modified: int


def looked(size: int, modified: int) -> Looked:
    """A file of this size and date, in ns since 1970 or -1, which was looked at just now."""
    return Looked(size, -1 if time.time_ns() - modified < NEW else modified)


class Entry(NamedTuple):
    """What is known of a file: the number of its rows, and the columns of `files` behind its name."""

    deck: int
    bytes: int
    modified: int
    digest: str
    key: str
    depends: str


class Order(NamedTuple):
    """A deck to read: its place in the archive, its path, its content, and how to lint it.

    It can be sent to another process: the settings are without their rules, which `codes` names.
    """

    place: str
    path: str
    data: bytes
    now: Looked
    digest: str
    key: str
    settings: LintSettings
    codes: tuple[str, ...]


class Read(NamedTuple):
    """What a deck gave."""

    place: str
    entry: Entry
    rows: Rows


def read_deck(order: Order) -> Read:
    """Read a deck, in any process. Never raises for content."""
    began = time.time()
    path = order.path
    with recording_looks() as looked_at:
        settings = replace(order.settings, rules=_named(order.codes))
        made = rows_of(order.data, os.path.basename(path), settings, Path(path).parent)  # noqa: PTH119 - a text
    depends = _depends_on(looked_at, path, began)
    number = number_of(f"{order.key} {depends}".encode())
    return Read(order.place, Entry(number, *order.now, order.digest, order.key, depends), made)


@cache
def _named(codes: tuple[str, ...]) -> tuple[Rule, ...]:
    return tuple(rule for rule in rules() if rule.code.code in codes)


def _depends_on(looked_at: Iterable[str], path: str, began: float) -> str:
    """The files that rows depend on with what is in them now, from the deck's folder, as JSON; "" for none.

    One that has changed since a moment has a state that never holds: what was read of it is not certain.
    """
    folder = os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links stay
    found = {}
    for one in looked_at:
        name = os.path.relpath(one, folder).replace(os.sep, "/")
        found[escaped(name)] = "?" if changed_since(began, one) else state(one)
    return json.dumps(found, sort_keys=True) if found else ""


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
    """A run that brings decks into an archive. Raises ArchiveError where it cannot be read, OSError, where written."""

    archive: Archive
    counts: Counts = field(default_factory=Counts)
    damage: str = ""
    _files: dict[str, Entry] = field(default_factory=dict)
    _by_key: dict[str, Entry] = field(default_factory=dict)
    _seen: set[str] = field(default_factory=set)
    _arrived: Counter[str] = field(default_factory=Counter)
    _changes: dict[str, Entry | None] = field(default_factory=dict)
    _rows: dict[int, Rows] = field(default_factory=dict)
    _starts: dict[int, tuple[str, LintSettings, tuple[str, ...], LintSettings]] = field(default_factory=dict)
    _places: dict[str, str] = field(default_factory=dict)
    _due: float = 0.0

    def __post_init__(self) -> None:
        self._root = os.path.dirname(os.path.abspath(self.archive.folder))  # noqa: PTH100, PTH120 - links stay
        self._state = cache(state)  # many decks may continue the same one
        self.damage = self.archive.damage(thorough=True)
        self._files = {} if self.damage else _entries(self.archive)
        self._by_key = {entry.key: entry for entry in self._files.values()}
        self._due = time.monotonic() + SECONDS

    # ------------------------------------------------------------------------------------------------ what is known

    def order(self, path: str, now: Looked, read: Callable[[], bytes], settings: LintSettings) -> Order | None:
        """What is to be read of a deck, whose content `read` gives; None where its rows are known. It is counted.

        A file whose size and date are as they were is not opened. Raises OSError for one that cannot be read.
        """
        start, plain, codes, _ = self._start(settings)
        place = self._place(path)
        if place in self._seen:
            return None
        entry = self._files.get(place)
        if entry and now.modified != -1 and now == entry[1:3] and self._holds(entry, start, path, entry.digest):
            self._seen.add(place)
            self.counts.unchanged += 1
            return None
        data = read()
        self._seen.add(place)
        digest = _digest(data)
        if entry and self._holds(entry, start, path, digest):
            self.counts.unchanged += 1
            return None
        key = _key(start, path, digest)
        if entry:
            self.counts.changed += 1
        else:
            self.counts.new += 1
            self._arrived[key] += 1
        same = self._by_key.get(key)
        if same is not None and self._depends_hold(same, path):
            self._changes[place] = Entry(same.deck, *now, digest, key, same.depends)
            return None
        return Order(place, path, data, now, digest, key, plain, codes)

    def _holds(self, entry: Entry, start: str, path: str, digest: str) -> bool:
        """Whether the rows of a file are those of this content under settings with this digest."""
        return entry.key == _key(start, path, digest) and self._depends_hold(entry, path)

    def _depends_hold(self, entry: Entry, path: str) -> bool:
        if not entry.depends:
            return True
        folder = os.path.dirname(path)  # noqa: PTH120 - many files
        found = json.loads(entry.depends)
        return all(self._state(os.path.abspath(os.path.join(folder, name))) == was for name, was in found.items())  # noqa: PTH100, PTH118

    def _start(self, settings: LintSettings) -> tuple[str, LintSettings, tuple[str, ...], LintSettings]:
        """A digest of program and settings, the settings without their rules, the codes of these, and the settings."""
        found = self._starts.get(id(settings))
        if found is None:
            codes = tuple(rule.code.code for rule in settings.rules)
            severities = sorted((code, severity.value) for code, severity in settings.severities.items())
            plugins = [(path, state(path)) for path in plugin_files()]
            words = repr((program(), plugins, codes, severities, settings.units, settings.dialect))
            start = _digest(words.encode("utf-8", "backslashreplace"))
            found = self._starts[id(settings)] = (start, replace(settings, rules=()), codes, settings)
        return found

    def _place(self, path: str) -> str:
        """A path from the folder that holds the archive, so that both may be moved; as it is from another drive."""
        folder, name = os.path.split(path)
        if folder not in self._places:
            absolute = os.path.abspath(folder)  # noqa: PTH100 - links stay what they are called
            try:
                found = os.path.relpath(absolute, self._root).replace(os.sep, "/")
            except ValueError:
                found = absolute.replace(os.sep, "/")
            self._places[folder] = "" if found == "." else found.rstrip("/") + "/"
        return escaped(self._places[folder] + name)

    # --------------------------------------------------------------------------------------------- what has been read

    def take(self, read: Read) -> None:
        """Take what was read; it is written when enough has come together."""
        self._changes[read.place] = read.entry
        self._rows[read.entry.deck] = read.rows
        if len(self._rows) >= DECKS or time.monotonic() > self._due:
            self.save()

    def remove_gone(self, folders: Sequence[str], *, everywhere: bool) -> None:
        """Drop the decks that are no longer found below folders, or, `everywhere`, whose files are gone."""
        for place in self._gone(folders, everywhere=everywhere):
            key = self._files[place].key
            if self._arrived[key]:
                self._arrived[key] -= 1
                self.counts.new -= 1
                self.counts.moved += 1
            else:
                self.counts.gone += 1
            self._changes[place] = None

    def _gone(self, below: Sequence[str], *, everywhere: bool) -> Iterator[str]:
        """The places of files that are not found any more; not those that nobody may look at."""
        starts = tuple(self._place(f"{folder}/_")[:-1] for folder in below)
        for place in self._files:
            if place in self._seen:
                continue
            inside = any(place.startswith(start) if start else not place.startswith("../") for start in starts)
            if not inside and not everywhere:
                continue
            try:
                is_there = self._is_there(place)
            except (OSError, ValueError):
                continue
            if inside or not is_there:
                yield place

    def _is_there(self, place: str) -> bool:
        """Raises OSError for a file that may not be looked at."""
        try:
            os.stat(os.path.normpath(os.path.join(self._root, place)))  # noqa: PTH116, PTH118 - many files
        except (FileNotFoundError, NotADirectoryError):
            return False
        return True

    def save(self) -> None:
        """Write the tables with all that has been read; what another run has written meanwhile stays."""
        if self._changes or self.damage:
            self.archive = Archive.made(self.archive.folder)
            if self.archive.damage(thorough=False) or self.damage:
                self.archive.files = {}
            held = {place: entry for place, entry in (_entries(self.archive) | self._changes).items() if entry}
            live = pa.array(sorted({entry.deck for entry in held.values()} - self._rows.keys()), pa.int64())
            tables = {FILES.name: table_of(FILES, ((deck, place, *rest) for place, (deck, *rest) in held.items()))}
            for table in TABLES:
                before = self.archive.read(table)
                kept = before.filter(pc.is_in(before.column(0), live))
                new = ((deck, *row) for deck, made in self._rows.items() for row in made.get(table.name, ()))
                tables[table.name] = pa.concat_tables([kept, table_of(table, new)]).combine_chunks()
            self.archive.write(tables)
            write_views(self.archive)
            self._changes, self._rows, self.damage = {}, {}, ""
        elif not (self.archive.folder / VIEWS).exists():
            write_views(self.archive)
        self._due = time.monotonic() + SECONDS


def _entries(archive: Archive) -> dict[str, Entry]:
    """The files of an archive by their places."""
    rows = archive.read(FILES)
    columns = {name: rows.column(name).to_pylist() for name in rows.schema.names}
    places = columns.pop("file")
    return {place: Entry(*values) for place, *values in zip(places, *columns.values(), strict=True)}


def _digest(data: bytes) -> str:
    return blake2b(data, digest_size=_DIGEST).hexdigest()


def _key(start: str, name: str, digest: str) -> str:
    """The key of a content in a file of this name, whose suffix gives form and units."""
    suffix = os.path.splitext(name)[1].lower()  # noqa: PTH122 - many files
    return _digest(f"{start} {suffix} {digest}".encode("utf-8", "surrogatepass"))
