"""The lossless tree of level one: leaves are spans of the text, laid end to end they are the text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import cache, lru_cache
from typing import NamedTuple

from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Span
from mudline.language.syntax.grammars import parser
from mudline.language.syntax.source import CONTROLS, Source

_BLANKS = re.compile(r"[ \t]+")
_COMMA = re.compile(r" *, *")
_REMEMBERED = 100
"""Characters of a line whose name is remembered: few lines are longer, and most decks have the same ones."""


class Kind(Enum):
    """What a leaf is, by its look alone."""

    SECTION = "SECTION"
    KEYWORD = "KEYWORD"
    RUN = "RUN"
    SETTING = "SETTING"
    UNDECIDED = "UNDECIDED"
    COMMENT = "COMMENT"
    BLANK = "BLANK"
    TEXT = "TEXT"


class Leaf(NamedTuple):
    """One line, or a run of numeric or blank lines, with its line ends."""

    kind: Kind
    span: Span


@dataclass(slots=True)
class RawBlock:
    """A `*KEYWORD` line and what follows it; `name` is in upper case with single blanks.

    A block of an `older` program may have what fields that are declared so say.
    """

    head: Leaf
    name: str
    leaves: list[Leaf] = field(default_factory=list)
    older: bool = False

    __repr__ = short_repr


@dataclass(slots=True)
class RawSection:
    """A `$SECTION` line and its blocks; the preamble has no head and the name ""."""

    head: Leaf | None
    name: str
    leaves: list[Leaf] = field(default_factory=list)
    blocks: list[RawBlock] = field(default_factory=list)

    __repr__ = short_repr


@dataclass(frozen=True, slots=True)
class SyntaxTree:
    """A whole file: what stands before the first section, then the sections."""

    source: Source
    preamble: RawSection
    sections: tuple[RawSection, ...]

    __repr__ = short_repr

    def leaves(self) -> Iterator[Leaf]:
        """Every leaf, in the order of the text."""
        for section in (self.preamble, *self.sections):
            if section.head:
                yield section.head
            yield from section.leaves
            for block in section.blocks:
                yield block.head
                yield from block.leaves


@cache
def _lines() -> re.Pattern[str]:
    """Return the pattern whose matches, laid end to end, are the tokens of a text; `lastgroup` is the terminal.

    It cuts a text as lark's basic lexer does, in a third of the time: the first of the terminals that fit is taken, in
    the order that lark documents.
    """
    order = sorted(
        parser("deck").terminals,
        key=lambda one: (-one.priority, -one.pattern.max_width, -len(one.pattern.value), one.name),
    )
    return re.compile("|".join(f"(?P<{one.name}>{one.pattern.to_regexp()})" for one in order))


def canonical_name(line: str) -> str:
    """The name that a `$` or `*` line gives: upper case, single blanks, none around a comma."""
    return _known_name(line) if len(line) <= _REMEMBERED else _known_name.__wrapped__(line)


@lru_cache(maxsize=1024)
def _known_name(line: str) -> str:
    name = _BLANKS.sub(" ", line.lstrip(f" \t{CONTROLS}").rstrip(" \t\r\n")[1:].strip(" \t"))
    return _COMMA.sub(",", name).upper()


def mark_of(line: str) -> str:
    """The `$` or `*` with which a line opens a section or a block, or nothing."""
    first = line.lstrip(f" \t{CONTROLS}")[:1]
    return first if first in ("$", "*") else ""


def parse(source: Source) -> SyntaxTree:
    """The tree of a source. Never fails: content that is not text becomes one leaf before any section."""
    if not source.readable:
        leaf = Leaf(Kind.TEXT, Span(0, len(source.text)))
        return SyntaxTree(source, RawSection(None, "", [leaf] if source.text else []), ())
    preamble = section = RawSection(None, "")
    sections: list[RawSection] = []
    leaves = section.leaves
    new = tuple.__new__  # what the classes call, in a third of the time: a deck has a leaf for nearly every line
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


_KINDS: dict[str | None, Kind] = {kind.value: kind for kind in Kind}
_SECTION, _KEYWORD = Kind.SECTION, Kind.KEYWORD
