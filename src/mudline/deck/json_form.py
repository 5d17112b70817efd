"""A deck to JSON and back."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from pydantic_core import to_json as compact

from mudline.deck.document import from_document, to_document
from mudline.deck.document_faults import decoded, refusal
from mudline.deck.json_places import JsonPlaces, repeated_key
from mudline.deck.model import Deck

_INDENT = " "


def to_json(deck: Deck) -> str:
    """The deck as JSON text: a line for each value, rows of a table on one line."""
    return "".join(_pretty(to_document(deck), "")) + "\n"


def write(deck: Deck) -> str:
    """What `dump` calls."""
    return to_json(deck)


def read(data: bytes, file: str) -> Deck:
    """The deck of a file's content; raises DeckError."""
    return from_json(decoded(data, file, "JSON"), file)


def from_json(text: str, file: str = "<json>") -> Deck:
    """The deck of a JSON text; raises DeckError for what is no JSON, has a key twice, or breaks the schema."""
    places = JsonPlaces(text)
    try:
        document = json.loads(text, object_pairs_hook=_unique)
    except json.JSONDecodeError as error:
        raise refusal(file, f"no JSON: {error.msg[0].lower()}{error.msg[1:]}", places.at(error.pos)) from error
    except RecursionError as error:
        raise refusal(file, "nested too deeply: is this a deck?") from error
    except _TwiceError as error:
        key, place = repeated_key(text)
        raise refusal(file, f"the key {key!r} stands twice in one object", places.at(place)) from error
    except ValueError as error:  # Python converts whole numbers of up to 4300 digits
        raise refusal(file, "a whole number of thousands of digits: is this a deck?") from error
    return from_document(document, file, places)


class _TwiceError(Exception):
    """A key that stands twice in one object."""


def _unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
    values = dict(pairs)
    if len(values) < len(pairs):
        raise _TwiceError
    return values


def _pretty(value: Any, indent: str) -> Iterator[str]:
    inner = indent + _INDENT
    if isinstance(value, dict) and value:
        mark = "{\n"
        for key, item in value.items():
            yield f"{mark}{inner}{_inline(key)}: "
            yield from _pretty(item, inner)
            mark = ",\n"
        yield f"\n{indent}}}"
    elif isinstance(value, list) and value and isinstance(value[0], list):
        yield f"[\n{inner}{_rows(value, inner)}\n{indent}]"
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        mark = "[\n"
        for item in value:
            yield f"{mark}{inner}"
            yield from _pretty(item, inner)
            mark = ",\n"
        yield f"\n{indent}]"
    else:
        yield _inline(value)


def _rows(rows: list[list[object]], indent: str) -> str:
    """The rows of a table, one a line; numbers alone are written all at once."""
    numbers = compact(rows).decode()
    if '"' in numbers:
        return f",\n{indent}".join(_inline(row) for row in rows)
    return numbers[1:-1].replace(",", ", ").replace("], [", f"],\n{indent}[")


def _inline(value: object) -> str:
    """A scalar, or a list of scalars, on one line."""
    if isinstance(value, list):
        return "[" + ", ".join(_inline(item) for item in value) + "]"
    return compact(value).decode()
