"""What a field of a keyword means: its unit, range and default, what it names, and how it is written."""

from __future__ import annotations

from dataclasses import dataclass
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, cast, get_args, get_origin

from pydantic import BaseModel, ConfigDict, GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic import fields as pydantic_fields
from pydantic_core import CoreSchema, core_schema

from mudline.basics.short_repr import with_fields
from mudline.language.keywords.table import LARGEST_WHOLE, Column
from mudline.language.keywords.usual import Usual
from mudline.language.keywords.values import Contents, Count, Equation, Kind, Label, Names, Text


def cell_schema(column: Column) -> dict[str, Any]:
    """The JSON Schema of a cell."""
    words = [Label] * (column.kind in (Kind.IDENT, Kind.WHOLE_OR_LABEL)) + [Equation] * (column.kind is not Kind.IDENT)
    number = {"type": "integer", "minimum": -LARGEST_WHOLE, "maximum": LARGEST_WHOLE}
    options = [number if column.whole else {"type": "number"}, *(word.json_schema() for word in words)]
    return {"description": column.label, "anyOf": options if column.required else [*options, {"type": "null"}]}


def with_limits(schema: dict[str, Any], limits: dict[str, float]) -> dict[str, Any]:
    """A JSON Schema in which the numbers have limits."""
    if schema.get("type") in ("number", "integer"):
        return schema | limits
    if limits and "anyOf" in schema:
        return schema | {"anyOf": [with_limits(one, limits) for one in schema["anyOf"]]}
    return schema


Expected = Usual | tuple[Usual, ...] | str


@dataclass(frozen=True, slots=True)
class FieldInfo:
    """What a field means. Units in F (force), L, M, T, deg; "-" is dimensionless. `inferred` names our deduction.

    `names` says what the field is the name or number of, `defines` of what it gives a new thing its own. `also`
    is another name by which `mudline set` finds it, `heading` that of its column in a table of the manual. A `unique`
    one tells the records of a list apart, so no two of them should have the same. Behind a
    setting with one of the values `opaque`, or with a value that is not known, lines stand whose form is not public:
    they are kept in a record that can keep lines. None: what stands behind it has one form. What is `older`, a field or
    some words of a choice, only decks of an older program have, whose files end in .das.
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
    holds: Contents | None = None
    heading: str = ""
    unique: bool = False
    opaque: tuple[str, ...] | None = None
    usual: Expected = ()
    older: bool | tuple[str, ...] = False

    @property
    def usuals(self) -> tuple[Usual, ...]:
        """What values are usual."""
        if isinstance(self.usual, str):
            return ()
        return (self.usual,) if isinstance(self.usual, Usual) else self.usual

    def fault(self, value: float) -> str:
        """What is wrong with a number, or nothing; NaN stands for one that could not be read."""
        if self.at_least is not None and value < self.at_least:
            return f"it must not be less than {self.at_least:g}"
        if self.above is not None and value <= self.above:
            return f"it must be greater than {self.above:g}"
        if self.at_most is not None and value > self.at_most:
            return f"it must not be more than {self.at_most:g}"
        return ""

    @property
    def limits(self) -> dict[str, float]:
        """The range as JSON Schema says it."""
        given = {"minimum": self.at_least, "exclusiveMinimum": self.above, "maximum": self.at_most}
        return {key: limit for key, limit in given.items() if limit is not None}

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        schema = handler(source)
        return core_schema.with_info_after_validator_function(self._in_range, schema) if self.limits else schema

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return with_limits(handler(schema), self.limits)

    def _in_range(self, value: object, info: ValidationInfo) -> object:
        """Refuse a number out of range; the text of a deck is read as it is, and its values are reported by checks."""
        numeric = isinstance(value, int | float) and info.context != AS_TEXT
        if numeric and (fault := self.fault(cast("float", value))):
            raise ValueError(f"{value!r} is out of range: {fault}")
        return value


AS_TEXT = "text of a deck"
"""The context in which the values of a text are validated."""


@dataclass(frozen=True, slots=True)
class Setting(FieldInfo):
    """A field written `KEY=value`; `inline` ones follow on the line of the setting before them.

    `behind` names the only setting whose line an inline one may follow on; without that it has a line of its own.
    """

    key: str = ""
    inline: bool = False
    behind: str = ""


def about(meaning: str, **details: Any) -> FieldInfo:
    """A positional field."""
    return FieldInfo(meaning, **details)


def setting(key: str, meaning: str, **details: Any) -> Setting:
    """A field written `KEY=value`."""
    return Setting(meaning, key=key, **details)


def parts_of(annotation: Any) -> list[Any]:
    """A type taken apart: members of unions, items of lists, what is annotated."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return [*parts_of(get_args(annotation)[0]), *get_args(annotation)[1:]]
    if origin in (Union, UnionType, list):
        return [piece for member in get_args(annotation) for piece in parts_of(member)]
    return [] if annotation is NoneType else [annotation]


def metadata_of(info: pydantic_fields.FieldInfo) -> list[Any]:
    """What a field is annotated with, and its types taken apart."""
    return [*info.metadata, *parts_of(info.annotation)]


def kind_of(info: pydantic_fields.FieldInfo) -> Kind | None:
    """How the text of a field is read, None for a part."""
    return next((item for item in metadata_of(info) if isinstance(item, Kind)), None)


def choices_of(annotation: Any) -> tuple[str, ...]:
    """The words that a field may hold, () where it is no choice."""
    literal = (piece for piece in parts_of(annotation) if get_origin(piece) is Literal)
    return next((get_args(piece) for piece in literal), ())


def is_list(annotation: Any) -> bool:
    """Whether a field holds a list."""
    origin = get_origin(annotation)
    if origin is Annotated:
        return is_list(get_args(annotation)[0])
    if origin in (Union, UnionType):
        return any(is_list(member) for member in get_args(annotation))
    return origin is list


class Comment(BaseModel):
    """A comment line; `before` is the index of the item that it precedes, `text` what follows the C."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)
    before: Count
    text: Text

    def __repr__(self) -> str:
        return with_fields(self, [("before", self.before), ("text", self.text)])
