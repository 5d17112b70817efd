"""How far a long run is: a bar on standard error while somebody looks on, nothing otherwise."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import monotonic
from types import TracebackType
from typing import Protocol, Self

from mudline.cli.lazy import printing
from mudline.cli.options import View

DELAY = 0.5
"""Seconds before a bar is worth its place."""
_PAUSE = 0.1
"""Seconds between two drawings."""


class _Bar(Protocol):
    def draw(self, done: int) -> None: ...

    def erase(self) -> None: ...


def looked_at(view: View) -> bool:
    """Whether somebody may want to see a bar: not in CI, not where standard error is no terminal that can erase."""
    dumb = os.environ.get("TERM", "").lower() in {"dumb", "unknown"}
    return sys.stderr.isatty() and not (view.quiet or dumb or os.environ.get("CI"))


class Progress:
    """Steps done of a number of them. The bar is gone while anything else is told, and at the end."""

    def __init__(self, total: int, view: View, *, shown: bool) -> None:
        self._total = total
        self._color = view.color
        self._done = 0
        self._bar: _Bar | None = None
        self._due = monotonic() + DELAY if shown and total > 1 else float("inf")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._erase()

    def advance(self) -> None:
        """One step more."""
        self._done += 1
        if monotonic() >= self._due:
            self._bar = self._bar or printing("progress").Bar(self._total, self._color)
            self._bar.draw(self._done)
            self._due = monotonic() + _PAUSE

    @contextmanager
    def hidden(self) -> Iterator[None]:
        """Room for other lines; the bar comes back with a later step."""
        self._erase()
        yield

    def _erase(self) -> None:
        if self._bar:
            self._bar.erase()
