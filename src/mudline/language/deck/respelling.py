"""Misspelt keys and words of a block in JSON or YAML, for which one name alone was meant."""

from __future__ import annotations

import re
from collections.abc import Collection
from copy import deepcopy
from typing import Any, NamedTuple

from pydantic import ValidationError

from mudline.basics.spelling import meant_names
from mudline.language.deck.faults import DocumentPath, shown
from mudline.language.keywords.model import Block, Part, record_schema
from mudline.language.keywords.text import hint

_QUOTED = re.compile(r"'([^']*)'")


class Respelt(NamedTuple):
    """A block as it was meant, and what is wrong in it as it is written."""

    block: Block
    faults: list[tuple[DocumentPath, str]]


def respelt(given: dict[str, Any], declared: type[Block], error: ValidationError) -> Respelt | None:
    """The block that a document means; None where more is wrong in it than the spelling of names."""
    meant = deepcopy(given)
    faults: list[tuple[DocumentPath, str]] = []
    for fault in error.errors(include_url=False):
        path = _path(given, fault["loc"])
        holder = _inside(meant, path[:-1])
        last = path[-1] if path else ""
        if fault["type"] == "extra_forbidden" and isinstance(holder, dict) and last in holder:
            if name := _near(str(last), _keys(declared, path[:-1]) - holder.keys()):
                holder[name] = holder.pop(last)
                faults.append((path, f"unknown key{hint(name)}"))
        elif fault["type"] == "literal_error" and isinstance(holder, dict) and isinstance(holder.get(last), str):
            expected = fault["ctx"]["expected"]
            if name := _near(holder[last], _QUOTED.findall(expected)):
                faults.append((path, f"expected {expected}, found {shown(holder[last])}{hint(name)}"))
                holder[last] = name
    try:
        return Respelt(declared.model_validate(meant), faults) if faults else None
    except ValidationError:
        return None


def _path(value: Any, steps: DocumentPath) -> DocumentPath:
    """The steps that a document has: pydantic puts the names of alternatives between them."""
    path: list[str | int] = []
    for step in steps:
        here = step in value if isinstance(value, dict) else isinstance(value, list) and isinstance(step, int)
        if here:
            path.append(step)
            value = value[step]
    return tuple(path)


def _inside(value: Any, path: DocumentPath) -> object:
    for step in path:
        try:
            value = value[step]
        except (LookupError, TypeError):
            return None
    return value


def _near(word: str, known: Collection[str]) -> str:
    """The one name that was meant by a word, or ""."""
    folded = {name.casefold(): name for name in known}
    near = meant_names(word.casefold(), folded)
    return folded[near[0]] if len(near) == 1 else ""


def _keys(part: type[Part], path: DocumentPath) -> set[str]:
    """The keys that an object of a document may have at a path of a block."""
    parts: list[type[Part]] = [part]
    for step in path:
        if isinstance(step, str):
            slots = [slot for each in parts for slot in record_schema(each).slots if slot.json == step]
            parts = [inner for slot in slots for inner in (slot.row, *slot.record.values()) if inner]
    return {slot.json for each in parts for slot in record_schema(each).slots}
