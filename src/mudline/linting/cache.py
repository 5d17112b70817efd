"""Findings kept from run to run, for decks whose content, settings and program are what they were.

The cache is a file for each working folder, whole or not at all, bounded in number and size: a head line with a digest
of the rest, then a line for each deck: its key, and its findings and the files that they depend on, if it has any.
Nothing here imports what reads decks: a run over decks that have not changed ends without it.
"""

from __future__ import annotations

import json
import os
import stat
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any, NamedTuple

from mudline.cache_folder import cache_folder
from mudline.diagnostics import Diagnostic, Edit, Fix, Severity
from mudline.files import write_atomically
from mudline.installed import metadata_folders
from mudline.linting.configuration import Configuration
from mudline.resources import grammar_file

LONGEST = 100_000
"""Letters of the findings of one deck; more of them are not kept."""

KEY = 40
"""Letters of a key."""

LARGEST_READ = 50_000_000
"""Bytes of a file that a deck names whose content is looked at in each run."""

MOST_FILES = 40
MOST_ENTRIES = 50_000
MOST_BYTES = 64_000_000
_MAGIC = b"mudline-lint-cache/3 "
_COARSE = 0.02
"""Seconds by which the date of a file may lag behind the clock."""


class Remembered(NamedTuple):
    """What is known of a deck: its findings, and the files that they depend on with what was in them."""

    found: tuple[Diagnostic, ...]
    states: dict[str, str]


def program() -> str:
    """What the program is: its version and files, and the packages beside it, which bring libraries and rules."""
    words = [sys.version]
    for root in {Path(__file__).parents[1], grammar_file("deck.lark").parent}:
        for folder, folders, names in os.walk(root):
            if "__pycache__" in folders:  # grows while the program runs: compiled modules and loops
                folders.remove("__pycache__")
            words += (_version(f"{folder}/{name}") for name in names)
    words += (_version(f"{folder}/entry_points.txt") for folder in metadata_folders())
    words.sort()
    return "\n".join(words)


def _version(path: str) -> str:
    """A file as far as its name, size and date tell what is in it."""
    try:
        found = os.stat(path)  # noqa: PTH116 - hundreds of files
    except OSError:  # not there, or inside an archive
        return path
    return f"{path} {found.st_size} {found.st_mtime_ns}"


def state(path: str) -> str:
    """What is at a path: a digest of a file's content or of the names in a folder; "" for nothing that can be read.

    What is neither, such as a pipe, is not opened: no deck is read from it. Very large files go by size and date.
    """
    digest = blake2b(digest_size=16)
    try:
        found = os.stat(path)  # noqa: PTH116 - as above
        if stat.S_ISDIR(found.st_mode):
            names = "\0".join(["", *sorted(os.listdir(path))])  # noqa: PTH208 - as above
            digest.update(names.encode("utf-8", "surrogateescape"))
        elif not stat.S_ISREG(found.st_mode):
            return ""
        elif found.st_size > LARGEST_READ:
            digest.update(_version(path).encode("utf-8", "surrogateescape"))
        else:
            with open(path, "rb") as stream:  # noqa: PTH123 - as above
                while piece := stream.read(1 << 20):
                    digest.update(piece)
    except (OSError, ValueError):  # a name that no file has
        return ""
    return digest.hexdigest()


def changed_since(moment: float, path: str) -> bool:
    """Whether a file may have changed since a moment."""
    try:
        found = os.stat(path)  # noqa: PTH116 - as above
    except (OSError, ValueError):  # still not there
        return False
    return max(found.st_mtime, found.st_ctime) > moment - _COARSE


