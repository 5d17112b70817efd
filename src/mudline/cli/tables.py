"""Plain tables on the terminal. A number is never cut: rather than that, a table is wider than the screen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import zip_longest
from types import MappingProxyType
from typing import NamedTuple

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from mudline.linting.output.visible import visible

_GAP = "  "
_UNSTYLED: Mapping[str, str] = MappingProxyType({})
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
    styles: Mapping[str, str] = _UNSTYLED,
    whole: Sequence[str] = (),
) -> None:
    """Print texts under their headings, with a blank line behind.

    Numbers stand to the right, the columns named in `left` to the left; only these are folded on a narrow terminal,
    those named in `whole` not even then. A heading may have several lines. `note` stands below the table; `styles`
    gives cells that hold just these words a style. Deck text is printed as plain text.
    """
    heads = [name.split("\n") for name in columns]
    cells = [[visible(cell, printer.encoding) for cell in row] for row in rows]
    widths = [max(map(cell_len, column)) for column in zip(*_filled(heads), *cells, strict=True)]
    folds = [name in left and name not in whole for name in columns]
    layout = _Layout(_fitted(widths, folds, printer.width), [name in left for name in columns])
    width = sum(layout.widths) + len(_GAP) * (len(columns) - 1)
    printer.print(Text(visible(title, printer.encoding), style="bold"), soft_wrap=False)
    for names in _filled(heads):
        printer.print(Text(layout.line(names)))
    printer.print(Text(("\u2500" if printer.encoding.startswith("utf") else "-") * width, style="dim"))
    lines = (line for row in cells for line in layout.lines(row, printer))
    if styles:
        for line in lines:
            printer.print(layout.styled(line, styles))
    elif cells:
        printer.out("\n".join(map(layout.line, lines)), highlight=False)
    if note:
        printer.print(Text(visible(note, printer.encoding), style="dim"), soft_wrap=False)
    printer.print()


class _Layout(NamedTuple):
    """Widths of the columns, and which of them stand to the left."""

    widths: list[int]
    to_left: list[bool]

    def lines(self, row: list[str], printer: Console) -> Iterable[Sequence[str]]:
        """A row as one line of cells, or several where a text is folded."""
        if all(cell_len(cell) <= width for cell, width in zip(row, self.widths, strict=True)):
            return [row]
        folded = [
            [part.plain.rstrip() for part in Text(cell).wrap(printer, width)]
            for cell, width in zip(row, self.widths, strict=True)
        ]
        return zip_longest(*folded, fillvalue="")

    def line(self, cells: Sequence[str]) -> str:
        """Cells side by side, without blanks behind the last."""
        return _GAP.join(self._padded(cells)).rstrip()

    def styled(self, cells: Sequence[str], styles: Mapping[str, str]) -> Text:
        """The same with the cells that have a style."""
        text = Text()
        for cell, padded in zip(cells, self._padded(cells), strict=True):
            text.append(_GAP if text else "").append(padded, styles.get(cell))
        text.rstrip()
        return text

    def _padded(self, cells: Sequence[str]) -> Iterator[str]:
        for cell, width, left in zip(cells, self.widths, self.to_left, strict=True):
            blanks = " " * (width - cell_len(cell))
            yield cell + blanks if left else blanks + cell


def _filled(heads: list[list[str]]) -> list[tuple[str, ...]]:
    """The lines of the headings, which stand at the bottom."""
    depth = max(len(head) for head in heads)
    return list(zip(*([""] * (depth - len(head)) + head for head in heads), strict=True))


def _fitted(widths: list[int], folds: list[bool], available: int) -> list[int]:
    """Take from the widest column of text until the table fits or all of them are narrow."""
    fitted = list(widths)
    while sum(fitted) + len(_GAP) * (len(fitted) - 1) > available:
        widest = max((width for width, text in zip(fitted, folds, strict=True) if text), default=0)
        if widest <= _NARROWEST:
            return fitted
        column = next(i for i, text in enumerate(folds) if text and fitted[i] == widest)
        fitted[column] -= 1
    return fitted
