"""Names, numbers and labels in the fields of a part: references to objects, and definitions of new ones."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Literal, NamedTuple, TypeGuard, get_args

from mudline.language.keywords.model import Block, FieldFilter, FieldSpec, Part, Path, fields_of, record_schema
from mudline.language.keywords.unknown import UNKNOWN_NAME
from mudline.language.keywords.values import Equation, Label, Names

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
def kinds_of(part: type[Part], role: Role) -> frozenset[Names]:
    """Return the kinds of objects that the fields of a part and its inner parts refer to or define."""
    return frozenset(kind for slot in fields_of(part) if (kind := getattr(slot.about, role)) is not None)


def may_name(part: type[Part], what: Names) -> bool:
    """Return True if a part has fields that refer to objects of a kind."""
    return what in kinds_of(part, "names")


class NameGiven(NamedTuple):
    """Name in a part: kind of the object, role of the field, name as written, path."""

    kind: Names
    role: Role
    name: str
    path: Path


@cache
def gives_names(part: type[Part]) -> bool:
    """Return True if a part, or an inner part, has fields for names."""
    return any(map(_holds_name, fields_of(part)))


def all_names_given(part: Part) -> list[NameGiven]:
    """Return every textual name in a part; numbers and labels of nodes and elements are left out."""
    return [
        NameGiven(kind, role, name, path)
        for path, slot, name in part.walk(_holds_name)
        if is_name(name)
        for role, kind in _roles_of(slot)
    ]


def _holds_name(slot: FieldSpec) -> bool:
    return any(True for _ in _roles_of(slot))


def _roles_of(slot: FieldSpec) -> Iterator[tuple[Role, Names]]:
    for role in ROLES:
        kind = getattr(slot.about, role)
        if kind is not None and kind not in (Names.NODE, Names.ELEMENT):
            yield role, kind


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
