"""The output folder as it is: what stands in the way of the new files."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from mudline.variations.manifest import MANIFEST
from mudline.variations.planning import ExpansionPlan


def conflicts(folder: Path, planned: ExpansionPlan, source: Path | None, *, force: bool) -> list[str]:
    """Why files of a plan may not be written into a folder, as sentences; `force` lets files be overwritten.

    Links are not followed out of the folder, and the source itself is never overwritten.
    """
    try:
        return list(_conflicts(folder, planned, source, force=force))
    except (OSError, ValueError) as error:
        return [f"{folder.as_posix()}: cannot be looked at: {str(error).lower()}"]


def lacking(folder: Path, planned: ExpansionPlan) -> list[str]:
    """The files that the new decks name and that do not stand where one of them would look."""
    parents = {(folder / deck.path).parent for deck in planned.decks} if planned.companions else set()
    return [
        name
        for name in planned.companions
        if not all(os.path.exists(parent / name) for parent in parents)  # noqa: PTH110 - Path raises where it may not look
    ]


def _conflicts(folder: Path, planned: ExpansionPlan, source: Path | None, *, force: bool) -> Iterator[str]:
    if folder.exists() and not folder.is_dir():
        yield f"{folder.as_posix()}: is a file: the decks need a folder"
        return
    root = os.path.realpath(folder)
    inside: dict[Path, bool] = {}
    for name in (*(deck.path for deck in planned.decks), MANIFEST):
        path = folder / name
        if path.parent not in inside:
            inside[path.parent] = os.path.commonpath([root, os.path.realpath(path.parent)]) == root
        if not inside[path.parent]:
            yield f"{path.as_posix()}: a link in its path leads out of the folder"
        elif os.path.lexists(path):
            yield from _there(path, source, force=force)
        elif (file := _file_above(folder, path)) is not None:
            yield f"{path.as_posix()}: {file.as_posix()} is a file, not a folder"


def _there(path: Path, source: Path | None, *, force: bool) -> Iterator[str]:
    """What is wrong with a path that exists."""
    if path.is_symlink() or not path.is_file():
        yield f"{path.as_posix()}: is there already, and no file that could be overwritten"
    elif source is not None and source.exists() and path.samefile(source):
        yield f"{path.as_posix()}: is the deck itself, which is not overwritten"
    elif not force:
        yield f"{path.as_posix()}: is there already: --force overwrites it"


def _file_above(folder: Path, path: Path) -> Path | None:
    """A file where a folder is needed."""
    above = (parent for parent in path.parents if parent != folder and folder in parent.parents)
    return next((parent for parent in above if parent.exists() and not parent.is_dir()), None)
