"""Files: whole contents written by atomic replacement, and which files were looked at."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import BinaryIO

_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0) | getattr(os, "O_NOFOLLOW", 0)
_NEW = 0o666
_PRIVATE = 0o600
"""Of a file that replaces another: until it has the permissions of the other one, nobody else reads it."""

_LOOKED_AT: ContextVar[dict[str, None] | None] = ContextVar("looked_at", default=None)


@contextmanager
def recording_looks() -> Iterator[dict[str, None]]:
    """Collect the paths that `look` is called with, each once, in order, until the block ends."""
    paths: dict[str, None] = {}
    token = _LOOKED_AT.set(paths)
    try:
        yield paths
    finally:
        _LOOKED_AT.reset(token)


def look(path: Path) -> Path:
    """Return the path, of which is now known that a result depends on what is there, or on nothing being there."""
    paths = _LOOKED_AT.get()
    if paths is not None:
        paths[os.path.abspath(path)] = None  # noqa: PTH100 - links stay what they are called
    return path


def write_atomically(path: Path, data: bytes | Iterable[bytes], *, synced: bool = True) -> None:
    """Write a file, whole or in pieces as they come, as `replacement` does it.

    What is not `synced` is not waited for until it is on the disk: for files with a checksum, that can be made again.
    Raises OSError, and whatever making the pieces raises; the old file is then still there.
    """
    with replacement(path, synced=synced) as stream:
        stream.writelines([data] if isinstance(data, bytes) else data)


@contextmanager
def replacement(path: Path, *, synced: bool = True) -> Iterator[BinaryIO]:
    """A temporary file beside `path` to write to, which replaces it in one step when all is written.

    Permissions are kept, and a symbolic link stays one: the file that it points to is replaced. What is no regular
    file, such as a terminal or a pipe, is written to directly. Raises OSError; the old file is then still there.
    """
    if path.exists() and not path.is_file():
        with path.open("wb") as stream:  # a directory says here that it is one
            yield stream
        return
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP), str(path))
    if target.exists() and not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))
    kept = target.stat().st_mode & 0o7777 if target.exists() else None
    handle, temporary = _new_beside(target, _NEW if kept is None else _PRIVATE)
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
            stream.flush()
            if synced:
                os.fsync(stream.fileno())
        if kept is not None:
            temporary.chmod(kept)
        temporary.replace(target)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise


def _new_beside(target: Path, mode: int) -> tuple[int, Path]:
    """An open new file in the folder of another one; the system takes its mask for new files off the mode."""
    while True:
        path = target.with_name(f".{target.name[:40]}.{os.urandom(8).hex()}")
        with suppress(FileExistsError):
            return os.open(path, _CREATE, mode), path
