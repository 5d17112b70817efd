"""Protection of the files of a run: no output is also an input or another output."""

from __future__ import annotations

import os
import sys
from contextlib import AbstractContextManager
from contextvars import ContextVar
from dataclasses import dataclass, field
from stat import S_ISREG
from typing import NamedTuple

from mudline.basics.contexts import holding
from mudline.basics.paths import relative_path

StrPath = str | os.PathLike[str]
_Identity = tuple[int, int] | str
"""Device and inode of a regular file, whatever its name; the real path of a file that does not exist yet."""

_STDIN = "standard input"


class OverwriteError(Exception):
    """Conflict of an output of a run with an input, or with another output of a different name."""


class ClaimedOutput(NamedTuple):
    """An output of a run.

    Attributes:
        option: the option that names it; "" for none.
        name: the name in messages.
        path: the absolute path.
    """

    option: str
    name: str
    path: str

    def __str__(self) -> str:
        return f"{self.option} {self.name}".lstrip()


ClaimedOutputs = dict[_Identity, ClaimedOutput]


@dataclass(slots=True)
class RunFiles:
    """Outputs of a run, and the files that it has read with the names by which it read them."""

    outputs: ClaimedOutputs = field(default_factory=dict)
    read: dict[_Identity, str] = field(default_factory=dict)


_RUN: ContextVar[RunFiles | None] = ContextVar("run", default=None)


def refusing_overwriting() -> AbstractContextManager[RunFiles]:
    """Let `reading` and `claim` raise OverwriteError until the block ends."""
    return holding(_RUN, RunFiles())


def outputs() -> ClaimedOutputs:
    """Return the outputs known in this run, to be passed to `continue_run`."""
    run = _RUN.get()
    return {} if run is None else run.outputs


def continue_run(known: ClaimedOutputs) -> None:
    """Refuse in this process whatever the run that started it refuses."""
    _RUN.set(RunFiles(known))


def reading(path: StrPath | None) -> None:
    """Record a file that the run reads, None for standard input; raises OverwriteError if it is an output."""
    run = _RUN.get()
    identity = None if run is None else _identity(path)
    if run is None or identity is None:
        return
    run.read[identity] = _STDIN if path is None else os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    output = run.outputs.get(identity)
    if output is not None and _identity(output.path) == identity:
        raise _refusal(output, _STDIN if path is None else os.fspath(path))


def claim(path: StrPath, option: str = "") -> None:
    """Record a file that the run writes.

    An option claims its output when the command line is read. A later claim without an option may name the same path as
    an option. Raises OverwriteError if the file is an input, or an output of another claim.
    """
    run = _RUN.get()
    if run is None:
        return
    absolute = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    output = ClaimedOutput(option, os.fspath(path), absolute)
    if (read := _read_as(run, path)) is not None:
        raise _refusal(output, read)
    identity = _identity(path) or _real(path)
    if identity is None:
        return
    other = run.outputs.setdefault(identity, output)
    is_same = other is not output and (_identity(other.path) or _real(other.path)) == identity
    if is_same and (option or other.path != absolute):
        raise OverwriteError(f"{output} is also the file of {other}: give another name")


def is_read(path: StrPath) -> bool:
    """Return True if the run has read the file."""
    run = _RUN.get()
    return run is not None and _read_as(run, path) is not None


def _read_as(run: RunFiles, path: StrPath) -> str | None:
    """Return the name by which the run has read a file, or None; inodes of deleted files may belong to new files."""
    identity = _identity(path)
    read = None if identity is None else run.read.get(identity)
    return read if read and _identity(None if read == _STDIN else read) == identity else None


def _refusal(output: ClaimedOutput, read: str) -> OverwriteError:
    absolute = read != _STDIN and os.path.isabs(read)  # noqa: PTH117 - text
    shown = relative_path(read) if absolute else read.replace(os.sep, "/")
    return OverwriteError(f"{output} would replace {shown}, which this run reads: give another name")


def _identity(path: StrPath | None) -> _Identity | None:
    """Return device and inode of a regular file, or of standard input for None; None for any other kind of file."""
    try:
        status = os.fstat(sys.stdin.fileno()) if path is None else os.stat(path)  # noqa: PTH116 - Path raises for long names
    except (OSError, ValueError, AttributeError):  # standard input is closed, or no stream of the system
        return None
    return (status.st_dev, status.st_ino) if S_ISREG(status.st_mode) else None


def _real(path: StrPath) -> str | None:
    """Return the real path of a file that does not exist yet; None for an existing file that is not regular."""
    try:
        return None if os.path.exists(path) else os.path.normcase(os.path.realpath(path))  # noqa: PTH110 - as above
    except (OSError, ValueError):
        return None
