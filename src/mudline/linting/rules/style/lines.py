"""The lines that style rules look at.

The lines of a block without a model are kept as they are: nobody here knows what a blank means in them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice
from typing import NamedTuple

from mudline.deck.reading import TextOrigin
from mudline.diagnostics import Problem, Span
from mudline.keywords.reader import ReadBlock, all_keys
from mudline.scene.context import MOST_REPORTED
from mudline.syntax.fields import first_key
from mudline.syntax.tree import Kind, Leaf

_DATA = (Kind.RUN, Kind.SETTING, Kind.TEXT)


class Placed(NamedTuple):
    """A line, or a run of them; `read` is the block that it stands in, `kept` says that this block has no model."""

    leaf: Leaf
    read: ReadBlock | None
    kept: bool


def placed_leaves(text: TextOrigin) -> Iterator[Placed]:
    """Every line but those of keywords and sections."""
    preamble = text.tree.preamble
    yield from (Placed(leaf, None, kept=False) for leaf in preamble.leaves)
    yield from (Placed(leaf, None, kept=False) for block in preamble.blocks for leaf in block.leaves)
    for index, section in enumerate(text.tree.sections):
        yield from (Placed(leaf, None, kept=False) for leaf in section.leaves)
        for number, block in enumerate(section.blocks):
            read = text.read.get((index, number))
            yield from (Placed(leaf, read, read is None) for leaf in block.leaves)


def data_leaves(text: TextOrigin) -> Iterator[tuple[Leaf, ReadBlock]]:
    """The lines with values of the blocks that have a model."""
    source, sections = text.source.unified, text.tree.sections
    for (section, number), read in text.read.items():
        for leaf in sections[section].blocks[number].leaves:
            if leaf.kind in _DATA or is_setting(source, leaf, read):
                yield leaf, read


def is_setting(source: str, leaf: Leaf, read: ReadBlock) -> bool:
    """Whether a line is a KEY= that the keyword knows."""
    known = leaf.kind in (Kind.SETTING, Kind.UNDECIDED)
    return known and first_key(source, leaf.span) in all_keys(type(read.model))


def first_of_lines(pattern: re.Pattern[str], source: str, span: Span) -> Iterator[re.Match[str]]:
    """The first match of a pattern on each line of a span."""
    at = span.start
    while at < span.end and (match := pattern.search(source, at, span.end)):
        yield match
        at = source.find("\n", match.end(), span.end) + 1 or span.end


def line_around(source: str, offset: int) -> Span:
    """The line that an offset stands in, without its LF; `source` is a unified text."""
    end = source.find("\n", offset)
    return Span(source.rfind("\n", 0, offset) + 1, len(source) if end < 0 else end)


def first_told(problems: Iterable[Problem]) -> Iterator[Problem]:
    """As many findings as are told one by one; the next says that there are more."""
    found = iter(problems)
    yield from islice(found, MOST_REPORTED)
    for further in islice(found, 1):
        yield replace(further, message=f"and more of the same: the first {MOST_REPORTED} are listed", repair=None)
