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
    return f"{short(1000.0 * float(metres))} mm"


def percent(share: str | float) -> str:
    """A share with two digits."""
    return f"{short(100.0 * float(share))} %"


def short(value: float) -> str:
    """Two digits, or all in front of the point."""
    return f"{value:.0f}" if abs(value) >= 10.0 else f"{value:.2g}"


def power(value: str | float) -> str:
    """A small number, with one digit."""
    number = float(value)
    return f"{number:.0e}".replace("e-0", "e-").replace("e+0", "e") if number else "0"


def listed(words: Iterable[str]) -> str:
    """A, b and c."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last


def wrapped(*sentences: str) -> str:
    """A paragraph, or a bullet if it begins with one."""
    text = " ".join(sentences)
    indent = "  " if text.startswith("* ") else ""
    return fill(text, _WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def rewrapped(text: str) -> str:
    """A text whose paragraphs and bullets had numbers put in; headings, tables and code stay as they are."""
    found: list[str] = []
    for block in text.split("\n\n"):
        if block.lstrip("\n").startswith(("#", "|", "```", "![")):
            found.append(block)
            continue
        bullets = block.replace("\n  ", " ").split("\n* ")
        words = [" ".join(bullet.split()) for bullet in bullets]
        ends = "\n" if block.endswith("\n") else ""
        found.append("\n".join([wrapped(words[0]), *(wrapped(f"* {word}") for word in words[1:])]) + ends)
    return "\n\n".join(found)
