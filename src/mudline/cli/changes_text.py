"""A diff in colours."""

from __future__ import annotations

from collections.abc import Iterable

from rich.text import Text

from mudline.cli.console import console, say
from mudline.linting.output.visible import visible_lines

_STYLES = {"+++": "bold", "---": "bold", "@@ ": "cyan", "+": "green", "-": "red"}


def print_diff(lines: Iterable[str], color: str) -> None:
    """Print the lines of a unified diff."""
    say(console(color), (Text(visible_lines(line.rstrip("\r\n")), style=_style(line)) for line in lines))


def _style(line: str) -> str:
    return next((style for mark, style in _STYLES.items() if line.startswith(mark)), "")
