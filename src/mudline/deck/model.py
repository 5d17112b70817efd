"""A deck: sections and blocks as models, and where each of them stands in the file that was read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Annotated, Any, NamedTuple, Self

from pydantic import Field

from mudline.diagnostics import DeckError, Diagnostic, Problem, Severity, Where
from mudline.keywords.model import Block, Comment, Part
from mudline.keywords.values import Expected, Text

_WORDS = "[^a-z \t\r\n,]+(?: [^a-z \t\r\n,]+)*"
Title = Annotated[
    str,
    Field(strict=True, pattern=f"^(?:{_WORDS})?(?:,(?:{_WORDS})?)*$"),
    Expected("a name in capital letters, with single blanks and none beside a comma"),
]
"""The name of a section or keyword as `canonical_name` gives it."""


class Opaque(Part):
    """A block without a model: its lines are kept as they are, without their ends."""

    keyword: Title
    lines: list[Text]


@dataclass(slots=True)
class Section:
    """A `$SECTION`; `lines` are stray ones before its first keyword."""

    name: str
    blocks: list[Block | Opaque] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)


class Range(NamedTuple):
    """Lines and columns from 1, the end exclusive."""

    line: int
    column: int
    end_line: int
    end_column: int


START = Range(1, 1, 1, 1)


class Origin:
    """What a deck was read from. This one is that of a deck that was made by a program: whole, without places."""

    def place(self, _problem: Problem, /) -> Range:
        """Lines and columns of a problem."""
        return START

    def places(self, problems: Sequence[Problem]) -> list[Range]:
        """Lines and columns of several problems."""
        return [self.place(problem) for problem in problems]

    def damaged(self, _where: Where, /) -> bool:
        """Whether something at this place could not be read."""
        return False

    def lost(self, _section: int, _block: int, /) -> int:
        """How many lines of a block could not be used at all."""
        return 0

    def written(self, _where: Where, /) -> bool:
        """Whether exactly this value stands in the file."""
        return True


@dataclass
class Deck:
    """The models of one file. `file` is the name for messages, `source` the file's own name.

    `units` is "metric", "imperial" or "user". `problems` holds what was noticed while reading.
    """

    file: str
    source: str = ""
    units: str = "user"
    preamble: list[str] = field(default_factory=list)
    sections: list[Section] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list, compare=False)
    origin: Origin = field(default_factory=Origin, compare=False, repr=False)

    def blocks(self, keyword: str, section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """The modelled blocks of a keyword in all sections of a name, in the order of the file.

        The caller knows the class that the keyword has; it is not imported for a deck that lacks the keyword.
        """
        for i, found in enumerate(self.sections):
            if found.name == section:
                for j, block in enumerate(found.blocks):
                    if block.keyword == keyword and isinstance(block, Block):
                        yield Where(i, j), block

    def keywords(self, section: str = "MODEL") -> set[str]:
        """Names of the keywords in the sections of a name."""
        return {block.keyword for found in self.sections if found.name == section for block in found.blocks}

    def diagnose(self, problems: Sequence[Problem]) -> list[Diagnostic]:
        """Problems as diagnostics, in the order of the file."""
        found = [
            Diagnostic(self.file, one.code.code, one.code.slug, one.weight, _printable(one.message), *place)
            for one, place in zip(problems, self.origin.places(problems), strict=True)
        ]
        return sorted(found, key=lambda diagnostic: diagnostic.sort_key)

    def require(self) -> Self:
        """The deck itself; raises DeckError when something in it could not be read."""
        errors = [problem for problem in self.problems if problem.weight is Severity.ERROR]
        if errors:
            raise DeckError(self.diagnose(errors))
        return self


def _printable(message: str) -> str:
    """A message in which names of the deck, which stand in it as they are, cannot act on a terminal."""
    if message.isprintable():
        return message
    return "".join(letter if letter.isprintable() else "\ufffd" for letter in message)
