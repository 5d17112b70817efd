"""What a declared field means and how it is written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypedDict, Unpack

from pydantic import GetJsonSchemaHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema


@dataclass(frozen=True, slots=True)
class About:
    """What a field means. Units in F (force), L, M, T, deg; "-" is dimensionless. `inferred` names our deduction."""

    meaning: str
    unit: str = ""
    default: str = ""
    at_least: float | None = None
    above: float | None = None
    inferred: str = ""

    @property
    def sentence(self) -> str:
        """Meaning, unit and default in one sentence."""
        unit = f" [{self.unit}]" if self.unit else ""
        default = f"; default {self.default}" if self.default else ""
        return f"{self.meaning}{unit}{default}"

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        return handler(schema) | {"description": self.sentence}


@dataclass(frozen=True, slots=True)
class Setting(About):
    """A field written `KEY=value`.

    An `inline` one follows on the line of the setting before it; a `sticky` one holds for later records, too.
    """

    key: str = ""
    inline: bool = False
    sticky: bool = False


class Details(TypedDict, total=False):
    """What may be said of a field besides its meaning, as in About."""

    unit: str
    default: str
    at_least: float
    above: float
    inferred: str


class SettingDetails(Details, total=False):
    """The same for a setting."""

    inline: bool
    sticky: bool


def about(meaning: str, **details: Unpack[Details]) -> About:
    """A positional field."""
    return About(meaning, **details)


def setting(key: str, meaning: str, **details: Unpack[SettingDetails]) -> Setting:
    """A field written `KEY=value`."""
    return Setting(meaning, key=key, **details)
