"""Deck as rules that advise see it: how it is read, as it is written, and its scene."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import chain, islice
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from mudline.basics.limits import MOST_REPORTED
from mudline.editing.variations.names import misspelt_actions, undefined_parameters, undefined_variations
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.model import Deck, NamedPlace, Origin
from mudline.language.deck.parameters import DEFINING
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Blocks, Code, Problem, Span, Where
from mudline.language.keywords.catalogue import hold_in_soil
from mudline.language.keywords.model import Block
from mudline.language.keywords.reader import ReadBlock, read_block, read_piece
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import RawBlock
from mudline.model.scene.context import placed_blocks
from mudline.model.scene.model import Scene, resolve

T = TypeVar("T")


@dataclass(eq=False)
class LintContext:
    """Deck as it is written, with its equations, and its scene, evaluated and resolved as far as possible.

    dialect: the deck language that the deck must keep to, "mudline", or "flexcom" without extension keywords.
    fixing: repairs are made, so repairs that another deck next to this one forbids must not be offered.
    text: tree, source and places of a deck that was read from text; None for a deck that a program made, and for a
        document that no keyword text can express.

    The deck of a document is read as keyword text, so that both have the same findings.
    """

    deck: Deck
    dialect: str = "mudline"
    fixing: bool = False
    text: TextOrigin | None = field(init=False, default=None)
    _made: dict[object, Any] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        """Take the keyword text of a document."""
        if not isinstance(self.deck.origin, TextOrigin) and not self.deck.origin.takes_edits:
            from mudline.language.deck.document import read_as_text  # noqa: PLC0415 - few decks are documents

            self.deck = read_as_text(self.deck)
        if isinstance(self.deck.origin, TextOrigin):
            self.text = self.deck.origin

    @cached_property
    def source(self) -> Source:
        """Source of the text, an empty one without a text."""
        return self.text.source if self.text else Source(self.deck.file, "")

    @cached_property
    def scene(self) -> Scene:
        """Scene of the deck."""
        return resolve(self.deck)

    def blocks(self, keyword: str, section: str = "MODEL") -> Sequence[tuple[Where, Any]]:
        """Return `Deck.blocks` of the deck of the scene, whose equations are evaluated."""
        return self.scene.context.placed.get((section, keyword), ())

    def records(self, keyword: str, name: str = "sets", section: str = "MODEL") -> list[tuple[Where, Any]]:
        """Return `records_of` the same blocks."""
        return self.scene.context.records(keyword, name, section)

    def written(self, keyword: str, section: str = "MODEL") -> Sequence[tuple[Where, Any]]:
        """Return `Deck.blocks` of the deck itself, with its equations."""
        return self._written.get((section, keyword), ())

    @cached_property
    def _written(self) -> dict[tuple[str, str], list[tuple[Where, Any]]]:
        return placed_blocks(self.deck)

    @cached_property
    def names(self) -> list[NamedPlace]:
        """`Deck.names` of the deck itself."""
        return self.deck.names()

    @cached_property
    def keywords(self) -> set[str]:
        """Names of the keywords in the models of the scene's deck, including those that are not read."""
        return self.scene.deck.keywords()

    @cached_property
    def in_soil(self) -> bool:
        """True if the model has soil springs."""
        return hold_in_soil(self.keywords)

    @cached_property
    def noticed(self) -> dict[str, list[Problem]]:
        """Problems from reading and resolving the deck, and from the rules that block, by code."""
        found: dict[str, list[Problem]] = {}
        for problem in chain(self.scene.findings, of_variations(self.deck)):
            found.setdefault(problem.code.code, []).append(problem)
        return found

    def once(self, make: Callable[[LintContext], T]) -> T:
        """Return the result of a function of this deck, computed once for all rules that ask."""
        if make not in self._made:
            self._made[make] = make(self)
        found: T = self._made[make]
        return found

    def problems_of(self, code: Code) -> Sequence[Problem]:
        """Return the problems of one code from reading and resolving the deck, and from the rules that block."""
        return self.noticed.get(code.code, ())


# ---------------------------------------------------------------------------------------------------- reading

_SHORT_BLOCK = 4096
"""Characters of the largest block that is remembered: decks of a project share their short blocks."""


class _Piece(str):
    """Text of a block, equal to any other with the same text; `raw` and `start` are those of the first one read."""

    __slots__ = ("raw", "start")

    raw: RawBlock
    start: int


@lru_cache(512)
def _read_piece(piece: _Piece, declared: type[Block], last: bool, older: bool) -> ReadBlock:  # noqa: ARG001, FBT001 - for the cache
    return read_piece(piece, piece.start, piece.raw, declared, last=last)


def read_once(text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
    """Return the result of `read_block` for a block; blocks with the same text share their model."""
    start, end = raw.head.span.start, (raw.leaves or [raw.head])[-1].span.end
    if end - start > _SHORT_BLOCK:
        return read_block(text, raw, declared, last=last)
    piece = _Piece(text[start:end])
    piece.raw, piece.start = raw, start
    known = _read_piece(piece, declared, last, raw.older)
    return known.at(text, start, [_reported_at(problem, start) for problem in known.problems] if known.problems else [])


def _reported_at(problem: Problem, by: int) -> Problem:
    span = problem.span and problem.span.moved(by)
    repair = problem.repair
    if repair is not None:
        repair = replace(repair, edits=tuple((place.moved(by), text) for place, text in repair.edits))
    return replace(problem, span=span, repair=repair)


def read_deck(
    data: bytes, name: str, *, form: str | None = None, units: str | None = None, folder: Path | None = None
) -> Deck:
    """Return the deck of a file's content; it must not be changed, as its models are shared with decks read before.

    Raises DeckError for a JSON or YAML file that holds no deck.
    """
    deck = load_bytes(data, name, form=form, units=units, folder=folder, read=read_once)
    if isinstance(deck.origin, TextOrigin):
        deck.origin.no_equations = "=[" not in deck.origin.source.text
    return deck


# ---------------------------------------------------------------------------------------------- for rules


def of_variations(deck: Deck) -> Iterator[Problem]:
    """Yield undefined names in variations: they are faults of the varied decks, and not of this deck."""
    if all(section.name != DEFINING for section in deck.sections):
        return
    for find in (undefined_parameters, undefined_variations, misspelt_actions):
        for problem in islice(find(deck), MOST_REPORTED):
            yield replace(problem, blocks=Blocks.NEVER)


class Joined(NamedTuple):
    """Finding, and others that follow from it or repeat it; `message` and `place` may replace its own."""

    first: Problem
    others: Sequence[Problem]
    words: str = ""
    message: str = ""
    place: Span | None = None


Found = Mapping[str, Sequence[Problem]]
"""Findings in a deck by code."""
Join = Callable[[LintContext, Found], Iterator[Joined]]
JOINTS: list[tuple[frozenset[str], Join]] = []
"""Joints of all rules, each with the codes of which the deck must have at least one."""


def joint(*codes: Code) -> Callable[[Join], Join]:
    """Return a decorator that registers a function which joins findings to those of some codes.

    It stands next to the rule that reports these codes.
    """

    def register(join: Join) -> Join:
        JOINTS.append((frozenset(code.code for code in codes), join))
        return join

    return register


ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
"""Number at the beginning of a row."""


def also_in(origin: Origin, others: Sequence[Problem]) -> str:
    """Return in words the other lines with the same fault."""
    *lines, last = sorted({origin.place_in_file(one).line for one in others})
    if not lines:
        return f"the same in line {last}"
    return f"the same in {len(lines) + 1} more lines, the last of them line {last}"
