"""Plain tables on the terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rich import box
from rich.table import Table
from rich.text import Text

from mudline.lint.output.text import visible


def table(title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], *, left: Sequence[str] = ()) -> Table:
    """A table of texts: numbers to the right, the columns named in `left` to the left; deck text as plain text."""
    made = Table(
        title=Text(visible(title)), title_justify="left", title_style="bold", box=box.SIMPLE_HEAD, pad_edge=False
    )
    for name in columns:
        made.add_column(
            Text(name), justify="left" if name in left else "right", overflow="fold", no_wrap=name not in left
        )
    for row in rows:
        made.add_row(*(Text(visible(cell)) for cell in row))
    return made
