"""Lexer for Pygments, which finds it by the entry point `pygments.lexers`: decks in the colours of what is read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import ClassVar

from pygments.lexer import Lexer
from pygments.token import Comment, Generic, Keyword, Name, Number, Operator, Punctuation, String, Text, _TokenType

from mudline.language.diagnostics import Span
from mudline.language.keywords import catalogue
from mudline.language.keywords.model import Block
from mudline.language.keywords.reader import schemas_of
from mudline.language.syntax.fields import Field, read_line, trimmed
from mudline.language.syntax.rows import blank_separated, line_spans, spells_number
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Leaf, LeafKind, is_data, parse

Found = tuple[Span, _TokenType]

_WORD = re.compile(r"\S+")
_BETWEEN = re.compile(r"\s+|\S+")
_EQUATION = re.compile(
    r'(?P<text>"[^"]*"?)|(?P<number>(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][-+]?[0-9]+)?)'
    r"|(?P<word>(?:and|or|not)(?![\w.]))|(?P<call>[^\W\d][\w.]*(?=[ \t]*\())|(?P<name>[^\W\d][\w.]*)"
    r"|(?P<operator>[-+*/^<>=!]+)|(?P<blank>\s+)|(?P<other>.)",
    re.IGNORECASE,
)
_IN_EQUATION = {
    "text": String.Double,
    "number": Number.Float,
    "word": Operator.Word,
    "call": Name.Function,
    "name": Name.Variable,
    "operator": Operator,
    "blank": Text.Whitespace,
    "other": Punctuation,
}


class DeckLexer(Lexer):
    """Lexer of riser and pipeline analysis decks in keyword text."""

    name = "mudline deck"
    aliases: ClassVar[list[str]] = ["mudline", "keyx"]
    filenames: ClassVar[list[str]] = ["*.keyx", "*.keyxm", "*.keyxi"]
    alias_filenames: ClassVar[list[str]] = ["*.das"]
    mimetypes: ClassVar[list[str]] = ["text/x-mudline"]

    def get_tokens_unprocessed(self, text: str) -> Iterator[tuple[int, _TokenType, str]]:
        """Yield the tokens of a text in order: offset, kind and text."""
        done = 0
        for (start, end), kind in _tokens(text):
            yield from _between(text, done, start)
            yield start, kind, text[start:end]
            done = end
        yield from _between(text, done, len(text))


def _between(text: str, start: int, end: int) -> Iterator[tuple[int, _TokenType, str]]:
    """Yield the blanks and the marks between other tokens."""
    for match in _BETWEEN.finditer(text, start, end):
        yield match.start(), Text.Whitespace if match[0].isspace() else Punctuation, match[0]


def _tokens(written: str) -> Iterator[Found]:
    """Yield the tokens of a text, without blanks and punctuation."""
    tree = parse(Source("", written))
    text = tree.source.unified
    for _, section, block, _ in tree.spots:
        if block:
            known = block.name in catalogue.keywords()
            yield trimmed(text, *block.head.span), Keyword if known else Keyword.Pseudo
        elif section.head:
            known = section.name in catalogue.SECTIONS
            yield trimmed(text, *section.head.span), Generic.Heading if known else Generic.Subheading
        declared = catalogue.block_class(section.name, block.name) if block else None
        yield from (found for leaf in (block or section).leaves for found in _leaf(text, leaf, declared))


def _leaf(text: str, leaf: Leaf, declared: type[Block] | None) -> Iterator[Found]:
    settings = _settings(declared) if declared else {}
    if is_data(text, leaf, settings):
        for line in line_spans(text, leaf.span):
            yield from _line(text, line, settings, slashes=declared is not None and declared.slashes)
    elif leaf.kind is not LeafKind.BLANK:
        yield trimmed(text, *leaf.span), Comment.Single


def _line(text: str, line: Span, settings: dict[str, set[str]], *, slashes: bool) -> Iterator[Found]:
    """Yield the tokens of a setting or a row."""
    if blank_separated(text[slice(*line)]):
        yield from ((Span(*word.span()), Number.Float) for word in _WORD.finditer(text, *line))
        return
    for group in read_line(text, line, slashes=slashes).groups:
        if group.key:
            equals = text.index("=", group.span.start)
            known = group.key in settings
            yield trimmed(text, group.span.start, equals), Name.Attribute if known else Name.Property
            yield Span(equals, equals + 1), Operator
        for field in group.fields:
            if field.text.startswith("=["):
                yield from _equation(text, field.span)
            elif field.text:
                yield field.span, _kind(field, settings.get(group.key, set()))


def _kind(field: Field, choices: set[str]) -> _TokenType:
    if spells_number(field.text):
        return Number.Float
    if field.text.upper() in choices:
        return Name.Constant
    return Name.Label if field.text[0] == "{" else String.Double if field.text[0] == '"' else String


def _equation(text: str, span: Span) -> Iterator[Found]:
    start, end = span
    yield Span(start, start + 2), Operator
    closed = text[end - 1] == "]"
    for match in _EQUATION.finditer(text, start + 2, end - closed):
        if not match[0].isspace():
            yield Span(*match.span()), _IN_EQUATION[str(match.lastgroup)]
    if closed:
        yield Span(end - 1, end), Operator


@cache
def _settings(declared: type[Block]) -> dict[str, set[str]]:
    """Return the keys of a keyword, with the words that each may have."""
    choices: dict[str, set[str]] = {}
    for schema in schemas_of(declared):
        for slot in schema.slots:
            if slot.key:
                choices.setdefault(slot.key, set()).update(slot.choices)
    return choices
