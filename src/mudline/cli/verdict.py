"""A validated deck in one row."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Verdict:
    """Counts, and "legal", "illegal" or, for a file without any section, "empty"."""

    file: str
    sections: int
    keywords: int
    curves: int
    elements: int
    errors: int
    verdict: str
