"""A deck to keyword text, a check that it can be read back from it, and the comparison of decks by their meaning.

Blocks that cannot be read are their lines: documents hold them so, and a keyword text gets them back.
"""

from __future__ import annotations

import sys
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain, zip_longest
from typing import cast

import numpy as np

from mudline.language.codes import DOC002
from mudline.language.deck.faults import document_path
from mudline.language.deck.model import Deck, Opaque
from mudline.language.deck.reading import TextOrigin, read_source
from mudline.language.diagnostics import DeckError, Problem, Severity, Where
from mudline.language.keywords.contents import is_refused
from mudline.language.keywords.faults import path_text, shown
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, FieldSpec, Part, Path
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
    if change := _first_difference(light, again, values_only=as_lines):
        where, reason = _described(*change)
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
        replace(section, blocks=[rebuilt(block, _few_rows, (Table,)) for block in section.blocks])
        for section in deck.sections
    ]
    return replace(deck, sections=sections)


def _few_rows(table: Table, _slot: FieldSpec, _path: Path) -> Table:
    if len(table) <= _FEW:
        return table
    firsts = np.unique(table.lengths, return_index=True)[1].tolist()
    first_of = {(column, word): row for (row, column), word in reversed(table.words.items())}
    return table.chosen(sorted({*range(_FEW), *firsts, *first_of.values()}))


def _described(where: Where, wanted: object, found: object) -> tuple[Where, str]:
    """A place, and what would be read there, in words."""
    if where.block < 0 and where.path == ("name",):
        if wanted is None:
            return Where(where.section - 1), f"a line would be read as ${found}"
        return where, f"{shown(wanted)} would not be read as this section"
    if wanted is None and where.path == ("keyword",):
        return Where(where.section), f"a line of this section would be read as *{found}"
    given, read = ("nothing" if one is None else shown(one) for one in (wanted, found))
    return where, f"{given} would be read as {read}"


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
    """Return the content of a block, on request with its comments; blanks at the end of a line do not count.

    With comments the layout does not count: blank lines at the end of a block without a model are left out.
    """
    if isinstance(part, Opaque):
        # formatting gives an end-of-file mark behind the last line a line of its own
        lines = "\n".join(part.lines).rstrip().split("\n") if comments else part.lines
        return {("keyword",): part.keyword, **_numbered("lines", lines)}
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


def same_meaning(first: Deck, second: Deck) -> bool:
    """Return True if sections, blocks, values, comments and lines that are not read are equal.

    Blanks at the end of a comment and blank lines before the first section are ignored.
    """
    return first.units == second.units and _first_difference(first, second, comments=True) is None


def _first_difference(
    first: Deck, second: Deck, *, comments: bool = False, values_only: bool = False
) -> tuple[Where, object, object] | None:
    """Return the place of the first difference of two decks, and what each has there, None for nothing.

    Comments count on request. With `values_only`, lines without a keyword and blocks that are lines do not count.
    """
    decks = (_pieces(deck, comments=comments, values_only=values_only) for deck in (first, second))
    for pair in zip_longest(*decks, fillvalue=(Where(sys.maxsize), {})):
        (one_place, one), (other_place, other) = pair
        if one_place == other_place and (one == other or (values_only and type(one) is Opaque)):
            continue
        where = min(one_place, other_place)  # if they are not the same, only one deck has this section or block
        left, right = (
            {} if place != where else piece if isinstance(piece, dict) else meaning(piece, comments=comments)
            for place, piece in pair
        )
        for path in left | right:
            if left.get(path) != right.get(path):
                return _innermost(where.inside(*path), left.get(path), right.get(path))
    return None


def _pieces(deck: Deck, *, comments: bool, values_only: bool) -> Iterator[tuple[Where, Block | Opaque | Meaning]]:
    """Yield what stands before the first section, what stands before the blocks of each section, and its blocks."""

    def lines(name: str, texts: list[str], remarks: list[Comment]) -> Meaning:
        plain = [(remark.before, remark.text.rstrip(" \t")) for remark in remarks] if comments else []
        return _numbered(name, [] if values_only else texts) | _numbered("comments", plain)

    preamble = [line.rstrip(" \t") for line in deck.preamble if line.strip(" \t")] if comments else deck.preamble
    yield Where(), lines("preamble", preamble, deck.comments)
    for number, section in enumerate(deck.sections):
        yield Where(number), {("name",): section.name} | lines("lines", section.lines, section.comments)
        yield from ((Where(number, index), block) for index, block in enumerate(section.blocks))


def _numbered(name: str, items: Sequence[object]) -> Meaning:
    return {(name, number): item for number, item in enumerate(items)}


def _innermost(where: Where, left: object, right: object) -> tuple[Where, object, object]:
    """Return the first row that differs in two tables, with its place; other values as they are."""
    if isinstance(left, Table):
        rows = ([row.tolist() for row in table.values] if isinstance(table, Table) else [] for table in (left, right))
        for number, (row, right_row) in enumerate(zip_longest(*rows)):
            if row != right_row:
                return where.inside(number), row, right_row
    return where, left, right
