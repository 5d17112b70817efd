"""Small HTML tables that notebooks show for an object: all text is escaped, long lists are cut."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from itertools import islice

from mudline.basics.limits import SHOWN_LETTERS, SHOWN_ROWS
from mudline.basics.short_repr import cut

Cell = str | float | None


def html_page(title: str, summary: str, *tables: str) -> str:
    """Return a title with a line of summary, and tables below it."""
    return f"<div><p><b>{_text(title)}</b> {_text(summary, 200)}</p>{''.join(tables)}</div>"


def html_table(headings: Sequence[str], rows: Iterable[Sequence[Cell]], count: int) -> str:
    """Return a table of the first rows, with a line that counts those left out of `count`; "" if `count` is 0.

    Texts are aligned left. Numbers are aligned right, with at most six digits. None is an empty cell.
    """
    if not count:
        return ""
    head = "".join(f"<th>{_text(name)}</th>" for name in headings)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in islice(rows, SHOWN_ROWS))
    more = f"... and {count - SHOWN_ROWS} more" if count > SHOWN_ROWS else ""
    last = f'<tr><td colspan="{len(headings)}">{more}</td></tr>' if more else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}{last}</tbody></table>"


def html_line(abscissas: Sequence[float], ordinates: Sequence[float]) -> str:
    """Return a small picture of a line through points."""
    spans = [(min(values), max(values)) for values in (abscissas, ordinates)]
    (left, right), (low, high) = ((least, most if most > least else least + 1.0) for least, most in spans)
    across = [_WIDE * (x / (right - left) - left / (right - left)) for x in abscissas]
    up = [_HIGH * (high / (high - low) - y / (high - low)) for y in ordinates]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(across, up, strict=True))
    style = 'fill="none" stroke="currentColor"'
    frame = f'<rect width="{_WIDE}" height="{_HIGH}" {style} stroke-opacity="0.3"/>'
    return f'<svg width="{_WIDE}" height="{_HIGH}">{frame}<polyline points="{line}" {style} stroke-width="2"/></svg>'


_WIDE, _HIGH = 240, 120


def _cell(value: Cell) -> str:
    if isinstance(value, str):
        return f'<td style="text-align: left">{_text(value)}</td>'
    text = "" if value is None or value != value else f"{value:.6g}"  # noqa: PLR0124 - NaN
    return f'<td style="text-align: right">{text}</td>'


def _text(text: str, most: int = SHOWN_LETTERS) -> str:
    """Return a text escaped for HTML; half a surrogate pair, as a name may hold, becomes an escape sequence."""
    return escape(cut(text, most).encode("utf-8", "backslashreplace").decode())
