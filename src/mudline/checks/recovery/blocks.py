"""Input of a corrector, the blocks of a deck's text, and its output: a correction of a fault that causes findings."""

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
from mudline.language.syntax.tree import Leaf, LeafKind, RawBlock, RawSection
from mudline.model.scene.references import CURVES
from mudline.model.scene.sets import ALL

ROW_NUMBER = re.compile(r"[ \t]*([0-9]{1,10})[ \t]*(?=,)")
"""Number at the beginning of a row."""


@dataclass(frozen=True, slots=True)
class Correction:
    """Edits that may correct a fault, and the part of the text that they change.

    cause: the finding of the fault.
    edits: the edits.
    region: the part of the text that is read differently with them.
    message: message of the finding if the correction is accepted, "" for its own message.
    does: the effect of the edits in words; the finding then has them as an unsafe repair.
    certain: the correction needs no trial.
    joins: the correction makes its lines part of the block above.
    """

    cause: Problem
    edits: tuple[TextEdit, ...]
    region: Span
    message: str = ""
    does: str = ""
    certain: bool = False
    joins: bool = False


def start_of(text: TextOrigin, problem: Problem) -> int:
    """Return the offset of a problem in the text, -1 if it has no place there."""
    span = problem.span or (text.span(problem.where) if problem.where else None)
    return -1 if span is None else span.start


def line_at(text: TextOrigin, offset: int) -> Span:
    """Return the line around an offset, without its end."""
    unified = text.source.unified
    end = unified.find("\n", offset)
    end = len(unified) if end < 0 else end
    return Span(unified.rfind("\n", 0, offset) + 1, end - (unified[end - 1 : end] == "\r"))


def behind(text: TextOrigin, line: Span) -> int:
    """Return the offset of the next line."""
    return (text.source.unified.find("\n", line.end) + 1) or len(text.source.unified) + 1


def head_start(text: TextOrigin, block: RawBlock) -> int:
    """Return the offset of a block's name, after the spaces at the start of its line."""
    line = text.source.unified[slice(*block.head.span)]
    return block.head.span.start + len(line) - len(line.lstrip(" \t"))


def whole(block: RawBlock) -> Span:
    """Return the span from the head of a block to the end of its last line."""
    return Span(block.head.span.start, (block.leaves or [block.head])[-1].span.end)


def data_of(leaves: Sequence[Leaf]) -> list[Leaf]:
    """Return the lines that are not comments."""
    return [leaf for leaf in leaves if leaf.kind not in (LeafKind.COMMENT, LeafKind.BLANK)]


def lines_of(text: TextOrigin, block: RawBlock) -> Iterator[Span]:
    """Yield the lines of a block below its head, without their ends."""
    at = block.head.span.end
    end = whole(block).end
    while at < end:
        line = line_at(text, at)
        yield line
        at = text.source.unified.find("\n", at) + 1 or end


def also_in(origin: Origin, others: Sequence[Problem]) -> str:
    """Return in words the other lines with the same fault."""
    *lines, last = sorted({origin.place_in_file(one).line for one in others})
    if not lines:
        return f"the same in line {last}"
    return f"the same in {len(lines) + 1} more lines, the last of them line {last}"


class Blocks:
    """Blocks of a deck's text by their place, computed on demand."""

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
        """All blocks, each with the name of its section."""
        return [(section.name, block) for section in self._sections for block in section.blocks]

    @cached_property
    def keywords(self) -> set[str]:
        """Names of all blocks."""
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
        """Return the span from the head of the block (or section) around an offset to the next head."""
        return self._around(self._starts, offset)

    def section_at(self, offset: int) -> Span:
        """Return the span from the head of the section around an offset to the next one."""
        return self._around(self._heads, offset)

    def _around(self, starts: list[int], offset: int) -> Span:
        at = bisect_right(starts, offset)
        return Span(starts[at - 1] if at else 0, starts[at] if at < len(starts) else self.end)

    def declared_at(self, offset: int) -> type[Block] | None:
        """Return the declaration of the block around an offset; None if its lines are not read."""
        at = bisect_right(self._block_starts, offset)
        block = self.blocks[at - 1][1] if at else None
        if block is None or offset >= whole(block).end:  # above the first block, or after the lines of a block
            return None
        return catalogue.block_class(self.section_name(offset), block.name)

    def section_name(self, offset: int) -> str:
        """Return the name of the section around an offset, "" before the first."""
        return self._sections[max(bisect_right(self._heads, offset) - 1, 0)].name

    @cached_property
    def _names(self) -> list[NamedPlace]:
        return self.deck.names()

    def missing(self, what: Names) -> list[str]:
        """Return the names of a kind that are used and not defined."""
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
        """Names of curves that are used and not defined, each with the kinds of curves that it may be."""
        found: dict[str, list[Names]] = {}
        for kind in (Names.CURVE, *CURVES):
            for name in self.missing(kind):
                found.setdefault(name_key(name), []).append(kind)
        return found
