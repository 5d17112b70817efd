"""What would change in a file, as a unified diff on standard output."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable, Iterator

from mudline.cli.options import View
from mudline.cli.streams import emit
from mudline.linting.output import visible_lines

_NO_END = "\\ No newline at end of file\n"
_STYLES = {"+++": "bold", "---": "bold", "@@ ": "cyan", "+": "green", "-": "red"}


def print_changes(old: str, new: str, name: str, view: View, *, created: bool = False) -> None:
    """Print how a text changes; `created` means that the file is new."""
    print_diff(unified_diff(old, new, name, created=created), view)


def print_diff(lines: Iterable[str], view: View) -> None:
    """Print the lines of a unified diff, coloured on a terminal. A pipe gets them unchanged, fit for a patch."""
    if view.color == "always" or (view.color == "auto" and sys.stdout.isatty()):
        view.printer().lines((visible_lines(line.rstrip("\r\n")), _style(line)) for line in lines)
    else:
        emit(lines)


def _style(line: str) -> str:
    return next((style for mark, style in _STYLES.items() if line.startswith(mark)), "")


def unified_diff(old: str, new: str, name: str, *, created: bool = False) -> Iterator[str]:
    """The lines of a diff with their ends; nothing when the texts are equal. Only LF ends a line."""
    before = "/dev/null" if created else name
    for line in difflib.unified_diff(_lines(old), _lines(new), before, name):
        yield line if line.endswith("\n") else f"{line}\n{_NO_END}"


def _lines(text: str) -> list[str]:
    *lines, last = text.split("\n")
    return [f"{line}\n" for line in lines] + ([last] if last else [])
