"""Findings as one line each: `file:line:column: CODE message`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mudline.checks.output import visible
from mudline.language.diagnostics import Diagnostic

SUMMARY = "`file:line:column: CODE message`, a line each"


def write(diagnostics: Iterable[Diagnostic], files: Sequence[str]) -> Iterator[str]:  # noqa: ARG001 - the same for every form
    """Yield the lines, with their ends."""
    for finding in diagnostics:
        place = f"{finding.file}:{finding.line}:{finding.column}"
        yield f"{visible(place)}: {finding.code} {visible(finding.message)}\n"
