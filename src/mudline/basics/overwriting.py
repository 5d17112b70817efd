"""Files that a run reads and files that it writes: none is both, and no two outputs are one file."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from stat import S_ISREG
from typing import NamedTuple

from mudline.basics.paths import relative_path

StrPath = str | os.PathLike[str]
_Identity = tuple[int, int] | str
"""Device and number of a regular file, whatever it is called; the real path of one that is not there yet."""

_STDIN = "standard input"


class OverwriteError(Exception):
    """An output of a run is a file that it reads, or that it also writes under another name."""


class Output(NamedTuple):
    """An output: the option that asks for it, "" for none, the name in messages, and the absolute path."""

    option: str
    name: str
    path: str

    def __str__(self) -> str:
        return f"{self.option} {self.name}".lstrip()


Outputs = dict[_Identity, Output]


@dataclass(slots=True)
class Run:
    """The files that a run has read, by their names then, and its outputs."""

    outputs: Outputs = field(default_factory=dict)
    read: dict[_Identity, str] = field(default_factory=dict)


_RUN: ContextVar[Run | None] = ContextVar("run", default=None)


@contextmanager
def refusing_overwriting() -> Iterator[None]:
    """Let `reading` and `claim` raise OverwriteError until the block ends."""
    token = _RUN.set(Run())
    try:
        yield
    finally:
        _RUN.reset(token)


def outputs() -> Outputs:
    """Return the outputs that are known of this run, for `continue_run`."""
    run = _RUN.get()
    return {} if run is None else run.outputs


def continue_run(known: Outputs) -> None:
    """Refuse in this process what the run refuses that started it."""
    _RUN.set(Run(known))


def reading(path: StrPath | None) -> None:
    """Note a file that the run reads, None for standard input; raises OverwriteError for one that is an output."""
    run = _RUN.get()
    identity = None if run is None else _identity(path)
    if run is None or identity is None:
        return
    run.read[identity] = _STDIN if path is None else os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    output = run.outputs.get(identity)
    if output is None:
        return
    if _identity(output.path) == identity if path is None else _is_same(output.path, path):
        raise _refusal(output, _STDIN if path is None else os.fspath(path))


def claim(path: StrPath, option: str = "") -> None:
    """Note a file that the run writes.

    An option claims its output when the command line is read. What is written later without an option may be the
    output of an option, by the same path. Raises OverwriteError for a file that the run reads, and for another output.
    """
    run = _RUN.get()
    if run is None:
        return
    absolute = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    output = Output(option, os.fspath(path), absolute)
    if (read := _read_as(run, path)) is not None:
        raise _refusal(output, read)
    identity = _identity(path) or _real(path)
    if identity is None:
        return
    other = run.outputs.setdefault(identity, output)
    if other is not output and (option or other.path != absolute) and _is_same(other.path, path):
        raise OverwriteError(f"{output} is also the file of {other}: give another name")


def is_read(path: StrPath) -> bool:
    """Return True if the run has read the file."""
    run = _RUN.get()
    return run is not None and _read_as(run, path) is not None


def _read_as(run: Run, path: StrPath) -> str | None:
    """Return the name by which the run has read a file; numbers of files that are gone are given to new ones."""
    identity = _identity(path)
    read = None if identity is None else run.read.get(identity)
    if read == _STDIN:
        return read if _identity(None) == identity else None
    return read if read is not None and _is_same(read, path) else None


def _refusal(output: Output, read: str) -> OverwriteError:
    absolute = read != _STDIN and os.path.isabs(read)  # noqa: PTH117 - text
    shown = relative_path(read) if absolute else read.replace(os.sep, "/")
    return OverwriteError(f"{output} would replace {shown}, which this run reads: give another name")


def _identity(path: StrPath | None) -> _Identity | None:
    """Return the device and the number of a regular file, None for standard input; None for anything else."""
    try:
        found = os.fstat(sys.stdin.fileno()) if path is None else os.stat(path)  # noqa: PTH116 - Path raises for long names
    except (OSError, ValueError, AttributeError):  # standard input is closed, or no stream of the system
        return None
    return (found.st_dev, found.st_ino) if S_ISREG(found.st_mode) else None


def _real(path: StrPath) -> str | None:
    """Return the real path of a file that is not there yet; None for what is there and is not a regular file."""
    try:
        return None if os.path.exists(path) else os.path.normcase(os.path.realpath(path))  # noqa: PTH110 - as above
    except (OSError, ValueError):
        return None


def _is_same(one: StrPath, other: StrPath) -> bool:
    """Return True if two paths lead to one file, or would if both were there."""
    try:
        return os.path.samefile(one, other)  # noqa: PTH121 - as above
    except (OSError, ValueError):
        return _real(one) is not None and _real(one) == _real(other)
