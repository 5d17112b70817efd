"""A deck with the models of the decks that it continues: one deck for the scene, several files for findings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mudline.deck.model import Deck, Origin, Range, Section
from mudline.diagnostics import Blocks, Diagnostic, Problem, Where
from mudline.keywords.model import Block
from mudline.short_repr import short_repr


@dataclass(frozen=True, slots=True)
class Base:
    """A deck that another one continues: as written, its `$MODEL` sections evaluated, and what is wrong in it.

    `sections` has them by their number in the deck.
    """

    deck: Deck
    sections: dict[int, Section]
    problems: tuple[Problem, ...]

    __repr__ = short_repr

    @property
    def errors(self) -> list[Problem]:
        """What keeps its model from being used."""
        return [problem for problem in self.problems if problem.blocking is Blocks.ALWAYS]


@dataclass(frozen=True, slots=True)
class BaseProblem(Problem):
    """A problem of a deck that is continued, in that deck's own terms."""

    deck: Deck | None = None

    __repr__ = short_repr


def as_base_problem(problem: Problem, deck: Deck) -> BaseProblem:
    """A problem of a deck that is continued."""
    return BaseProblem(
        code=problem.code,
        message=problem.message,
        span=problem.span,
        severity=problem.severity,
        where=problem.where,
        blocks=problem.blocks,
        deck=deck,
    )


@dataclass(frozen=True)
class ContinuedOrigin:
    """Where values stand, each in its own file; the sections from number `own` on are those of `base_sections`."""

    origin: Origin
    own: int
    base_sections: Sequence[tuple[Deck, int]]

    __repr__ = short_repr

    def base_of(self, where: Where) -> tuple[Deck, Where] | None:
        """The deck that a value was taken from, and its place there; None for one of the deck itself."""
        if where.section < self.own:
            return None
        deck, number = self.base_sections[where.section - self.own]
        return deck, where._replace(section=number)

    def _at(self, where: Where) -> tuple[Origin, Where]:
        found = self.base_of(where)
        return (found[0].origin, found[1]) if found else (self.origin, where)

    def place(self, problem: Problem) -> Range:
        """Lines and columns of a problem."""
        if problem.where is None:
            return self.origin.place(problem)
        origin, where = self._at(problem.where)
        return origin.place(replace(problem, where=where))

    def damaged(self, where: Where) -> bool:
        """Whether something at this place could not be read."""
        origin, inner = self._at(where)
        return origin.damaged(inner)

    def lost(self, section: int, block: int) -> int:
        """How many lines of a block could not be used at all."""
        origin, inner = self._at(Where(section, block))
        return origin.lost(inner.section, inner.block)

    def written(self, where: Where) -> bool:
        """Whether exactly this value stands in its file."""
        origin, inner = self._at(where)
        return origin.written(inner)


@dataclass(repr=False)
class ContinuedDeck(Deck):
    """A deck whose last sections are those of the models that it continues; its own keep their numbers.

    `bases` are the decks in front of it, the nearest first; `incomplete` says that the first of all was not found.
    """

    bases: tuple[Base, ...] = ()
    incomplete: bool = False

    @property
    def alone(self) -> Deck:
        """The deck without those that it continues."""
        origin = self.origin.origin if isinstance(self.origin, ContinuedOrigin) else self.origin
        return Deck(
            file=self.file,
            source=self.source,
            units=self.units,
            preamble=self.preamble,
            sections=[*self.own_sections],
            comments=self.comments,
            problems=self.problems,
            origin=origin,
            folder=self.folder,
        )

    @property
    def own_sections(self) -> Sequence[Section]:
        """The sections of the deck itself."""
        return self.sections[: len(self.sections) - sum(len(base.sections) for base in self.bases)]

    def blocks(self, keyword: str, section: str = "MODEL") -> Iterator[tuple[Where, Any]]:
        """As of any deck; what it continues comes first, so that what it says itself holds."""
        own = len(self.own_sections)
        for i in (*range(own, len(self.sections)), *range(own)):
            if self.sections[i].name == section:
                for j, block in enumerate(self.sections[i].blocks):
                    if block.keyword == keyword and isinstance(block, Block):
                        yield Where(i, j), block

    def folder_of(self, where: Where) -> Path | None:
        """Where the files are looked for that the deck names at a place."""
        found = self._base_of(where)
        return found[0].folder if found else self.folder

    def diagnose(self, problems: Sequence[Problem]) -> list[Diagnostic]:
        """Problems as diagnostics, each in the file that it belongs to."""
        return sorted((self._located(problem) for problem in problems), key=lambda found: found.sort_key)

    def _located(self, problem: Problem) -> Diagnostic:
        if isinstance(problem, BaseProblem) and problem.deck is not None:
            return problem.deck.diagnose([problem])[0]
        found = self._base_of(problem.where) if problem.where else None
        if found is None:
            return super().diagnose([problem])[0]
        return found[0].diagnose([replace(problem, where=found[1])])[0]

    def _base_of(self, where: Where) -> tuple[Deck, Where] | None:
        return self.origin.base_of(where) if isinstance(self.origin, ContinuedOrigin) else None


def continuation(deck: Deck, bases: Sequence[Base], *, incomplete: bool) -> ContinuedDeck:
    """The deck with the models of `bases`, the nearest first."""
    far_first = [(base.deck, number, section) for base in bases[::-1] for number, section in base.sections.items()]
    units = [deck.units, *(base.deck.units for base in bases)]
    return ContinuedDeck(
        file=deck.file,
        source=deck.source,
        units=next((name for name in units if name != "user"), "user"),
        preamble=deck.preamble,
        sections=[*deck.sections, *(section for _, _, section in far_first)],
        comments=deck.comments,
        problems=deck.problems,
        origin=ContinuedOrigin(deck.origin, len(deck.sections), [(base, number) for base, number, _ in far_first]),
        folder=deck.folder,
        bases=tuple(bases),
        incomplete=incomplete,
    )


def of_base(deck: Deck, problem: Problem) -> bool:
    """Whether a problem of a scene lies in a deck that `deck` continues, and not in `deck` itself."""
    beyond = problem.where is not None and problem.where.section >= len(deck.sections)
    return beyond or isinstance(problem, BaseProblem)
