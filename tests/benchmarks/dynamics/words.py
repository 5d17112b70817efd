"""Numbers and tables of the page, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def mm(metres: str | float) -> str:
    """A length in millimetres."""
    return f"{1000.0 * float(metres):.2g} mm"


def percent(share: str | float) -> str:
    """A share with two digits."""
    return f"{100.0 * float(share):.2g} %"


def power(value: str | float) -> str:
    """A small number, with one digit."""
    number = float(value)
    return f"{number:.0e}".replace("e-0", "e-").replace("e+0", "e") if number else "0"
