"""Files: whole contents written by atomic replacement, which files were looked at, and which are open elsewhere."""

from __future__ import annotations

import errno
import os
import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path, PurePath
from typing import BinaryIO, NamedTuple

from mudline.basics.overwriting import reading

PLOT_FORMS = ("png", "svg", "pdf")
"""Suffixes of the file of a plot."""

_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0) | getattr(os, "O_NOFOLLOW", 0)
_NEW = 0o666
_PRIVATE = 0o600
"""Of a file that replaces another: until it has the permissions of the other one, nobody else reads it."""

_MARK = ".mudline"
"""The end of the names of temporary files: those that a killed run left are known by it."""
_RANDOM = 8
"""Random bytes in the name of a temporary file."""
_TEMPORARY = re.compile(rf"\.(.*\.)?[0-9a-f]{{{2 * _RANDOM}}}{re.escape(_MARK)}", re.DOTALL)
"""Names that `_new_beside` gives."""

_tidied: set[str] = set()
"""Folders in which this run has looked for what killed runs left."""

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
    reading(path)
    paths = _LOOKED_AT.get()
    if paths is not None:
        paths[os.path.abspath(path)] = None  # noqa: PTH100 - links stay what they are called
    return path


class Unsaved(NamedTuple):
    """A file that is open in an editor: the number of its text, which changes with it, and the text as a file."""

    revision: int
    content: Callable[[], bytes]


_UNSAVED: ContextVar[Mapping[str, Unsaved] | None] = ContextVar("unsaved", default=None)


@contextmanager
def with_unsaved(files: Mapping[str, Unsaved]) -> Iterator[None]:
    """Let `unsaved` know files that are open in an editor, by their absolute paths, until the block ends."""
    token = _UNSAVED.set(files)
    try:
        yield
    finally:
        _UNSAVED.reset(token)


def unsaved(path: Path) -> Unsaved | None:
    """Return the text that an editor has of a file, which holds before that on the disk; None where it has none."""
    files = _UNSAVED.get()
    return files.get(os.path.abspath(path)) if files else None  # noqa: PTH100 - as in `look`


def suffix_of(path: str | os.PathLike[str]) -> str:
    """The suffix of a file, which names its format: in lower case, without the dot."""
    return PurePath(path).suffix.lower().removeprefix(".")


def form_of_file(path: str | os.PathLike[str], forms: Collection[str]) -> str:
    """The form of a file to write, by its suffix; raises ValueError for one that is not among the forms."""
    form = suffix_of(path)
    if form not in forms:
        *others, last = (f".{name}" for name in forms)
        raise ValueError(f"{path}: unknown file format: give a name ending in {', '.join(others)} or {last}")
    return form


def write_atomically(path: Path, data: bytes | Iterable[bytes | memoryview], *, synced: bool = True) -> None:
    """Write a file, whole or in pieces as they come, as `replacement` does it.

    What is not `synced` is not waited for until it is on the disk: for files with a checksum, that can be made again.
    Raises OSError, and whatever making the pieces raises; the old file is then still there.
    """
    with replacement(path, synced=synced) as stream:
        stream.writelines([data] if isinstance(data, bytes) else data)


