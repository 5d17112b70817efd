"""Which tables keywords have in the form of the manual: their columns, and the headings by which these are known."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from mudline.language.keywords import catalogue
from mudline.language.keywords.fields import Setting
from mudline.language.keywords.model import Block, FieldSpec, Record, Rows, record_schema
from mudline.language.keywords.values import Kind, Names

_NOT_LETTERS = re.compile(r"[\W_]+")


@dataclass(frozen=True, eq=False)
class Column:
    """A column that a form has, and the headings by which it is known, without blanks and case."""

    spec: FieldSpec
    headings: frozenset[str]

    @classmethod
    def of(cls, spec: FieldSpec, *headings: str) -> Column:
        """Return the column of a field that is known by some headings."""
        return cls(spec, frozenset(map(plain, headings)) - {""})

    @property
    def label(self) -> str:
        """What the column is called in a message."""
        return self.spec.about.heading or self.spec.label.removesuffix("=")


@dataclass(frozen=True, eq=False)
class TableForm:
    """The rows of a keyword as a table: a column that names their set, curve or thing, if they have one, and values.

    `opening` is the line that says which of several kinds of rows follow.
    """

    declared: type[Block]
    name: Column | None
    values: tuple[Column, ...]
    opening: str
    curve: Rows | None

    @property
    def keyword(self) -> str:
        """The name of the keyword."""
        return str(self.declared.model_fields["keyword"].default)

    @property
    def section(self) -> str:
        """The section where its lines are written."""
        return self.declared.sections[0]

    @property
    def columns(self) -> tuple[Column, ...]:
        """All columns, that of the name first."""
        return ((self.name,) if self.name else ()) + self.values

    @property
    def required(self) -> list[Column]:
        """The columns of values that a table must have."""
        return [column for column in self.values if column.spec.required]


@cache
def table_forms() -> tuple[TableForm, ...]:
    """The tables of all keywords."""
    classes = catalogue.block_classes()
    records = ((one, record) for one in classes for slot in record_schema(one).slots for record in slot.record.values())
    return tuple(form for declared, record in records for form in _of_record(declared, record))


def _of_record(declared: type[Block], record: type[Record]) -> Iterator[TableForm]:
    schema = record_schema(record)
    named = (spec for spec in schema.keys.values() if spec.kind is Kind.NAME and not spec.many)
    named = (spec for spec in named if not (isinstance(spec.about, Setting) and spec.about.inline))
    name = next((spec for spec in named if spec.about.names is Names.SET or spec.about.defines), None)
    if any(spec.required and spec is not name for spec in schema.keys.values()):
        return
    rows = [spec for spec in schema.slots if spec.row is not None and not spec.key]
    for spec in rows:
        values = record_schema(spec.row).slots if spec.row else []
        if not values or any(value.key or value.row or value.record for value in values):
            continue
        opening = f"{record.sticky.upper()}={spec.json.upper()}" if record.sticky and len(rows) > 1 else ""
        yield TableForm(
            declared,
            None if name is None else Column.of(name, name.key, f"{name.key} name", name.about.heading),
            tuple(Column.of(value, value.json, value.label, value.about.heading) for value in values),
            opening,
            curve=spec.about if isinstance(spec.about, Rows) and spec.about.curve else None,
        )


def plain(text: str) -> str:
    """A heading as headings compare."""
    return _NOT_LETTERS.sub("", text).casefold()
