"""Which files a deck may name: those outside of its project are read, but not shown, and may be refused."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path, PurePath

_PROJECT = (".git", "mudline.toml", "pyproject.toml")
"""What the folder of a project has: a repository or a configuration."""
_NO_FILES = ("/proc", "/sys", "/dev")
"""Folders whose files are no files: what is read there is made by the system."""

_NO_TEXT = "its text is not shown, as the file lies outside of the project"
_AT_LINE = re.compile(r"line \d+")

_REFUSES: ContextVar[Callable[[Path], bool] | None] = ContextVar("refuses", default=None)


@contextmanager
def refusing_outside(refuses: Callable[[Path], bool]) -> Iterator[None]:
    """Until the block ends, decks of the folders for which `refuses` is true name no file outside of their project."""
    token = _REFUSES.set(refuses)
    try:
        yield
    finally:
        _REFUSES.reset(token)


@lru_cache(maxsize=256)
def project_of(folder: Path) -> Path:
    """The folder of the project that a folder is in: the nearest with a repository or a configuration, else itself."""
    here = Path(os.path.realpath(folder))
    for each in (here, *here.parents):
        if any(os.path.exists(each / name) for name in _PROJECT):  # noqa: PTH110 - Path raises where nobody may search
            return each
    return here


def is_outside(path: Path, folder: Path) -> bool:
    """Whether a path, with all links followed, leads out of the project of the deck's folder."""
    return not Path(os.path.realpath(path)).is_relative_to(project_of(folder))


def is_refused(path: Path, folder: Path) -> bool:
    """Whether a deck in a folder may not name the file: it lies outside of the project, and that is refused."""
    refuses = _REFUSES.get()
    return refuses is not None and is_outside(path, folder) and refuses(folder)


def is_made_by_system(path: Path) -> bool:
    """Whether a path leads, with all links followed, to a file that only looks like one."""
    real = PurePath(os.path.realpath(path))
    return any(real.is_relative_to(each) for each in _NO_FILES)


def without_text(fault: str, path: Path, folder: Path | None) -> str:
    """What is wrong with a file, without a text of it where it lies outside of the project: the line remains."""
    if folder is None or not is_outside(path, folder):
        return fault
    line = _AT_LINE.search(fault)
    return f"{line[0]} is not as it should be; {_NO_TEXT}" if line else f"it is not as it should be; {_NO_TEXT}"
