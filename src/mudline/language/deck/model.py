"""Deck: sections and blocks as models, and their places in the file that was read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import NoneType
from typing import Any, NamedTuple, Self

from mudline.basics.arguments import expect, expect_fields, expect_word
from mudline.basics.limits import LONGEST_MESSAGE
from mudline.basics.short_repr import counted, cut, listed, outline, printable, short_repr
from mudline.basics.units import UNITS
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
from mudline.language.keywords.contents import Role, every_name_given, gives_names, keeps_lines, kept_places
from mudline.language.keywords.faults import DocumentPath
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, Part
from mudline.language.keywords.values import Names, Text


class Opaque(Part):
    """Block without a model: its lines are passed through unchanged, without their line ends.

    It has no subclasses: comparing the class itself takes a fifth of the time of `isinstance` with a pydantic model.
    """

    keyword: Text
    lines: list[Text]


@dataclass(slots=True, repr=False)
class Section:
    """`$SECTION` of a deck; `lines` are stray lines before its first keyword."""

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
        "alone",
        "at",
        "base_of",
        "bases",
        "blocks_with",
        "diagnose",
        "errors",
        "every_block",
        "folder_of",
        "incomplete",
        "lost",
        "origin",
        "own_sections",
        "place",
        "placed",
        "problems",
        "require",
        "written",
    ]
)
"""Names that the program itself uses; `dir` leaves them out."""

START = Range(1, 1, 1, 1)
_PLACED = Code("", "", Severity.INFO)
"""Code of a value whose place is asked for."""


class NamedPlace(NamedTuple):
    """Name in a deck: kind of the object, role of the field, name as written, place."""

    kind: Names
    role: Role
    name: str
    where: Where


class Origin:
    """Source of a deck; this base class stands for a deck that a program created.

    no_equations: True if no value is an equation, which is known of a text that is not changed after reading.
    takes_edits: True if places in its text are places in the file, which repairs can change.
    """

    no_equations = False
    takes_edits = True

    def place(self, problem: Problem) -> Range:
        """Return lines and columns of a problem."""
        return START

    def place_in_file(self, problem: Problem) -> Range:
        """Return lines and columns of a problem in the file, whose text may be that of a document."""
        return self.place(problem)

    def lost(self, section: int, block: int, *, kept: bool = True) -> int:
        """Return the number of lines of a block that could not be used at all, with or without those it keeps."""
        return 0

    def written(self, where: Where) -> bool:
        """Return True if the file contains exactly this value."""
        return True


_KINDS: dict[str, tuple[Any, str]] = {
    **dict.fromkeys(("file", "source"), (str, "a str")),
    **dict.fromkeys(("preamble", "sections", "comments", "problems"), (list, "a list")),
    "origin": (Origin, "an Origin"),
    "folder": ((Path, NoneType), "a Path or None"),
    "bases": (tuple, "a tuple"),
    "incomplete": (bool, "True or False"),
}
"""Types of the fields of a deck, with their description for messages."""


@dataclass(repr=False)
class Deck:
    """Deck: its sections and blocks as validated models, equations as written.

    `mudline.Deck` is this class with the methods that create texts and scenes from a deck. Decks are equal (`==`) if
    the names of their files are the same too: two copies of a text under different names are not.

    Attributes:
        file: name of the file in messages.
        source: the file's own name, without its folder.
        units: unit system of all numbers: "metric", "imperial" or "user".
        preamble: lines before the first section.
        sections: `$SECTION`s in the order of the file, with their blocks.
        comments: comments before sections.
        problems: findings of reading; `require` raises the errors among them.
        origin: gives the place of each value in the file.
        folder: folder of the files that the deck names; None for a deck without a path: no other file is then read.
        bases: decks that this deck continues, the nearest first, once they are found; their models are the last
            sections.
        incomplete: True if the first of the continued decks was not found.
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
        """Raise ValueError if a caller of `mudline.Deck` gave a value of the wrong type."""
        expect_fields(self, _KINDS)
        expect_word(self.units, "units", UNITS)

    def __repr__(self) -> str:
        blocks = sum(len(section.blocks) for section in self.sections)
        parts = [self.units, counted(len(self.sections), "section"), counted(blocks, "block")]
        if errors := len(self.errors()):
            parts.append(counted(errors, "error"))
        return outline(f"{type(self).__name__} {cut(self.file, 80)!r}", ", ".join(parts))

    def _repr_html_(self) -> str:
        """Return the keywords of each section with their numbers, for notebooks."""
        from mudline.basics.html_repr import html_page, html_table  # noqa: PLC0415 - needed only in notebooks

        blocks = [(section.name, block.keyword, block) for section in self.sections for block in section.blocks]
        contents = ((*names, getattr(block, "summary", "lines are kept, not read")) for *names, block in blocks)
        rows = [(section, keyword, number, text) for (section, keyword, text), number in Counter(contents).items()]
        errors = [counted(len(self.errors()), "error")] if self.errors() else []
        summary = ", ".join([self.file, self.units, *errors])
        return html_page(
            type(self).__name__, summary, html_table(("section", "keyword", "blocks", "says"), rows, len(rows))
        )

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if name not in _INTERNAL]

    @property
    def alone(self) -> Self:
        """Deck without the decks that it continues."""
        return replace(self, sections=[*self.own_sections], bases=(), incomplete=False) if self.bases else self

    @property
    def own_sections(self) -> Sequence[Section]:
        """Sections of this file; the models of the decks that it continues follow them."""
        return self.sections[: len(self.sections) - sum(len(base.sections) for base in self.bases)]

    def base_of(self, where: Where | None) -> tuple[Deck, Where] | None:
        """Return the continued deck that a value comes from, and its place there; None for a value of this deck."""
        if where is None or not self.bases:
            return None
        places = [(base.deck, number) for base in reversed(self.bases) for number in base.sections]
        index = where.section - len(self.sections) + len(places)
        return (places[index][0], where._replace(section=places[index][1])) if index >= 0 else None

    def at(self, where: Where) -> Any:
        """Return the block at a place, or the value in it; None for a value that the block does not have."""
        return self.sections[where.section].blocks[where.block].at(where.path)[1]

    def _owned_at(self, where: Where) -> tuple[Deck, Where]:
        return self.base_of(where) or (self, where)

    def _owned(self, problem: Problem) -> tuple[Deck, Problem]:
        """Return the deck that a problem belongs to, and the problem in the terms of that deck."""
        if isinstance(problem, BaseProblem):
            return problem.deck, problem
        base = self.base_of(problem.where)
        return (base[0], replace(problem, where=base[1])) if base else (self, problem)

    def place(self, problem: Problem | Where) -> Range:
        """Return lines and columns of a problem or a value, in the file that it belongs to."""
        deck, own = self._owned(problem if isinstance(problem, Problem) else Problem(_PLACED, "", where=problem))
        return deck.origin.place_in_file(own)

    def lost(self, where: Where, *, kept: bool = True) -> int:
        """Return the number of lines of a block that could not be used at all, with or without those it keeps."""
        deck, inner = self._owned_at(where)
        return deck.origin.lost(inner.section, inner.block, kept=kept)

    def written(self, where: Where) -> bool:
        """Return True if the file of the value contains exactly this value."""
        deck, inner = self._owned_at(where)
        return deck.origin.written(inner)

    def folder_of(self, where: Where) -> Path | None:
        """Return the folder of the files that the deck names at a place."""
        return self._owned_at(where)[0].folder

    def blocks(self, keyword: str, section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """Yield the modelled blocks of a keyword in all sections of a name, in the order of the file.

        Blocks of continued decks come first, so that the deck's own blocks override them. The caller knows the class of
        the keyword; it is not imported for a deck that lacks the keyword.
        """
        for index, number, block in self._modelled(section):
            if block.keyword == keyword:
                yield Where(index, number), block

    def blocks_with(self, fact: str, section: str = "MODEL") -> list[tuple[Where, Any]]:
        """Return the modelled blocks whose declaration has a flag of `Facts`, in the order of `blocks`."""
        modelled = self._modelled(section)
        return [(Where(index, number), block) for index, number, block in modelled if getattr(block.facts, fact)]

    def _modelled(self, section: str) -> Iterator[tuple[int, int, Any]]:
        """Yield the modelled blocks in sections of a name with their numbers, those of continued decks first."""
        own = len(self.own_sections)
        for index, holder in sorted(enumerate(self.sections), key=lambda placed: placed[0] < own):
            for number, block in enumerate(holder.blocks) if holder.name == section else ():
                if type(block) is not Opaque:
                    yield index, number, block

    def every_block(self) -> list[tuple[Where, str, Block | Opaque]]:
        """Return the blocks of all sections in order, read or not: place, name of the section, block."""
        return [
            (Where(i, j), section.name, block)
            for i, section in enumerate(self.sections)
            for j, block in enumerate(section.blocks)
        ]

    def names(self) -> list[NamedPlace]:
        """Return every name in the fields of the deck, in order, whether the field uses or defines it.

        Numbers and labels of nodes and elements are not included.
        """
        return [
            NamedPlace(kind, role, name, where._replace(path=path))
            for where, _, block in self.every_block()
            if gives_names(type(block))
            for kind, role, name, path in every_name_given(block)
        ]

    def keywords(self, section: str = "MODEL") -> set[str]:
        """Return the names of the keywords in the sections of a name."""
        expect(section, "section", str, "a str")
        return {block.keyword for holder in self.sections if holder.name == section for block in holder.blocks}

    def diagnose(self, problems: Sequence[Problem]) -> list[Diagnostic]:
        """Return problems as diagnostics, each in the file that it belongs to, in the order of the file."""
        return sorted(map(self._diagnosed, problems), key=lambda diagnostic: diagnostic.sort_key)

    def _diagnosed(self, problem: Problem) -> Diagnostic:
        deck, own = self._owned(problem)
        code, place = own.code, deck.origin.place_in_file(own)
        fix = _fix(deck.origin, own.repair, code) if own.repair and deck.origin.takes_edits else None
        blocks, following = own.blocking is not Blocks.NEVER, tuple(self.diagnose(problem.following))
        message = printable(cut(own.message, LONGEST_MESSAGE))  # names of a deck may be anything
        return Diagnostic(deck.file, code.code, code.slug, own.weight, message, *place, fix, blocks, following)

    def require(self) -> Self:
        """Return the deck itself; raises DeckError if a part of it could not be read."""
        if errors := self.errors():
            raise DeckError(self.diagnose(errors))
        return self

    def errors(self) -> list[Problem]:
        """Return the problems that are errors."""
        return [problem for problem in self.problems if problem.weight is Severity.ERROR]


def unread_lines(block: Block | Opaque) -> Iterable[tuple[DocumentPath, str]]:
    """Return the lines of a block that are not read, with their paths: all without a model, else those it keeps."""
    if type(block) is Opaque:
        return ((("lines", number), line) for number, line in enumerate(block.lines))
    return kept_places(block) if keeps_lines(type(block)) else ()


def raw_lines(block: Block | Opaque) -> list[str]:
    """Return the lines of a block that are not read."""
    return [line for _, line in unread_lines(block)]


class Base(NamedTuple):
    """Deck that another deck continues: as written, with its `$MODEL` sections evaluated, and its problems.

    `sections` maps the number of a section in the deck to the evaluated section.
    """

    deck: Deck
    sections: dict[int, Section]
    problems: tuple[Problem, ...]

    def __repr__(self) -> str:
        return short_repr(self)

    @property
    def errors(self) -> list[Problem]:
        """Errors that keep the model of the deck from being used."""
        return [problem for problem in self.problems if problem.blocking is Blocks.ALWAYS]


@dataclass(frozen=True, slots=True, kw_only=True, repr=False)
class BaseProblem(Problem):
    """Problem of a continued deck, in the terms of that deck."""

    deck: Deck

    __repr__ = short_repr


def _fix(origin: Origin, repair: Repair, code: Code) -> Fix:
    """Return a repair in lines and columns."""
    places = [(origin.place(Problem(code, "", span)), text) for span, text in repair.edits]
    edits = tuple(Edit((p.line, p.column), (p.end_line, p.end_column), text) for p, text in places)
    return Fix(repair.applicability, repair.message, edits)
