"""Files at URLs (s3://, file://, memory:// and whatever else fsspec knows): read, listed, written in one step.

Credentials and settings are those that the libraries of fsspec find by themselves. Paths are opened as usual, without
fsspec.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from typing import Any
from urllib.parse import urlsplit

from mudline.files import is_url


class UrlError(OSError):
    """A URL that cannot be read, listed or written; `strerror` says why."""


def as_path(given: str) -> str:
    """The path that a file:// URL stands for; anything else as it is. Raises UrlError for a URL of another machine."""
    if not given.lower().startswith("file://"):
        return given
    from urllib.request import url2pathname  # noqa: PLC0415 - imports what speaks HTTP and TLS

    parts = urlsplit(given)
    if parts.netloc not in ("", "localhost"):
        raise UrlError(errno.EINVAL, "a file:// URL has three slashes, as in file:///folder/deck.keyxm", given)
    return url2pathname(parts.path)


def join(folder: str, name: str) -> str:
    """A file below a folder or a URL; `name` has `/`."""
    return f"{folder.rstrip('/')}/{name}" if is_url(folder) else os.path.join(folder, name)  # noqa: PTH118 - texts


def read(url: str, size: int | None = None) -> bytes:
    """The content of a file, or its first bytes; raises OSError."""
    with _opened(url) as (system, inside):
        return bytes(system.cat_file(inside, start=None if size is None else 0, end=size))


def exists(url: str) -> bool:
    """Whether there is a file or a folder; raises UrlError where that cannot be found out."""
    with _opened(url) as (system, inside):
        return bool(system.exists(inside))


def is_folder(url: str) -> bool:
    """Whether a URL is that of a folder; raises UrlError for one where nothing is."""
    with _opened(url) as (system, inside):
        return bool(system.info(inside)["type"] == "directory")


def files_below(url: str) -> list[str]:
    """The URLs of all files below a folder, sorted; raises UrlError."""
    with _opened(url) as (system, inside):
        start = inside.rstrip("/")
        return sorted(f"{url.rstrip('/')}{name.removeprefix(start)}" for name in system.find(inside))


def size_and_date(url: str) -> tuple[int, int]:
    """Bytes of a file and the time of its last change in ns since 1970, -1 where a store has none; raises UrlError."""
    with _opened(url) as (system, inside):
        info = system.info(inside)
        date = info.get("LastModified") or info.get("mtime") or info.get("last_modified") or info.get("updated")
        seconds = date.timestamp() if isinstance(date, datetime) else date
        changed = round(seconds * 1e9) if isinstance(seconds, (int, float)) else -1
        return info.get("size") or 0, changed


def write(url: str, data: bytes) -> None:
    """Write a file that is there whole or not at all; raises OSError."""
    with _opened(url) as (system, inside):
        system.makedirs(inside.rpartition("/")[0], exist_ok=True)
        with system.transaction, system.open(inside, "wb") as stream:
            stream.write(data)


def remove(url: str) -> None:
    """Remove a file; raises UrlError."""
    with _opened(url) as (system, inside):
        system.rm_file(inside)


@contextmanager
def _opened(url: str) -> Iterator[tuple[Any, str]]:
    """The file system of a URL and the URL's path in it; what a library of a protocol raises becomes an OSError."""
    try:
        from fsspec.core import url_to_fs  # noqa: PLC0415 - few commands have URLs
    except ImportError as error:
        raise UrlError(errno.ENOENT, "URLs need fsspec: pip install 'mudline[cluster]'", url) from error
    try:
        yield url_to_fs(url)
    except UrlError:
        raise
    except FileNotFoundError as error:
        raise UrlError(errno.ENOENT, "nothing is at this URL", url) from error
    except Exception as error:  # each library has its own errors
        text = " ".join(str(error).split()) or type(error).__name__
        raise UrlError(errno.EIO, f"cannot be reached: {text}", url) from error
