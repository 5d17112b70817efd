"""A deck: sections and blocks as models, and where each of them stands in the file that was read."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, Self

from mudline.diagnostics import Blocks, Code, DeckError, Diagnostic, Edit, Fix, Problem, Repair, Severity, Where
from mudline.keywords.model import Block, Comment, Part, layout
from mudline.keywords.values import Text
from mudline.short_repr import counted, cut, listed, outline

if TYPE_CHECKING:
    from mudline.scene.model import Scene


class Opaque(Part):
    """A block without a model: its lines are passed through unchanged, without their ends."""

    keyword: Text
    lines: list[Text]


@dataclass(slots=True)
class Section:
    """A `$SECTION`; `lines` are stray ones before its first keyword."""

    name: str
    blocks: list[Block | Opaque] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        keywords = list(dict.fromkeys(block.keyword for block in self.blocks))
        return outline(f"Section {cut(self.name, 40)!r}", counted(len(self.blocks), "block"), listed(keywords))


class Range(NamedTuple):
    """Lines and columns from 1, the end exclusive."""

    line: int
    column: int
    end_line: int
    end_column: int


_LONGEST = 1000
"""Characters of a message; names of the deck are part of it, and may be of any length."""

_INTERNAL = frozenset({"alone", "diagnose", "folder_of", "origin", "own_sections", "problems", "require"})
"""What the rest of the program uses of a deck; `dir` leaves it out."""

START = Range(1, 1, 1, 1)


class Origin(Protocol):
    """What a deck was read from: tells where a problem is."""

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a problem."""

    def damaged(self, where: Where) -> bool:
        """Whether something at this place could not be read."""

    def lost(self, section: int, block: int) -> int:
        """How many lines of a block could not be used at all."""

    def written(self, where: Where) -> bool:
        """Whether exactly this value stands in the file."""


class Nowhere:
    """The origin of a deck that was made by a program."""

    def place(self, problem: Problem) -> Range:
        """Always the start."""
        return START

    def damaged(self, where: Where) -> bool:
        """Nothing is."""
        return False

    def lost(self, section: int, block: int) -> int:
        """Nothing is."""
        return 0

    def written(self, where: Where) -> bool:
        """Everything is."""
        return True


