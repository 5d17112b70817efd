"""Verdicts on the terminal."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict

from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import table
from mudline.cli.verdict import Verdict


def print_verdicts(verdicts: Sequence[Verdict], total: dict[str, int], color: str) -> None:
    """A row a deck, and a total."""
    rows = [[str(cell) for cell in asdict(verdict).values()] for verdict in verdicts]
    printer = console(color)
    printer.print(table("Decks", tuple(Verdict.__dataclass_fields__), rows, left=("file", "verdict")))
    style = "green" if total["legal"] == total["decks"] else "red"
    noun = "deck" if total["decks"] == 1 else "decks"
    printer.print(Text(f"{total['legal']} of {total['decks']} {noun} legal", style=style))
