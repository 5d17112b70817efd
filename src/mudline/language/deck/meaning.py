"""Meaning of a deck: the content of its blocks, whatever the layout. Two decks are the same if all of it is equal."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, zip_longest

from mudline.language.deck.model import Deck, Opaque
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, Part, Path
from mudline.language.keywords.table import Table

Meaning = dict[Path, object]
"""Values by path. A table is one value; a part follows its values, as the name of its class."""


def meaning(part: Part, *, comments: bool = False) -> Meaning:
    """Return the content of a block, on request with its comments; blanks at the end of a line do not count."""
    if isinstance(part, Opaque):
        return {("keyword",): part.keyword, **numbered("lines", part.lines)}
    values = [(path, value) for path, _, value in part.walk()]
    parts = [(path, value) for path, value in values if isinstance(value, Part)]
    content: Meaning = {("keyword",): part.keyword} if isinstance(part, Block) else {}
    content |= {path: value for path, value in values if not isinstance(value, Part)}
    for path, holder in chain(parts, [((), part)]):
        for name in ("comments", "unread") if comments else ("unread",):
            for number, line in enumerate(getattr(holder, name, ())):
                content[*path, name, number] = (line.before, line.text.rstrip(" \t"))
        content[path] = type(holder).__name__
    return content


def first_difference(first: Meaning, second: Meaning) -> tuple[Path, object, object] | None:
    """Return the first value that differs in two blocks, with its path; None if the blocks are equal."""
    for path in first | second:
        left, right = first.get(path), second.get(path)
        if left != right:
            return _in_table(path, left, right) if isinstance(left, Table) else (path, left, right)
    return None


def _in_table(path: Path, left: Table, right: object) -> tuple[Path, object, object]:
    """Return the first row that differs in two tables."""
    rows = ([row.tolist() for row in table.values] if isinstance(table, Table) else [] for table in (left, right))
    for number, (row, right_row) in enumerate(zip_longest(*rows)):
        if row != right_row:
            return (*path, number), row, right_row
    return path, left, right


def same_meaning(first: Deck, second: Deck) -> bool:
    """Return True if sections, blocks, values, comments and lines that are not read are equal.

    Blanks at the end of a comment and blank lines before the first section are ignored.
    """
    return first.units == second.units and all(a == b for a, b in zip_longest(_pieces(first), _pieces(second)))


def _pieces(deck: Deck) -> Iterator[object]:
    yield [line.rstrip(" \t") for line in deck.preamble if line.strip(" \t")]
    yield _plain(deck.comments)
    for section in deck.sections:
        yield section.name, section.lines, _plain(section.comments)
        for block in section.blocks:
            if isinstance(block, Opaque):
                yield block.keyword, _without_blanks(block.lines)
            else:
                yield meaning(block, comments=True)


def _plain(comments: list[Comment]) -> list[tuple[int, str]]:
    return [(comment.before, comment.text.rstrip(" \t")) for comment in comments]


def numbered(name: str, lines: list[str]) -> Meaning:
    """Return lines keyed by their numbers."""
    return {(name, number): line for number, line in enumerate(lines)}


def _without_blanks(lines: list[str]) -> list[str]:
    """Return lines without blank ones at the end: an end-of-file mark behind the last line gets a line of its own."""
    end = len(lines)
    while end and not lines[end - 1].strip():
        end -= 1
    return [*lines[: end - 1], *(line.rstrip() for line in lines[max(end - 1, 0) : end])]
