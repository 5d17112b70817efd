"""A deck to JSON and back."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import cache
from typing import Any

from pydantic_core import to_json as compact

from mudline.codes import DOC001
from mudline.deck.document import DocumentPath, from_document, to_document
from mudline.deck.model import START, Deck, Range
from mudline.deck.node_places import places
from mudline.diagnostics import DeckError, Diagnostic

_INDENT = " "


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
    """A scalar, or a list of scalars, on one line."""
    if isinstance(value, list):
        return "[" + ", ".join(_inline(item) for item in value) + "]"
    return compact(value, inf_nan_mode="constants").decode()


def from_json(text: str, file: str = "<json>") -> Deck:
    """The deck of a JSON text; raises DeckError for what is no JSON, has a key twice, or breaks the schema."""
    try:
        document = json.loads(text, object_pairs_hook=_unique, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        raise _refusal(
            file, f"no JSON: {error.msg}", Range(error.lineno, error.colno, error.lineno, error.colno)
        ) from error
    except RecursionError as error:
        raise _refusal(file, "nested too deeply", START) from error
    except ValueError as error:
        raise _refusal(file, str(error), START) from error

    @cache
    def found() -> dict[DocumentPath, Range]:
        return places(text)

    def locate(path: DocumentPath) -> Range:
        known = found()
        return next((known[path[:n]] for n in range(len(path), -1, -1) if path[:n] in known), START)

    return from_document(document, file, locate)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) != len(pairs):
        seen: set[str] = set()
        twice = next(key for key, _ in pairs if key in seen or seen.add(key))  # type: ignore[func-returns-value]
        raise ValueError(f"the key {twice!r} stands twice in one object")
    return values


def _no_constant(name: str) -> None:
    raise ValueError(f"{name} is no JSON number: a deck holds finite numbers only")


def _refusal(file: str, message: str, place: Range) -> DeckError:
    return DeckError([Diagnostic(file, DOC001.code, DOC001.slug, DOC001.severity, message, *place)])
