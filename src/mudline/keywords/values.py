"""The kinds of value that a field of a deck can hold."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum
from typing import Annotated, ClassVar, Self

from pydantic import Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema


class _Pattern(str):
    """A string of a fixed form, kept as written."""

    __slots__ = ()
    form: ClassVar[str]

    @classmethod
    def __get_pydantic_core_schema__(cls, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_after_validator_function(
            cls,
            core_schema.str_schema(pattern=cls.form, strict=True),
            serialization=core_schema.plain_serializer_function_ser_schema(str, return_schema=core_schema.str_schema()),
        )

    @classmethod
    def match(cls, text: str) -> Self | None:
        """The text as this type, or None when it has not this form."""
        return cls(text) if re.fullmatch(cls.form, text) else None


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


def unbraced_label(text: str) -> Label | None:
    """The label that a text without braces stands for, or None when it is no likely one."""
    return Label.match("{" + text + "}") if text[:1].isalpha() and not is_not_finite(text) else None


def is_not_finite(text: str) -> bool:
    """Whether a text spells what is no finite number."""
    return text.lower().lstrip("+-") in ("nan", "inf", "infinity")


class Kind(Enum):
    """How a field's text is read; the sentence says what is expected there."""

    REAL = "a number or an equation =[...]"
    WHOLE = "a whole number or an equation =[...]"
    IDENT = "a number or a {label}"
    REAL_OR_NAME = "a number, an equation =[...] or a name"
    NAME = "a text of one line"


@dataclass(frozen=True, slots=True)
class Expected:
    """Beside a type: whatever is wrong with a value of it is told in these words."""

    what: str

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.custom_error_schema(
            handler(source), custom_error_type="expected", custom_error_message=f"expected {self.what}"
        )


LARGEST_WHOLE = 2**53
"""Above it not every whole number is a double."""

Finite = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Integer = Annotated[int, Field(strict=True, ge=-LARGEST_WHOLE, le=LARGEST_WHOLE)]
Text = Annotated[str, Field(strict=True, pattern=r"^[^\r\n]*$"), Expected(Kind.NAME.value)]

_IN_ORDER = Field(union_mode="left_to_right")
Real = Annotated[Finite | Equation, _IN_ORDER, Expected(Kind.REAL.value), Kind.REAL]
Whole = Annotated[Integer | Equation, _IN_ORDER, Expected(Kind.WHOLE.value), Kind.WHOLE]
Ident = Annotated[Integer | Label, _IN_ORDER, Expected(Kind.IDENT.value), Kind.IDENT]
RealOrName = Annotated[Finite | Equation | Text, _IN_ORDER, Expected(Kind.REAL_OR_NAME.value), Kind.REAL_OR_NAME]
Name = Annotated[Text, Kind.NAME]