@dataclass
class Deck:
    """A deck: its sections and blocks as validated models, equations as written.

    `mudline.read`, `mudline.from_keyword`, `mudline.from_json` and `mudline.from_yaml` make decks.

    Attributes:
        file: name of the file in messages.
        source: the file's own name, without its folder.
        units: unit system of all numbers: "metric", "imperial" or "user".
        preamble: lines before the first section.
        sections: `$SECTION`s in the order of the file, with their blocks.
        comments: comments before sections.
        problems: what reading noticed; `require` raises those that are errors.
        origin: tells where in the file a value stands.
        folder: where files that the deck names are looked for; None for a deck that came from no path: nothing is then
            read but the deck itself.
    """

    file: str
    source: str = ""
    units: str = "user"
    preamble: list[str] = field(default_factory=list)
    sections: list[Section] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list, compare=False)
    origin: Origin = field(default_factory=Nowhere, compare=False, repr=False)
    folder: Path | None = field(default=None, compare=False)

    def __repr__(self) -> str:
        parts = [self.units, counted(len(self.sections), "section"), counted(self._count_blocks(), "block")]
        if errors := len(self._errors()):
            parts.append(counted(errors, "error"))
        return outline(f"{type(self).__name__} {cut(self.file, 80)!r}", ", ".join(parts))

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _INTERNAL]

    def _count_blocks(self) -> int:
        return sum(len(section.blocks) for section in self.sections)

    def to_json(self) -> str:
        """Return the deck as JSON text; nothing but layout is lost."""
        from mudline.deck.forms.json import to_json  # noqa: PLC0415 - the module of a form is loaded where it is used

        return to_json(self.alone)

    def to_yaml(self) -> str:
        """Return the deck as YAML 1.2 text; nothing but layout is lost."""
        from mudline.deck.forms.yaml import to_yaml  # noqa: PLC0415 - as in to_json

        return to_yaml(self.alone)

    def to_keyword(self) -> str:
        """Return the deck as keyword text.

        Raises:
            DeckError: a name, comment or raw line cannot be written in a keyword file.
        """
        from mudline.deck.forms.keyword import to_keyword  # noqa: PLC0415 - as in to_json

        return to_keyword(self.alone)

    def scene(self) -> Scene:
        """Return the deck resolved: equations evaluated, sets expanded, diameters, lengths and laws as arrays.

        Raises:
            DeckError: the deck has errors on which a result depends.
        """
        from mudline.scene.model import resolve  # noqa: PLC0415 - the one way up: a deck that is read knows no physics

        return resolve(self.alone).require()

    @property
    def alone(self) -> Deck:
        """The deck without those that it continues."""
        return self

    @property
    def own_sections(self) -> Sequence[Section]:
        """The sections of this file; a deck that was put together from several has others besides."""
        return self.sections

    def folder_of(self, where: Where) -> Path | None:
        """Where the files are looked for that the deck names at a place."""
        return self.folder

    def blocks(self, keyword: str, section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """The modelled blocks of a keyword in all sections of a name, in the order of the file.

        The caller knows the class that the keyword has; it is not imported for a deck that lacks the keyword.
        """
        for i, found in enumerate(self.sections):
            if found.name == section:
                for j, block in enumerate(found.blocks):
                    if block.keyword == keyword and isinstance(block, Block):
                        yield Where(i, j), block

    def blocks_that(self, fact: Callable[[type[Block]], object], section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """The modelled blocks whose declaration has a fact, in all sections of a name, in the order of the file."""
        for i, found in enumerate(self.sections):
            if found.name == section:
                for j, block in enumerate(found.blocks):
                    if isinstance(block, Block) and fact(type(block)):
                        yield Where(i, j), block

    def keywords(self, section: str = "MODEL") -> set[str]:
        """Names of the keywords in the sections of a name."""
        return {block.keyword for found in self.sections if found.name == section for block in found.blocks}

    def diagnose(self, problems: Sequence[Problem]) -> list[Diagnostic]:
        """Problems as diagnostics, in the order of the file."""
        return sorted((self._diagnostic(problem) for problem in problems), key=lambda found: found.sort_key)

    def _diagnostic(self, problem: Problem) -> Diagnostic:
        code: Code = problem.code
        place = self.origin.place(problem)
        message = problem.message if len(problem.message) <= _LONGEST else problem.message[: _LONGEST - 3] + "..."
        if not message.isprintable():  # names of the deck are quoted verbatim
            message = "".join(char if char.isprintable() else "\ufffd" for char in message)
        fix = self._fix(problem.repair, code) if problem.repair else None
        blocks = problem.blocking is not Blocks.NEVER
        return Diagnostic(self.file, code.code, code.slug, problem.weight, message, *place, fix, blocks)

    def _fix(self, repair: Repair, code: Code) -> Fix:
        """A repair in lines and columns."""
        places = [(self.origin.place(Problem(code, "", span)), text) for span, text in repair.edits]
        edits = tuple(Edit((p.line, p.column), (p.end_line, p.end_column), text) for p, text in places)
        return Fix(repair.applicability, repair.message, edits)

    def require(self) -> Self:
        """The deck itself; raises DeckError when something in it could not be read."""
        if errors := self._errors():
            raise DeckError(self.diagnose(errors))
        return self

    def _errors(self) -> list[Problem]:
        return [problem for problem in self.problems if problem.weight is Severity.ERROR]


def comment_texts(deck: Deck) -> Iterator[str]:
    """The text of every comment of a deck, without its mark."""
    yield from deck.preamble
    yield from (comment.text for comment in deck.comments)
    for section in deck.sections:
        yield from (comment.text for comment in section.comments)
        for block in section.blocks:
            yield from _comments_in(block)


def _comments_in(part: Part) -> Iterator[str]:
    yield from (comment.text for comment in getattr(part, "comments", ()))
    for slot in layout(type(part)).slots:
        for record in (getattr(part, slot.name, None) or ()) if slot.record else ():
            yield from _comments_in(record)
