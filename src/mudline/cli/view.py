"""How a command prints: colours, less or more, and a bar of how far a long run is."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple, TypeVar

if TYPE_CHECKING:
    from mudline.cli.printing import Bar, Line, Printer

DELAY = 0.5
"""Seconds of a run before a bar is drawn."""
_PAUSE = 0.1
"""Seconds between two drawings."""

T = TypeVar("T")


class View(NamedTuple):
    """How to print: colours ("auto", "always", "never"), less, or more. The one place where rich is loaded."""

    color: str = "auto"
    quiet: bool = False
    verbose: bool = False

    def printer(self) -> Printer:
        """What prints for people."""
        from mudline.cli.printing import Printer  # noqa: PLC0415 - output for programs needs no rich

        return Printer(self.color)

    def lines(self, lines: Iterable[Line]) -> None:
        """Print lines for people; rich does it where there is a terminal or colour, as it takes half of a short run."""
        if self.color == "always" or sys.stdout.isatty():
            self.printer().lines(lines)
        else:
            texts = ((part if isinstance(part, str) else part[0] for part in line) for line in lines)
            sys.stdout.writelines(f"{''.join(pieces)}\n" for pieces in texts)

    @property
    def width(self) -> int | None:
        """The columns of the terminal that is printed on; None where it is none."""
        return self.printer().width if sys.stdout.isatty() else None

    def bar(self, total: int) -> Bar:
        """A bar of so many steps."""
        from mudline.cli.printing import Bar  # noqa: PLC0415 - as above

        return Bar(total, self.color)


# ------------------------------------------------------------------------------------------------ how far a long run is


class Progress(AbstractContextManager["Progress"]):
    """Steps done out of a total, as a bar on standard error. It is hidden while anything else is printed.

    None is drawn in CI, or where standard error is not a terminal that can erase.
    """

    def __init__(self, total: int, view: View, *, shown: bool = True) -> None:
        self.view = view
        self._total = total
        self._done = 0
        self._bar: Bar | None = None
        dumb = os.environ.get("TERM", "").lower() in {"dumb", "unknown"}
        may_draw = sys.stderr.isatty() and not (view.quiet or dumb or os.environ.get("CI"))
        self._due = monotonic() + DELAY if shown and total > 1 and may_draw else float("inf")

    def __exit__(self, *_: object) -> None:
        self.hide()

    def advance(self, steps: int = 1) -> None:
        """Count one more step, or several."""
        self._done += steps
        if monotonic() >= self._due:
            self._bar = self._bar or self.view.bar(self._total)
            self._bar.draw(self._done)
            self._due = monotonic() + _PAUSE

    def hide(self) -> None:
        """Erase the bar so that other lines can be printed; a later step draws it again."""
        if self._bar:
            self._bar.erase()


def tracked(items: Sequence[T], view: View) -> Iterator[T]:
    """The items, with a bar of how many are done."""
    with Progress(len(items), view) as progress:
        for item in items:
            yield item
            progress.advance()
