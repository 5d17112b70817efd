"""Files by path or by URL (s3://, file:// and whatever else fsspec knows): read, listed, written in one step.

Only what has a URL needs fsspec; paths are opened as usual.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from datetime import datetime
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from mudline.files import is_url, write_atomically

if TYPE_CHECKING:
    from fsspec import AbstractFileSystem

_REFUSED = {"memory": "what one process has in memory no other can read"}
"""Protocols of fsspec that workers cannot share, and why."""


class Found(NamedTuple):
    """A file at a URL: its size, what its store calls its version, and its last change in ns since 1970 or -1."""

    size: int
    version: str
    changed: int


_listed: dict[str, Found] = {}
"""Files that were listed, until their marks are asked for: a store would be asked for each of very many."""


class UrlError(OSError):
    """A URL that cannot be read, listed or written; `strerror` says why."""


class MissingLibraryError(OSError):
    """A library for URLs is not installed; `strerror` names it and what brings it."""


def as_path(given: str) -> str:
    """The path that a file:// URL stands for; anything else as it is. Raises UrlError for a URL of another machine."""
    if not given.lower().startswith("file://"):
        return given
    from urllib.parse import urlsplit  # noqa: PLC0415 - few commands have URLs
    from urllib.request import url2pathname  # noqa: PLC0415 - as above

    parts = urlsplit(given)
    if parts.netloc not in ("", "localhost"):
        raise _refused(given, "a file:// URL has three slashes, as in file:///folder/deck.keyxm")
    return url2pathname(parts.path)


def join(folder: str, name: str) -> str:
    """A file in a folder or below a URL; `name` has `/`."""
    return f"{folder.rstrip('/')}/{name}" if is_url(folder) else str(Path(folder, name))


def resolved(path: str, folder: str) -> str:
    """A path that was given in a working folder, as a worker can open it: unchanged where the worker is in it too."""
    if is_url(path) or os.getcwd() == folder:  # noqa: PTH109 - compared as text
        return path
    return os.path.join(folder, path)  # noqa: PTH118 - the text stays what was given


# --------------------------------------------------------------------------------------------------------- reading


def read(path: str) -> bytes:
    """The content of a file; raises OSError."""
    if not is_url(path):
        return Path(path).read_bytes()
    with _naming(path):
        system, inside = _opened(path)
        return cast("bytes", system.cat_file(inside))


def head(path: str, size: int) -> bytes:
    """The first bytes of a file at a URL; raises OSError."""
    with _naming(path):
        system, inside = _opened(path)
        return cast("bytes", system.cat_file(inside, start=0, end=size))


def exists(path: str) -> bool:
    """Whether there is a file or a folder; raises UrlError where that cannot be found out."""
    if not is_url(path):
        return Path(path).exists()
    with _naming(path):
        system, inside = _opened(path)
        return bool(system.exists(inside))


def is_folder(path: str) -> bool:
    """Whether a URL is that of a folder; raises UrlError for one where nothing is."""
    with _naming(path):
        system, inside = _opened(path)
        return bool(system.info(inside)["type"] == "directory")


def files_below(url: str) -> list[str]:
    """The URLs of all files below a folder, sorted; raises UrlError."""
    with _naming(url):
        system, inside = _opened(url)
        start = url.split("://", 1)[0]
        found = system.find(inside, detail=True).items()
        urls = {name if is_url(name) else f"{start}://{name}": info for name, info in found}
    _listed.update((one, _found(info)) for one, info in urls.items())
    return sorted(urls)


def names_in(folder: str) -> list[str]:
    """The names of the files in a folder as they are now; none where it does not exist. Raises OSError."""
    if not is_url(folder):
        try:
            return sorted(os.listdir(folder))  # noqa: PTH208 - names are wanted
        except FileNotFoundError:
            return []
    with _naming(folder):
        system, inside = _opened(folder)
        system.invalidate_cache(inside)
        try:
            return sorted(name.rpartition("/")[2] for name in system.ls(inside, detail=False))
        except FileNotFoundError:
            return []
        finally:
            system.invalidate_cache(inside)  # else what workers write from now on would not be there


def mark(path: str) -> str:
    """What changes when a file does, without reading it: size with date or with what a store calls its version.

    "" for what is not there or cannot be looked at. What was listed is asked for once as it was then.
    """
    if path in _listed:
        return _mark(_listed.pop(path))
    try:
        if not is_url(path):
            found = os.stat(path)  # noqa: PTH116 - asked for each of many files
            return f"{found.st_size} {found.st_mtime_ns}"
        with _naming(path):
            system, inside = _opened(path)
            return _mark(_found(system.info(inside)))
    except (OSError, ValueError):
        return ""


