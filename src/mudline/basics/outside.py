"""Files that a deck may name: those outside its project are read but not shown, and may be refused."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from contextlib import AbstractContextManager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path, PurePath

from mudline.basics.contexts import holding

CONFIGURATIONS = ("mudline.toml", "pyproject.toml")
"""Names of the file with the configuration of a folder; the first that is there applies."""
_PROJECT = (".git", *CONFIGURATIONS)
"""Names that mark the folder of a project: a repository or a configuration."""
_NO_FILES = ("/proc", "/sys", "/dev")
"""Folders of virtual files, whose content the system makes when they are read."""

_NO_TEXT = "its text is not shown, as the file lies outside of the project"

_REFUSES: ContextVar[Callable[[Path], bool] | None] = ContextVar("refuses", default=None)


def refusing_outside(refuses: Callable[[Path], bool]) -> AbstractContextManager[object]:
    """Forbid decks in folders for which `refuses` is true to name files outside their project, until the block ends."""
    return holding(_REFUSES, refuses)


@lru_cache(maxsize=256)
def project_of(folder: Path) -> Path:
    """Return the nearest folder with a repository or a configuration, from a folder upwards; else the folder itself."""
    here = Path(os.path.realpath(folder))
    for parent in (here, *here.parents):
        if any(os.path.exists(parent / name) for name in _PROJECT):  # noqa: PTH110 - Path raises where nobody may search
            return parent
    return here


def is_outside(path: Path, folder: Path) -> bool:
    """Return True if a path, with links followed, lies outside the project of the deck's folder."""
    return not Path(os.path.realpath(path)).is_relative_to(project_of(folder))


def is_refused(path: Path, folder: Path) -> bool:
    """Return True if decks in a folder are forbidden to name the file because it lies outside their project."""
    refuses = _REFUSES.get()
    return refuses is not None and is_outside(path, folder) and refuses(folder)


def is_made_by_system(path: Path) -> bool:
    """Return True if a path, with links followed, leads to a virtual file of the system."""
    real = PurePath(os.path.realpath(path))
    return any(real.is_relative_to(each) for each in _NO_FILES)


def without_text(fault: str, path: Path, folder: Path | None) -> str:
    """Return the description of a fault in a file; for a file outside the project only the line, without its text."""
    if folder is None or not is_outside(path, folder):
        return fault
    line = re.search(r"line \d+", fault)
    return f"{line[0]} is not as it should be; {_NO_TEXT}" if line else f"it is not as it should be; {_NO_TEXT}"
