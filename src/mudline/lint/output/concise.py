"""A finding a line: `file:line:column: CODE message`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mudline.diagnostics import Diagnostic


def concise(diagnostics: Iterable[Diagnostic]) -> Iterator[str]:
    """The lines, with their ends."""
    for found in diagnostics:
        yield f"{found}\n"