def size_and_date(url: str) -> tuple[int, int]:
    """Bytes of a file and the time of its last change in ns since 1970, -1 where a store has none; raises UrlError.

    Of what was listed they are those of the list.
    """
    found = _listed.get(url)
    if found is None:
        with _naming(url):
            system, inside = _opened(url)
            found = _found(system.info(inside))
    return found.size, found.changed


def _found(info: Mapping[str, Any]) -> Found:
    date = info.get("LastModified") or info.get("mtime") or info.get("last_modified") or info.get("updated")
    version = info.get("ETag") or info.get("etag") or date or ""
    seconds: object = date.timestamp() if isinstance(date, datetime) else date
    changed = round(seconds * 1e9) if isinstance(seconds, (int, float)) else -1
    return Found(info.get("size") or 0, str(version), changed)


def _mark(found: Found) -> str:
    return f"{found.size} {found.version}"


# --------------------------------------------------------------------------------------------------------- writing


def make_folder(folder: str) -> None:
    """Make a folder if there is none; a URL needs none. Raises OSError."""
    if not is_url(folder):
        Path(folder).mkdir(parents=True, exist_ok=True)
    else:
        with _naming(folder):
            _opened(folder)


def write(path: str, data: bytes) -> None:
    """Write a file that is there whole or not at all; raises OSError.

    An object store shows an object when all of it has arrived; other URLs are written beside their place and moved.
    """
    if not is_url(path):
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(Path(path), data, synced=False)
        return
    with _naming(path):
        system, inside = _opened(path)
        if _stores_objects(system):
            system.pipe_file(inside, data)
            return
        system.makedirs(inside.rpartition("/")[0], exist_ok=True)
        beside = f"{inside}.{os.urandom(8).hex()}.part"
        system.pipe_file(beside, data)
        system.mv(beside, inside)


def remove(path: str) -> None:
    """Remove a file; raises OSError."""
    if not is_url(path):
        Path(path).unlink()
        return
    with _naming(path):
        system, inside = _opened(path)
        system.rm_file(inside)


@contextmanager
def local_copy(path: str | None) -> Iterator[str | None]:
    """The path of a file: its own, or that of a copy of what a URL holds while the block runs. Raises OSError."""
    if path is None or not is_url(path):
        yield path
        return
    from tempfile import TemporaryDirectory  # noqa: PLC0415 - few commands have URLs

    with TemporaryDirectory(prefix="mudline-") as folder:
        copy = Path(folder, path.rpartition("/")[2])
        copy.write_bytes(read(path))
        yield str(copy)


# ---------------------------------------------------------------------------------------------------------- fsspec


def _refused(url: str, why: str) -> UrlError:
    return UrlError(errno.EINVAL, why, url)


def _stores_objects(system: AbstractFileSystem) -> bool:
    protocols = system.protocol if isinstance(system.protocol, tuple) else (system.protocol,)
    return not {"s3", "s3a", "gs", "gcs", "abfs", "az"}.isdisjoint(protocols)


def _opened(url: str) -> tuple[Any, str]:
    """The file system of a URL, and the URL's path in it."""
    protocol = url.split("://", 1)[0].lower()
    if "::" in url:
        raise _refused(url, "URLs in URLs are not supported: give the URL of a folder or a file")
    if protocol in _REFUSED:
        raise _refused(url, f"{protocol}:// is not supported: {_REFUSED[protocol]}")
    system = _system(protocol, os.getpid())
    return system, str(system._strip_protocol(url))  # noqa: SLF001 - fsspec's way to take a URL apart


@lru_cache(maxsize=16)
def _system(protocol: str, _process: int) -> AbstractFileSystem:
    try:
        import fsspec  # noqa: PLC0415 - few commands have URLs
    except ImportError as error:
        what = "URLs need fsspec: pip install 'mudline[cluster]'"
        raise MissingLibraryError(errno.ENOENT, what) from error
    try:
        return fsspec.filesystem(protocol)
    except ImportError as error:  # the library of one protocol, such as s3fs
        raise MissingLibraryError(errno.ENOENT, f"{protocol}:// needs a library: {error}") from error


@contextmanager
def _naming(url: str) -> Iterator[None]:
    """Raise whatever a library of a protocol raises as UrlError."""
    try:
        yield
    except (UrlError, MissingLibraryError):
        raise
    except FileNotFoundError as error:
        raise UrlError(errno.ENOENT, "nothing is at this URL", url) from error
    except Exception as error:  # each library has its own errors
        text = " ".join(str(error).split()) or type(error).__name__
        raise UrlError(errno.EIO, f"cannot be reached: {text}", url) from error
