"""What mudline itself takes each character of a deck for: the measure of the lexer and the grammar for editors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from mudline.language.diagnostics import Span
from mudline.language.expression.parsing import equation_grammar
from mudline.language.keywords.catalogue import block_class, keywords
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.reader import all_keys
from mudline.language.syntax.fields import Field, first_key, read_line, trimmed
from mudline.language.syntax.rows import blank_separated, line_spans, spells_number
from mudline.language.syntax.source import Source
from mudline.language.syntax.tree import Leaf, LeafKind, SyntaxTree, parse

Classes = list[str]
"""A class for each character, "" where none is expected: blanks, commas, signs."""

_SIGNS = "(),[]"
_ROUND = str.maketrans("[]", "()")  # the lexer of equations has no word for square ones
_EQUATION = {"NUMBER": "number", "TEXT": "text", "NAME": "name", "AND": "word", "OR": "word", "NOT": "word"}


def own_classes(text: str) -> Classes:
    """The class of every character of a deck."""
    found = [""] * len(text)
    for span, kind in _tokens(parse(Source("deck.keyxm", text))):
        found[span.start : span.end] = [kind] * (span.end - span.start)
    return [kind if not char.isspace() else "" for char, kind in zip(text, found, strict=True)]


def first_difference(text: str, own: Classes, other: Classes) -> str:
    """Where another division of a text differs from mudline's own, or ""."""
    for at, (expected, found) in enumerate(zip(own, other, strict=True)):
        if not text[at].isspace() and expected != found:
            line = text.count("\n", 0, at) + 1
            return f"line {line}: {text[at : at + 20]!r} is {found!r}, expected {expected!r}"
    return ""


def _tokens(tree: SyntaxTree) -> Iterator[tuple[Span, str]]:
    text = tree.source.unified
    for section in (tree.preamble, *tree.sections):
        if section.head:
            yield section.head.span, "section"
        yield from (found for leaf in section.leaves for found in _leaf(text, leaf, None))
        for block in section.blocks:
            yield block.head.span, "keyword" if block.name in keywords() else "unknown keyword"
            declared = block_class(section.name, block.name)
            yield from (found for leaf in block.leaves for found in _leaf(text, leaf, declared))


def _leaf(text: str, leaf: Leaf, declared: type[Block] | None) -> Iterator[tuple[Span, str]]:
    known = declared is not None and first_key(text, leaf.span) in all_keys(declared)
    if leaf.kind is LeafKind.COMMENT or (leaf.kind is LeafKind.UNDECIDED and not known):
        yield leaf.span, "comment"
    elif leaf.kind is not LeafKind.BLANK:
        for line in line_spans(text, leaf.span):
            yield from _line(text, line, declared)


def _line(text: str, line: Span, declared: type[Block] | None) -> Iterator[tuple[Span, str]]:
    if blank_separated(text[slice(*line)]):
        yield line, "number"
        return
    choices = _choices(declared) if declared else {}
    for group in read_line(text, line, slashes=declared is not None and declared.slashes).groups:
        if group.key:
            equals = text.index("=", group.span.start)
            kind = "setting" if group.key in choices else "unknown setting"
            yield trimmed(text, group.span.start, equals), kind
            yield Span(equals, equals + 1), "operator"
        for given in group.fields:
            yield from _field(given, choices.get(group.key, set()))


def _field(given: Field, choices: set[str]) -> Iterator[tuple[Span, str]]:
    text, span = given.text, given.span
    if text.startswith("=["):
        yield span, "operator"
        yield Span(span.start + 2, span.end - text.endswith("]")), ""
        start = span.start + 2
        for token in equation_grammar().lex(text[2:].removesuffix("]").translate(_ROUND)):
            kind = _EQUATION.get(token.type, "" if token in _SIGNS else "operator")
            yield Span(start + cast("int", token.start_pos), start + cast("int", token.end_pos)), kind
    elif spells_number(text):
        yield span, "number"
    else:
        yield span, "choice" if text.upper() in choices else "text"


def _choices(part: type[Part]) -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for slot in record_schema(part).slots:
        if slot.key:
            found.setdefault(slot.key, set()).update(slot.choices)
        for record in slot.record.values():
            for key, choices in _choices(record).items():
                found.setdefault(key, set()).update(choices)
    return found
