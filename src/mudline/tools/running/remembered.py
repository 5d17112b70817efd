"""Results kept from run to run, for the same content under the same settings by the same program.

A memory is one file, written as a whole and bounded in number and size. Its first line has a digest of the other lines;
each of these has a key, and a result with the files that it depends on. A damaged file counts as missing. Nothing here
imports the code that makes results: a run without changes ends without it.
"""

from __future__ import annotations

import json
import os
import stat
import sys
import time
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from hashlib import blake2b, file_digest
from itertools import accumulate
from pathlib import Path
from typing import Any

from mudline.basics.files import version_of, write_atomically
from mudline.basics.installed import metadata_folders
from mudline.basics.limits import LARGEST_MEMORY, LARGEST_NEIGHBOUR, LONGEST_REMEMBERED, MOST_MEMORIES, MOST_REMEMBERED
from mudline.basics.overwriting import reading
from mudline.basics.resources import grammar_file

PLACE = "MUDLINE_CACHE_DIR"
"""Variable with the path of the user's cache folder."""
_KEY = 40
_MAGIC = b"mudline-remembered/1 "
_COARSE = 0.02
"""Seconds by which the date of a file may lag behind the clock."""


class Memory:
    """The results in a file; those of other `settings` or another version of the program are not found.

    A `shared` file lies in the user's cache folder, next to others.
    """

    def __init__(self, path: Path, settings: str = "", *, shared: bool = False) -> None:
        self._path, self._shared = path, shared
        self._entries = _read(path, own=shared)
        self._start = blake2b(f"{program()}\0{settings}".encode("utf-8", "backslashreplace")).digest()
        self._began = time.time()
        self._state = cache(state)  # many results may depend on the same file
        self._changed = False

    def key(self, *parts: str | bytes) -> str:
        """Return the key of a result from its inputs; two lists of parts have the same key only if they are equal."""
        digest = blake2b(self._start, digest_size=_KEY // 2)
        for part in parts:
            data = part.encode("utf-8", "surrogatepass") if isinstance(part, str) else part
            digest.update(b"%d " % len(data))
            digest.update(data)
        return digest.hexdigest()

    def get(self, key: str) -> Any:  # noqa: ANN401 - what JSON holds
        """Return the result; None if it is unknown, or if a file that it depends on has changed."""
        held = self._entries.get(key)
        if held is None:
            return None
        try:
            result, states = json.loads(held)
            for path in states:
                reading(path)
            holds = all(self._state(path) == before for path, before in states.items())
        except (ValueError, AttributeError, TypeError, RecursionError):
            del self._entries[key]
            return None
        return result if holds else None

    def put(self, key: str, result: list[Any] | dict[str, Any], files: Iterable[str] = ()) -> None:
        """Keep a result that JSON can hold and that depends on the content at some paths.

        It is not kept if a path has changed since the run began: its content at the time of reading is then uncertain.
        """
        self._changed |= self._entries.pop(key, None) is not None
        states = {}
        for path in files:
            if changed_since(self._began, path):
                return
            states[path] = self._state(path)
        held = json.dumps([result, states], separators=(",", ":"))
        if len(held) <= LONGEST_REMEMBERED:
            self._entries[key] = held
            self._changed = True

    def save(self) -> None:
        """Write the results if any has changed; does nothing where writing is not possible."""
        if not self._changed:
            return
        lines = [f"{key} {held}\n".encode("ascii") for key, held in list(self._entries.items())[-MOST_REMEMBERED:]]
        kept = sum(size <= LARGEST_MEMORY - 1000 for size in accumulate(map(len, reversed(lines))))
        body = b"".join(lines[len(lines) - kept :])
        with suppress(OSError):
            self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            write_atomically(self._path, [_head(body), b"\n", body], synced=False)
            if self._shared:
                _drop_old(self._path)


def cache_folder() -> Path | None:
    """Return the cache folder: from the variable, else that of the user on this system; None if there is none."""
    if folder := os.environ.get(PLACE):
        return Path(folder)
    folder = os.environ.get("XDG_CACHE_HOME", "")
    if os.path.isabs(folder):  # noqa: PTH117 - a text that may be empty
        return Path(folder, "mudline")
    if sys.platform == "win32":
        local = os.environ.get("LOCALAPPDATA")
        return Path(local, "mudline", "Cache") if local else None
    try:
        home = Path.home()
    except RuntimeError:
        return None
    return home / ("Library/Caches" if sys.platform == "darwin" else ".cache") / "mudline"


def of_working_folder(name: str, settings: str) -> Memory | None:
    """Return the memory of the working folder, which lies in the user's cache folder; None without such a folder."""
    folder = cache_folder()
    if folder is None:
        return None
    try:
        place = blake2b(os.fsencode(Path.cwd()), digest_size=16).hexdigest()
    except OSError:  # the working folder is gone
        return None
    return Memory(folder / f"{name}-{place}.txt", settings, shared=True)


# ------------------------------------------------------------------------------------------- what results depend on


def program() -> str:
    """Return the identity of the program: version, files, and the installed packages with libraries and rules."""
    words = [sys.version]
    for root in {Path(__file__).parents[2], grammar_file("deck.lark").parent}:
        for folder, folders, names in os.walk(root):
            if "__pycache__" in folders:  # grows while the program runs: compiled modules and loops
                folders.remove("__pycache__")
            words += (_version(f"{folder}/{name}") for name in names)
    words += (_version(f"{folder}/entry_points.txt") for folder in metadata_folders())
    words.sort()
    return "\n".join(words)


def _version(path: str) -> str:
    """Return the identity of a file from its name, date and size; those inside archives have none."""
    return f"{path} {version_of(path)}"


def state(path: str) -> str:
    """Return a digest of a file's content or of the names in a folder; "" for anything that cannot be read.

    Other objects, such as pipes, are not opened: no deck is read from them. Very large files are identified by size and
    date.
    """
    digest = blake2b(digest_size=16)
    try:
        status = os.stat(path)  # noqa: PTH116 - as above
        if stat.S_ISDIR(status.st_mode):
            names = "\0".join(["", *sorted(os.listdir(path))])  # noqa: PTH208 - as above
            digest.update(names.encode("utf-8", "surrogateescape"))
        elif not stat.S_ISREG(status.st_mode):
            return ""
        elif status.st_size > LARGEST_NEIGHBOUR:
            digest.update(_version(path).encode("utf-8", "surrogateescape"))
        else:
            with open(path, "rb") as stream:  # noqa: PTH123 - as above
                file_digest(stream, lambda: digest)
    except (OSError, ValueError):  # a name that no file has
        return ""
    return digest.hexdigest()


def changed_since(moment: float, path: str) -> bool:
    """Return True if a file may have changed since a moment."""
    try:
        status = os.stat(path)  # noqa: PTH116 - as above
    except (OSError, ValueError):  # still not there
        return False
    return max(status.st_mtime, status.st_ctime) > moment - _COARSE


# ------------------------------------------------------------------------------------------------------------ the file


def _read(path: Path, *, own: bool) -> dict[str, str]:
    """Return keys and results; an empty dict if the file is missing, damaged, too large or not a memory.

    Where only this user's `own` files count, files of another user are ignored: nobody else may supply results.
    """
    try:
        if not path.is_file() or path.stat().st_size > LARGEST_MEMORY:
            return {}
        if own and hasattr(os, "getuid") and path.stat().st_uid != os.getuid():
            return {}
        head, _, body = path.read_bytes().partition(b"\n")
    except OSError:
        return {}
    if head != _head(body) or not body.isascii():
        return {}
    return {line[:_KEY]: line[_KEY + 1 :] for line in body.decode("ascii").split("\n") if line}


def _head(body: bytes) -> bytes:
    return _MAGIC + blake2b(body, digest_size=20).hexdigest().encode("ascii")


def _drop_old(written: Path) -> None:
    """Keep the most recently written memories of one name, and delete the others."""
    start = f"{written.name.partition('-')[0]}-"
    with os.scandir(written.parent) as entries:
        files = [(entry.stat().st_mtime, entry.path) for entry in entries if entry.name.startswith(start)]
    for _, path in sorted(files)[:-MOST_MEMORIES]:
        with suppress(OSError):
            Path(path).unlink()
