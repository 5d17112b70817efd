"""The ladder of extremes: verdicts on small decks with the largest and smallest numbers, by family.

The decks and their exact results are those of a test, which says what is compared.
"""

from __future__ import annotations

from collections.abc import Callable

from tests.benchmarks.tables import Cell, save
from tests.model.contact.extreme_decks import FAMILIES, Verdict, judge

NAME = "stability-ladder"


def run(progress: Callable[[str], None]) -> None:
    """Write the table."""
    progress("ladder of extremes")
    rows: list[list[Cell]] = []
    for family, (values, deck) in FAMILIES.items():
        found = [judge(family, value, deck(value)) for value in values]
        counts = [sum(one.verdict is verdict for one in found) for verdict in Verdict]
        ends = f"{values[0]} to {values[-1]}"
        rows.append(
            [family, ends, len(found), *counts, sum(one.results for one in found), max(one.error for one in found)]
        )
    heads = ("number", "values", "decks", *(str(verdict) for verdict in Verdict), "results", "largest error [2^-53]")
    save(NAME, heads, rows)
