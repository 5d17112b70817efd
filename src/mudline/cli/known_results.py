"""Results that an earlier run has written into a folder: taken over while nothing has changed that they depend on.

A file in the folder lists them: a key of deck, options and program, the other files that were read, and the files that
were written, with a digest of each. A list or a file that is damaged is as good as none.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any, NamedTuple

from mudline.diagnostics import PluginError
from mudline.files import write_atomically
from mudline.linting.registry import plugin_files
from mudline.results.cases import CaseSummary
from mudline.running.remembered import changed_since, program, state

LIST = ".mudline-results.json"
_FORMAT = "mudline-results/1"
KEY = 40
"""Letters of a key."""


class Kept(NamedTuple):
    """The row of a deck, and its warnings: the code and the whole text of each."""

    row: CaseSummary
    warnings: tuple[tuple[str, str], ...]


class KnownResults:
    """The list of a folder; `options` are those on which results depend besides the files."""

    def __init__(self, folder: Path, options: str) -> None:
        self._folder, self._path = folder, folder / LIST
        self._entries = _read(self._path)
        self._began = time.time()
        self._state = cache(state)  # many decks may read the same file
        start = blake2b(digest_size=KEY)
        for part in (program(), options):
            start.update(part.encode("utf-8", "surrogateescape"))
        for path in plugins_in_use():
            start.update(f"{path} {state(path)}".encode("utf-8", "surrogateescape"))
        self._start = start.digest()

    def key(self, name: str, data: bytes, others: Iterable[str]) -> str:
        """The key of a deck with this name and content, evaluated with other files whose names these are."""
        digest = blake2b(self._start, digest_size=KEY // 2)
        for text in (name, *map(self._relative, others)):
            digest.update(f"{len(text)} {text}".encode("utf-8", "surrogatepass"))
        digest.update(data)
        return digest.hexdigest()

    def find(self, key: str, result: str) -> Kept | None:
        """What is known of a deck, if its files are still there as they were written."""
        entry = self._entries.get(result)
        if entry is None or entry.get("key") != key:
            return None
        try:
            if any(self._state(self._absolute(path)) != was for path, was in entry["read"].items()):
                return None
            if any(state(self._absolute(path)) != was for path, was in entry["written"].items()):
                return None
            return Kept(CaseSummary.of_row(entry["row"]), tuple((code, text) for code, text in entry["warnings"]))
        except (AttributeError, KeyError, TypeError, ValueError):
            return None

    def put(self, key: str, result: str, kept: Kept, read: Iterable[str], written: Iterable[Path]) -> None:
        """List a result, unless a file that it depends on has changed since the run began."""
        others = [os.path.abspath(path) for path in read]  # noqa: PTH100 - links stay what they are called
        if any(changed_since(self._began, path) for path in others):
            self._entries.pop(result, None)
            return
        self._entries[result] = {
            "key": key,
            "read": {self._relative(path): self._state(path) for path in others},
            "written": {self._relative(str(path)): state(str(path)) for path in written},
            "row": kept.row.row(),
            "warnings": kept.warnings,
        }

    def drop(self, result: str) -> None:
        """Remove the listed files of a result that its deck no longer gives; files that were changed stay."""
        entry = self._entries.pop(result, None)
        written = {} if entry is None else entry.get("written")
        for path, was in written.items() if isinstance(written, dict) else ():
            if (found := self._absolute(path)) and was and state(found) == was:
                with suppress(OSError):
                    Path(found).unlink()

    def save(self) -> None:
        """Write the list, without results whose file is no longer there. Raises OSError."""
        there = {name: entry for name, entry in self._entries.items() if (self._folder / name).is_file()}
        if there or self._path.exists():
            content = {"format": _FORMAT, "digest": _digest(there), "results": there}
            write_atomically(self._path, json.dumps(content, indent=0, sort_keys=True).encode(), synced=False)

    def _relative(self, path: str) -> str:
        """A path from the folder, so that both can be moved; as it is from another drive."""
        try:
            return Path(os.path.relpath(path, self._folder)).as_posix()
        except ValueError:
            return path

    def _absolute(self, path: str) -> str:
        return os.path.abspath(self._folder / path)  # noqa: PTH100 - links stay what they are called


def plugins_in_use() -> tuple[str, ...]:
    """The files of plugins; none where they cannot be used."""
    try:
        return plugin_files()
    except PluginError:
        return ()


def _digest(entries: dict[str, Any]) -> str:
    return blake2b(json.dumps(entries, sort_keys=True).encode(), digest_size=KEY // 2).hexdigest()


def _read(path: Path) -> dict[str, Any]:
    """The results of a list by their file; none for a list that is damaged or of another version."""
    try:
        content = json.loads(path.read_bytes())
        entries = content["results"]
        if content["format"] != _FORMAT or content["digest"] != _digest(entries):
            return {}
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return {}
    return entries if isinstance(entries, dict) and all(isinstance(one, dict) for one in entries.values()) else {}
