"""A deck to keyword text, and a check that it can be read back from it.

Blocks that cannot be read are their lines: documents hold them so, and a keyword text gets them back.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from typing import Any, TypeVar, cast

import numpy as np

from mudline.language.codes import DOC002
from mudline.language.deck.faults import document_path
from mudline.language.deck.meaning import first_difference, meaning, numbered
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.faults import DocumentPath, path_text, shown
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.reader import ReadBlock
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import block_lines, with_comments
from mudline.language.syntax.source import Source


def to_keyword(deck: Deck, *, as_lines: bool = False) -> str:
    """The deck as keyword text with LF line ends; blank lines and the spelling of numbers are not carried.

    With `as_lines` only the values must be read back: comments and lines are what the text makes of them.

    Raises DeckError for a deck that keyword text cannot say: a name with a comma, a second curve of the set ALL.
    """
    _require_survival(deck, as_lines=as_lines)
    return canonical_text(deck)


def _require_survival(deck: Deck, *, as_lines: bool) -> None:
    """Write the deck with shortened tables and read it again without an error: all must be there, also its comments."""
    light = sampled(deck)
    text = canonical_text(light)
    again = read_source(Source.from_bytes(text.encode(errors="replace"), deck.source), units=deck.units)
    raw = raw_places(deck)
    again, _ = with_raw_lines(again, raw)
    if change := _first_difference(light, again, as_lines=as_lines):
        where, reason = change
        message = f"{path_text(document_path(where))} cannot be written as keyword text: {reason}"
        raise DeckError(deck.diagnose([Problem(DOC002, message, where=where)]))
    if not as_lines and text != (other := canonical_text(again)):
        lines = zip(text.split("\n"), other.split("\n"), strict=False)
        one, two = next(pair for pair in lines if pair[0] != pair[1])
        message = f"the line {shown(one)} cannot be written as keyword text: {shown(two)} would be read there"
        raise DeckError(deck.diagnose([Problem(DOC002, message)]))
    errors = again.errors()
    if as_lines:
        read = cast("TextOrigin", again.origin).read.items()
        others = (block for place, block in read if Where(*place) not in raw)
        errors = [each for block in others for each in block.problems if each.weight is Severity.ERROR]
    if errors and not deck.errors():
        line = again.diagnose(errors[:1])[0].line
        written = text.split("\n")[line - 1]
        message = f"the line {shown(written)} cannot be written as keyword text: {errors[0].message}"
        raise DeckError(deck.diagnose([Problem(DOC002, message)]))


def as_text(deck: Deck) -> Deck:
    """Return the deck as read from keyword text; one from JSON or YAML is written first.

    Raises DeckError as `to_keyword` does.
    """
    if isinstance(deck.origin, TextOrigin):
        return deck
    source = Source.from_bytes(to_keyword(deck).encode(), deck.file)
    return replace(read_source(source, units=deck.units), source=deck.source, folder=deck.folder)


def canonical_text(deck: Deck) -> str:
    """The deck as keyword text, whether it can be read back or not."""
    sections = with_comments(deck.comments, ((_section(section), 1) for section in deck.sections))
    return "\n".join([*deck.preamble, *sections, ""])


def _section(section: Section) -> list[str]:
    blocks = with_comments(section.comments, ((lines_of(block), 1) for block in section.blocks))
    return [f"${section.name}", *section.lines, *blocks]


def lines_of(block: Block | Opaque) -> list[str]:
    """The lines of a block in canonical layout."""
    return [f"*{block.keyword}", *block.lines] if isinstance(block, Opaque) else list(block_lines(block))


_P = TypeVar("_P", bound=Part)
_FEW = 20
"""Rows of a table that are tried, beside one for every length and every word in it: numbers are safe."""


def sampled(deck: Deck) -> Deck:
    """The deck with few rows in its tables, enough to see whether they survive."""
    sections = [replace(section, blocks=[_sample(block) for block in section.blocks]) for section in deck.sections]
    return replace(deck, sections=sections)


def _first_difference(deck: Deck, again: Deck, *, as_lines: bool) -> tuple[Where, str] | None:
    """The first value of a deck that is another one in what was read from its text, and what it was read as."""
    if not as_lines and (
        change := first_difference(numbered("preamble", deck.preamble), numbered("preamble", again.preamble))
    ):
        return _described(Where(), *change)
    for index, section in enumerate(deck.sections):
        if index == len(again.sections) or again.sections[index].name != section.name:
            return Where(index, -1, ("name",)), f"{shown(section.name)} would not be read as this section"
        if found := _section_difference(section, again.sections[index], index, as_lines=as_lines):
            return found
    if len(again.sections) > len(deck.sections):
        return Where(len(deck.sections) - 1), f"a line would be read as ${again.sections[-1].name}"
    return None


def _section_difference(section: Section, again: Section, index: int, *, as_lines: bool) -> tuple[Where, str] | None:
    if not as_lines and (change := first_difference(numbered("lines", section.lines), numbered("lines", again.lines))):
        return _described(Where(index), *change)
    for number, block in enumerate(section.blocks):
        if as_lines and type(block) is Opaque:
            continue
        found = again.blocks[number] if number < len(again.blocks) else None
        if block != found and (change := first_difference(meaning(block), meaning(found) if found else {})):
            return _described(Where(index, number), *change)
    if len(again.blocks) > len(section.blocks):
        return Where(index), f"a line of this section would be read as *{again.blocks[-1].keyword}"
    return None


def _sample(part: _P) -> _P:
    changes: dict[str, Any] = {}
    for slot in record_schema(type(part)).slots:
        value = getattr(part, slot.name, None)
        if isinstance(value, Table) and len(value) > _FEW:
            changes[slot.name] = _some_rows(value)
        elif slot.record and value:
            changes[slot.name] = [_sample(record) for record in value]
    return part.model_copy(update=changes) if changes else part


def _some_rows(table: Table) -> Table:
    firsts = np.unique(table.lengths, return_index=True)[1].tolist()
    first_of = {(column, word): row for (row, column), word in reversed(table.words.items())}
    return table.chosen(sorted({*range(_FEW), *firsts, *first_of.values()}))


def _described(where: Where, path: DocumentPath, wanted: object, found: object) -> tuple[Where, str]:
    """A place, and what would be read there, in words."""
    given, read = ("nothing" if one is None else shown(one) for one in (wanted, found))
    return where._replace(path=path), f"{given} would be read as {read}"


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
