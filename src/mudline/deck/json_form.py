"""A deck to JSON and back."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from pydantic_core import to_json as compact

from mudline.deck.document import to_document
from mudline.deck.document_reading import decoded, from_document
from mudline.deck.faults import DocumentPath, path_text, refusal
from mudline.deck.json_places import JsonPlaces
from mudline.deck.model import Deck, Range
from mudline.keywords.listing import Listing

_INDENT = " "
_HALF_PAIR = re.compile(r"[\ud800-\udfff]")


def to_json(deck: Deck) -> str:
    """The deck as JSON text: a line for each value, rows of a table on one line."""
    return "".join(_pretty(to_document(deck), "")) + "\n"


def _pretty(value: Any, indent: str) -> Iterator[str]:
    inner = indent + _INDENT
    if isinstance(value, dict) and value:
        mark = "{\n"
        for key, item in value.items():
            yield f"{mark}{inner}{json.dumps(key, ensure_ascii=False)}: "
            yield from _pretty(item, inner)
            mark = ",\n"
        yield f"\n{indent}}}"
    elif isinstance(value, Listing) and len(value):
        mark = f"[\n{inner}["
        for piece in value.lines(_cells):
            yield mark + piece.replace("\n", f"],\n{inner}[")
            mark = f"],\n{inner}["
        yield f"]\n{indent}]"
    elif isinstance(value, list) and value and isinstance(value[0], dict | list):
        mark = "[\n"
        for item in value:
            yield f"{mark}{inner}"
            yield from _pretty(item, inner)
            mark = ",\n"
        yield f"\n{indent}]"
    else:
        yield _inline(value)


def _inline(value: Any) -> str:
    """A scalar, a list of scalars, or a table without rows, on one line."""
    if isinstance(value, list | Listing):
        return f"[{_cells(value)}]" if isinstance(value, list) else "[]"
    return compact(value, inf_nan_mode="constants").decode()


def _cells(row: list[Any]) -> str:
    return ", ".join(map(_inline, row))


def write(deck: Deck) -> str:
    """What `dump` calls."""
    return to_json(deck)


def read(data: bytes, file: str) -> Deck:
    """The deck of a file's content; raises DeckError."""
    return from_json(decoded(data, file, "JSON"), file)


def from_json(text: str, file: str = "<json>") -> Deck:
    """The deck of a JSON text; raises DeckError for what is no JSON, has a key twice, or breaks the schema."""
    try:
        document = json.loads(text, object_pairs_hook=_unique, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        place = Range(error.lineno, error.colno, error.lineno, error.colno)
        raise refusal(file, f"no JSON: {error.msg}", place) from error
    except RecursionError as error:
        raise refusal(file, "nested too deeply: is this a deck?") from error
    except ValueError as error:
        raise refusal(file, str(error)) from error
    places = JsonPlaces(text)
    if "\\ud" in text or "\\uD" in text:
        _refuse_half_pairs(document, file, places)
    return from_document(document, file, places.locate)


def _refuse_half_pairs(document: object, file: str, places: JsonPlaces) -> None:
    """Refuse escapes that are half of a surrogate pair, which no file can hold."""
    stack: list[tuple[DocumentPath, object]] = [((), document)]
    while stack:
        path, value = stack.pop()
        if isinstance(value, dict):
            stack += [((*path, key), item) for key, item in value.items()]
            value = "".join(value)
        elif isinstance(value, list):
            stack += [((*path, index), item) for index, item in enumerate(value)]
        if isinstance(value, str) and not value.isascii() and _HALF_PAIR.search(value):
            raise refusal(file, f"{path_text(path)}: \\uD800 to \\uDFFF stand in pairs only", places.locate(path))


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for key, value in pairs:
        if key in values:
            raise ValueError(f"the key {key!r} stands twice in one object")
        values[key] = value
    return values


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no JSON number: a deck holds finite numbers only")
