"""A deck to keyword text."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.deck.model import Deck, Opaque, Section
from mudline.keywords.model import Comment
from mudline.keywords.writer import block_lines


def to_keyword(deck: Deck) -> str:
    """The deck as keyword text with LF line ends; blank lines and the spelling of numbers are not carried."""
    return "\n".join([*_lines(deck), ""])


def write(deck: Deck) -> str:
    """What `dump` calls."""
    return to_keyword(deck)


def _lines(deck: Deck) -> Iterator[str]:
    yield from deck.preamble
    for index, section in enumerate(deck.sections):
        yield from _comments(deck.comments, index)
        yield f"${section.name}"
        yield from _section(section)
    yield from _comments(deck.comments, len(deck.sections))


def _section(section: Section) -> Iterator[str]:
    yield from section.lines
    for index, block in enumerate(section.blocks):
        yield from _comments(section.comments, index)
        if isinstance(block, Opaque):
            yield f"*{block.keyword}"
            yield from block.lines
        else:
            yield from block_lines(block)
    yield from _comments(section.comments, len(section.blocks))


def _comments(comments: list[Comment], before: int) -> Iterator[str]:
    yield from (f"C{comment.text}" for comment in comments if comment.before == before)
