"""A deck: sections and blocks as models, and where each of them stands in the file that was read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import NoneType
from typing import Any, NamedTuple, Self

from mudline.basics.arguments import expect, expect_fields
from mudline.basics.limits import LONGEST_MESSAGE
from mudline.basics.quantities import checked_units
from mudline.basics.short_repr import counted, cut, listed, outline, short_repr
from mudline.language.diagnostics import (
    Blocks,
    Code,
    DeckError,
    Diagnostic,
    Edit,
    Fix,
    Problem,
    Repair,
    Severity,
    Where,
)
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.keeping import kept_lines
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.naming import Role, all_names_given, gives_names
from mudline.language.keywords.values import Names, Text


class Opaque(Part):
    """A block without a model: its lines are passed through unchanged, without their ends.

    It has no subclasses: to ask for the very class takes a fifth of the time of `isinstance` with a pydantic model.
    """

    keyword: Text
    lines: list[Text]


@dataclass(slots=True, repr=False)
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


_INTERNAL = frozenset(
    [
        "all_of",
        "alone",
        "base_of",
        "bases",
        "blocks_with",
        "diagnose",
        "errors",
        "every_block",
        "folder_of",
        "incomplete",
        "lost",
        "one_of",
        "origin",
        "own_sections",
        "place",
        "placed",
        "problems",
        "require",
        "written",
    ]
)
"""What the rest of the program uses of a deck; `dir` leaves it out."""

START = Range(1, 1, 1, 1)


class NamedPlace(NamedTuple):
    """A name in a deck: the kind of the thing, the role of the field, the name as written, its place."""

    kind: Names
    role: Role
    name: str
    where: Where


class Origin:
    """What a deck was read from; this class itself: nothing, as a program made the deck.

    `no_equations` says that no value is an equation: it is known of a text that nobody changes once it is read.
    `takes_edits` says that places in its text are places in the file, which repairs can change.
    """

    no_equations = False
    takes_edits = True

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a problem."""
        return START

    def place_in_file(self, problem: Problem) -> Range:
        """Lines and columns of a problem in the file, whose text may be that of a document."""
        return self.place(problem)

    def lost(self, section: int, block: int) -> int:
        """How many lines of a block could not be used at all."""
        return 0

    def written(self, where: Where) -> bool:
        """Whether exactly this value stands in the file."""
        return True


_KINDS: dict[str, tuple[Any, str]] = {
    **dict.fromkeys(("file", "source"), (str, "a str")),
    **dict.fromkeys(("preamble", "sections", "comments", "problems"), (list, "a list")),
    "origin": (Origin, "an Origin"),
    "folder": ((Path, NoneType), "a Path or None"),
    "bases": (tuple, "a tuple"),
    "incomplete": (bool, "True or False"),
}
"""The fields of a deck by what they hold."""


