"""Fields of a keyword: meaning, unit, range, default, names, and the way they are written."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, cast, get_args, get_origin

from pydantic import BaseModel, ConfigDict, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic import fields as pydantic_fields
from pydantic_core import CoreSchema, core_schema

from mudline.basics.short_repr import with_fields
from mudline.language.keywords.table import LARGEST_WHOLE, Column
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Count, DataFile, Equation, Kind, Label, Names, Text


def cell_schema(column: Column) -> dict[str, Any]:
    """Return the JSON Schema of a cell."""
    words = [Label] * (column.kind in (Kind.IDENT, Kind.WHOLE_OR_LABEL)) + [Equation] * (column.kind is not Kind.IDENT)
    number = {"type": "integer", "minimum": -LARGEST_WHOLE, "maximum": LARGEST_WHOLE}
    options = [number if column.whole else {"type": "number"}, *(word.json_schema() for word in words)]
    return {"description": column.label, "anyOf": options if column.required else [*options, {"type": "null"}]}


def with_limits(schema: dict[str, Any], limits: dict[str, float]) -> dict[str, Any]:
    """Return a JSON Schema with limits on its numbers."""
    if schema.get("type") in ("number", "integer"):
        return schema | limits
    if limits and "anyOf" in schema:
        return schema | {"anyOf": [with_limits(inner, limits) for inner in schema["anyOf"]]}
    return schema


Expected = Usual | tuple[Usual, ...] | str


@dataclass(frozen=True, slots=True)
class FieldInfo:
    """Declaration of a field.

    Attributes:
        meaning: words for a reader.
        unit: in F (force), L, M, T, deg; "-" is dimensionless.
        default: value of an empty field, in words.
        at_least, above, at_most: range of the value.
        inferred: statement about the field that is our deduction, not published.
        names: kind of object that the field refers to.
        also: another name for the field in `mudline set`.
        defines: kind of object that the field creates.
        holds: contents of the file that the field names.
        heading: column heading in a table of the manual.
        unique: True if no two records of a list should have the same value.
        opaque: values of a setting that are followed by lines of an unpublished form, which a record keeps; so do
            unknown values. None: the form of the following lines does not depend on the value.
        usual: usual values.
        written_in: unit for people where `unit` does not hold for every value; a second one is that of degrees of
            freedom 4 to 6 and of rotary inertia.
        older: True, or words of a choice, if only decks of an older program (files ending in .das) have them.
    """

    meaning: str
    unit: str = ""
    default: str = ""
    at_least: float | None = None
    above: float | None = None
    at_most: float | None = None
    inferred: str = ""
    names: Names | None = None
    also: str = ""
    defines: Names | None = None
    holds: DataFile | None = None
    heading: str = ""
    unique: bool = False
    opaque: tuple[str, ...] | None = None
    usual: Expected = ()
    written_in: tuple[str, ...] = ()
    older: bool | tuple[str, ...] = False

    @property
    def usuals(self) -> tuple[Usual, ...]:
        """Ranges of usual values."""
        if isinstance(self.usual, str):
            return ()
        return (self.usual,) if isinstance(self.usual, Usual) else self.usual

    def fault(self, value: float) -> str:
        """Return the fault of a number that is out of range, or ""; NaN, as of an unreadable value, has none."""
        if self.at_least is not None and value < self.at_least:
            return f"it must not be less than {self.at_least:g}"
        if self.above is not None and value <= self.above:
            return f"it must be greater than {self.above:g}"
        if self.at_most is not None and value > self.at_most:
            return f"it must not be more than {self.at_most:g}"
        return ""

    @property
    def span(self) -> tuple[float, float]:
        """Least and greatest value of the range."""
        least = self.at_least if self.above is None else math.nextafter(self.above, math.inf)
        return -math.inf if least is None else least, math.inf if self.at_most is None else self.at_most

    @property
    def limits(self) -> dict[str, float]:
        """Range in the terms of JSON Schema."""
        limits = {"minimum": self.at_least, "exclusiveMinimum": self.above, "maximum": self.at_most}
        return {key: limit for key, limit in limits.items() if limit is not None}

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        return core_schema.with_info_after_validator_function(self._in_range, schema) if self.limits else schema

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return with_limits(handler(schema), self.limits)

    def _in_range(self, value: object, info: ValidationInfo) -> object:
        """Raise ValueError for a number out of range; values in the text of a deck pass, and are reported by checks."""
        numeric = isinstance(value, int | float) and info.context != AS_TEXT
        if numeric and (fault := self.fault(cast("float", value))):
            raise ValueError(f"{value!r} is out of range: {fault}")
        return value


AS_TEXT = "text of a deck"
"""Validation context of values that were read from text."""


@dataclass(frozen=True, slots=True)
class Setting(FieldInfo):
    """Field written `KEY=value`.

    An `inline` setting follows on the line of the setting before it. If `behind` names a setting, it may follow only on
    the line of that setting, and has a line of its own otherwise.
    """

    key: str = ""
    inline: bool = False
    behind: str = ""


def about(meaning: str, **details: Any) -> FieldInfo:
    """Return a positional field."""
    return FieldInfo(meaning, **details)


def setting(key: str, meaning: str, **details: Any) -> Setting:
    """Return a field written `KEY=value`."""
    return Setting(meaning, key=key, **details)


def parts_of(annotation: Any) -> list[Any]:
    """Return the constituents of a type: members of unions, items of lists, annotated types."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return [*parts_of(get_args(annotation)[0]), *get_args(annotation)[1:]]
    if origin in (Union, UnionType, list):
        return [piece for member in get_args(annotation) for piece in parts_of(member)]
    return [] if annotation is NoneType else [annotation]


def metadata_of(info: pydantic_fields.FieldInfo) -> list[Any]:
    """Return the annotations of a field and of the constituents of its type."""
    return [*info.metadata, *parts_of(info.annotation)]


def kind_of(info: pydantic_fields.FieldInfo) -> Kind | None:
    """Return the kind of a field's text, None for a part."""
    return next((item for item in metadata_of(info) if isinstance(item, Kind)), None)


def choices_of(annotation: Any) -> tuple[str, ...]:
    """Return the words that a field may hold, () if it is not a choice."""
    literal = (piece for piece in parts_of(annotation) if get_origin(piece) is Literal)
    return next((get_args(piece) for piece in literal), ())


def is_list(annotation: Any) -> bool:
    """Return True if a field holds a list."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return is_list(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return any(is_list(member) for member in get_args(annotation))
    return origin is list


class Comment(BaseModel):
    """Comment line; `before` is the index of the item that it precedes, `text` the text after the C."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
    before: Count
    text: Text

    def __repr__(self) -> str:
        return with_fields(self, [("before", self.before), ("text", self.text)])
