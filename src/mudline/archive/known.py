"""What an archive knows of files: whether they have changed since they were read, have moved, or are gone."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import NamedTuple

from mudline.archive.store import Archive, newest
from mudline.archive.tables import FILES, TABLES
from mudline.files import is_url
from mudline.linting.engine import LintSettings
from mudline.linting.registry import plugin_files
from mudline.resources import grammar_file
from mudline.running.remembered import changed_since, state

NEW = 2_000_000_000
"""Nanoseconds within which a second change of a file may leave its date as it is."""
_DIGEST = 16


class Looked(NamedTuple):
    """A file as it was just before it was read: its size, and its date or -1 where that is too new to trust."""

    bytes: int
    modified: int


class Entry(NamedTuple):
    """What is known of a file."""

    deck: int
    bytes: int
    modified: int
    content: str
    key: str
    depends: str


def looked(size: int, modified: int) -> Looked:
    """A file of this size and date, in ns since 1970 or -1, which was looked at just now."""
    return Looked(size, -1 if time.time_ns() - modified < NEW else modified)


def digest_of(data: bytes) -> str:
    """The digest of a file's content."""
    return blake2b(data, digest_size=_DIGEST).hexdigest()


def depends_on(looked_at: Iterable[str], path: str, began: float) -> str:
    """The files that rows depend on with what is in them now, from the deck's folder, as JSON; "" for none.

    One that has changed since a moment has a state that never holds: what was read of it is not certain.
    """
    folder = os.path.dirname(os.path.abspath(path))  # noqa: PTH100, PTH120 - links stay
    found = {}
    for one in looked_at:
        name = os.path.relpath(one, folder).replace(os.sep, "/")
        found[_escaped(name)] = "?" if changed_since(began, one) else state(one)
    return json.dumps(found, sort_keys=True) if found else ""


@cache
def program() -> str:
    """A digest of the program and its plug-ins, the same wherever they are installed."""
    digest = blake2b(sys.version.encode(), digest_size=_DIGEST)
    package = Path(__file__).parents[1]
    files = [*package.rglob("*.py"), *grammar_file("deck.lark").parent.glob("*.lark")]
    for path in sorted(files, key=lambda path: path.parts):
        digest.update(path.read_bytes())
    for file in plugin_files():
        digest.update(state(file).encode())
    return digest.hexdigest()


def start_of(settings: LintSettings) -> str:
    """A digest of the program and of the settings of a run, on which all rows depend."""
    codes = [rule.code.code for rule in settings.rules]
    severities = sorted((code, severity.value) for code, severity in settings.severities.items())
    return digest_of(repr((program(), codes, severities, settings.units, settings.dialect)).encode())


def key_of(start: str, name: str, content: str) -> str:
    """The key of a content in a file of this name, whose suffix gives form and units.

    At a URL it is another one: files beside it are not looked for.
    """
    suffix = os.path.splitext(name)[1].lower()  # noqa: PTH122 - many files
    if is_url(name):
        suffix = f"{suffix} at a URL"
    return digest_of(f"{start} {suffix} {content}".encode("utf-8", "surrogatepass"))


@dataclass
class Known:
    """The files of an archive by their path from the folder that holds it, or by their URL, and the same by key.

    `is_at_url` says whether there is something at a URL; it raises OSError where that cannot be found out.
    """

    archive: Archive
    is_at_url: Callable[[str], bool]
    files: dict[str, Entry] = field(default_factory=dict)
    by_key: dict[str, Entry] = field(default_factory=dict)
    sizes: set[int] = field(default_factory=set)
    latest: int = 0
    _root: str = ""
    _places: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._root = os.path.dirname(os.path.abspath(self.archive.folder))  # noqa: PTH100, PTH120 - links stay
        self._state = cache(state)
        rows = newest(self.archive.read(FILES.name))
        names = ("file", "deck", "bytes", "modified", "content", "key", "depends", "written")
        there = set(self.archive.read(TABLES[0].name).column("deck").to_pylist())
        for file, *values, written in zip(*(rows.column(name).to_pylist() for name in names), strict=True):
            self.latest = max(self.latest, written)
            if values[0] in there:  # else it is gone, or its batch is damaged
                self.files[file] = self.by_key[values[4]] = Entry(*values)
                self.sizes.add(values[1])

    def place(self, path: str) -> str:
        """A path from the folder that holds the archive, so that both may be moved; as it is from another drive.

        A URL is its own place.
        """
        if is_url(path):
            return _escaped(path)
        folder, name = os.path.split(path)
        if folder not in self._places:
            absolute = os.path.abspath(folder)  # noqa: PTH100 - links stay what they are called
            try:
                found = os.path.relpath(absolute, self._root).replace(os.sep, "/")
            except ValueError:
                found = absolute.replace(os.sep, "/")
            self._places[folder] = "" if found == "." else found.rstrip("/") + "/"
        return _escaped(self._places[folder] + name)

    def path(self, place: str) -> str:
        """The path of a place."""
        return os.path.normpath(os.path.join(self._root, place))  # noqa: PTH118 - many files

    def unchanged(self, place: str, path: str, now: Looked, start: str, data: bytes | None = None) -> bool:
        """Whether the rows of a file hold still under settings with this digest.

        Without its content, size and date are to be enough.
        """
        entry = self.files.get(place)
        if entry is None or entry.bytes != now.bytes:
            return False
        if data is None and (entry.modified == -1 or entry.modified != now.modified):
            return False
        content = entry.content if data is None else digest_of(data)
        return entry.key == key_of(start, path, content) and self._depends_hold(entry, path)

    def same_content(self, key: str, path: str) -> Entry | None:
        """What is known of a content that another file had, if it means the same at this path."""
        entry = self.by_key.get(key)
        return entry if entry and self._depends_hold(entry, path) else None

    def _depends_hold(self, entry: Entry, path: str) -> bool:
        if not entry.depends:
            return True
        folder = os.path.dirname(path)  # noqa: PTH120 - many files
        found = json.loads(entry.depends)
        return all(self._state(os.path.abspath(os.path.join(folder, name))) == was for name, was in found.items())  # noqa: PTH100, PTH118

    def gone(self, below: Sequence[str], seen: set[str], *, everywhere: bool) -> Iterator[str]:
        """The places of files that are no longer found below folders, or `everywhere`; not those nobody may look at."""
        starts = tuple(self._start(folder) for folder in below)
        for place in self.files:
            if place in seen:
                continue
            inside = any(place.startswith(start) if start else not _is_elsewhere(place) for start in starts)
            if not inside and not everywhere:
                continue
            try:
                is_there = self._is_there(place)
            except (OSError, ValueError):
                continue
            if inside or not is_there:
                yield place

    def _start(self, folder: str) -> str:
        if is_url(folder):
            return self.place(folder.rstrip("/") + "/")
        return self.place(os.path.join(os.path.abspath(folder), "_"))[:-1]  # noqa: PTH100, PTH118 - many files

    def _is_there(self, place: str) -> bool:
        """Raises OSError for a file that may not be looked at."""
        if is_url(place):
            return self.is_at_url(place)
        try:
            os.stat(self.path(place))  # noqa: PTH116 - many files
        except (FileNotFoundError, NotADirectoryError):
            return False
        return True


def _is_elsewhere(place: str) -> bool:
    return place.startswith("../") or is_url(place)


def _escaped(text: str) -> str:
    return text.encode("utf-8", "backslashreplace").decode()
