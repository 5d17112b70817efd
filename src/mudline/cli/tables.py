"""Plain tables on the terminal. A number is never cut: rather than that, a table is wider than the screen."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import zip_longest

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from mudline.lint.output.visible import visible

_GAP = "  "
_NARROWEST = 12
"""Columns of text are not folded below this width."""


def print_table(
    printer: Console,
    title: str,
    columns: Sequence[str],
    rows: Iterable[Sequence[str]],
    *,
    left: Sequence[str] = (),
    note: str = "",
) -> None:
    """Print texts under their headings, with a blank line behind.

    Numbers stand to the right, the columns named in `left` to the left; only these are folded on a narrow terminal.
    A heading may have several lines. `note` stands below the table. Deck text is printed as plain text.
    """
    heads = [name.split("\n") for name in columns]
    cells = [[visible(cell, printer.encoding) for cell in row] for row in rows]
    to_left = [name in left for name in columns]
    widths = [
        max(cell_len(text) for text in (*head, *column))
        for head, column in zip(heads, zip(*cells, strict=True) if cells else [()] * len(heads), strict=True)
    ]
    widths = _fitted(widths, to_left, printer.width)
    rule = ("\u2500" if printer.encoding.startswith("utf") else "-") * (sum(widths) + len(_GAP) * (len(widths) - 1))
    printer.print(Text(visible(title, printer.encoding), style="bold"))
    depth = max(len(head) for head in heads)
    for line in zip(*([""] * (depth - len(head)) + head for head in heads), strict=True):
        printer.print(Text(_line(line, widths, to_left)))
    printer.print(Text(rule, style="dim"))
    if cells:
        printer.out("\n".join(line for row in cells for line in _lines(row, widths, to_left, printer)), highlight=False)
    if note:
        printer.print(Text(visible(note), style="dim"))
    printer.print()


def _fitted(widths: list[int], to_left: list[bool], available: int) -> list[int]:
    """Take from the widest column of text until the table fits or all of them are narrow."""
    fitted = list(widths)
    while sum(fitted) + len(_GAP) * (len(fitted) - 1) > available:
        widest = max((width for width, text in zip(fitted, to_left, strict=True) if text), default=0)
        if widest <= _NARROWEST:
            return fitted
        column = next(i for i, text in enumerate(to_left) if text and fitted[i] == widest)
        fitted[column] -= 1
    return fitted


def _lines(row: list[str], widths: list[int], to_left: list[bool], printer: Console) -> Iterable[str]:
    """A row, on several lines where a text is folded."""
    if all(cell_len(cell) <= width for cell, width in zip(row, widths, strict=True)):
        return [_line(row, widths, to_left)]
    folded = [
        [part.plain.rstrip() for part in Text(cell).wrap(printer, width)]
        for cell, width in zip(row, widths, strict=True)
    ]
    return [_line(line, widths, to_left) for line in zip_longest(*folded, fillvalue="")]


def _line(cells: Sequence[str], widths: list[int], to_left: list[bool]) -> str:
    padded = (
        cell + " " * (width - cell_len(cell)) if text else " " * (width - cell_len(cell)) + cell
        for cell, width, text in zip(cells, widths, to_left, strict=True)
    )
    return _GAP.join(padded).rstrip()
