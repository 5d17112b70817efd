"""Verdicts on the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import print_table
from mudline.cli.verdict import Verdict

_STYLES = {"legal": "green", "illegal": "bold red", "empty": "bold red"}
_COLUMNS = ("verdict", "errors", "sections", "keywords", "curves", "elements", "file")


def print_verdicts(verdicts: Sequence[Verdict], total: dict[str, int], color: str) -> None:
    """A row a deck, the file last as it may be long, and a total."""
    rows = [[str(getattr(verdict, name)) for name in _COLUMNS] for verdict in verdicts]
    printer = console(color)
    print_table(printer, "Decks", _COLUMNS, rows, left=("verdict", "file"), styles=_STYLES, whole=("file",))
    style = "green" if total["legal"] == total["decks"] else "red"
    noun = "deck" if total["decks"] == 1 else "decks"
    printer.print(Text(f"{total['legal']} of {total['decks']} {noun} legal", style=style))
