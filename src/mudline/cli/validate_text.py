"""Verdicts on the terminal: ten thousand rows at once, so the lines are put together by hand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import click
from rich.cells import cell_len, set_cell_size
from rich.console import Console

from mudline.cli.console import console
from mudline.cli.verdict import Total, Verdict
from mudline.linting.output.visible import visible

_COUNTS = ("errors", "sections", "keywords", "curves", "elements")
_VERDICT = len("verdict")
_GAP = "  "
_SHORTEST = 20
"""Columns that a file name gets on the narrowest terminal."""


def print_verdicts(verdicts: Sequence[Verdict], total: Total, color: str) -> None:
    """A row a deck, the file last as it may be long, and the total; on a terminal long names lack their middle."""
    printer = console(color)
    printer.file.writelines(f"{line}\n" for line in _lines(verdicts, total, printer))


def _lines(verdicts: Sequence[Verdict], total: Total, printer: Console) -> Iterator[str]:
    cells = [[str(getattr(verdict, name)) for name in _COUNTS] for verdict in verdicts]
    widths = [max(map(len, column)) for column in zip(_COUNTS, *cells, strict=True)]
    before = _VERDICT + sum(widths) + len(_GAP) * (len(widths) + 1)
    room = max(printer.width - before, _SHORTEST)
    files = [elided(visible(verdict.file, printer.encoding), room, printer.encoding) for verdict in verdicts]
    longest = max(map(cell_len, files))
    colored = printer.color_system is not None and not printer.legacy_windows
    yield _bold("Decks", colored)
    yield _row("verdict", _COUNTS, widths, "file")
    rule = "\u2500" if printer.encoding.startswith("utf") else "-"
    yield rule * (before + max(longest, len("file")))
    for verdict, counts, file in zip(verdicts, cells, files, strict=True):
        yield _row(_stated(verdict.verdict.ljust(_VERDICT), verdict.verdict == "legal", colored), counts, widths, file)
    yield ""
    yield _stated(str(total), total.legal == total.decks and not total.unreadable, colored)


def _row(verdict: str, counts: Sequence[str], widths: Sequence[int], file: str) -> str:
    numbers = _GAP.join(count.rjust(width) for count, width in zip(counts, widths, strict=True))
    return f"{verdict}{_GAP}{numbers}{_GAP}{file}"


def _bold(text: str, colored: bool) -> str:
    return click.style(text, bold=True) if colored else text


def _stated(text: str, good: bool, colored: bool) -> str:
    if not colored:
        return text
    return click.style(text, fg="green") if good else click.style(text, fg="red", bold=True)


def elided(text: str, width: int, encoding: str = "utf-8") -> str:
    """The text in so many columns, without its middle; more is left of the end, where names differ."""
    if (len(text) <= width and text.isascii()) or cell_len(text) <= width:
        return text
    mark = "\u2026" if encoding.startswith("utf") else "..."
    room = width - len(mark)
    end = text[len(text) - room + room // 3 :]
    while cell_len(end) > room - room // 3:
        end = end[1:]
    return f"{set_cell_size(text, room // 3).rstrip()}{mark}{end}"
