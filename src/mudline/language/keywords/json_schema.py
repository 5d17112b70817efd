"""The JSON Schema of cells, and of numbers within limits."""

from __future__ import annotations

from typing import Any

from mudline.language.keywords.table import LARGEST_WHOLE, Column
from mudline.language.keywords.values import Equation, Kind, Label


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
