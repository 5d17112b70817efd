"""Lossless tree of a deck's lines: each leaf is a span of the text, and all leaves together are the whole text."""

from __future__ import annotations

import re
import sys
from bisect import bisect_right
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import cache, cached_property, lru_cache
from typing import NamedTuple

from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Span, Where
from mudline.language.syntax.fields import first_key
from mudline.language.syntax.grammars import parser
from mudline.language.syntax.source import CONTROLS, Source

_BLANKS = re.compile(r"[ \t]+")
_COMMA = re.compile(r" *, *")
_REMEMBERED = 100
"""Greatest length of a line whose name is cached: few lines are longer, and most decks have the same names."""


class LeafKind(Enum):
    """Kind of a leaf, by its text alone."""

    SECTION = "SECTION"
    KEYWORD = "KEYWORD"
    RUN = "RUN"
    SETTING = "SETTING"
    UNDECIDED = "UNDECIDED"
    COMMENT = "COMMENT"
    BLANK = "BLANK"
    TEXT = "TEXT"


class Leaf(NamedTuple):
    """Line, or run of numeric or blank lines, with line ends."""

    kind: LeafKind
    span: Span


@dataclass(slots=True)
class RawBlock:
    """`*KEYWORD` line and the lines of its block; `name` is in upper case with single blanks.

    `older` is True for a block of an older program, whose fields may have values that are declared as older.
    """

    head: Leaf
    name: str
    leaves: list[Leaf] = field(default_factory=list)
    older: bool = False

    __repr__ = short_repr

    @property
    def span(self) -> Span:
        """Span from its `*KEYWORD` line to the end of its last line."""
        return Span(self.head.span.start, (self.leaves or [self.head])[-1].span.end)


@dataclass(slots=True)
class RawSection:
    """`$SECTION` line and its blocks; the preamble has no head and the name ""."""

    head: Leaf | None
    name: str
    leaves: list[Leaf] = field(default_factory=list)
    blocks: list[RawBlock] = field(default_factory=list)

    __repr__ = short_repr

    @property
    def above(self) -> Span:
        """Span of its lines above the first block."""
        last = self.leaves[-1] if self.leaves else self.head
        return Span(self.head.span.start if self.head else 0, last.span.end if last else 0)

    @property
    def span(self) -> Span:
        """Span from its `$SECTION` line to the end of its last line; it ends where the next section begins."""
        return Span(self.above.start, self.blocks[-1].span.end if self.blocks else self.above.end)


class Spot(NamedTuple):
    """Block, or lines of a section above its first block (`block` None), and its place among the values of the deck."""

    where: Where
    section: RawSection
    block: RawBlock | None
    part: RawBlock | RawSection
    """The block, or else the section, with its `*` or `$` line and the lines below it."""

    @property
    def keyword(self) -> str:
        """Name of the block, or ""."""
        return self.block.name if self.block else ""

    @property
    def span(self) -> Span:
        """Span of the lines; it ends where the next one begins."""
        return self.block.span if self.block else self.section.above


@dataclass(frozen=True)
class SyntaxTree:
    """Tree of a whole file: the lines before the first section, then the sections."""

    source: Source
    preamble: RawSection
    sections: tuple[RawSection, ...]

    __repr__ = short_repr

    def leaves(self) -> Iterator[Leaf]:
        """Yield every leaf, in the order of the text."""
        for spot in self.spots:
            if spot.part.head:
                yield spot.part.head
            yield from spot.part.leaves

    @cached_property
    def spots(self) -> list[Spot]:
        """Sections and blocks in the order of the text; the preamble, with section -1, comes first."""
        return [
            Spot(Where(index, number), section, block, block or section)
            for index, section in enumerate((self.preamble, *self.sections), -1)
            for number, block in enumerate((None, *section.blocks), -1)
        ]

    def at(self, offset: int) -> Spot:
        """Return the section or block around an offset."""
        return self.spots[max(bisect_right(self.spots, offset, key=lambda spot: spot.span.start) - 1, 0)]


