"""A deck to keyword text."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import DOC002
from mudline.deck.faults import document_path, path_text, shown
from mudline.deck.model import Deck, Opaque, Section
from mudline.deck.reading import read_source
from mudline.deck.survival import lightened, lost
from mudline.diagnostics import DeckError, Problem
from mudline.keywords.model import Comment
from mudline.keywords.writer import block_lines
from mudline.syntax.source import Source


def to_keyword(deck: Deck) -> str:
    """The deck as keyword text with LF line ends; blank lines and the spelling of numbers are not carried.

    Raises DeckError for a deck that keyword text cannot say: a name with a comma, a second curve of the set ALL.
    """
    _require_survival(deck)
    return _text(deck)


def _require_survival(deck: Deck) -> None:
    """Write the deck with shortened tables and read it again: all must be there, comments in their order too."""
    light = lightened(deck)
    text = _text(light)
    again = read_source(Source.from_bytes(text.encode(errors="replace"), deck.source), units=deck.units)
    if change := lost(light, again):
        where, reason = change
        message = f"{path_text(document_path(where))} cannot be said in keyword text: {reason}"
        raise DeckError(deck.diagnose([Problem(DOC002, message, where=where)]))
    if text != (other := _text(again)):
        lines = zip(text.split("\n"), other.split("\n"), strict=False)
        one, two = next(pair for pair in lines if pair[0] != pair[1])
        message = f"the line {shown(one)} cannot be said in keyword text: {shown(two)} would be read there"
        raise DeckError(deck.diagnose([Problem(DOC002, message)]))


def write(deck: Deck) -> str:
    """What `dump` calls."""
    return to_keyword(deck)


def _text(deck: Deck) -> str:
    return "\n".join([*_lines(deck), ""])


def _lines(deck: Deck) -> Iterator[str]:
    yield from deck.preamble
    comments = _Comments(deck.comments)
    for index, section in enumerate(deck.sections):
        yield from comments.before(index)
        yield f"${section.name}"
        yield from _section(section)
    yield from comments.rest()


def _section(section: Section) -> Iterator[str]:
    yield from section.lines
    comments = _Comments(section.comments)
    for index, block in enumerate(section.blocks):
        yield from comments.before(index)
        if isinstance(block, Opaque):
            yield f"*{block.keyword}"
            yield from block.lines
        else:
            yield from block_lines(block)
    yield from comments.rest()


class _Comments:
    """Comments in their order, given out as the items that they precede come by."""

    def __init__(self, comments: list[Comment]) -> None:
        self.waiting = sorted(comments, key=lambda comment: comment.before)[::-1]

    def before(self, index: int) -> Iterator[str]:
        """The lines before an item."""
        while self.waiting and self.waiting[-1].before <= index:
            yield f"C{self.waiting.pop().text}"

    def rest(self) -> Iterator[str]:
        """The lines behind the last item."""
        yield from (f"C{comment.text}" for comment in reversed(self.waiting))
