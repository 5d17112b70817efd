"""A deck to keyword text, a check that it can be read back from it, and the comparison of decks by their meaning.

Blocks that cannot be read are their lines: documents hold them so, and a keyword text gets them back.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from itertools import chain, zip_longest
from typing import cast

import numpy as np

from mudline.language.codes import DOC002
from mudline.language.deck.faults import document_path
from mudline.language.deck.model import Deck, Opaque, Section
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.faults import DocumentPath, path_text, shown
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, FieldSpec, Part, Path, Rows
from mudline.language.keywords.reader import ReadBlock
from mudline.language.keywords.rebuilding import rebuilt
from mudline.language.keywords.table import Table
from mudline.language.keywords.writer import block_lines
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
    return "\n".join([*chain.from_iterable(pieces_of(deck)), ""])


Lines = tuple[str, ...]


def pieces_of(deck: Deck) -> list[Lines]:
    """The lines of the preamble, of the head of each section and of each block, with the comments behind them."""
    between = _by_place(deck.comments, len(deck.sections))
    pieces: list[Lines] = [(*deck.preamble, *between[0])]
    for number, section in enumerate(deck.sections, 1):
        inside = _by_place(section.comments, len(section.blocks))
        pieces.append((f"${section.name}", *section.lines, *inside[0]))
        pieces += [(*lines_of(block), *texts) for block, texts in zip(section.blocks, inside[1:], strict=True)]
        pieces[-1] += between[number]
    return pieces


def _by_place(comments: Iterable[Comment], count: int) -> list[Lines]:
    """The lines of the comments before each of so many items, and behind the last."""
    found: list[list[str]] = [[] for _ in range(count + 1)]
    for comment in sorted(comments, key=lambda one: one.before):
        found[min(comment.before, count)].append(f"C{comment.text}")
    return list(map(tuple, found))


def lines_of(block: Block | Opaque) -> list[str]:
    """The lines of a block in canonical layout."""
    return [f"*{block.keyword}", *block.lines] if isinstance(block, Opaque) else list(block_lines(block))


_FEW = 20
"""Rows of a table that are tried, beside one for every length and every word in it: numbers are safe."""


def sampled(deck: Deck) -> Deck:
    """The deck with few rows in its tables, enough to see whether they survive."""
    sections = [
        replace(section, blocks=[rebuilt(block, _few_rows, _is_table) for block in section.blocks])
        for section in deck.sections
    ]
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


def _is_table(slot: FieldSpec) -> bool:
    return isinstance(slot.about, Rows)


def _few_rows(table: Table, _slot: FieldSpec, _path: Path) -> Table:
    if len(table) <= _FEW:
        return table
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
    return [where for where, _, block in deck.every_block() if isinstance(block, Opaque)]


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


# ---------------------------------------------------------------------------------------------------------- the meaning

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
