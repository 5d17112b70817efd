"""Lists of a model are checked a few entries at a time: one with a million faults would fill the memory with them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import Any, cast

from pydantic import ValidationError
from pydantic_core import CoreSchema, ErrorDetails, InitErrorDetails, PydanticCustomError, core_schema

_PART = 32
"""Entries checked at once; lists are nested three deep at most."""

_UNCHECKED = PydanticCustomError("unchecked", "not looked at, nor what follows: mend the entries before first")


def checked_by_parts(schema: CoreSchema) -> CoreSchema:
    """The schema of a model with a limit on each of its own lists; those of the models in it have theirs."""
    found = cast("dict[str, Any]", schema)
    if found["type"] == "list":
        return core_schema.no_info_wrap_validator_function(_by_parts, schema)
    if "schema" in found:
        found["schema"] = checked_by_parts(found["schema"])
    if found["type"] == "model-fields":
        for field in found["fields"].values():
            field["schema"] = checked_by_parts(field["schema"])
    return schema


def _by_parts(given: object, check: core_schema.ValidatorFunctionWrapHandler) -> list[object]:
    """All entries, or the faults of the first part that has any. Entries may be made as they are checked."""
    if not isinstance(given, list | Iterator) or (isinstance(given, list) and len(given) <= _PART):
        return cast("list[object]", check(given))
    made: list[object] = []
    entries = iter(given)
    while part := list(islice(entries, _PART)):
        try:
            made += check(part)
        except ValidationError as error:
            start = len(made)
            moved = [_moved(fault, start) for fault in error.errors(include_url=False)]
            if any(True for _ in entries):
                moved.append(InitErrorDetails(type=_UNCHECKED, loc=(start + _PART,), input=None))
            raise ValidationError.from_exception_data(error.title, moved) from error
    return made


def _moved(fault: ErrorDetails, start: int) -> InitErrorDetails:
    """A fault of a part as one of the whole list."""
    kind = PydanticCustomError(
        cast("Any", fault["type"]), "{message}", {**fault.get("ctx", {}), "message": fault["msg"]}
    )
    index, *rest = fault["loc"]
    return InitErrorDetails(type=kind, loc=(cast("int", index) + start, *rest), input=fault["input"])