@contextmanager
def replacement(path: Path, *, synced: bool = True) -> Iterator[BinaryIO]:
    """A temporary file beside `path` to write to, which replaces it in one step when all is written.

    Permissions are kept, owner and group where this user may give files to them, and a symbolic link stays one: the
    file that it points to is replaced. Other hard links to the file keep its old content. What is not a regular file,
    such as a terminal or a pipe, is written to directly. Raises OSError; the old file is then still there.

    What a killed run has left in the folder is removed.
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
    old = target.stat() if target.exists() else None
    folder = str(target.parent)
    if folder not in _tidied:
        _tidied.add(folder)
        remove_left(folder)
    handle, temporary = _new_beside(target, _NEW if old is None else _PRIVATE)
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
            stream.flush()
            if synced:
                os.fsync(stream.fileno())
            if old is not None:
                _take_over(stream.fileno(), temporary, old)
            if sys.platform != "win32":  # there, what is open cannot be renamed; here, it is locked until it is closed
                temporary.replace(target)
                if synced:
                    _sync_folder(target.parent)
        if sys.platform == "win32":
            temporary.replace(target)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise


@contextmanager
def alone_at(path: Path, waiting: Callable[[], None] | None = None, *, made: bool = False) -> Iterator[None]:
    """Let no other run of this program be in such a block for a file; one that is there is waited for.

    `waiting` is called before that, and a missing file is `made`. Runs do not wait for each other on Windows, nor where
    files cannot be opened or locked.
    """
    handle = _alone(path, waiting, os.O_CREAT if made else 0)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _alone(path: Path, waiting: Callable[[], None] | None, flags: int) -> int | None:
    """A handle of a file that only this run has locked; None where there is none."""
    if sys.platform == "win32":
        return None
    import fcntl  # noqa: PLC0415 - as below

    while True:
        try:
            handle = os.open(path, os.O_RDWR | os.O_NONBLOCK | flags, _NEW)
        except OSError:
            return None
        try:
            if _locked(handle) is False:
                if waiting is not None:
                    waiting()
                fcntl.flock(handle, fcntl.LOCK_EX)
            if os.path.samestat(os.fstat(handle), os.stat(path)):  # noqa: PTH116 - may be a name that Path refuses
                return handle
        except OSError:  # it is gone, or another file system says otherwise
            return handle
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)  # the run that was waited for has put another file there


def _sync_folder(folder: Path) -> None:
    """Wait until the disk has the new name of a file; a folder that may not be read is left to the system."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _take_over(handle: int, temporary: Path, old: os.stat_result) -> None:
    """Give a file the owner and the group of another one, as far as this user may, and its permissions.

    A program that runs as its owner does not become one that runs as this user.
    """
    bits = old.st_mode & 0o7777
    if sys.platform != "win32":
        new = os.fstat(handle)
        if new.st_gid != old.st_gid:
            with suppress(OSError):
                os.fchown(handle, -1, old.st_gid)
        if new.st_uid != old.st_uid:
            with suppress(OSError):
                os.fchown(handle, old.st_uid, -1)
        new = os.fstat(handle)
        if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
            bits &= 0o1777
    temporary.chmod(bits)


# ------------------------------------------------------------------------------------------------- temporary files


def _new_beside(target: Path, mode: int) -> tuple[int, Path]:
    """An open and locked new file in the folder of another one; the system takes its mask for new files off the mode.

    One that another run took for left behind, before it was locked, is given up. A signal that ends the run leaves
    none, also between the making of the file and its first line.
    """
    while True:
        path = target.with_name(f".{target.name[:40]}.{os.urandom(_RANDOM).hex()}{_MARK}")
        try:
            handle = os.open(path, _CREATE, mode)
            if _locked(handle) is not False and path.exists():
                return handle, path
            os.close(handle)
        except FileExistsError:
            continue
        except BaseException:
            with suppress(OSError):
                path.unlink()
            raise


def _locked(handle: int) -> bool | None:
    """Whether a file is now locked until it is closed, by this run; None where files cannot be locked.

    The lock says that a temporary file is in use. On Windows, that it is open says so.
    """
    if sys.platform == "win32":
        return None
    import fcntl  # noqa: PLC0415 - most runs write nothing

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # a file system without locks
        return None
    return True


def remove_left(folder: str) -> None:
    """Remove the temporary files of a folder that no run has in use."""
    with suppress(OSError), os.scandir(folder) as entries:
        for path in [
            one.path for one in entries if _TEMPORARY.fullmatch(one.name) and one.is_file(follow_symlinks=False)
        ]:
            with suppress(OSError):  # it is another user's, or in use
                _remove_left(path)


def _remove_left(path: str) -> None:
    """Remove a temporary file unless it is in use; raises OSError."""
    if sys.platform == "win32":
        os.unlink(path)  # noqa: PTH108 - as below
        return
    handle = os.open(path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        if _locked(handle):
            os.unlink(path)  # noqa: PTH108 - the path is a text of scandir
    finally:
        os.close(handle)
