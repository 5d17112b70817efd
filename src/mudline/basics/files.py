"""Files: atomic writing, paths that a result depends on, and texts that are open in an editor."""

from __future__ import annotations

import errno
import os
import re
import sys
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path, PurePath
from typing import BinaryIO, NamedTuple

from mudline.basics.contexts import holding
from mudline.basics.overwriting import reading

PLOT_FORMS = ("png", "svg", "pdf")
"""Suffixes of the file of a plot."""

_CREATE = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0) | getattr(os, "O_NOFOLLOW", 0)
_NEW = 0o666
_PRIVATE = 0o600
"""Permissions of a temporary file that replaces a file, until it gets those of the replaced file."""

_MARK = ".mudline"
"""Suffix of the names of temporary files, by which those of a killed run are recognised."""
_RANDOM = 8
"""Random bytes in the name of a temporary file."""
_TEMPORARY = re.compile(rf"\.(.*\.)?[0-9a-f]{{{2 * _RANDOM}}}{re.escape(_MARK)}", re.DOTALL)
"""Names that `_new_beside` makes."""

_tidied: set[str] = set()
"""Folders already searched by this run for temporary files of killed runs."""

_LOOKED_AT: ContextVar[dict[str, None] | None] = ContextVar("looked_at", default=None)


def recording_looks() -> AbstractContextManager[dict[str, None]]:
    """Collect the paths that `look` is called with until the block ends: each once, in order."""
    return holding(_LOOKED_AT, {})


def look(path: Path) -> Path:
    """Return the path and record that a result depends on the file there, or on its absence."""
    reading(path)
    paths = _LOOKED_AT.get()
    if paths is not None:
        paths[os.path.abspath(path)] = None  # noqa: PTH100 - links stay what they are called
    return path


class Unsaved(NamedTuple):
    """A file that is open in an editor.

    Attributes:
        revision: number of the text, which grows with each change.
        content: the text as the bytes of a file.
    """

    revision: int
    content: Callable[[], bytes]


_UNSAVED: ContextVar[Mapping[str, Unsaved] | None] = ContextVar("unsaved", default=None)


def with_unsaved(files: Mapping[str, Unsaved]) -> AbstractContextManager[Mapping[str, Unsaved]]:
    """Make files that are open in an editor known to `unsaved`, by their absolute paths, until the block ends."""
    return holding(_UNSAVED, files)


def unsaved(path: Path) -> Unsaved | None:
    """Return the text of a file that is open in an editor, which replaces that on the disk; None for any other file."""
    files = _UNSAVED.get()
    return files.get(os.path.abspath(path)) if files else None  # noqa: PTH100 - as in `look`


def version_of(path: str) -> tuple[int, ...]:
    """Return what changes with a file, its date and its size; nothing for a file that is not there."""
    try:
        status = os.stat(path)  # noqa: PTH116 - asked for many files
    except (OSError, ValueError):  # a name that no file has
        return ()
    return status.st_mtime_ns, status.st_size


def reason(error: OSError) -> str:
    """Return the reason why a file could not be read or written."""
    return (error.strerror or str(error)).lower()


def suffix_of(path: str | os.PathLike[str]) -> str:
    """Return the suffix of a file, which names its format, in lower case without the dot."""
    return PurePath(path).suffix.lower().removeprefix(".")


def form_of_file(path: str | os.PathLike[str], forms: Collection[str]) -> str:
    """Return the form of a file to write, by its suffix; raises ValueError unless it is among `forms`."""
    form = suffix_of(path)
    if form not in forms:
        *others, last = (f".{name}" for name in forms)
        raise ValueError(f"{path}: unknown file format: give a name ending in {', '.join(others)} or {last}")
    return form


def write_atomically(path: Path, data: bytes | Iterable[bytes | memoryview], *, synced: bool = True) -> None:
    """Write a file by `replacement`, from bytes or from pieces as they are made.

    Without `synced`, the function does not wait until the data are on the disk: for files with a checksum that can be
    made again. Raises OSError, and any error of making the pieces; the old file then remains.
    """
    with replacement(path, synced=synced) as stream:
        stream.writelines([data] if isinstance(data, bytes) else data)


@contextmanager
def replacement(path: Path, *, synced: bool = True) -> Iterator[BinaryIO]:
    """Open a temporary file next to `path` for writing; it replaces `path` in one step when the block ends.

    Permissions are kept, and owner and group where this user may set them. Of a symbolic link the target is replaced;
    other hard links keep the old content. Anything but a regular file, such as a terminal or a pipe, is written to
    directly. Raises OSError; the old file then remains.

    Temporary files of killed runs are removed from the folder.
    """
    if path.exists() and not path.is_file():
        with path.open("wb") as stream:  # a directory says here that it is one
            yield stream
        return
    target = Path(os.path.realpath(path))
    if target.is_symlink():  # it leads to itself
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
    """Let only one run of this program at a time be in such a block for a file; other runs wait.

    `waiting` is called before this run waits, and with `made` a missing file is created. Runs do not wait on Windows,
    nor where files cannot be opened or locked.
    """
    handle = _alone(path, waiting, os.O_CREAT if made else 0)
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def _alone(path: Path, waiting: Callable[[], None] | None, flags: int) -> int | None:
    """Return a handle of a file that this run has locked, or None where files cannot be opened or locked."""
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
        os.close(handle)  # the other run has replaced the file


def _sync_folder(folder: Path) -> None:
    """Wait until the disk has the new name of a file, unless the folder may not be read."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _take_over(handle: int, temporary: Path, old: os.stat_result) -> None:
    """Give a new file the permissions of the old one, and its owner and group as far as this user may."""
    if sys.platform != "win32":
        for owner, group in ((-1, old.st_gid), (old.st_uid, -1)):
            with suppress(OSError):
                os.fchown(handle, owner, group)
    temporary.chmod(old.st_mode & 0o777)


# ------------------------------------------------------------------------------------------------- temporary files


def _new_beside(target: Path, mode: int) -> tuple[int, Path]:
    """Return a new file in the folder of `target`, open and locked; the system's mask for new files applies to `mode`.

    A file that another run removed as left over, before it was locked here, is given up and made again. A signal that
    ends the run leaves no file, not even between creation and the first line.
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
    """Lock a file until it is closed. Return False if another run has it, and None where files cannot be locked.

    The lock marks a temporary file as in use. On Windows an open file cannot be removed anyway.
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
    """Remove the temporary files of a folder that no run uses."""
    with suppress(OSError), os.scandir(folder) as entries:
        for path in [
            entry.path for entry in entries if _TEMPORARY.fullmatch(entry.name) and entry.is_file(follow_symlinks=False)
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
