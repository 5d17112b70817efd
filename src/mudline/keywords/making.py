"""Models of values that their reader has checked one by one.

Pydantic would check them again, and takes some ms to prepare for that for each keyword that a deck has.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

from pydantic import AfterValidator, BaseModel, BeforeValidator, PlainValidator, WrapValidator

from mudline.keywords.annotations import metadata_of
from mudline.keywords.model import ListRow, Part, record_schema

_OF_DOCUMENTS = ("_few_keys", "_from_list")
"""Validators that all parts have, for values from JSON and YAML."""
_VALIDATORS = (AfterValidator, BeforeValidator, PlainValidator, WrapValidator)
_put_fields_set, _put_extra, _put_private = (
    getattr(BaseModel, f"__pydantic_{name}__").__set__ for name in ("fields_set", "extra", "private")
)
"""What an object of a model has beside its fields: `model_construct` sets the same, and takes ten times as long."""


@dataclass(frozen=True, slots=True)
class _Recipe:
    """How the models of a part are made.

    `defaults` have all fields in their order, `lists` are those that hold an empty list of their own where nothing is
    given, `rows` those of rows; `renamed` are those with another name in JSON, which comes first.
    """

    defaults: dict[str, object]
    renamed: tuple[tuple[str, str], ...]
    required: frozenset[str]
    lists: tuple[str, ...]
    rows: tuple[tuple[str, type[Part]], ...]
    checks: tuple[str, ...]


@cache
def can_be_made(part: type[Part]) -> bool:
    """Whether pydantic would check nothing of a part but what each field holds, and what `make` checks too."""
    decorators = part.__pydantic_decorators__
    checks = [one.info.mode for name, one in decorators.model_validators.items() if name not in _OF_DOCUMENTS]
    metadata = (item for info in part.model_fields.values() for item in metadata_of(info))
    inner = (each for slot in record_schema(part).slots for each in (slot.row, *slot.record.values()) if each)
    return (
        not decorators.field_validators
        and set(checks) <= {"after"}
        and not any(isinstance(item, _VALIDATORS) for item in metadata)
        and all(map(can_be_made, inner))
    )


@cache
def _recipe(part: type[Part]) -> _Recipe:
    slots = record_schema(part).slots
    required = [name for name, info in part.model_fields.items() if info.is_required()]
    defaults = part.model_construct(**dict.fromkeys(required)).__dict__
    validators = part.__pydantic_decorators__.model_validators
    return _Recipe(
        defaults,
        tuple((info.alias, name) for name, info in part.model_fields.items() if info.alias not in (None, name)),
        frozenset(required),
        tuple(name for name, value in defaults.items() if isinstance(value, list)),
        tuple((slot.json, slot.row) for slot in slots if slot.row and slot is not record_schema(part).table),
        tuple(name for name in validators if name not in _OF_DOCUMENTS),
    )


def make(part: type[Part], values: dict[str, Any]) -> Part:
    """The model of a part from what its fields hold, by their names in JSON; those of records hold models.

    Raises ValueError where a value is missing, or where some do not fit each other.
    """
    recipe = _recipe(part)
    for name, row in recipe.rows:
        inner = values.get(name)
        if isinstance(inner, list) and issubclass(row, ListRow):
            inner = {slot.json: value for slot, value in zip(record_schema(row).columns, inner, strict=False)}
        if isinstance(inner, dict):
            values[name] = make(row, inner)
    for json, name in recipe.renamed:
        if json in values:
            values[name] = values.pop(json)
    given = {*values}
    if not recipe.required <= given:
        raise ValueError("a value is missing")
    fields = recipe.defaults.copy()
    for name in recipe.lists:
        fields[name] = []
    fields.update(values)
    made = part.__new__(part)
    object.__setattr__(made, "__dict__", fields)
    _put_fields_set(made, given)
    _put_extra(made, None)
    _put_private(made, None)
    for check in recipe.checks:
        getattr(made, check)()
    return made
