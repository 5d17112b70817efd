"""`mudline lint --watch`: lint, wait until something changes, and lint again, until Ctrl-C."""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import click

from mudline.cli.inputs import STDIN, is_deck
from mudline.cli.lint_outputs import Outputs
from mudline.cli.options import View
from mudline.cli.searching import GITIGNORE
from mudline.cli.terminal import tell
from mudline.linting.output.formats import TEXT

WAIT = 0.3
"""Seconds between two looks; more where a look takes long, so that waiting costs little."""

_LOOKS = 10
_CONFIGURATIONS = ("mudline.toml", "pyproject.toml")
_RULES = (*_CONFIGURATIONS, GITIGNORE)
_PRINTED = (TEXT, "concise")

State = dict[str, tuple[int, int]]
"""When each file was changed, in nanoseconds, and its size."""


def refuse(writing: Mapping[str, bool], paths: Sequence[str], told: Outputs) -> None:
    """Raise click.UsageError for what cannot be done again and again."""
    for option, given in writing.items():
        if given:
            raise click.UsageError(f"--watch only looks, and {option} writes or compares: give one of them")
    if STDIN in paths:
        raise click.UsageError("--watch needs files: standard input can be read once only")
    if told.form not in _PRINTED:
        raise click.UsageError(
            f"--watch prints for people: {' or '.join(_PRINTED)}, not {told.form}; "
            f"--output-format {told.form}=FILE writes a file after each change"
        )


@dataclass(frozen=True)
class Watched:
    """What is looked at: the files and folders given, other decks beside them, configurations that may hold for them.

    `others` are a configuration and a baseline that were named.
    """

    paths: tuple[str, ...]
    others: tuple[str, ...] = ()

    def state(self) -> State:
        """How all files are now. What is not there, or may not be looked at, is left out."""
        folders = {os.path.abspath(path if _is_folder(path) else os.path.dirname(path)) for path in self.paths}  # noqa: PTH100, PTH120 - links stay what they are called
        found: State = {}
        for path in (*self.paths, *self.others):
            _look(path, found)
        for folder in folders:
            for place in Path(folder, "-").parents:
                for name in _RULES:
                    _look(str(place / name), found)
        for file in (file for path in self.paths for file in _files(path)):
            _look(file, found)
        return found


def watched(once: Callable[[], int], files: Watched, view: View) -> NoReturn:
    """Lint, and again after each change; ends by KeyboardInterrupt only. What ends a run is told, and waited out."""
    while True:
        before = files.state()
        click.clear()
        try:
            once()
        except click.ClickException as error:
            tell(error.format_message())
        if not view.quiet:
            tell(f"{time.strftime('%H:%M:%S')}: waiting for changes; Ctrl-C ends")
        wait_for_change(files, before)


def wait_for_change(files: Watched, before: State) -> None:
    """Return as soon as the files are no longer as they were, and have come to rest."""
    now = before
    while now == before:
        start = time.perf_counter()
        now = files.state()
        if now == before:
            time.sleep(max(WAIT, _LOOKS * (time.perf_counter() - start)))
    while (later := _after(files)) != now:
        now = later


def _after(files: Watched) -> State:
    """How files are a moment later: editors write in several steps."""
    time.sleep(WAIT / 6)
    return files.state()


def _files(given: str) -> Iterator[str]:
    """The files of a folder and below; for a file, the decks beside it, which it may continue."""
    if _is_folder(given):
        for folder, _, names in os.walk(given):
            yield from (os.path.join(folder, name) for name in names if is_deck(Path(name)) or name in _RULES)  # noqa: PTH118 - many files
        return
    folder = os.path.dirname(given) or "."  # noqa: PTH120 - as above
    try:
        names = os.listdir(folder)  # noqa: PTH208 - as above
    except OSError:
        return
    yield from (os.path.join(folder, name) for name in names if is_deck(Path(name)))  # noqa: PTH118 - as above


def _is_folder(path: str) -> bool:
    return os.path.isdir(path)  # noqa: PTH112 - Path raises for a name that is too long


def _look(path: str, found: State) -> None:
    try:
        state = os.stat(path)  # noqa: PTH116 - as above
    except (OSError, ValueError):
        return
    if not stat.S_ISDIR(state.st_mode):
        found[path] = (state.st_mtime_ns, state.st_size)
