"""Findings counted by rule."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Diagnostic


def statistics_lines(diagnostics: list[Diagnostic]) -> Iterator[str]:
    """Findings counted by rule, the most frequent first."""
    counts: dict[tuple[str, str], int] = {}
    for found in diagnostics:
        counts[found.code, found.slug] = counts.get((found.code, found.slug), 0) + 1
    for (code, slug), count in sorted(counts.items(), key=lambda item: (-item[1], item[0])):
        yield f"{count:6}  {code}  {slug}\n"
