"""What would change in a file, as a unified diff on standard output."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterator

from mudline.cli.lazy import printing
from mudline.cli.streams import emit

_NO_END = "\\ No newline at end of file\n"


def tell_changes(old: str, new: str, name: str, color: str, *, created: bool = False) -> None:
    """Print the diff; `created` says that the file is new. A pipe gets the lines as they are, fit for a patch."""
    lines = unified_diff(old, new, name, created=created)
    if color == "always" or (color == "auto" and sys.stdout.isatty()):
        printing("changes").print_diff(lines, color)
    else:
        emit(lines)


def unified_diff(old: str, new: str, name: str, *, created: bool = False) -> Iterator[str]:
    """The lines of a diff with their ends; nothing when the texts are equal. Only LF ends a line."""
    before = "/dev/null" if created else name
    for line in difflib.unified_diff(_lines(old), _lines(new), before, name):
        yield line if line.endswith("\n") else f"{line}\n{_NO_END}"


def _lines(text: str) -> list[str]:
    *lines, last = text.split("\n")
    return [f"{line}\n" for line in lines] + ([last] if last else [])
