"""Where the cache stands, and its files: one for each working folder, whole or not at all, bounded in number and size.

A file is a head line with a digest of the rest, then a line for each deck: its key, and its findings if it has any.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress
from hashlib import blake2b
from pathlib import Path

from mudline.files import write_atomically
from mudline.linting.cache_keys import KEY

MOST_FILES = 40
MOST_ENTRIES = 50_000
MOST_BYTES = 64_000_000
_MAGIC = b"mudline-lint-cache/1 "


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


def write_entries(path: Path, entries: Mapping[str, str]) -> None:
    """Replace a file of the cache by the last of the entries; does nothing where that is not possible."""
    lines: list[bytes] = []
    size = 0
    for key, held in list(entries.items())[: -MOST_ENTRIES - 1 : -1]:
        line = f"{key} {held}\n".encode("ascii")
        size += len(line)
        if size > MOST_BYTES - 1000:
            break
        lines.append(line)
    body = b"".join(reversed(lines))
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        write_atomically(path, _head(body) + b"\n" + body)
        _drop_old(path.parent)


def _head(body: bytes) -> bytes:
    return _MAGIC + blake2b(body, digest_size=20).hexdigest().encode("ascii")


def _drop_old(folder: Path) -> None:
    """Keep the files that were written last."""
    with os.scandir(folder) as entries:
        files = [(entry.stat().st_mtime, entry.path) for entry in entries if "lint-" in entry.name and entry.is_file()]
    for _, path in sorted(files)[:-MOST_FILES]:
        with suppress(OSError):
            Path(path).unlink()
