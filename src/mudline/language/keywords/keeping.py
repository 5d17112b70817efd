"""Parts of blocks whose form is not public: lines that a model keeps as they are, in their place among the others.

An open block takes any line: one that its declaration does not know is kept. In a record that can keep lines these are
also the lines behind a setting whose value says that their form is not public.
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
    """A line that is passed through; `before` is the index of the item that it precedes, behind the comments there."""


def _no_lines() -> list[KeptLine]:
    """A function of our own: of the class `list` pydantic parses the signature, in each model that has the field."""
    return []


class OpenRecord(Record):
    """A record that can keep lines."""

    unread: list[KeptLine] = Field(default_factory=_no_lines)


class OpenBlock(Block):
    """A block that keeps every line of a form which it does not know; without `open_lines` only those it is told of."""

    open_lines = True
    unread: list[KeptLine] = Field(default_factory=_no_lines)


# ------------------------------------------------------------------------------------------------- what a model keeps


@cache
def can_keep(part: type[Part]) -> bool:
    """Return True if a part, or one inside it, can keep lines or hold a value that is not known."""
    return any(map(_is_open, fields_of(part))) or keeps_lines(part)


@cache
def keeps_lines(part: type[Part]) -> bool:
    """Return True if a part, or one inside it, can keep lines."""
    return "unread" in part.model_fields or any(_holds_keepers(slot) for slot in record_schema(part).slots)


def _is_open(slot: FieldSpec) -> bool:
    return slot.kind is Kind.OTHER or slot.about.opaque is not None


def _holds_keepers(slot: FieldSpec) -> bool:
    return any(map(keeps_lines, slot.parts))


def kept_lines(part: Part) -> list[str]:
    """Return the lines that a part and those inside it keep."""
    return [line for _, line in kept_places(part)] if keeps_lines(type(part)) else []


def kept_places(part: Part) -> Iterator[tuple[Path, str]]:
    """Yield the lines that a part and those inside it keep, with their paths."""
    if not keeps_lines(type(part)):
        return
    inner = ((path, one) for path, _, one in part.walk(_holds_keepers) if isinstance(one, Part))
    for path, keeper in chain([((), part)], inner):
        for number, line in enumerate(getattr(keeper, "unread", ())):
            yield (*path, "unread", number, "text"), line.text


def is_read(part: Part) -> bool:
    """Return True if a part keeps no line and holds no value that is not known."""
    if not can_keep(type(part)):
        return True
    values = ((slot, value) for _, slot, value in part.walk(_is_open))
    known = all(value in slot.choices and value not in (slot.about.opaque or ()) for slot, value in values)
    return known and next(kept_places(part), None) is None


# ----------------------------------------------------------------------- settings behind which lines are kept


@dataclass
class _Opener:
    """A setting whose value may say that the lines behind it are not public, and the keys that end these.

    Where it begins its line, other lines of its own record may follow: only keys of `far` end the lines then.
    """

    known: set[str] = field(default_factory=set)
    choices: set[str] = field(default_factory=set)
    ends: set[str] = field(default_factory=set)
    far: set[str] = field(default_factory=set)


@cache
def openers(block: type[Block]) -> dict[str, _Opener]:
    """The settings of a block behind which lines may be kept, by their keys."""
    found: dict[str, _Opener] = {}
    if can_keep(block):
        _add_openers(block, (), (), found)
    return found


def _add_openers(part: type[Part], near: Sequence[str], far: Sequence[str], found: dict[str, _Opener]) -> None:
    """`near` are the keys that begin a record of this kind, `far` those that begin others."""
    schema = record_schema(part)
    for key, slot in schema.keys.items():
        if slot.about.opaque is not None:
            opener = found.setdefault(key, _Opener())
            opener.choices.update(slot.choices)
            opener.known.update(set(slot.choices) - set(slot.about.opaque))
            opener.far.update([key, *far])
            opener.ends.update([key, *far, *near])
    for slot in schema.slots:
        firsts = {record: [*_first_keys(record)] for record in slot.record.values()}
        for record, own in firsts.items():
            others = [key for other, keys in firsts.items() if other is not record for key in keys]
            _add_openers(record, own, [*near, *far, *others], found)


def _first_keys(record: type[Record]) -> Iterable[str]:
    """The keys with which the lines of a record may begin."""
    terminals = grammar.first_terminals(record.rule)
    return [key for key in record_schema(record).keys if grammar.terminal_of(key) in terminals]


def is_choice(block: type[Block], key: str, value: str) -> bool:
    """Whether a setting behind which lines may be kept has one of the values that are declared for it."""
    opener = openers(block).get(key)
    return opener is not None and " ".join(value.partition(",")[0].upper().split()) in opener.choices


def opened(block: type[Block], key: str, fields: str) -> frozenset[str]:
    """The keys that end the lines to be kept behind a line of settings; none where they are read."""
    known = openers(block)
    if not known:
        return frozenset()
    given = [(key, fields.partition(",")[0]), *_INLINE.findall(fields)]
    ends: set[str] = set()
    for index, (name, text) in enumerate(given):
        opener, value = known.get(canonical_key(name)), " ".join(text.upper().split())
        if opener and value and value not in opener.known:
            ends |= opener.ends if index else opener.far
    return frozenset(ends)
