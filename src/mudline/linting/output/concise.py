"""A finding a line: `file:line:column: CODE message`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mudline.diagnostics import Diagnostic
from mudline.linting.output.visible import visible


def concise(diagnostics: Iterable[Diagnostic]) -> Iterator[str]:
    """The lines, with their ends."""
    for found in diagnostics:
        place = f"{found.file}:{found.line}:{found.column}"
        yield f"{visible(place)}: {found.code} {visible(found.message)}\n"