@dataclass(repr=False)
class Deck:
    """A deck: its sections and blocks as validated models, equations as written.

    `mudline.Deck` is this class with the methods that make texts and scenes of a deck.

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
        bases: the decks that it continues, the nearest first, once they are found; their models are the last sections.
        incomplete: the first of them all was not found.
    """

    file: str
    source: str = ""
    units: str = "user"
    preamble: list[str] = field(default_factory=list)
    sections: list[Section] = field(default_factory=list)
    comments: list[Comment] = field(default_factory=list)
    problems: list[Problem] = field(default_factory=list, compare=False)
    origin: Origin = field(default_factory=Origin, compare=False, repr=False)
    folder: Path | None = field(default=None, compare=False)
    bases: tuple[Base, ...] = ()
    incomplete: bool = False

    def __post_init__(self) -> None:
        """Raise ValueError for what a caller of `mudline.Deck` gave in the place of a text or a list."""
        expect_fields(self, _KINDS)
        checked_units(self.units)

    def __repr__(self) -> str:
        blocks = sum(len(section.blocks) for section in self.sections)
        parts = [self.units, counted(len(self.sections), "section"), counted(blocks, "block")]
        if errors := len(self.errors()):
            parts.append(counted(errors, "error"))
        return outline(f"{type(self).__name__} {cut(self.file, 80)!r}", ", ".join(parts))

    def _repr_html_(self) -> str:
        """The keywords of each section with their numbers, for notebooks."""
        from mudline.basics.html_repr import html_page, html_table  # noqa: PLC0415 - only notebooks ask for it

        blocks = [(section.name, block.keyword, block) for section in self.sections for block in section.blocks]
        said = ((*names, getattr(block, "summary", "lines are kept, not read")) for *names, block in blocks)
        rows = [(section, keyword, number, text) for (section, keyword, text), number in Counter(said).items()]
        errors = [counted(len(self.errors()), "error")] if self.errors() else []
        summary = ", ".join([self.file, self.units, *errors])
        return html_page(
            type(self).__name__, summary, html_table(("section", "keyword", "blocks", "says"), rows, len(rows))
        )

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _INTERNAL]

    @property
    def alone(self) -> Self:
        """The deck without those that it continues."""
        return replace(self, sections=[*self.own_sections], bases=(), incomplete=False) if self.bases else self

    @property
    def own_sections(self) -> Sequence[Section]:
        """The sections of this file; the models of the decks that it continues stand behind them."""
        return self.sections[: len(self.sections) - sum(len(base.sections) for base in self.bases)]

    def base_of(self, where: Where | None) -> tuple[Deck, Where] | None:
        """The deck that a value was taken from, and its place there; None for one of the deck itself."""
        if where is None or not self.bases:
            return None
        places = [(base.deck, number) for base in reversed(self.bases) for number in base.sections]
        index = where.section - len(self.sections) + len(places)
        return (places[index][0], where._replace(section=places[index][1])) if index >= 0 else None

    def _at(self, where: Where) -> tuple[Deck, Where]:
        return self.base_of(where) or (self, where)

    def _owned(self, problem: Problem) -> tuple[Deck, Problem]:
        """The deck that a problem belongs to, and the problem in that deck's own terms."""
        if isinstance(problem, BaseProblem):
            return problem.deck, problem
        found = self.base_of(problem.where)
        return (found[0], replace(problem, where=found[1])) if found else (self, problem)

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a problem, in the file that it belongs to."""
        deck, own = self._owned(problem)
        return deck.origin.place_in_file(own)

    def lost(self, where: Where) -> int:
        """How many lines of a block could not be used at all."""
        deck, inner = self._at(where)
        return deck.origin.lost(inner.section, inner.block)

    def written(self, where: Where) -> bool:
        """Whether exactly this value stands in its file."""
        deck, inner = self._at(where)
        return deck.origin.written(inner)

    def folder_of(self, where: Where) -> Path | None:
        """Where the files are looked for that the deck names at a place."""
        return self._at(where)[0].folder

    def blocks(self, keyword: str, section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """The modelled blocks of a keyword in all sections of a name, in the order of the file.

        What the deck continues comes first, so that what it says itself holds. The caller knows the class that the
        keyword has; it is not imported for a deck that lacks the keyword.
        """
        for index, found in self._in_order():
            if found.name == section:
                for number, block in enumerate(found.blocks):
                    if block.keyword == keyword and type(block) is not Opaque:
                        yield Where(index, number), block

    def blocks_with(self, fact: str, section: str = "MODEL") -> list[tuple[Where, Any]]:
        """The modelled blocks whose declaration has one of its `Facts`, in the order of `blocks`."""
        return [
            (Where(index, number), block)
            for index, found in self._in_order()
            if found.name == section
            for number, block in enumerate(found.blocks)
            if type(block) is not Opaque and getattr(block.facts, fact)  # type: ignore[union-attr]  # as above
        ]

    def _in_order(self) -> Iterable[tuple[int, Section]]:
        """The sections with their numbers: those of the decks that it continues first."""
        numbered = enumerate(self.sections)
        if not self.bases:
            return numbered
        own = len(self.own_sections)
        return sorted(numbered, key=lambda placed: placed[0] < own)

    def every_block(self) -> list[tuple[Where, str, Block | Opaque]]:
        """The blocks of all sections in their order, read or not: their place, the name of their section, the block."""
        return [
            (Where(i, j), section.name, block)
            for i, section in enumerate(self.sections)
            for j, block in enumerate(section.blocks)
        ]

    def names(self) -> list[NamedPlace]:
        """Return every name that the fields of the deck give, in its order, whether it is used or defined there.

        Numbers and labels of nodes and elements are no names.
        """
        return [
            NamedPlace(kind, role, name, where._replace(path=path))
            for where, _, block in self.every_block()
            if gives_names(type(block))
            for kind, role, name, path in all_names_given(block)
        ]

    def keywords(self, section: str = "MODEL") -> set[str]:
        """Names of the keywords in the sections of a name."""
        expect(section, "section", str, "a str")
        return {block.keyword for found in self.sections if found.name == section for block in found.blocks}

    def diagnose(self, problems: Sequence[Problem]) -> list[Diagnostic]:
        """Problems as diagnostics, each in the file that it belongs to, in the order of the file."""
        return sorted(map(self._diagnosed, problems), key=lambda found: found.sort_key)

    def _diagnosed(self, problem: Problem) -> Diagnostic:
        found = _diagnostic(*self._owned(problem))
        return replace(found, following=tuple(self.diagnose(problem.following))) if problem.following else found

    def require(self) -> Self:
        """The deck itself; raises DeckError when something in it could not be read."""
        if errors := self.errors():
            raise DeckError(self.diagnose(errors))
        return self

    def errors(self) -> list[Problem]:
        """What could not be read."""
        return [problem for problem in self.problems if problem.weight is Severity.ERROR]


def raw_lines(block: Block | Opaque) -> list[str]:
    """The lines of a block that are passed through: those that its model keeps, of a block without one all."""
    return block.lines if isinstance(block, Opaque) else kept_lines(block)


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
    for slot in record_schema(type(part)).slots:
        for record in (getattr(part, slot.name, None) or ()) if slot.record else ():
            yield from _comments_in(record)


class Base(NamedTuple):
    """A deck that another one continues: as written, its `$MODEL` sections evaluated, and what is wrong in it.

    `sections` has them by their number in the deck.
    """

    deck: Deck
    sections: dict[int, Section]
    problems: tuple[Problem, ...]

    def __repr__(self) -> str:
        return short_repr(self)

    @property
    def errors(self) -> list[Problem]:
        """What keeps its model from being used."""
        return [problem for problem in self.problems if problem.blocking is Blocks.ALWAYS]


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class BaseProblem(Problem):
    """A problem of a deck that is continued, in that deck's own terms."""

    deck: Deck

    __repr__ = short_repr


def _diagnostic(deck: Deck, problem: Problem) -> Diagnostic:
    code: Code = problem.code
    place = deck.origin.place_in_file(problem)
    message = cut(problem.message, LONGEST_MESSAGE)
    if not message.isprintable():  # names of the deck are quoted verbatim
        message = "".join(char if char.isprintable() else "\ufffd" for char in message)
    fix = _fix(deck.origin, problem.repair, code) if problem.repair and deck.origin.takes_edits else None
    blocks = problem.blocking is not Blocks.NEVER
    return Diagnostic(deck.file, code.code, code.slug, problem.weight, message, *place, fix, blocks)


def _fix(origin: Origin, repair: Repair, code: Code) -> Fix:
    """A repair in lines and columns."""
    places = [(origin.place(Problem(code, "", span)), text) for span, text in repair.edits]
    edits = tuple(Edit((p.line, p.column), (p.end_line, p.end_column), text) for p, text in places)
    return Fix(repair.applicability, repair.message, edits)
