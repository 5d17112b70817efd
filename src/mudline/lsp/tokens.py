"""What each word of a deck is, for colours: a keyword, a setting, a number, a name, a parameter, a comment."""

from __future__ import annotations

import re
from collections.abc import Iterator

from lsprotocol import types

from mudline.diagnostics import Span
from mudline.keywords.catalogue import block_class
from mudline.keywords.model import Block
from mudline.keywords.reader import all_keys
from mudline.lsp.decks import Analysis
from mudline.lsp.documents import units_of
from mudline.lsp.sites import slot_of_key
from mudline.syntax.fields import Field, first_key, read_line, trimmed
from mudline.syntax.rows import line_spans, read_number
from mudline.syntax.tree import Kind, Leaf

TYPES = [
    "namespace",
    "keyword",
    "property",
    "comment",
    "number",
    "string",
    "variable",
    "function",
    "operator",
    "enumMember",
]
"""Of a section, a keyword, a setting, and so on; standard names, which every editor has colours for."""
LEGEND = types.SemanticTokensLegend(TYPES, [])
LONGEST_RUN = 20_000
"""Characters of numeric lines that are coloured when the whole deck is asked for."""
_IN_EQUATION = re.compile(
    r'(?P<string>"[^"]*")|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*)(?P<call>\s*\()?'
    r"|(?P<operator>[-+*/^<>=&|]+)"
)

Token = tuple[Span, str]


def tokens(analysis: Analysis, range_: types.Range | None = None) -> types.SemanticTokens:
    """The words of a deck, or of a range of it; without a range, long runs of numbers are left out."""
    origin = analysis.origin
    if origin is None:
        return types.SemanticTokens([])
    document = analysis.document
    within = Span(0, len(document.text))
    if range_ is not None:
        within = Span(document.offset(range_.start), document.offset(range_.end))
    found = _of_deck(analysis, within, whole=range_ is None)
    data: list[int] = []
    line = character = 0
    for span, kind in found:
        place = document.position(span.start)
        if place.line != line:
            character = 0
        length = units_of(document.text[slice(*span)], document.encoding)
        data += (place.line - line, place.character - character, length, TYPES.index(kind), 0)
        line, character = place.line, place.character
    return types.SemanticTokens(data)


def _of_deck(analysis: Analysis, within: Span, *, whole: bool) -> Iterator[Token]:
    origin = analysis.origin
    if origin is None:
        return
    text = origin.source.unified
    for section in (origin.tree.preamble, *origin.tree.sections):
        leaves: list[tuple[Leaf, type[Block] | None]] = [(section.head, None)] if section.head else []
        leaves += [(leaf, None) for leaf in section.leaves]
        for block in section.blocks:
            declared = block_class(section.name, block.name)
            leaves += [(leaf, declared) for leaf in (block.head, *block.leaves)]
        for leaf, declared in leaves:
            if leaf.span.end > within.start and leaf.span.start < within.end:
                yield from _of_leaf(text, leaf, declared, within, whole=whole)


def _of_leaf(text: str, leaf: Leaf, declared: type[Block] | None, within: Span, *, whole: bool) -> Iterator[Token]:
    kind = leaf.kind
    if kind is Kind.UNDECIDED:
        known = declared is not None and first_key(text, leaf.span) in all_keys(declared)
        kind = Kind.SETTING if known else Kind.COMMENT
    if kind in _WHOLE:
        yield trimmed(text, *leaf.span), _WHOLE[kind]
    elif kind is Kind.RUN:
        if whole and leaf.span.end - leaf.span.start > LONGEST_RUN:
            return
        begin = max(text.rfind("\n", leaf.span.start, max(within.start, leaf.span.start)) + 1, leaf.span.start)
        for line in line_spans(text, Span(begin, min(leaf.span.end, within.end))):
            yield from _of_line(text, line, declared)
    elif kind in (Kind.SETTING, Kind.TEXT):
        yield from _of_line(text, leaf.span, declared)


_WHOLE = {Kind.SECTION: "namespace", Kind.KEYWORD: "keyword", Kind.COMMENT: "comment"}


def _of_line(text: str, line: Span, declared: type[Block] | None) -> Iterator[Token]:
    for group in read_line(text, line, slashes=declared is not None and declared.slashes).groups:
        choices: tuple[str, ...] = ()
        if group.key:
            equals = text.index("=", group.span.start)
            yield trimmed(text, group.span.start, equals), "property"
            yield Span(equals, equals + 1), "operator"
            slot = slot_of_key(declared, group.key) if declared else None
            choices = slot.choices if slot else ()
        for given in group.fields:
            yield from _of_field(given, choices)


def _of_field(given: Field, choices: tuple[str, ...]) -> Iterator[Token]:
    text, span = given
    if not text:
        return
    if text.startswith("=["):
        yield Span(span.start, span.start + 2), "operator"
        yield from _of_equation(text.removesuffix("]")[2:], span.start + 2)
        if text.endswith("]"):
            yield Span(span.end - 1, span.end), "operator"
    elif read_number(text) is not None:
        yield span, "number"
    elif text.upper() in choices:
        yield span, "enumMember"
    else:
        yield span, "string"


def _of_equation(text: str, start: int) -> Iterator[Token]:
    for match in _IN_EQUATION.finditer(text):
        if match["name"]:
            yield (
                Span(start + match.start("name"), start + match.end("name")),
                "function" if match["call"] else "variable",
            )
        else:
            yield Span(start + match.start(), start + match.end()), str(match.lastgroup)
