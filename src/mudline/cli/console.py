"""The console of printing modules: plain text of a deck stays plain text, and nothing is cut where no terminal is."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable

from rich.console import Console
from rich.text import Text

_WIDE = 10_000
EXCERPT_WIDTH = 120
"""Columns of a source line that are shown where no terminal sets a limit."""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """Leave to the command what it means that nobody reads any more."""
        raise BrokenPipeError


def console(color: str) -> Console:
    """A console on standard output for "auto", "always" or "never" colours."""
    terminal = sys.stdout.isatty()
    plain = color == "never" or (color == "auto" and (not terminal or bool(os.environ.get("NO_COLOR"))))
    return _Console(
        file=sys.stdout,
        force_terminal=True if color == "always" else None,
        color_system=None if plain else "standard" if color == "always" else "auto",
        no_color=plain,
        width=None if terminal else _WIDE,
        markup=False,
        highlight=False,
        emoji=False,
        soft_wrap=True,
    )


def say(printer: Console, texts: Iterable[Text]) -> None:
    """Print lines, folded between words on a terminal; where there is no terminal and no colour, in the quick way."""
    if printer.is_terminal or printer.color_system is not None:
        for text in texts:
            printer.print(text, soft_wrap=False)
    else:
        printer.file.writelines(f"{text.plain}\n" for text in texts)
