"""What a corrector sees of a deck's text, and what it gives: a correction of a fault from which findings follow."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from mudline.language.deck.model import Deck, NamedPlace, Origin
from mudline.language.deck.parameters import name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Problem, Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block
from mudline.language.keywords.values import Names
from mudline.language.syntax.edits import TextEdit
from mudline.language.syntax.tree import Kind, Leaf, RawBlock, RawSection
from mudline.model.scene.references import CURVES
from mudline.model.scene.sets import ALL

ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
"""The number at the begin of a row."""


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a finding, and the part of the text that is read differently then.

    `message` is what the finding says where the correction holds, "" for its own message. With `does`, the words for
    what its edits do, the finding has them as an unsafe repair. One that is `certain` needs no trial; one that `joins`
    makes its lines part of the block above.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    does: str = ""
    certain: bool = False
    joins: bool = False


def start_of(text: TextOrigin, problem: Problem) -> int:
    """Where a problem begins in the text, -1 where it has no place there."""
    span = problem.span or (text.span(problem.where) if problem.where else None)
    return -1 if span is None else span.start


def line_at(text: TextOrigin, offset: int) -> Span:
    """The line around an offset, without its end."""
    unified = text.source.unified
    end = unified.find("\n", offset)
    end = len(unified) if end < 0 else end
    return Span(unified.rfind("\n", 0, offset) + 1, end - (unified[end - 1 : end] == "\r"))


def behind(text: TextOrigin, line: Span) -> int:
    """Where the next line begins."""
    return (text.source.unified.find("\n", line.end) + 1) or len(text.source.unified) + 1


def head_start(text: TextOrigin, block: RawBlock) -> int:
    """Where the name of a block begins: behind the blanks of its line."""
    line = text.source.unified[slice(*block.head.span)]
    return block.head.span.start + len(line) - len(line.lstrip(" \t"))


def whole(block: RawBlock) -> Span:
    """From the head of a block to the end of its last line."""
    return Span(block.head.span.start, (block.leaves or [block.head])[-1].span.end)


def data_of(leaves: Sequence[Leaf]) -> list[Leaf]:
    """The lines that are no comments."""
    return [leaf for leaf in leaves if leaf.kind not in (Kind.COMMENT, Kind.BLANK)]


def lines_of(text: TextOrigin, block: RawBlock) -> Iterator[Span]:
    """The lines of a block below its head, without their ends."""
    at = block.head.span.end
    end = whole(block).end
    while at < end:
        line = line_at(text, at)
        yield line
        at = text.source.unified.find("\n", at) + 1 or end


def also_in(origin: Origin, others: Sequence[Problem]) -> str:
    """Where else the same is found, in words."""
    *lines, last = sorted({origin.place_in_file(one).line for one in others})
    if not lines:
        return f"the same in line {last}"
    return f"the same in {len(lines) + 1} more lines, the last of them line {last}"


class Blocks:
    """The blocks of a deck's text by their place, sorted out when somebody asks."""

    def __init__(self, deck: Deck, text: TextOrigin) -> None:
        self.deck = deck
        self.text = text
        self.end = len(text.source.unified)
        self._missing: dict[Names, list[str]] = {}

    @cached_property
    def _sections(self) -> tuple[RawSection, ...]:
        return (self.text.tree.preamble, *self.text.tree.sections)

    @cached_property
    def blocks(self) -> list[tuple[str, RawBlock]]:
        """All of them, each with the name of its section."""
        return [(section.name, block) for section in self._sections for block in section.blocks]

    def declared(self) -> Iterator[tuple[RawBlock, type[Block]]]:
        """Those whose lines are read, each with its declaration."""
        for section, block in self.blocks:
            if (declared := catalogue.block_class(section, block.name)) is not None:
                yield block, declared

    @cached_property
    def keywords(self) -> set[str]:
        """The names of all blocks."""
        return {block.name for _, block in self.blocks}

    @cached_property
    def _heads(self) -> list[int]:
        return [section.head.span.start if section.head else 0 for section in self._sections]

    @cached_property
    def _block_starts(self) -> list[int]:
        return [block.head.span.start for _, block in self.blocks]

    @cached_property
    def _starts(self) -> list[int]:
        return sorted([*self._heads, *self._block_starts])

    def block_at(self, offset: int) -> Span:
        """From the head of the block (or section) around an offset to the next one."""
        return self._around(self._starts, offset)

    def section_at(self, offset: int) -> Span:
        """From the head of the section around an offset to the next one."""
        return self._around(self._heads, offset)

    def _around(self, starts: list[int], offset: int) -> Span:
        at = bisect_right(starts, offset)
        return Span(starts[at - 1] if at else 0, starts[at] if at < len(starts) else self.end)

    def raw_at(self, offset: int) -> RawBlock | None:
        """The block whose lines are around an offset, None above the first one and below the last line of one."""
        at = bisect_right(self._block_starts, offset)
        block = self.blocks[at - 1][1] if at else None
        return block if block is not None and offset < whole(block).end else None

    def declared_at(self, offset: int) -> type[Block] | None:
        """The declaration of the block around an offset, None where its lines are not read."""
        block = self.raw_at(offset)
        return catalogue.block_class(self.section_name(offset), block.name) if block else None

    def section_name(self, offset: int) -> str:
        """The name of the section around an offset, "" before the first."""
        return self._sections[max(bisect_right(self._heads, offset) - 1, 0)].name

    @cached_property
    def _names(self) -> list[NamedPlace]:
        return self.deck.names()

    def missing(self, what: Names) -> list[str]:
        """The names of a kind that are used and nothing defines."""
        if self.keywords.isdisjoint(catalogue.users(what)):
            return []
        if what not in self._missing:
            defined = {ALL} if what is Names.SET else set[str]()
            found = [one for one in self._names if one.kind is what]
            models = (one for one in found if self.deck.sections[one.where.section].name == "MODEL")
            defined |= {name_key(one.name) for one in models if one.role == "defines"}
            given = (one.name for one in found if one.role == "names")
            self._missing[what] = list(dict.fromkeys(name for name in given if name and name_key(name) not in defined))
        return self._missing[what]

    @cached_property
    def lacked_curves(self) -> dict[str, list[Names]]:
        """The names of curves that are used and nothing defines, each with the kinds of curves that it is one of."""
        found: dict[str, list[Names]] = {}
        for kind in (Names.CURVE, *CURVES):
            for name in self.missing(kind):
                found.setdefault(name_key(name), []).append(kind)
        return found
