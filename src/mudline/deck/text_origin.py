"""Where the values of a deck stand in its keyword text."""

from __future__ import annotations

from dataclasses import dataclass, field

from mudline.deck.model import START, Origin, Range
from mudline.diagnostics import Problem, Span, Where
from mudline.keywords.reader import ReadBlock
from mudline.syntax.source import Source
from mudline.syntax.tree import SyntaxTree


@dataclass
class TextOrigin(Origin):
    """The tree of the text, the lines of sections and keywords, and what was read of each block with a model."""

    tree: SyntaxTree
    heads: dict[Where, Span] = field(default_factory=dict)
    read: dict[tuple[int, int], ReadBlock] = field(default_factory=dict)

    @property
    def source(self) -> Source:
        """The text."""
        return self.tree.source

    def span(self, where: Where) -> Span | None:
        """The span of a value, of its block or section where it has none."""
        block = self.read.get((where.section, where.block))
        if block is not None and where.path:
            return block.places.find(where.path)
        return self.heads.get(where._replace(path=()))

    def place(self, problem: Problem, /) -> Range:
        """Lines and columns of a problem."""
        span = problem.span
        if span is None and problem.where is not None:
            span = self.span(problem.where)
        if span is None:
            return START
        return Range(*self.source.position(span.start), *self.source.position(span.end))

    def damaged(self, where: Where, /) -> bool:
        """Whether something at this place could not be read."""
        block = self.read.get((where.section, where.block))
        return block is not None and where.path in block.places.damaged

    def lost(self, section: int, block: int, /) -> int:
        """How many lines of a block could not be used at all."""
        found = self.read.get((section, block))
        return found.lost if found else 0

    def written(self, where: Where, /) -> bool:
        """Whether exactly this value stands in the file."""
        block = self.read.get((where.section, where.block))
        return block is not None and block.places.has(where.path)
