"""Planned decks on the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import print_table
from mudline.variations.rewriting import PlannedDeck

_COLUMNS = ("file", "case", "values")


def print_decks(decks: Sequence[PlannedDeck], color: str) -> None:
    """A row a deck: its file, what it shows, the values of its parameters; then how many there are."""
    rows = [
        [deck.path, deck.description, ", ".join(f"{name}={text}" for name, text in deck.values.items())]
        for deck in decks
    ]
    printer = console(color)
    print_table(printer, "Decks", _COLUMNS, rows, left=_COLUMNS, whole=("file",))
    printer.print(Text(f"{len(decks)} deck{'' if len(decks) == 1 else 's'}"))
