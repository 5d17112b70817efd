"""A validated deck in one row, and all of them in another."""

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


@dataclass(slots=True)
class Total:
    """Decks by verdict, the errors in all of them, and the files that could not be read and are no decks here."""

    decks: int = 0
    legal: int = 0
    illegal: int = 0
    empty: int = 0
    errors: int = 0
    unreadable: int = 0

    def add(self, verdict: Verdict) -> None:
        """Count one more deck."""
        self.decks += 1
        self.legal += verdict.verdict == "legal"
        self.illegal += verdict.verdict == "illegal"
        self.empty += verdict.verdict == "empty"
        self.errors += verdict.errors

    def __str__(self) -> str:
        """The total for a reader; what there is none of is left out."""
        noun = "deck" if self.decks == 1 else "decks"
        others = [
            f"{self.illegal} illegal" if self.illegal else "",
            f"{self.empty} empty" if self.empty else "",
            f"{self.errors} error{'s' * (self.errors != 1)}" if self.errors else "",
            f"{self.unreadable} file{'s' * (self.unreadable != 1)} unreadable" if self.unreadable else "",
        ]
        rest = ", ".join(filter(None, others))
        return f"{self.legal} of {self.decks} {noun} legal" + (f": {rest}" if rest else "")
