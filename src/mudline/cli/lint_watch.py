"""`mudline lint --watch`: lint, wait until something changes, and lint again, until Ctrl-C."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from stat import S_ISREG
from typing import NoReturn

import click

from mudline.checks.output import TEXT
from mudline.cli.inputs import STDIN, is_deck
from mudline.cli.streams import notify
from mudline.cli.view import View

WAIT = 0.3
"""Seconds between two looks."""

_CONFIGURATIONS = ("mudline.toml", "pyproject.toml")
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


def watched(once: Callable[[], int], paths: Sequence[str], view: View) -> NoReturn:
    """Lint, and again after each change; ends by KeyboardInterrupt only. An error that ends a run is reported."""
    while True:
        before = state(paths)
        click.clear()
        try:
            once()
        except click.ClickException as error:
            notify(error.format_message())
        if not view.quiet:
            notify(f"{time.strftime('%H:%M:%S')}: waiting for changes; Ctrl-C ends")
        wait_for_change(paths, before)


def wait_for_change(paths: Sequence[str], before: State) -> None:
    """Return as soon as the files differ from `before`, and no longer change: editors write in several steps."""
    last, now = before, state(paths)
    while now == before or now != last:
        time.sleep(WAIT)
        last, now = now, state(paths)


def state(paths: Sequence[str]) -> State:
    """The state of the files given, of the decks below folders and beside files, and of the configurations for them.

    Those that are missing or unreadable are left out.
    """
    found: State = {}
    for file in (*paths, *(file for path in paths for file in _near(path))):
        try:
            now = os.stat(file)  # noqa: PTH116 - asked for many files
        except (OSError, ValueError):
            continue
        if S_ISREG(now.st_mode):
            found[file] = (now.st_mtime_ns, now.st_size)
    return found


def _near(given: str) -> Iterator[str]:
    """The decks and configurations in a folder and below, or beside a file; and the configurations above."""
    folder = given if os.path.isdir(given) else os.path.dirname(given) or "."  # noqa: PTH112, PTH120 - Path raises for a long name
    for place, folders, names in os.walk(folder):
        yield from (os.path.join(place, name) for name in names if is_deck(name) or name in _CONFIGURATIONS)  # noqa: PTH118 - many files
        if folder != given:
            folders.clear()
    for parent in Path(os.path.abspath(folder)).parents:  # noqa: PTH100 - links stay what they are called
        yield from (str(parent / name) for name in _CONFIGURATIONS)
