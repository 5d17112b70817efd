"""Findings about a deck, for every package: codes, problems with a place, and finished diagnostics.

A *problem* is a finding in the terms of the package that reports it: code, sentence, and place. The place is a span
of the text or a path into the values. A *diagnostic* is its public form: file, line, column, rule.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import counted, cut, outline, short_repr

MORE = f"and more of the same: the first {MOST_REPORTED} are listed"
"""Message of the last reported finding, which replaces all further ones."""


class Severity(StrEnum):
    """Severity of a finding, in ascending order."""

    INFO = "info"
    WARNING = "warning"
    ERROR = "error"

    @property
    def rank(self) -> int:
        """0 for info, 1 for warning, 2 for error."""
        return [*Severity].index(self)


class Span(NamedTuple):
    """Half-open range of code points of a source text."""

    start: int
    end: int

    def moved(self, by: int) -> Span:
        """Return the span shifted by a number of code points."""
        return Span(self.start + by, self.end + by)


class Where(NamedTuple):
    """Place among the values of a deck: section, block in the section, path in the block; -1 stands for none."""

    section: int = -1
    block: int = -1
    path: tuple[str | int, ...] = ()

    def inside(self, *steps: str | int) -> Where:
        """Return the place that is reached from this one by steps along the path."""
        return Where(self.section, self.block, self.path + steps)


class Blocks(StrEnum):
    """Condition under which a finding keeps a deck from being evaluated, whatever severity a configuration gives it."""

    NEVER = "never"
    WITH_TENSION = "with tension keep"
    """Only if the suction of curves is kept, which is the default."""
    ALWAYS = "always"


@dataclass(frozen=True, slots=True)
class Code:
    """Name of a kind of finding: code, slug, and default severity.

    `page` explains the findings of a code without a function of its own, in the form of a rule's docstring.
    """

    code: str
    slug: str
    severity: Severity
    page: str = field(default="", compare=False, repr=False)


@dataclass(frozen=True, slots=True, repr=False)
class Repair:
    """Correction of a problem: spans of the deck's text, and the text that replaces each.

    `applicability` is "safe" if the meaning of the deck stays the same, "unsafe" if it changes or is guessed.
    """

    applicability: str
    message: str
    edits: tuple[tuple[Span, str], ...]

    __repr__ = short_repr


@dataclass(frozen=True, slots=True, repr=False)
class Problem:
    """Finding in a deck, at a span of its text or among its values.

    Attributes:
        code: kind of finding.
        message: sentence for the user.
        span: place in the text.
        severity: severity that replaces the one of the code; None keeps that of the code.
        where: place among the values.
        repair: correction; only a deck that was read from text has it.
        blocks: condition under which the deck cannot be evaluated; None: always if the problem is an error.
        following: problems that disappear together with this one.
        maybe_defined_by: misspelt or misplaced keyword that may define the missing object; the error is then a warning.
        lacks: name or number that is used but not defined; "" for problems of another kind.
    """

    code: Code
    message: str
    span: Span | None = None
    severity: Severity | None = None
    where: Where | None = None
    repair: Repair | None = None
    blocks: Blocks | None = None
    following: tuple[Problem, ...] = ()
    maybe_defined_by: str = ""
    lacks: str = ""

    __repr__ = short_repr

    @property
    def weight(self) -> Severity:
        """Severity of the problem itself, else that of its code."""
        return self.severity or self.code.severity

    @property
    def blocking(self) -> Blocks:
        """Condition under which the problem keeps the deck from being evaluated."""
        return self.blocks or (Blocks.ALWAYS if self.weight is Severity.ERROR else Blocks.NEVER)


def strongest(problems: Iterable[Problem]) -> Blocks:
    """Return the strictest condition under which any of the problems keeps the deck from being evaluated."""
    return max((problem.blocking for problem in problems), key=[*Blocks].index)


def new_codes(before: Iterable[Problem], after: Iterable[Problem]) -> Counter[str]:
    """Return the codes of which there are more problems after than before, each with the number of further ones."""
    return Counter(each.code.code for each in after) - Counter(each.code.code for each in before)


class Edit(NamedTuple):
    """Replacement of the text from `start` to `end` (line, column; from 1, end exclusive) by `text`."""

    start: tuple[int, int]
    end: tuple[int, int]
    text: str


class Fix(NamedTuple):
    """Edits that clear a finding; `applicability` is "safe" or "unsafe"."""

    applicability: str
    message: str
    edits: tuple[Edit, ...]

    def __repr__(self) -> str:
        return short_repr(self)


@dataclass(frozen=True, slots=True, repr=False)
class Diagnostic:
    """Finding with its place in the file; lines and columns count from 1, the end is exclusive.

    Attributes:
        blocks: True if the deck cannot be evaluated, unless the reason is suction and the curves are cut there.
        following: consequences of this finding, which are left out of every output; the message counts them.
    """

    file: str
    code: str
    slug: str
    severity: Severity
    message: str
    line: int
    column: int
    end_line: int
    end_column: int
    fix: Fix | None = None
    blocks: bool = False
    following: tuple[Diagnostic, ...] = ()

    @property
    def sort_key(self) -> tuple[str, int, int, str, str]:
        """Order of findings in every output."""
        return (self.file, self.line, self.column, self.code, self.message)

    def __repr__(self) -> str:
        return outline("Diagnostic", f"{self.severity.value} {self}")

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.code} {self.message}"


class DeckError(ValueError):
    """Deck that cannot be read or resolved; `diagnostics` gives the reasons, each with its place."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(diagnostic) for diagnostic in self.diagnostics))

    def __repr__(self) -> str:
        first = str(self.diagnostics[0]) if self.diagnostics else ""
        return outline("DeckError", counted(len(self.diagnostics), "diagnostic"), first)

    def __reduce__(self) -> tuple[type[DeckError], tuple[tuple[Diagnostic, ...]]]:
        return type(self), (self.diagnostics,)