def key(start: bytes, name: str, data: bytes) -> str:
    """The key of a file's content under settings; its name gives units and form, and is named in findings."""
    called = name.encode("utf-8", "surrogatepass")
    digest = blake2b(b"%d %d " % (len(start), len(called)), digest_size=KEY // 2)
    for part in (start, called, data):
        digest.update(part)
    return digest.hexdigest()


def packed(found: Sequence[Diagnostic], states: Mapping[str, str]) -> str:
    """Findings and states in ASCII without a line end; "" for neither. The deck's own name is left out."""
    if not (found or states):
        return ""
    return json.dumps([[_row(one) for one in found], dict(states)], separators=(",", ":"))


def unpacked(text: str, file: str) -> Remembered:
    """What `packed` wrote, for a file of that name; raises ValueError for anything else."""
    if not text:
        return Remembered((), {})
    try:
        content = json.loads(text)
    except RecursionError as error:
        raise ValueError("lists in lists without end") from error
    rows, states = _shaped(content, "**")
    if not isinstance(rows, list) or not isinstance(states, dict):
        raise ValueError("neither findings nor files")  # noqa: TRY004 - one kind of error for whatever a file holds
    if not all(isinstance(one, str) for one in states.values()):
        raise ValueError("a file in an unknown state")
    return Remembered(tuple(_finding(row, file) for row in rows), states)


def _row(one: Diagnostic) -> list[object]:
    fix = one.fix and [
        one.fix.applicability,
        one.fix.message,
        [[*edit.start, *edit.end, edit.text] for edit in one.fix.edits],
    ]
    place = (one.line, one.column, one.end_line, one.end_column)
    following = [_row(each) for each in one.following]
    return [one.code, one.slug, one.severity.value, one.message, *place, fix, one.blocks, following]


def _finding(row: object, file: str, *, follows: bool = False) -> Diagnostic:
    code, slug, severity, message, line, column, end_line, end_column, fix, blocks, rows = _shaped(row, "ssssiiii*b*")
    place = (line, column, end_line, end_column)
    repair = None if fix is None else _fix(fix)
    if not isinstance(rows, list) or (rows and follows):
        raise ValueError("no list of findings")
    following = tuple(_finding(each, file, follows=True) for each in rows)
    return Diagnostic(file, code, slug, Severity(severity), message, *place, repair, blocks, following)


def _fix(value: object) -> Fix:
    applicability, message, edits = _shaped(value, "ss*")
    if applicability not in ("safe", "unsafe") or not isinstance(edits, list):
        raise ValueError("no fix")
    rows = (_shaped(edit, "iiiis") for edit in edits)
    return Fix(applicability, message, tuple(Edit((a, b), (c, d), text) for a, b, c, d, text in rows))


def _shaped(value: object, kinds: str) -> list[Any]:
    """The list, if its items are texts (s), numbers from 1 (i), true or false (b), or anything (*) as wanted."""
    if not isinstance(value, list) or len(value) != len(kinds):
        raise ValueError("a row of another length")
    for item, kind in zip(value, kinds, strict=True):
        if (kind == "s" and not isinstance(item, str)) or (kind == "i" and not (type(item) is int and item > 0)):
            raise ValueError("an item of another kind")
        if kind == "b" and not isinstance(item, bool):
            raise ValueError("neither true nor false")
    return value


def file_of(folder: Path, place: Path) -> Path:
    """The file of the cache for runs in a working folder."""
    return folder / f"lint-{blake2b(os.fsencode(place), digest_size=16).hexdigest()}.txt"


def read_entries(path: Path) -> dict[str, str]:
    """Keys and what they hold; nothing for a file that is missing, damaged or no cache."""
    try:
        if not path.is_file() or path.stat().st_size > MOST_BYTES:
            return {}
        head, _, body = path.read_bytes().partition(b"\n")
    except OSError:
        return {}
    if head != _head(body) or not body.isascii():
        return {}
    return {line[:KEY]: line[KEY + 1 :] for line in body.decode("ascii").split("\n") if line}


def line_of(key: str, held: str) -> bytes:
    """An entry as it is in a file."""
    return f"{key} {held}\n".encode("ascii")


def write_entries(path: Path, entries: Mapping[str, str], new: bytes | bytearray = b"") -> None:
    """Replace a file of the cache by the last of the entries and the lines of new ones.

    Does nothing where that is not possible.
    """
    body = b"".join([*(line_of(*entry) for entry in entries.items()), new]) if entries else new
    start = 0
    for _ in range(body.count(b"\n") - MOST_ENTRIES):
        start = body.index(b"\n", start) + 1
    beyond = len(body) - (MOST_BYTES - 1000)
    if beyond > start:
        start = body.index(b"\n", beyond - 1) + 1
    kept = memoryview(body)[start:]
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_atomically(path, [_head(kept), b"\n", kept], synced=False)
        _drop_old(path.parent)


def _head(body: bytes | memoryview) -> bytes:
    return _MAGIC + blake2b(body, digest_size=20).hexdigest().encode("ascii")


def _drop_old(folder: Path) -> None:
    """Keep the files that were written last."""
    with os.scandir(folder) as entries:
        files = [(entry.stat().st_mtime, entry.path) for entry in entries if "lint-" in entry.name and entry.is_file()]
    for _, path in sorted(files)[:-MOST_FILES]:
        with suppress(OSError):
            Path(path).unlink()


@dataclass
class Cache:
    """What is known from runs before in a working folder, and the lines that this run adds.

    `given` is what the command line says about findings.
    """

    path: Path
    known: dict[str, str]
    given: str
    new: bytearray = field(default_factory=bytearray)
    _program: str = field(default_factory=program)
    _starts: dict[Path | None, bytes] = field(default_factory=dict)
    _state: Callable[[str], str] = field(default_factory=lambda: cache(state))
    """The state of a path, looked at once in a run: many decks continue the same one."""
    _began: float = field(default_factory=time.time)

    def key(self, name: str, data: bytes, configuration: Configuration) -> str:
        """What the findings of a file are kept under."""
        place = configuration.path
        if place not in self._starts:
            words = repr((self._program, self.given, str(place), configuration.content))
            self._starts[place] = blake2b(words.encode("utf-8", "backslashreplace")).digest()
        return key(self._starts[place], name, data)

    def get(self, key: str, name: str) -> tuple[Diagnostic, ...] | None:
        """The findings of a file, or None where they are not known or the files that they depend on have changed."""
        held = self.known.get(key)
        if held is None:
            return None
        try:
            found, states = unpacked(held, name)
        except ValueError:
            del self.known[key]
            return None
        return found if all(self._state(path) == before for path, before in states.items()) else None

    def put(self, key: str, found: Sequence[Diagnostic], looked_at: Sequence[str]) -> None:
        """Keep what was found in a file, which depends on what is at some paths.

        Nothing is kept where one of them has changed since the run began: what was read of it is not certain.
        """
        if any(changed_since(self._began, path) for path in looked_at):
            return
        held = packed(found, {path: self._state(path) for path in looked_at})
        if len(held) <= LONGEST:
            self.known.pop(key, None)
            self.new += line_of(key, held)

    def save(self) -> None:
        """Write what was added, if anything was."""
        if self.new:
            write_entries(self.path, self.known, self.new)


def opened(given: str) -> Cache | None:
    """The cache of the working folder; None where there is no place for one."""
    folder = cache_folder()
    if folder is None:
        return None
    try:
        path = file_of(folder, Path.cwd())
    except OSError:  # the working folder is gone
        return None
    return Cache(path, read_entries(path), given)
