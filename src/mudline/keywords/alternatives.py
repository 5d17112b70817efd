"""A list of records of several kinds, each known by the field that it must have."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import get_args

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from mudline.keywords.model import Record, layout
from mudline.keywords.text import either


@dataclass(frozen=True, slots=True)
class ByField:
    """Beside a union of records: a record is of the kind whose first mandatory field it has.

    The kind stands between angle brackets in the place of a fault, which tells it from a field.
    """

    def __get_pydantic_core_schema__(self, source: object, handler: GetCoreSchemaHandler) -> CoreSchema:
        kinds = dict(_kinds(source))

        def kind_of(given: object) -> str | None:
            if isinstance(given, Record):
                return next(tag for tag, record in kinds.items() if record is type(given))
            return next((tag for tag in kinds if isinstance(given, dict) and tag[1:-1] in given), None)

        return core_schema.tagged_union_schema(
            {tag: handler.generate_schema(record) for tag, record in kinds.items()},
            kind_of,
            custom_error_type="expected",
            custom_error_message=f"expected an object with {either(f'`{tag[1:-1]}`' for tag in kinds)}",
        )


def _kinds(source: object) -> Iterator[tuple[str, type[Record]]]:
    for record in get_args(source):
        yield f"<{next(slot.json for slot in layout(record).slots if slot.required)}>", record
