"""A document read as the keyword text that it makes: its findings are those of a keyword file, at its own places."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace
from typing import cast

from mudline.language.deck.faulty_blocks import raw_places
from mudline.language.deck.keyword_text import to_keyword
from mudline.language.deck.model import START, Deck, Origin, Range
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Where
from mudline.language.syntax.source import Source


@dataclass
class LinesOrigin(TextOrigin):
    """Places in the keyword text of the values of a document whose blocks `raw` are lines.

    `document` knows the places in the file.
    """

    takes_edits = False
    document: Origin = field(default_factory=Origin)
    raw: Collection[Where] = ()

    def place_in_file(self, problem: Problem) -> Range:
        """Lines and columns of a problem in the document: of the line, where a block has lines."""
        where, span = problem.where, problem.span
        if span is None and where is not None and where._replace(path=()) in self.raw:
            span = self.span(where)
        if span is not None:
            line = self._line(span.start)
            own = where is not None and where.path and where[:2] == line[:2] and not line.path
            where = where if own else line
        return START if where is None else self.document.place(replace(problem, span=None, where=where))

    def _line(self, offset: int) -> Where:
        """The line of a block or of the preamble that an offset of the text is in; of other blocks the block."""
        line = self.source.position(offset)[0]
        found, first = Where(path=("preamble", line - 1)), 0
        for i, section in enumerate(self.tree.sections):
            for j, head in enumerate([section.head, *(block.head for block in section.blocks)], -1):
                at = self.source.position(head.span.start)[0] if head else 0
                if first < at <= line:
                    found, first = Where(i, j), at
        if found in self.raw and line > first:
            return found.inside("lines", line - first - 1)
        return found


def read_as_text(deck: Deck) -> Deck:
    """Return the deck of a document as it is read from its keyword text; findings have their places in the document.

    What a keyword text cannot say is returned as it is.
    """
    try:
        text = to_keyword(deck)
    except DeckError:
        return deck
    read = read_source(Source.from_bytes(text.encode(), deck.source or deck.file), units=deck.units)
    origin = cast("TextOrigin", read.origin)
    origin = LinesOrigin(origin.tree, origin.read, document=deck.origin, raw=frozenset(raw_places(deck)))
    return replace(read, file=deck.file, source=deck.source, folder=deck.folder, origin=origin)
