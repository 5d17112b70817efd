"""What every package may report about a deck: codes, problems with a place, and finished diagnostics.

A *problem* is what a package finds: a code, a sentence and where it is, in the terms of that package (a span of the
text, or a path into the values). A *diagnostic* is the public form of the same thing: file, line, column, rule.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from mudline.basics.limits import MOST_REPORTED
from mudline.basics.short_repr import counted, cut, outline, short_repr

MORE = f"and more of the same: the first {MOST_REPORTED} are listed"
"""The message of the finding behind them, which replaces all the others."""


class Severity(StrEnum):
    """How bad a finding is; the order of the members is the order of badness."""

    INFO = "info"
    WARNING = "warning"
    ERROR = "error"

    @property
    def rank(self) -> int:
        """0 for info, 1 for warning, 2 for error."""
        return _RANKS[self]


_RANKS = {Severity.INFO: 0, Severity.WARNING: 1, Severity.ERROR: 2}


class Span(NamedTuple):
    """A half-open range of code points of a source text."""

    start: int
    end: int

    def moved(self, by: int) -> Span:
        """The same range so many code points further behind."""
        return Span(self.start + by, self.end + by)


class Where(NamedTuple):
    """A place among the values of a deck: section, block in it, and the path inside the block; -1 stands for none."""

    section: int = -1
    block: int = -1
    path: tuple[str | int, ...] = ()

    def inside(self, *steps: str | int) -> Where:
        """The place that steps lead to from this one."""
        return Where(self.section, self.block, self.path + steps)


class Blocks(StrEnum):
    """Whether a finding keeps a deck from being evaluated, whatever severity a configuration gives it.

    The members are in ascending order.
    """

    NEVER = "never"
    WITH_TENSION = "with tension keep"
    """Only where the pull of curves is kept, which is the default."""
    ALWAYS = "always"


@dataclass(frozen=True, slots=True)
class Code:
    """The name of a kind of finding: code, slug, and the severity it has unless something says otherwise.

    `page` explains the findings of a code that has no function of its own, in the form of a rule's docstring.
    """

    code: str
    slug: str
    severity: Severity
    page: str = field(default="", compare=False, repr=False)


@dataclass(frozen=True, slots=True, repr=False)
class Repair:
    """What clears a problem: spans of the deck's text, and what is to stand there.

    `applicability` is "safe" where the deck means the same afterwards, "unsafe" where it changes or is guessed.
    """

    applicability: str
    message: str
    edits: tuple[tuple[Span, str], ...]

    __repr__ = short_repr


@dataclass(frozen=True, slots=True, repr=False)
class Problem:
    """Something noticed in a deck, at a span of its text or among its values.

    `severity` None means the severity of the code. Only a deck that was read from text has repairs. `blocks` None means
    that the problem keeps the deck from being evaluated if it is an error. `following` are the problems that would be
    gone without this one. `maybe_defined_by` is the keyword that may define what is missing, where it is misspelt or
    misplaced and the error therefore a warning. `lacks` is the name or number that the deck uses and nothing defines,
    "" for other problems.
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
        """The severity that holds."""
        return self.severity or self.code.severity

    @property
    def blocking(self) -> Blocks:
        """Whether the deck can be evaluated in spite of it."""
        return self.blocks or (Blocks.ALWAYS if self.weight is Severity.ERROR else Blocks.NEVER)


def strongest(problems: Iterable[Problem]) -> Blocks:
    """Return how far problems keep a deck from being evaluated: as the one that does so the most."""
    return max((one.blocking for one in problems), key=[*Blocks].index)


class Edit(NamedTuple):
    """Replace the text from `start` to `end` (line, column; from 1, end exclusive) by `text`."""

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
    """A finding with its place in the file; lines and columns count from 1, the end is exclusive.

    `blocks` says that the deck cannot be evaluated, unless its curves are cut where they pull and that is the reason.
    `following` are the findings that follow from this one and are left out of every output; the message counts them.
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
    """A deck that cannot be read or resolved; `diagnostics` says why, each with its place."""

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(diagnostic) for diagnostic in self.diagnostics))

    def __repr__(self) -> str:
        first = str(self.diagnostics[0]) if self.diagnostics else ""
        return outline("DeckError", counted(len(self.diagnostics), "diagnostic"), first)

    def __reduce__(self) -> tuple[type[DeckError], tuple[tuple[Diagnostic, ...]]]:
        return type(self), (self.diagnostics,)


class PluginError(RuntimeError):
    """Installed packages with rules that cannot be used; the message has a line for each."""

    def __init__(self, faults: Sequence[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(faults))


_MOST_NAMES = 20
"""Names of keywords that were not read in one sentence."""


@dataclass(slots=True)
class Coverage:
    """How many keywords of a deck, or of several, were read.

    Attributes:
        total: all of them, each as often as it occurs.
        read: those of which each line was read, or has a finding.
        partly: those of which a line or part was passed over, by name.
        unread: those whose lines were passed over, by name.
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
        """`31 of 38 keywords`."""
        return f"{self.read} of {counted(self.total, 'keyword')}"

    def add(self, other: Coverage) -> None:
        """Count the keywords of another deck too."""
        self.total += other.total
        self.read += other.read
        for mine, theirs in ((self.partly, other.partly), (self.unread, other.unread)):
            for keyword, count in theirs.items():
                mine[keyword] = mine.get(keyword, 0) + count

    def __str__(self) -> str:
        """`31 of 38 keywords, 5 in part; not read: *GUIDE (2)`."""
        partly = sum(self.partly.values())
        names = [f"*{cut(name, 40)}" + (f" ({count})" if count > 1 else "") for name, count in self.unread.items()]
        names[_MOST_NAMES:] = [f"and {len(names) - _MOST_NAMES} more"] if len(names) > _MOST_NAMES else []
        text = self.share + (f", {partly} in part" if partly else "")
        return text + (f"; not read: {', '.join(names)}" if names else "")

    def sentence(self) -> str:
        """The same for people who asked for findings."""
        return f"All {counted(self.total, 'keyword')} read." if self.whole else f"Read {self}."
