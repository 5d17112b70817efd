"""`mudline lint --watch`: lint, wait until something changes, and lint again, until Ctrl-C."""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NoReturn

import click

from mudline.cli.inputs import GITIGNORE, STDIN, is_deck
from mudline.cli.streams import notify
from mudline.cli.view import View
from mudline.lean import dataclass
from mudline.linting.configuration import base_paths
from mudline.linting.output import TEXT

WAIT = 0.3
"""Seconds between two checks; more where a check takes long, so that waiting costs little."""

_FACTOR = 10
"""Seconds of waiting per second of checking, at least."""
_CONFIGURATIONS = ("mudline.toml", "pyproject.toml")
_RULES = (*_CONFIGURATIONS, GITIGNORE)
_PRINTED = (TEXT, "concise")

State = dict[str, tuple[int, int]]
"""When each file was changed, in nanoseconds, and its size."""


def refuse(writing: Mapping[str, bool], paths: Sequence[str], form: str) -> None:
    """Raise click.UsageError for what cannot be repeated."""
    for option, given in writing.items():
        if given:
            raise click.UsageError(f"--watch and {option} exclude each other: give one of them")
    if STDIN in paths:
        raise click.UsageError("--watch needs files: standard input can be read once only")
    if form not in _PRINTED:
        raise click.UsageError(
            f"--watch prints {' or '.join(_PRINTED)}, not {form}; "
            f"--output-format {form}=FILE writes a file after each change"
        )


@dataclass(frozen=True)
class Watched:
    """The files and folders given, other decks beside them, and configurations that may apply, with what they extend.

    `others` are a configuration and a baseline that were named.
    """

    paths: tuple[str, ...]
    others: tuple[str, ...] = ()

    def state(self) -> State:
        """The state of all files now. Those that are missing or unreadable are left out."""
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
        for path in [path for path in found if os.path.basename(path) in _CONFIGURATIONS or path in self.others]:  # noqa: PTH119 - as above
            for base in base_paths(Path(path)):
                _look(str(base), found)
        return found


def watched(once: Callable[[], int], files: Watched, view: View) -> NoReturn:
    """Lint, and again after each change; ends by KeyboardInterrupt only. An error that ends a run is reported."""
    while True:
        before = files.state()
        click.clear()
        try:
            once()
        except click.ClickException as error:
            notify(error.format_message())
        if not view.quiet:
            notify(f"{time.strftime('%H:%M:%S')}: waiting for changes; Ctrl-C ends")
        wait_for_change(files, before)


def wait_for_change(files: Watched, before: State) -> None:
    """Return as soon as the files differ from `before`, and no longer change."""
    now = before
    while now == before:
        start = time.perf_counter()
        now = files.state()
        if now == before:
            time.sleep(max(WAIT, _FACTOR * (time.perf_counter() - start)))
    while (later := _after(files)) != now:
        now = later


def _after(files: Watched) -> State:
    """The state a moment later: editors write in several steps."""
    time.sleep(WAIT / 6)
    return files.state()


def _files(given: str) -> Iterator[str]:
    """The files in a folder and below; for a file, the decks beside it, which it may continue."""
    if _is_folder(given):
        for folder, _, names in os.walk(given):
            yield from (os.path.join(folder, name) for name in names if is_deck(name) or name in _RULES)  # noqa: PTH118 - many files
        return
    folder = os.path.dirname(given) or "."  # noqa: PTH120 - as above
    try:
        names = os.listdir(folder)  # noqa: PTH208 - as above
    except OSError:
        return
    yield from (os.path.join(folder, name) for name in names if is_deck(name))  # noqa: PTH118 - as above


def _is_folder(path: str) -> bool:
    return os.path.isdir(path)  # noqa: PTH112 - Path raises for a name that is too long


def _look(path: str, found: State) -> None:
    try:
        state = os.stat(path)  # noqa: PTH116 - as above
    except (OSError, ValueError):
        return
    if not stat.S_ISDIR(state.st_mode):
        found[path] = (state.st_mtime_ns, state.st_size)
