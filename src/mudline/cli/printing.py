"""Texts for people with rich: coloured lines, tables, and the progress bar of a long run."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING, NamedTuple

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from mudline.basics.display import Cell, DisplayTable
from mudline.basics.quantities import shown
from mudline.checks.output import visible

if TYPE_CHECKING:
    from rich.progress import Progress

WIDTH = 100
"""Columns of a table without a terminal."""

_WIDE = 10_000
_GAPS = (2, 1)
"""Blanks between columns, and between the columns of a table that is too wide otherwise."""
_NARROWEST = 12
"""Width below which columns of text are not wrapped."""


class _Console(Console):
    def on_broken_pipe(self) -> None:
        """Raise BrokenPipeError, which the command handles."""
        raise BrokenPipeError


class Printer:
    """Printer on standard output. Text of a deck stays plain text; without a terminal only tables are wrapped."""

    def __init__(self, color: str) -> None:
        """Take the colours of `color`: "auto", "always" or "never"."""
        terminal = sys.stdout.isatty()
        plain = color == "never" or (color == "auto" and (not terminal or bool(os.environ.get("NO_COLOR"))))
        self._console = _Console(
            file=sys.stdout,
            force_terminal=True if color == "always" else None,
            color_system=None if plain else "standard" if color == "always" else "auto",
            no_color=plain,
            width=None if terminal else _WIDE,
            markup=False,
            highlight=False,
            emoji=False,
            soft_wrap=True,
        )
        self.width = self._console.width if terminal else WIDTH
        self.encoding = self._console.encoding
        self.colored = self._console.color_system is not None and not self._console.legacy_windows
        self._rule = "\u2500" if self.encoding.startswith("utf") else "-"

    def visible(self, text: str) -> str:
        """Return text of a deck in a form that the terminal can show."""
        return visible(text, self.encoding)

    def line(self, *parts: str | tuple[str, str], fold: bool = True) -> None:
        """Print a line; on a terminal a long line is wrapped between words."""
        self._console.print(Text.assemble(*parts), soft_wrap=not fold)

    def table(self, table: DisplayTable) -> None:
        """Print cells under their headings, with a blank line after the table.

        Long texts are wrapped, so the column of the longest should be last. A table becomes wider than the screen
        rather than cut a number or a column that stays whole.
        """
        table = table.filled()
        columns = table.columns
        digits = [column.digits for column in columns]
        cells = [list(map(self._cell, row, digits)) for row in table.cells()]
        depth = max(column.head.count("\n") for column in columns)
        padded = (("\n" * (depth - column.head.count("\n")) + column.head).split("\n") for column in columns)
        heads = list(zip(*([self.visible(line) for line in lines] for lines in padded), strict=True))
        texts = ([text for text, _ in row] for row in cells)
        widths = [max(map(cell_len, column)) for column in zip(*heads, *texts, strict=True)]
        to_left = [column.left for column in columns]
        foldable = [column.left and not column.whole for column in columns]
        # Columns are moved closer together if they do not fit otherwise.
        layouts = [_TableLayout(_fitted(widths, foldable, self.width, gap), to_left, gap) for gap in _GAPS]
        layout = next((layout for layout in layouts if layout.width <= self.width), layouts[0])
        if table.title:
            self.line((self.visible(table.title), "bold"))
        lines: list[Iterable[_Styled]] = [layout.line([(text, "") for text in head]) for head in heads]
        lines.append([(self._rule * layout.width, "dim")])
        lines += (layout.line(part) for row in cells for part in layout.folded(row, self._console))
        if self.colored:
            for line in lines:
                text = Text.assemble(*line)
                text.rstrip()
                self._console.print(text, soft_wrap=True)
        else:
            self._console.file.writelines("".join(text for text, _ in line).rstrip() + "\n" for line in lines)
        if below := table.more or table.note:
            self.line((self.visible(below), "dim"))
        self._console.print()

    def _cell(self, cell: Cell, digits: int) -> _Styled:
        """Return the text of a cell, and its style."""
        value, style = cell if isinstance(cell, tuple) else (cell, "")
        text = value if isinstance(value, str) else str(value) if isinstance(value, int) else shown(value, digits)
        return self.visible(text), style


_Styled = tuple[str, str]


class _TableLayout(NamedTuple):
    """Layout of a table: widths of the columns, which of them are aligned left, and the blanks between them."""

    widths: list[int]
    to_left: list[bool]
    gap: int

    @property
    def width(self) -> int:
        """Width of the whole table."""
        return sum(self.widths) + self.gap * (len(self.widths) - 1)

    def folded(self, row: Sequence[_Styled], console: Console) -> Iterable[Sequence[_Styled]]:
        """Return a row as one line of cells, or several if a text is wrapped."""
        if all(cell_len(text) <= width for (text, _), width in zip(row, self.widths, strict=True)):
            return [row]
        folded = [
            [(part.plain.rstrip(), style) for part in Text(text).wrap(console, width)]
            for (text, style), width in zip(row, self.widths, strict=True)
        ]
        return zip_longest(*folded, fillvalue=("", ""))

    def line(self, cells: Iterable[_Styled]) -> Iterator[_Styled]:
        """Yield the cells of a line, aligned, with blanks between them."""
        gap = ""
        for (text, style), width, left in zip(cells, self.widths, self.to_left, strict=True):
            blanks = " " * (width - cell_len(text))
            yield gap + ("" if left else blanks), ""
            yield text, style
            yield blanks if left else "", ""
            gap = " " * self.gap


def _fitted(widths: list[int], foldable: list[bool], available: int, gap: int) -> list[int]:
    """Return the widths, less what the widest columns of text must give up until the table fits or all are narrow."""
    fitted = list(widths)
    while sum(fitted) + gap * (len(fitted) - 1) > available:
        widest = max((width for width, text in zip(fitted, foldable, strict=True) if text), default=0)
        if widest <= _NARROWEST:
            return fitted
        column = next(i for i, text in reversed([*enumerate(foldable)]) if text and fitted[i] == widest)
        fitted[column] -= 1
    return fitted


def bar(total: int, color: str) -> Progress:
    """Return a progress bar of `total` steps on one line of standard error, drawn without a thread."""
    from rich.progress import (  # noqa: PLC0415 - large, and a bar is rare
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TimeRemainingColumn,
    )

    plain = color == "never" or bool(os.environ.get("NO_COLOR"))
    progress = Progress(
        BarColumn(bar_width=None),
        MofNCompleteColumn(),
        TimeRemainingColumn(compact=True),
        console=Console(file=sys.stderr, force_interactive=True, no_color=plain),
        auto_refresh=False,
        transient=True,
        expand=True,
        redirect_stdout=False,
        redirect_stderr=False,
    )
    progress.add_task("", total=total)
    return progress
