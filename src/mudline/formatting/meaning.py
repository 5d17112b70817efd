"""Whether two decks say the same, whatever their layout."""

from __future__ import annotations

from collections.abc import Sequence

from mudline.deck.model import Deck, Section
from mudline.keywords.model import Comment, Part


def same_meaning(one: Deck, other: Deck) -> bool:
    """Whether sections, blocks, values, comments and lines that nobody reads are equal.

    Blanks at the end of a comment do not count, and neither do blank lines before the first section.
    """
    return (
        one.units == other.units
        and _preamble(one) == _preamble(other)
        and _same(one.comments, other.comments)
        and _same(one.sections, other.sections)
    )


def _preamble(deck: Deck) -> list[str]:
    lines = (line.rstrip(" \t") for line in deck.preamble)
    return [line for line in lines if line]


def _same(one: object, other: object) -> bool:
    if type(one) is not type(other):
        return False
    if isinstance(one, Comment) and isinstance(other, Comment):
        return one.before == other.before and one.text.rstrip(" \t") == other.text.rstrip(" \t")
    if isinstance(one, Section) and isinstance(other, Section):
        return one.name == other.name and one.lines == other.lines and _all(_parts(one), _parts(other))
    if isinstance(one, Part) and isinstance(other, Part):
        names = type(one).model_fields
        return all(_same(getattr(one, name), getattr(other, name)) for name in names)
    if isinstance(one, list) and isinstance(other, list):
        return _all(one, other)
    return bool(one == other)


def _parts(section: Section) -> list[object]:
    return [*section.comments, *section.blocks]


def _all(one: Sequence[object], other: Sequence[object]) -> bool:
    return len(one) == len(other) and all(map(_same, one, other))