@cache
def _lines() -> re.Pattern[str]:
    """Return the pattern whose consecutive matches are the tokens of a text; `lastgroup` is the terminal.

    It splits a text like lark's basic lexer, in a third of the time: the first fitting terminal is taken, in the order
    that lark documents.
    """
    order = sorted(
        parser("deck").terminals,
        key=lambda token: (-token.priority, -token.pattern.max_width, -len(token.pattern.value), token.name),
    )
    return re.compile(matchable("|".join(f"(?P<{token.name}>{token.pattern.to_regexp()})" for token in order)))


def matchable(pattern: str) -> str:
    """Return a pattern without possessive repeats of groups before Python 3.11.5.

    There a repeat that fails halfway keeps what it took. Elsewhere they need a fifth of the time, and no memory.
    """
    return pattern.replace(")*+", ")*").replace(")++", ")+") if sys.version_info < (3, 11, 5) else pattern


def canonical_name(line: str) -> str:
    """Return the name on a `$` or `*` line: upper case, single blanks, no blanks around a comma."""
    return _known_name(line) if len(line) <= _REMEMBERED else _known_name.__wrapped__(line)


@lru_cache(maxsize=1024)
def _known_name(line: str) -> str:
    name = _BLANKS.sub(" ", line.lstrip(f" \t{CONTROLS}").rstrip(" \t\r\n")[1:].strip(" \t"))
    return _COMMA.sub(",", name).upper()


_COMMENT = re.compile(r"[Cc](?:[ \t]|[-*=#_.~+]{2}|$)")
_WORD_WITH_C = re.compile("C[A-Za-z]")


def is_comment(line: str, *, words: bool = False) -> bool:
    """Return True for a comment; with `words` also for a line with C and a letter in column 1, which may be one."""
    return bool(_COMMENT.match(line) or (words and _WORD_WITH_C.match(line)))


def is_data(text: str, leaf: Leaf, keys: Container[str] | None) -> bool:
    """Return True for a leaf of a block that is neither blank nor a comment.

    A line with C and a letter in column 1 is data if it begins with one of the `keys` of the keyword; always without
    keys, which are those of a keyword whose lines are not read.
    """
    if leaf.kind is LeafKind.UNDECIDED and keys is not None:
        return first_key(text, leaf.span) in keys
    return leaf.kind not in (LeafKind.COMMENT, LeafKind.BLANK)


def data_lines(lines: Iterable[str], *, words: bool = False) -> list[str]:
    """Return the lines that are neither blank nor comments in the sense of `is_comment`, without blanks around them."""
    return [data for line in lines if not is_comment(line, words=words) and (data := line.strip(" \t\r"))]


def mark_of(line: str) -> str:
    """Return the `$` or `*` that opens a section or a block on a line, or ""."""
    first = line.lstrip(f" \t{CONTROLS}")[:1]
    return first if first in ("$", "*") else ""


def parse(source: Source) -> SyntaxTree:
    """Return the tree of a source. Never fails: unreadable content becomes one leaf before any section."""
    if not source.readable:
        leaf = Leaf(LeafKind.TEXT, Span(0, len(source.text)))
        return SyntaxTree(source, RawSection(None, "", [leaf] if source.text else []), ())
    preamble = section = RawSection(None, "")
    sections: list[RawSection] = []
    leaves = section.leaves
    new = tuple.__new__  # a third of the time of the classes: a deck has a leaf for nearly every line
    for line in _lines().finditer(source.unified):
        kind = _KINDS[line.lastgroup]
        leaf = new(Leaf, (kind, new(Span, line.span())))
        if kind is _SECTION:
            section = RawSection(leaf, canonical_name(line[0]))
            sections.append(section)
            leaves = section.leaves
        elif kind is _KEYWORD:
            block = RawBlock(leaf, canonical_name(line[0]))
            section.blocks.append(block)
            leaves = block.leaves
        else:
            leaves.append(leaf)
    return SyntaxTree(source, preamble, tuple(sections))


_KINDS: dict[str | None, LeafKind] = {kind.value: kind for kind in LeafKind}
_SECTION, _KEYWORD = LeafKind.SECTION, LeafKind.KEYWORD
