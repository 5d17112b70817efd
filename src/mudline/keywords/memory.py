"""Blocks that were read before: the decks of a project share most of their blocks, letter by letter."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import replace

from mudline.diagnostics import Problem
from mudline.keywords.model import Block
from mudline.keywords.reader import ReadBlock, read_block
from mudline.syntax.tree import Leaf, RawBlock

LONGEST = 4096
"""Characters of a block that is remembered."""

MOST = 512
"""Blocks that are remembered."""


class BlockMemory:
    """The last few hundred short blocks, as they were read.

    A block that comes again shares its model with the one before: for decks that are looked at and not changed.
    """

    def __init__(self) -> None:
        self._known: OrderedDict[tuple[type[Block], bool, str], ReadBlock] = OrderedDict()

    def read(self, text: str, raw: RawBlock, declared: type[Block], *, last: bool) -> ReadBlock:
        """What `read_block` gives for the block."""
        start = raw.head.span.start
        end = (raw.leaves[-1] if raw.leaves else raw.head).span.end
        if end - start > LONGEST:
            return read_block(text, raw, declared, last=last)
        piece = text[start:end]
        key = (declared, last, piece)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = read_block(piece, _moved(raw, -start), declared, last=last)
            if len(self._known) > MOST:
                self._known.popitem(last=False)
        else:
            self._known.move_to_end(key)
        problems = [_told_at(problem, start) for problem in known.problems]
        return ReadBlock(known.model, known.own, problems, known.trailing, known.lost, (text, start))


def _moved(raw: RawBlock, by: int) -> RawBlock:
    leaves = [Leaf(leaf.kind, leaf.span.moved(by)) for leaf in raw.leaves]
    return RawBlock(Leaf(raw.head.kind, raw.head.span.moved(by)), raw.name, leaves)


def _told_at(problem: Problem, by: int) -> Problem:
    span = problem.span and problem.span.moved(by)
    repair = problem.repair
    if repair is not None:
        repair = replace(repair, edits=tuple((place.moved(by), text) for place, text in repair.edits))
    return replace(problem, span=span, repair=repair)
