"""The kinds of value that a field of a deck can hold."""

from __future__ import annotations

import re
from enum import Enum
from typing import Annotated, Any, ClassVar, Self

from pydantic import BeforeValidator, Field, GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

_NO_LINE_END = {"not": {"pattern": "[\\r\\n]"}}
"""Said apart in JSON Schema: in some dialects of patterns $ matches also before a line end."""


class _Pattern(str):
    """A string of a fixed form, kept as written."""

    __slots__ = ()
    form: ClassVar[str]

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_after_validator_function(
            cls,
            core_schema.str_schema(pattern=cls.form, strict=True),
            serialization=core_schema.plain_serializer_function_ser_schema(str, return_schema=core_schema.str_schema()),
        )

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        return cls.json_schema()

    @classmethod
    def json_schema(cls) -> dict[str, Any]:
        """The form in JSON Schema."""
        return {"type": "string", "pattern": cls.form, **_NO_LINE_END}

    @classmethod
    def match(cls, text: str) -> Self | None:
        """The text as this type, or None when it has not this form."""
        return cls(text) if re.search(cls.form, text) and not text.endswith("\n") else None


class Equation(_Pattern):
    """`=[expression]`, kept as written until the scene evaluates it."""

    form = r"^=\[[^\r\n]*\]$"
    __slots__ = ()

    @property
    def expression(self) -> str:
        """What stands between the brackets."""
        return self[2:-1]


class Label(_Pattern):
    """`{label}` of a node or an element, braces included."""

    form = r"^\{[^{}\r\n]*\}$"
    __slots__ = ()


class Kind(Enum):
    """How a field's text is read; the sentence says what is expected there."""

    REAL = "a number or an equation =[...]"
    WHOLE = "a whole number or an equation =[...]"
    IDENT = "a number or a {label}"
    REAL_OR_NAME = "a number, an equation =[...] or a name"
    NAME = "a name"


def _whole(given: object) -> object:
    """1.0 is a whole number in JSON."""
    return int(given) if isinstance(given, float) and given.is_integer() else given


Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Integer = Annotated[int, Field(strict=True, ge=-(2**53), le=2**53), BeforeValidator(_whole)]
Count = Annotated[int, Field(strict=True, ge=0, le=2**53), BeforeValidator(_whole)]
Text = Annotated[str, Field(strict=True, pattern=r"^[^\r\n]*$", json_schema_extra=_NO_LINE_END)]

Real = Annotated[Finite | Equation, Field(union_mode="left_to_right"), Kind.REAL]
Whole = Annotated[Integer | Equation, Field(union_mode="left_to_right"), Kind.WHOLE]
Ident = Annotated[Integer | Label, Field(union_mode="left_to_right"), Kind.IDENT]
RealOrName = Annotated[Finite | Equation | Text, Field(union_mode="left_to_right"), Kind.REAL_OR_NAME]
Name = Annotated[Text, Kind.NAME]
