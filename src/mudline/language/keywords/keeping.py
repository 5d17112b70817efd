"""Blocks with lines of unpublished form, which a model keeps unchanged, in their place among the other lines.

An open block keeps any line that its declaration does not know. A record that can keep lines also keeps the lines
behind a setting whose value announces an unpublished form.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import chain

from pydantic import Field

from mudline.language.keywords import grammar
from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import Block, FieldSpec, Part, Path, Record, fields_of, record_schema
from mudline.language.keywords.values import Kind
from mudline.language.syntax.fields import canonical_key

_INLINE = re.compile(r",[ \t]*([A-Za-z][\w \t-]*)=([^,\r\n]*)")


class KeptLine(Comment):
    """Line that is passed through; `before` is the index of the item that it precedes, behind the comments there."""


def _no_lines() -> list[KeptLine]:
    """Return an empty list; for the class `list` pydantic would parse the signature in each model with the field."""
    return []


class OpenRecord(Record):
    """Record that can keep lines."""

    unread: list[KeptLine] = Field(default_factory=_no_lines)


class OpenBlock(Block):
    """Block that keeps every line of unknown form; without `open_lines`, only lines that a setting announces."""

    open_lines = True
    unread: list[KeptLine] = Field(default_factory=_no_lines)


# ------------------------------------------------------------------------------------------------- what a model keeps


@cache
def can_keep(part: type[Part]) -> bool:
    """Return True if a part, or an inner part, can keep lines or hold an unknown value."""
    return any(map(_is_open, fields_of(part))) or keeps_lines(part)


@cache
def keeps_lines(part: type[Part]) -> bool:
    """Return True if a part, or an inner part, can keep lines."""
    return "unread" in part.model_fields or any(_holds_keepers(slot) for slot in record_schema(part).slots)


def _is_open(slot: FieldSpec) -> bool:
    return slot.kind is Kind.OTHER or slot.about.opaque is not None


def _holds_keepers(slot: FieldSpec) -> bool:
    return any(map(keeps_lines, slot.parts))


def kept_lines(part: Part) -> list[str]:
    """Return the lines that a part and its inner parts keep."""
    return [line for _, line in kept_places(part)] if keeps_lines(type(part)) else []


def kept_places(part: Part) -> Iterator[tuple[Path, str]]:
    """Yield the lines that a part and its inner parts keep, with their paths."""
    if not keeps_lines(type(part)):
        return
    inner = ((path, value) for path, _, value in part.walk(_holds_keepers) if isinstance(value, Part))
    for path, keeper in chain([((), part)], inner):
        for number, line in enumerate(getattr(keeper, "unread", ())):
            yield (*path, "unread", number, "text"), line.text


def is_read(part: Part) -> bool:
    """Return True if a part keeps no line and holds no unknown value."""
    if not can_keep(type(part)):
        return True
    values = ((slot, value) for _, slot, value in part.walk(_is_open))
    known = all(value in slot.choices and value not in (slot.about.opaque or ()) for slot, value in values)
    return known and next(kept_places(part), None) is None


# ----------------------------------------------------------------------- settings behind which lines are kept


@dataclass
class _Opener:
    """Setting whose value may announce lines of unpublished form, and the keys that end these lines.

    If the setting begins its line, other lines of its own record may follow: then only keys in `far` end the lines.
    """

    known: set[str] = field(default_factory=set)
    choices: set[str] = field(default_factory=set)
    ends: set[str] = field(default_factory=set)
    far: set[str] = field(default_factory=set)


@cache
def openers(block: type[Block]) -> dict[str, _Opener]:
    """Return the settings of a block that may announce kept lines, by their keys."""
    by_key: dict[str, _Opener] = {}
    if can_keep(block):
        _add_openers(block, (), (), by_key)
    return by_key


def _add_openers(part: type[Part], near: Sequence[str], far: Sequence[str], by_key: dict[str, _Opener]) -> None:
    """Add the settings of a part that may announce kept lines.

    `near` are the keys that begin a record of this kind, `far` those that begin other records.
    """
    schema = record_schema(part)
    for key, slot in schema.keys.items():
        if slot.about.opaque is not None:
            opener = by_key.setdefault(key, _Opener())
            opener.choices.update(slot.choices)
            opener.known.update(set(slot.choices) - set(slot.about.opaque))
            opener.far.update([key, *far])
            opener.ends.update([key, *far, *near])
    for slot in schema.slots:
        firsts = {record: [*_first_keys(record)] for record in slot.record.values()}
        for record, own in firsts.items():
            siblings = [key for sibling, keys in firsts.items() if sibling is not record for key in keys]
            _add_openers(record, own, [*near, *far, *siblings], by_key)


def _first_keys(record: type[Record]) -> Iterable[str]:
    """Return the keys with which the lines of a record may begin."""
    terminals = grammar.first_terminals(record.rule)
    return [key for key in record_schema(record).keys if grammar.terminal_of(key) in terminals]


def is_choice(block: type[Block], key: str, value: str) -> bool:
    """Return True if a value is declared for a setting that may announce kept lines."""
    opener = openers(block).get(key)
    return opener is not None and " ".join(value.partition(",")[0].upper().split()) in opener.choices


def opened(block: type[Block], key: str, fields: str) -> frozenset[str]:
    """Return the keys that end the kept lines after a line of settings; none if the following lines are read."""
    known = openers(block)
    if not known:
        return frozenset()
    settings = [(key, fields.partition(",")[0]), *_INLINE.findall(fields)]
    ends: set[str] = set()
    for index, (name, text) in enumerate(settings):
        opener, value = known.get(canonical_key(name)), " ".join(text.upper().split())
        if opener and value and value not in opener.known:
            ends |= opener.ends if index else opener.far
    return frozenset(ends)
