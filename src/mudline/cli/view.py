"""Output for people as the common options have it: colours, more or less of it, and the progress of a long run."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple, Self, TypeVar

from mudline.basics.limits import SHOWN_ROWS
from mudline.cli.streams import DRAWN, erase, notify

if TYPE_CHECKING:
    import rich.progress

    from mudline.cli.printing import Printer

T = TypeVar("T")

Part = str | tuple[str, str]
"""Piece of a line: a text, or a text and its style."""
Line = Sequence[Part]
"""Pieces of a line; a single text is not a line."""


class View(NamedTuple):
    """Settings of printing: colours ("auto", "always", "never"), less, or more."""

    color: str = "auto"
    quiet: bool = False
    verbose: bool = False

    def printer(self) -> Printer:
        """Return the printer for people."""
        from mudline.cli.printing import Printer  # noqa: PLC0415 - output for programs needs no rich

        return Printer(self.color)

    def lines(self, lines: Iterable[Line]) -> None:
        """Print lines for people; without terminal and colour rich is not loaded, as that takes half of a short run."""
        erase()
        if self.color == "always" or sys.stdout.isatty():
            printer = self.printer()
            for line in lines:
                printer.line(*line)
        else:
            texts = ((part if isinstance(part, str) else part[0] for part in line) for line in lines)
            sys.stdout.writelines(f"{''.join(pieces)}\n" for pieces in texts)

    @property
    def most(self) -> int:
        """Largest number of rows of a table; -v shows all."""
        return sys.maxsize if self.verbose else SHOWN_ROWS

    @property
    def width(self) -> int | None:
        """Columns of the terminal; None without a terminal."""
        return self.printer().width if sys.stdout.isatty() else None

    def note(self, message: str) -> None:
        """Print a note to standard error, unless only the result is wanted."""
        if not self.quiet:
            notify(message)


# ------------------------------------------------------------------------------------------- progress of a long run

DELAY = 0.5
"""Seconds before a bar is drawn."""
_PAUSE = 0.1
"""Minimum seconds between two drawings."""


class Progress(AbstractContextManager["Progress"]):
    """Steps done out of a total, as a bar on standard error, which is erased before anything else is printed.

    No bar is drawn in CI, or if standard error is not a terminal that can erase.
    """

    def __init__(self, total: int, view: View, *, shown: bool = True) -> None:
        self._color = view.color
        self._total = total
        self._done = 0
        self._bar: rich.progress.Progress | None = None
        dumb = os.environ.get("TERM", "").lower() in {"dumb", "unknown"}
        may_draw = sys.stderr.isatty() and not (view.quiet or dumb or os.environ.get("CI"))
        self._due = monotonic() + DELAY if shown and total > 1 and may_draw else float("inf")

    def __enter__(self) -> Self:
        DRAWN.append(self._hide)
        return self

    def __exit__(self, *_: object) -> None:
        self._hide()
        DRAWN.remove(self._hide)

    def advance(self, steps: int = 1) -> None:
        """Count one more step, or several."""
        self._done += steps
        if monotonic() >= self._due:
            if self._bar is None:
                from mudline.cli.printing import bar  # noqa: PLC0415 - large, and a bar is rare

                self._bar = bar(self._total, self._color)
            self._bar.update(self._bar.task_ids[0], completed=self._done)
            self._bar.start()
            self._bar.refresh()
            self._due = monotonic() + _PAUSE

    def _hide(self) -> None:
        """Erase the bar; a later step draws it again."""
        if self._bar:
            self._bar.stop()


def tracked(items: Sequence[T], view: View) -> Iterator[T]:
    """Yield the items, with a bar of the number done."""
    with Progress(len(items), view) as progress:
        for item in items:
            yield item
            progress.advance()
