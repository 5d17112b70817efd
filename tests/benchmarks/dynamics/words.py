"""Numbers and tables of the page, as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from textwrap import fill

_WIDTH = 120


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


def wrapped(*sentences: str) -> str:
    """A paragraph, or a bullet if it begins with one."""
    text = " ".join(sentences)
    return fill(text, _WIDTH, subsequent_indent="  " if text.startswith("* ") else "", break_long_words=False,
                break_on_hyphens=False)  # fmt: skip
