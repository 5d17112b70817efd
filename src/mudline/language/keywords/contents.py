"""Contents of a block: the names in its fields, values that its model refuses, and lines that it passes through.

Lines of unpublished form keep their place among the other lines. An open block keeps any line that its declaration does
not know. A record that can keep lines also keeps the lines behind a setting whose value announces an unpublished form.
Values out of range and curves of too few points are read from text unchanged, so that a check reports them at their
place; documents with them are refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import chain
from typing import Literal, TypeGuard, cast, get_args

import numpy as np
from pydantic import BaseModel, Field

from mudline.language.keywords.fields import Comment
from mudline.language.keywords.model import (
    FEWEST_POINTS,
    Block,
    FieldFilter,
    FieldSpec,
    Part,
    Path,
    Record,
    Rows,
    fields_of,
    record_schema,
)
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import UNKNOWN, UNKNOWN_NAME, Equation, Kind, Label, Names, Partly
from mudline.language.syntax.fields import canonical_key
from mudline.language.syntax.grammars import first_terminals, terminal_of

_INLINE = re.compile(r",[ \t]*([A-Za-z][\w \t-]*)=([^,\r\n]*)")


class KeptLine(Comment):
    """Line that is passed through; `before` is the index of the item that it precedes, behind the comments there."""


class OpenRecord(Record):
    """Record that can keep lines."""

    unread: list[KeptLine] = Field(default_factory=lambda: [])  # noqa: PIE807 - as for `comments` of a record


class OpenBlock(OpenRecord, Block):
    """Block that keeps every line of unknown form; without `open_lines`, only lines that a setting announces."""

    open_lines = True


# ------------------------------------------------------------------------------------------------- what a model keeps


@cache
def keeps_lines(part: type[Part]) -> bool:
    """Return True if a part, or an inner part, can keep lines."""
    return "unread" in part.model_fields or any(_holds_keepers(slot) for slot in record_schema(part).slots)


def _is_open(slot: FieldSpec) -> bool:
    return slot.kind is Kind.OTHER or slot.about.opaque is not None


def _holds_keepers(slot: FieldSpec) -> bool:
    return any(map(keeps_lines, slot.parts))


def kept_places(part: Part) -> Iterator[tuple[Path, str]]:
    """Yield the lines that a part and its inner parts keep, with their paths."""
    inner = ((path, value) for path, _, value in part.walk(_holds_keepers) if isinstance(value, Part))
    for path, keeper in chain([((), part)], inner):
        for number, line in enumerate(getattr(keeper, "unread", ())):
            yield (*path, "unread", number, "text"), line.text


def is_read(part: Part) -> bool:
    """Return True if a part keeps no line and holds no unknown value."""
    if not keeps_lines(type(part)):
        return True
    values = ((slot, value) for _, slot, value in part.walk(_is_open))
    known = all(value in slot.choices and value not in (slot.about.opaque or ()) for slot, value in values)
    return known and next(kept_places(part), None) is None


def is_partly_unknown(value: object) -> bool:
    """Return True if a value, an item of a list, or a field of a table or part could not be read."""
    if value is UNKNOWN or value is UNKNOWN_NAME or type(value) is Partly:
        return True
    if isinstance(value, Table):
        return bool(value.unknown)
    return isinstance(value, BaseModel) and any(map(is_partly_unknown, value.__dict__.values()))


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
    if keeps_lines(block):
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
        firsts: dict[type[Record], list[str]] = {}
        for record in slot.record.values():  # the keys with which its lines may begin
            terminals = first_terminals(record.rule)
            firsts[record] = [key for key in record_schema(record).keys if terminal_of(key) in terminals]
        for record, own in firsts.items():
            siblings = [key for sibling, keys in firsts.items() if sibling is not record for key in keys]
            _add_openers(record, own, [*near, *far, *siblings], by_key)


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


# ---------------------------------------------------------------------------------------------------------------- names

Role = Literal["names", "defines"]
"""Role of a name in a field: it refers to an object ("names"), or creates one ("defines")."""
ROLES: tuple[Role, ...] = get_args(Role)


@cache
def naming(what: Names | None, role: Role = "names") -> FieldFilter:
    """Return the predicate of fields that refer to, or define, an object of a kind; None for any kind."""

    def names(slot: FieldSpec) -> bool:
        kind = getattr(slot.about, role)
        return kind is what if what else kind is not None

    return names


@cache
def of_keys(*keys: str) -> FieldFilter:
    """Return the predicate of settings with one of these keys."""
    return lambda slot: slot.key in keys


@cache
def kinds_of(part: type[Part], role: Role) -> frozenset[Names]:
    """Return the kinds of objects that the fields of a part and its inner parts refer to or define."""
    return frozenset(kind for slot in fields_of(part) if (kind := getattr(slot.about, role)) is not None)


@cache
def gives_names(part: type[Part]) -> bool:
    """Return True if a part, or an inner part, has fields for names."""
    return any(map(_holds_name, fields_of(part)))


def every_name_given(part: Part) -> list[tuple[Names, Role, str, Path]]:
    """Return every name in a part: kind of the object, role of the field, name as written, path.

    Numbers and labels of nodes and elements are not names.
    """
    return [
        (kind, role, name, path)
        for path, slot, name in part.walk(_holds_name)
        if is_name(name)
        for role, kind in _roles_of(slot)
    ]


def _holds_name(slot: FieldSpec) -> bool:
    return bool(_roles_of(slot))


def _roles_of(slot: FieldSpec) -> list[tuple[Role, Names]]:
    kinds = ((role, getattr(slot.about, role)) for role in ROLES)
    return [(role, kind) for role, kind in kinds if kind not in (None, Names.NODE, Names.ELEMENT)]


def names_given(part: Part, what: Names, role: Role = "names") -> Iterator[tuple[Path, str]]:
    """Yield the names of objects of a kind in a part, with their paths; numbers and equations are left out."""
    return ((path, name) for path, _, name in part.walk(naming(what, role)) if is_name(name))


def is_name(item: object) -> TypeGuard[str]:
    """Return True if an item is a readable name: a text that is not an equation."""
    return isinstance(item, str) and item is not UNKNOWN_NAME and not isinstance(item, Equation)


def idents_given(part: Part, what: Names) -> Iterator[tuple[Path, int | Label]]:
    """Yield numbers and labels of nodes or elements in a part, with their paths; unreadable ones are left out.

    Those in table rows are left out too: a keyword with such a table examines them itself.
    """
    return ((path, item) for path, _, item in part.walk(naming(what)) if isinstance(item, int | Label))


@cache
def set_slots(block: type[Block]) -> tuple[tuple[FieldSpec, FieldSpec], ...]:
    """Return the lists of a block whose records go by element set, each with the field that names the set."""
    return tuple(
        (slot, named)
        for slot in record_schema(block).slots
        for record in slot.record.values()
        for named in record_schema(record).slots
        if named.about.names is Names.SET
    )


def repeated_set(block: Block) -> Path:
    """Return the path of the first element set that a block gives again with other values; () if there is none."""
    for listed, named in set_slots(type(block)) if block.facts.later_wins else ():
        by_name: dict[str, Part] = {}
        for index, entry in enumerate(getattr(block, listed.name)):
            name = getattr(entry, named.name, None)
            if isinstance(name, str) and name:
                first = by_name.setdefault(name.casefold(), entry)
                if first is not entry and first != entry:
                    return listed.json, index, named.json
    return ()


# ---------------------------------------------------------------------------------------------------- refused values


def range_fault(value: float, slot: FieldSpec) -> str:
    """Return the fault of a number that is out of range, or ""; NaN, which stands for an unreadable value, has none."""
    fault = slot.about.fault(value)
    return f"{in_words(slot)} is {value!r}: {fault}" if fault else ""


def in_words(slot: FieldSpec) -> str:
    """Return the field in words: `FRICTION=`, `water depth`, `external diameter Do`, `area of the section (A)`."""
    meaning = re.split("[;,]", slot.about.meaning)[0]
    if slot.key:
        return slot.label
    if slot.label.islower():  # a word; symbols have capitals
        return meaning
    return f"{meaning} ({slot.label})" if " of " in meaning else f"{meaning} {slot.label}"


def is_refused(part: Part) -> bool:
    """Return True if a block that was read from text cannot be written as a document."""
    return (
        any(True for _ in range_faults(part))
        or any(len(curve) < FEWEST_POINTS for _, _, curve in part.walk(is_curve))
        or any(isinstance(value, int) and range_fault(value, slot) for _, slot, value in part.walk(_is_ranged_in_list))
    )


def range_faults(part: Part) -> Iterator[tuple[Path, str]]:
    """Yield path and message of each value that is out of range."""
    for path, slot, value in part.walk(_is_ranged):
        if isinstance(value, Table):
            for index, column in enumerate(record_schema(cast("type[Part]", slot.row)).columns):
                values = value.column(index) if column.about.limits else np.zeros(0)
                low, high = column.span
                for row in np.flatnonzero((values < low) | (values > high)).tolist():
                    yield (*path, row, index), range_fault(float(values[row]), column)
        elif isinstance(value, float | int) and (value < slot.span[0] or value > slot.span[1]):
            yield path, range_fault(value, slot)


def _is_ranged(slot: FieldSpec) -> bool:
    """Return True for a field with a range, except those of GEN=, and for a table with a ranged column."""
    if isinstance(slot.about, Rows):
        return slot.row is not None and any(column.about.limits for column in record_schema(slot.row).columns)
    return bool(slot.about.limits) and not slot.of_list


def _is_ranged_in_list(slot: FieldSpec) -> bool:
    """Return True for a field of a GEN= that has a range."""
    return bool(slot.about.limits) and slot.of_list


def is_curve(slot: FieldSpec) -> bool:
    """Return True for a field that is the table of a curve."""
    return isinstance(slot.about, Rows) and bool(slot.about.curve)
