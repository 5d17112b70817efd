"""Places in a deck: where it names or defines a set, a curve or a parameter, and the field and value at an offset."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator
from typing import NamedTuple, cast

from mudline.language.deck.model import Deck
from mudline.language.deck.parameters import PLACEHOLDER, bare, folded, list_items, name_key
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Span, Where
from mudline.language.expression.evaluation import CONSTANTS
from mudline.language.expression.parsing import ExpressionError, parse
from mudline.language.keywords.model import Block, FieldSpec, Part, Path
from mudline.language.keywords.reader import ReadBlock, schemas_of
from mudline.language.keywords.values import Names
from mudline.language.syntax.fields import canonical_key, first_key, read_line
from mudline.language.syntax.tree import LeafKind

KINDS = {
    Names.SET: Names.SET,
    Names.SUBSET: Names.SET,
    Names.CURVE: Names.CURVE,
    Names.PARAMETER: Names.PARAMETER,
}
"""Kind of the named object, for each way to name it."""
_SET = "SET"
_EQUATION = re.compile(r"=\[(?:[^\[\]\r\n]|\[[^\[\]\r\n]*\])*\]")


class Thing(NamedTuple):
    """Something with a name; `key` is the name in the form in which names are compared."""

    kind: Names
    key: str


class Occurrence(NamedTuple):
    """Place where an object is named; `composed` is True if the name is put together there from parts."""

    thing: Thing
    name: str
    span: Span
    defines: bool
    composed: bool = False


def thing(kind: Names, name: str) -> Thing:
    """Return the object of a name as written."""
    return Thing(kind, name_key(name))


def occurrences(deck: Deck) -> list[Occurrence]:
    """Return every occurrence in the deck itself, in the order of the text; none if it is not keyword text."""
    origin = deck.origin
    if not isinstance(origin, TextOrigin):
        return []
    listed = [*_given(deck, origin), *_in_equations(origin)]
    known = {place.thing for place in listed if place.defines}
    listed += [place for place in (*_placeholders(origin), *_passed_through(origin)) if place.thing in known]
    return sorted(listed, key=lambda place: place.span)


def at(listed: list[Occurrence], offset: int) -> Occurrence | None:
    """Return the occurrence at an offset, or one that ends there; the shortest of several."""
    here = [place for place in listed if place.span.start <= offset <= place.span.end]
    return min(here, key=lambda place: place.span.end - place.span.start, default=None)


# ------------------------------------------------------------------------------------------------- fields that name


def _given(deck: Deck, origin: TextOrigin) -> Iterator[Occurrence]:
    for kind, role, name, where in deck.names():
        read = origin.read.get((where.section, where.block))
        if kind not in KINDS or read is None:
            continue
        if kind is Names.PARAMETER and role == "defines":
            yield from _parameters(read, where.path)
        elif read.places.has(where.path):
            span = _inner(origin, read.places.find(where.path))
            yield Occurrence(thing(KINDS[kind], name), name, span, defines=role == "defines")


def _inner(origin: TextOrigin, span: Span) -> Span:
    """Return the span of a name without quotes or braces."""
    text = origin.source.unified[slice(*span)]
    name = bare(text)
    start = span.start + text.find(name)
    return Span(start, start + len(name))


def _parameters(read: ReadBlock, path: Path) -> Iterator[Occurrence]:
    """Yield the parameters that a line defines: one, or those of a list."""
    parameter = read.model.at(path[:-1])[1]
    name, value = cast("str", parameter.name), cast("object", parameter.value)
    if isinstance(value, str) and value.startswith("/"):
        span = read.places.find((*path[:-1], "value"))
        for item in list_items(name, value)[0]:
            place = Span(span.start + item.start, span.start + item.start + len(item.value))
            yield Occurrence(thing(Names.PARAMETER, item.name), item.name, place, defines=True, composed=True)
        return
    yield Occurrence(thing(Names.PARAMETER, name), name, read.places.find(path), defines=True)


def _passed_through(origin: TextOrigin) -> Iterator[Occurrence]:
    """Yield the sets that SET= names in blocks whose lines are not read."""
    text = origin.source.unified
    for where, _, block, _ in origin.tree.spots:
        for leaf in block.leaves if block and where.section >= 0 and where[:2] not in origin.read else ():
            if leaf.kind is LeafKind.SETTING and first_key(text, leaf.span) == _SET:
                value = read_line(text, leaf.span).groups[0].fields[0]
                span = _inner(origin, value.span)
                yield Occurrence(thing(Names.SET, value.text), value.text, span, defines=False)


# -------------------------------------------------------------------------------------------------------- equations


def equation_spans(origin: TextOrigin) -> Iterator[Span]:
    """Yield the place of every equation of a text, comments left out."""
    text = origin.source.unified
    for start, end in _data(origin):
        if text.find("=[", start, end) >= 0:
            yield from (Span(*match.span()) for match in _EQUATION.finditer(text, start, end))


def _data(origin: TextOrigin) -> Iterator[Span]:
    """Yield the lines that may contain words: no comments, and no runs of numbers."""
    for leaf in origin.tree.leaves():
        read = leaf.kind in (LeafKind.TEXT, LeafKind.SETTING, LeafKind.RUN)
        if read or (leaf.kind is LeafKind.UNDECIDED and first_key(origin.source.unified, leaf.span)):
            yield leaf.span


def _in_equations(origin: TextOrigin) -> Iterator[Occurrence]:
    text = origin.source.unified
    for start, end in equation_spans(origin):
        try:
            read = parse(text[start + 2 : end - 1])
        except ExpressionError:
            continue
        for place, name in read.uses:
            if folded(name) not in CONSTANTS:
                yield Occurrence(thing(Names.PARAMETER, name), name, place.moved(start + 2), defines=False)


def _placeholders(origin: TextOrigin) -> Iterator[Occurrence]:
    """Yield the `%name%` in lines of data."""
    text = origin.source.unified
    for start, end in _data(origin):
        if text.find("%", start, end) >= 0:
            for match in PLACEHOLDER.finditer(text, start, end):
                yield Occurrence(thing(Names.PARAMETER, match[1]), match[1], Span(*match.span(1)), defines=False)


# ------------------------------------------------------------------------------------------------- place of an offset


class Site(NamedTuple):
    """A value of a deck: its place, its field, and the value as read (None if it could not be read)."""

    where: Where
    span: Span
    slot: FieldSpec
    value: object


def site(deck: Deck, offset: int) -> Site | None:
    """Return the value at an offset of a deck in keyword text, also if its KEY= is there."""
    origin = cast("TextOrigin", deck.origin)
    where, _, raw, _ = origin.tree.at(offset)
    read = origin.read.get(where[:2])
    if read is None or raw is None:
        return None
    leaves = [raw.head, *raw.leaves]
    leaf = leaves[bisect_right(leaves, offset, key=lambda leaf: leaf.span.start) - 1]  # the line, or run of lines
    if leaf.kind is LeafKind.COMMENT:
        return None
    place = read.places.at(offset)
    if place is not None:
        path, span = place
        slot, value = read.model.at(path)
        if slot is not None and not isinstance(value, Part | list):
            return Site(where.inside(*path), span, slot, value)
    if leaf.kind not in (LeafKind.SETTING, LeafKind.UNDECIDED):
        return None
    declared = type(read.model)
    for group in read_line(origin.source.unified, leaf.span, slashes=declared.slashes).groups:
        end = group.fields[0].span.start if group.fields else group.span.end
        if group.key and group.span.start <= offset <= end:
            slot = slot_of_key(declared, group.key)
            return Site(where, Span(group.span.start, end), slot, None) if slot else None
    return None


def slot_of_key(declared: type[Block], key: str) -> FieldSpec | None:
    """Return the field of a KEY= of a keyword; of several records with this key, that of the first."""
    name = canonical_key(key)
    return next((schema.keys[name] for schema in schemas_of(declared) if name in schema.keys), None)
