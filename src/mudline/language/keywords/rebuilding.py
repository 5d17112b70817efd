"""Parts with other values: numbers in place of equations, other names, tables with few rows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from operator import is_
from typing import Any, TypeVar, cast

from pydantic import BaseModel

from mudline.language.keywords.model import FieldSpec, Part, Path, is_part, record_schema

Change = Callable[[Any, FieldSpec, Path], Any]
"""Function of a value, its field and its path; it returns the value that takes its place, or the value itself."""

_P = TypeVar("_P", bound=Part)


def rebuilt(part: _P, change: Change, kinds: tuple[type, ...] = (object,), *, bare: bool = False) -> _P:
    """Return a part with changed values; a part or a list in which nothing changes is the same object.

    `change` gets each value of one of these kinds: one value, one item of a list, or a whole table. Fields without a
    value (None) stay. A `bare` part has neither comments nor lines that are not read.
    """
    return cast("_P", _Rebuilding(change, kinds, bare).part(part, ()))


@dataclass(frozen=True, slots=True)
class _Rebuilding:
    """The change of all parts of a block; an object, as functions that call each other keep a deck in memory."""

    change: Change
    kinds: tuple[type, ...]
    bare: bool

    def part(self, part: Part, path: Path) -> Part:
        lines = ("comments", "unread") if self.bare else ()
        changes: dict[str, Any] = {name: [] for name in lines if getattr(part, name, None)}
        for slot in record_schema(type(part)).slots:
            old: Any = getattr(part, slot.name, None)
            if old is None:
                continue
            place = (*path, slot.order if slot.of_list else slot.json)
            if isinstance(old, list):
                items = [self.value(item, slot, (*place, index)) for index, item in enumerate(old)]
                new = old if all(map(is_, items, old)) else items
            else:
                new = self.value(old, slot, place)
            if new is not old:
                changes[slot.name] = new
        return part.model_copy(update=changes) if changes else part

    def value(self, value: Any, slot: FieldSpec, path: Path) -> Any:
        kind: type[BaseModel] = type(value)
        if is_part(kind):
            return self.part(value, path)
        return self.change(value, slot, path) if isinstance(value, self.kinds) else value
