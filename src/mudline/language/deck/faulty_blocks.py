"""Blocks that cannot be read, as their lines: documents hold them so, and a keyword text gets them back."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import cast

from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Severity, Where
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.reader import ReadBlock


def is_faulty(read: ReadBlock) -> bool:
    """Return True for a block that no document holds as values: one with an error, or with a value out of range."""
    return any(one.weight is Severity.ERROR for one in read.problems) or is_refused(read.model)


def raw_places(deck: Deck) -> list[Where]:
    """Return where a deck has blocks that are lines."""
    return [
        Where(i, j)
        for i, section in enumerate(deck.sections)
        for j, block in enumerate(section.blocks)
        if isinstance(block, Opaque)
    ]


def with_raw_lines(deck: Deck, among: Collection[Where] | None = None) -> tuple[Deck, list[Where]]:
    """Return a deck whose faulty blocks are their lines as they are written, and where these blocks are.

    The comments behind the last line of such a block are among its lines. `among` are the blocks that are looked at, if
    not all are. A deck that was not read from text is returned as it is.
    """
    origin = deck.origin
    read = origin.read if isinstance(origin, TextOrigin) else {}
    places = read if among is None else [where[:2] for where in among if where[:2] in read]
    found = [Where(*place) for place in sorted(places) if is_faulty(read[place])]
    if not found:
        return deck, []
    sections = [replace(one, blocks=[*one.blocks], comments=[*one.comments]) for one in deck.sections]
    comments = deck.comments
    for where in found:
        section = sections[where.section]
        lines = cast("TextOrigin", origin).lines_of(where)
        section.blocks[where.block] = Opaque(keyword=section.blocks[where.block].keyword, lines=lines)
        if where.block == len(section.blocks) - 1:
            comments = _without(comments, where.section + 1)
        else:
            section.comments = _without(section.comments, where.block + 1)
    return replace(deck, sections=sections, comments=comments), found


def _without(comments: list[Comment], before: int) -> list[Comment]:
    return [one for one in comments if one.before != before]
