"""What a worker does with a chunk of decks, and the file of results that it leaves: a row of JSON for each deck.

The file is named by a digest of its content: a chunk that is done twice is there once, and a damaged file is none.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from hashlib import blake2b
from typing import Any, NamedTuple

from mudline import __version__
from mudline.cluster import storage
from mudline.files import is_url

_SUFFIX = ".jsonl"
_DIGEST = 20


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


def resolved(path: str, folder: str) -> str:
    """A path that was given in a working folder, as a worker can open it: unchanged where the worker is in it too."""
    if is_url(path) or os.getcwd() == folder:  # noqa: PTH109 - compared as text
        return path
    return os.path.join(folder, path)  # noqa: PTH118 - the text stays what was given
