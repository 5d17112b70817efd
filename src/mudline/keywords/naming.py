"""The names, numbers and labels that the fields of a part give: those of other things, or those of a new one."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, Literal, TypeGuard

from pydantic import BaseModel

from mudline.keywords.model import Block, FieldSpec, Part, record_schema
from mudline.keywords.unknown import UNKNOWN_NAME
from mudline.keywords.values import Equation, Label, Names

Role = Literal["names", "defines"]
"""What a field does with a name: it uses that of another thing, or gives a thing its own."""


@cache
def is_part(kind: type[BaseModel]) -> bool:
    """Whether a class is one of parts: to ask a model itself takes several times as long."""
    return issubclass(kind, Part)


@cache
def _naming(part: type[Part], what: Names | None, role: Role = "names") -> tuple[FieldSpec, ...]:
    """The fields that name or define a thing of a kind, None for any, and those with parts that have one."""

    def names(slot: FieldSpec) -> bool:
        kind = getattr(slot.about, role)
        return kind is what if what else kind is not None

    return tuple(
        slot
        for slot in record_schema(part).slots
        if names(slot) or any(_naming(each, what, role) for each in _inside(slot))
    )


def _inside(slot: FieldSpec) -> list[type[Part]]:
    return [part for part in (slot.row, *slot.record.values()) if part]


@cache
def kinds_of(part: type[Part], role: Role) -> frozenset[Names]:
    """The kinds of things that the fields of a part, and of those inside it, name or define."""
    slots = record_schema(part).slots
    own = {kind for slot in slots if (kind := getattr(slot.about, role)) is not None}
    return frozenset(own).union(*(kinds_of(each, role) for slot in slots for each in _inside(slot)))


def may_name(part: type[Part], what: Names) -> bool:
    """Whether a part has fields for names of a kind."""
    return bool(_naming(part, what))


Path = tuple[str | int, ...]


def names_given(part: Part, what: Names, role: Role = "names") -> Iterator[tuple[Path, str]]:
    """The names of things of a kind that a part gives, with their paths; what is not a text is not a name."""
    slots = _naming(type(part), what, role)
    return ((path, name) for _, path, name in _given(part, slots, role, what)) if slots else iter(())


def all_names_given(part: Part, role: Role) -> Iterator[tuple[Names, Path, str]]:
    """The names of things of every kind that a part gives, with their kinds and paths."""
    return _given(part, _naming(type(part), None, role), role, None)


def _given(
    part: Part, slots: tuple[FieldSpec, ...], role: Role, what: Names | None
) -> Iterator[tuple[Names, Path, str]]:
    for slot in slots:
        value = getattr(part, slot.name, None)
        if value is None:
            continue
        if _is_name(value):
            if (kind := getattr(slot.about, role)) is not None:
                yield kind, (slot.json,), value
            continue
        for at, item in enumerate_items(slot, value):
            form: type[Part] = type(item)
            if is_part(form):
                inner = _naming(form, what, role)
                for kind, path, name in _given(item, inner, role, what) if inner else ():
                    yield kind, (*at, *path), name


def _is_name(item: object) -> TypeGuard[str]:
    return isinstance(item, str) and item is not UNKNOWN_NAME and not isinstance(item, Equation)


def idents_given(part: Part, what: Names) -> Iterator[tuple[tuple[str | int, ...], int | Label]]:
    """The numbers and labels of nodes or elements that a part gives, with their paths; what could not be read is none.

    Those in the rows of a table are left out: a keyword with such a table looks at them itself.
    """
    for slot in _naming(type(part), what):
        value = getattr(part, slot.name, None)
        for path, item in enumerate_items(slot, value):
            if isinstance(item, Part):
                yield from (((*path, *inner), ident) for inner, ident in idents_given(item, what))
            elif isinstance(item, int | Label) and slot.about.names is what:
                yield path, item


def enumerate_items(slot: FieldSpec, value: object) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """The value of a field, or those of its list, each with the path to it."""
    if isinstance(value, list):
        yield from (((slot.json, index), item) for index, item in enumerate(value))
    else:
        yield (slot.json,), value


@cache
def set_slots(block: type[Block]) -> tuple[tuple[FieldSpec, FieldSpec], ...]:
    """The lists of a block whose records go by element set, each with the field of these that names it."""
    return tuple(
        (slot, named)
        for slot in record_schema(block).slots
        for record in slot.record.values()
        for named in record_schema(record).slots
        if named.about.names is Names.SET
    )


def repeated_set(block: Block) -> Path:
    """The place of the first element set that a block gives a second time with other values; () where none is."""
    for listed, named in set_slots(type(block)) if block.facts.later_wins else ():
        given: dict[str, Part] = {}
        for index, entry in enumerate(getattr(block, listed.name)):
            name = getattr(entry, named.name, None)
            if isinstance(name, str) and name:
                first = given.setdefault(name.casefold(), entry)
                if first is not entry and first != entry:
                    return listed.json, index, named.json
    return ()