class PluginError(RuntimeError):
    """Installed packages whose rules cannot be used; the message has a line for each package."""

    def __init__(self, faults: Sequence[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(faults))


_MOST_NAMES = 20
"""Greatest number of unread keywords named in one sentence."""


@dataclass(slots=True)
class Coverage:
    """Number of keywords that were read, in one or more decks.

    Attributes:
        total: number of keywords, repeated ones included.
        read: number of keywords of which each line was read or has a finding.
        partly: keywords of which a line or a part was skipped, with their numbers by name.
        unread: keywords whose lines were all skipped, with their numbers by name.
    """

    total: int = 0
    read: int = 0
    partly: dict[str, int] = field(default_factory=dict)
    unread: dict[str, int] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        """True if all lines of all keywords were read."""
        return self.read == self.total

    @property
    def share(self) -> str:
        """Share as text: `31 of 38 keywords`."""
        return f"{self.read} of {counted(self.total, 'keyword')}"

    def add(self, other: Coverage) -> None:
        """Add the counts of another deck."""
        self.total += other.total
        self.read += other.read
        for mine, theirs in ((self.partly, other.partly), (self.unread, other.unread)):
            for keyword, count in theirs.items():
                mine[keyword] = mine.get(keyword, 0) + count

    def __str__(self) -> str:
        """Return a summary: `31 of 38 keywords, 5 in part; not read: *GUIDE (2)`."""
        partly = sum(self.partly.values())
        names = [f"*{cut(name, 40)}" + (f" ({count})" if count > 1 else "") for name, count in self.unread.items()]
        names[_MOST_NAMES:] = [f"and {len(names) - _MOST_NAMES} more"] if len(names) > _MOST_NAMES else []
        text = self.share + (f", {partly} in part" if partly else "")
        return text + (f"; not read: {', '.join(names)}" if names else "")

    def sentence(self) -> str:
        """Return the summary as a sentence for a list of findings."""
        return f"All {counted(self.total, 'keyword')} read." if self.whole else f"Read {self}."
