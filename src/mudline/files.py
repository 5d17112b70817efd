"""Writing files: whole contents, atomic replacement."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO


def write_atomically(path: Path, data: bytes | Iterable[bytes]) -> None:
    """Write a file, whole or in pieces as they come, as `replacement` does it.

    Raises OSError, and whatever making the pieces raises; the old file is then still there.
    """
    with replacement(path) as stream:
        stream.writelines([data] if isinstance(data, bytes) else data)


@contextmanager
def replacement(path: Path) -> Iterator[BinaryIO]:
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
    handle, name = tempfile.mkstemp(prefix=f".{target.name[:40]}.", dir=target.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
            stream.flush()
            os.fsync(stream.fileno())
        temporary.chmod(target.stat().st_mode & 0o7777 if target.exists() else 0o666 & ~_umask())
        temporary.replace(target)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise


def _umask() -> int:
    """The process's mask for new files, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask
