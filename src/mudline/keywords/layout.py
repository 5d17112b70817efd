"""The declared fields of a class as the reader and the writer see them: by how they are written."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Literal, TypeVar, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from mudline.keywords.about import About, Setting
from mudline.keywords.table import Column
from mudline.keywords.table_reading import wanted
from mudline.keywords.values import Kind

if TYPE_CHECKING:
    from mudline.keywords.model import Record, Row

T = TypeVar("T")


@dataclass(slots=True)
class Slot:
    """One field of a part.

    `row` is the class of a row that it holds, or of the rows of its table; `record` the classes of the records in its
    list, by their rules; `many` says that it is a list; `order` is its place among the fields.
    """

    name: str
    json: str
    about: About
    kind: Kind | None
    choices: tuple[str, ...]
    row: type[Row] | None
    record: dict[str, type[Record]]
    table: bool
    required: bool
    many: bool
    order: int

    @property
    def key(self) -> str:
        """The KEY of a setting, or ""."""
        return self.about.key if isinstance(self.about, Setting) else ""

    @property
    def inline(self) -> bool:
        """Whether it follows on the line of the setting before it."""
        return isinstance(self.about, Setting) and self.about.inline

    @property
    def sticky(self) -> bool:
        """Whether it holds for later records, too."""
        return isinstance(self.about, Setting) and self.about.sticky

    @property
    def label(self) -> str:
        """The field's name for a reader."""
        return self.key + "=" if self.key else self.json.replace("_", " ")

    @property
    def column(self) -> Column:
        """The field as a column."""
        return Column(self.label, self.kind or Kind.REAL, self.required, self.about.sentence)


@dataclass(slots=True)
class Layout:
    """The fields of a part: all of them, those of its row, its settings by KEY, its table, its records by rule."""

    slots: list[Slot] = field(default_factory=list)
    columns: list[Slot] = field(default_factory=list)
    keys: dict[str, Slot] = field(default_factory=dict)
    table: Slot | None = None
    children: dict[str, Slot] = field(default_factory=dict)

    def add(self, slot: Slot) -> None:
        """Put a field where it belongs."""
        self.slots.append(slot)
        if slot.table:
            self.table = slot
        elif slot.key:
            self.keys[slot.key] = slot
        elif slot.record:
            self.children |= dict.fromkeys(slot.record, slot)
        else:
            self.columns.append(slot)

    def named(self, name: str) -> Slot:
        """A field by its name."""
        return next(slot for slot in self.slots if slot.name == name)

    @property
    def row_slots(self) -> list[Slot]:
        """The fields that a row can fill."""
        return [*self.columns, *([self.table] if self.table else [])]

    @property
    def plain_row(self) -> bool:
        """Whether there are columns, and they stand together on one row rather than each on a line of its own."""
        return bool(self.columns) and not any(slot.row or slot.many for slot in self.columns)

    @property
    def wanted(self) -> str:
        """The row in words: `depth, density [, gravity]`."""
        return wanted([slot.column for slot in self.columns])


def pieces(annotation: object) -> Iterator[object]:
    """A type taken apart: members of unions, items of lists, what is annotated and the annotations."""
    origin = get_origin(annotation)
    if origin is Annotated:
        inner, *metadata = get_args(annotation)
        yield from pieces(inner)
        yield from metadata
    elif origin in (Union, UnionType, list):
        for member in get_args(annotation):
            yield from pieces(member)
    elif annotation is not NoneType:
        yield annotation


def annotated(info: FieldInfo, wanted_type: type[T]) -> T | None:
    """The first annotation of a type, on the field or inside its type."""
    return next((item for item in (*info.metadata, *pieces(info.annotation)) if isinstance(item, wanted_type)), None)


def classes(info: FieldInfo, base: type[T]) -> list[type[T]]:
    """The classes below `base` in the field's type."""
    return [piece for piece in pieces(info.annotation) if isinstance(piece, type) and issubclass(piece, base)]


def choices(info: FieldInfo) -> tuple[str, ...]:
    """The words of a Literal in the field's type."""
    return next((get_args(piece) for piece in pieces(info.annotation) if get_origin(piece) is Literal), ())


def is_list(annotation: object) -> bool:
    """Whether a type is a list, or a list or None."""
    origin = get_origin(annotation)
    if origin in (Annotated, Union, UnionType):
        return any(is_list(member) for member in get_args(annotation))
    return origin is list
