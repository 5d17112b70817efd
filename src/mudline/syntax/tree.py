"""The lossless tree of level one: leaves are spans of the text, laid end to end they are the text."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum
from functools import cache, lru_cache
from typing import NamedTuple

from mudline.diagnostics import Span
from mudline.resources import grammar_file
from mudline.short_repr import short_repr
from mudline.syntax.source import CONTROLS, Source

_BLANKS = re.compile(r"[ \t]+")
_COMMA = re.compile(r" *, *")
_LONG = 1 << 16
"""Characters of a run, or of a text, from which on the run is found with arrays."""
_CHUNK = 1 << 18
_LF, _PLUS, _SLASH, _NINE = b"\n+/9"  # a line of a run begins with a character from + to 9, but not with a slash
_REMEMBERED = 100
"""Characters of a line whose name is remembered: few lines are longer, and most decks have the same ones."""
_TERMINAL = re.compile(r"^([A-Z]+)\.?(\d*): /(.*)/$", re.MULTILINE)


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
    """A `*KEYWORD` line and what follows it; `name` is in upper case with single blanks."""

    head: Leaf
    name: str
    leaves: list[Leaf] = field(default_factory=list)

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
def _cutter() -> re.Pattern[str]:
    """The terminals of the grammar as one pattern, by priority: it cuts as lark does, which takes long to get ready."""
    found = _TERMINAL.findall(grammar_file("deck.lark").read_text(encoding="utf-8"))
    order = sorted(found, key=lambda one: -int(one[1] or 0))
    return re.compile("|".join(f"(?P<{name}>{pattern})" for name, _, pattern in order))


def _long_runs(text: str) -> Iterator[Span]:
    """The inner lines of long runs, all but the first and the last, which the pattern finds: arrays are sooner done."""
    if len(text) < _LONG:
        return
    import numpy as np  # noqa: PLC0415 - short decks are cut without arrays

    others = [np.zeros(1, np.intp)]
    for at in range(0, len(text), _CHUNK):
        letters = np.frombuffer(text[at : at + _CHUNK + 1].encode("latin-1", "replace"), np.uint8)
        first = letters[1:] - np.uint8(_PLUS)
        begins = (first > _NINE - _PLUS) | (first == _SLASH - _PLUS)
        begins &= letters[:-1] == _LF
        others.append(np.flatnonzero(begins) + (at + 1))
    lines = np.concatenate([*others, [len(text)]])
    for index in np.flatnonzero(np.diff(lines) >= _LONG).tolist():
        line, end = int(lines[index]), int(lines[index + 1])
        second = text.find("\n", text.find("\n", line, end) + 1 or end, end) + 1
        last = text.rfind("\n", line, end - 1) + 1
        if 0 < second < last:
            yield Span(second, last)


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
    text, cutter = source.unified, _cutter()
    begun = resumed = 0
    for run in (*_long_runs(text), Span(len(text), len(text))):
        for match in cutter.finditer(text, resumed, run.start):
            kind, end = _KINDS[match.lastgroup], match.end()
            leaf = new(Leaf, (kind, new(Span, (begun, end))))
            begun = end
            if kind is Kind.SECTION:
                section = RawSection(leaf, canonical_name(match[0]))
                sections.append(section)
                leaves = section.leaves
            elif kind is Kind.KEYWORD:
                block = RawBlock(leaf, canonical_name(match[0]))
                section.blocks.append(block)
                leaves = block.leaves
            else:
                leaves.append(leaf)
        if run.end > run.start:
            begun, resumed = leaves.pop().span.start, run.end
    return SyntaxTree(source, preamble, tuple(sections))


_KINDS: dict[str | None, Kind] = {kind.value: kind for kind in Kind}
