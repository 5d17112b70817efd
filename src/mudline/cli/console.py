"""The console of printing modules: plain text of a deck stays plain text, and nothing is cut where no terminal is."""

from __future__ import annotations

import os
import sys

from rich.console import Console

_WIDE = 200


def console(color: str) -> Console:
    """A console on standard output for "auto", "always" or "never" colours."""
    terminal = sys.stdout.isatty()
    plain = color == "never" or (color == "auto" and (not terminal or "NO_COLOR" in os.environ))
    return Console(
        file=sys.stdout,
        force_terminal=True if color == "always" else None,
        color_system=None if plain else "standard" if color == "always" else "auto",
        width=None if terminal else _WIDE,
        markup=False,
        highlight=False,
        emoji=False,
        soft_wrap=True,
    )
