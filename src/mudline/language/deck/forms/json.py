"""A deck to JSON and back."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cached_property
from json import JSONDecoder
from typing import Any

from pydantic_core import to_json as compact

from mudline.language.deck.document import decoded, from_document, to_document
from mudline.language.deck.faults import refusal
from mudline.language.deck.model import Deck, Range
from mudline.language.diagnostics import DeckError
from mudline.language.keywords.faults import DocumentPath, path_text
from mudline.language.keywords.table import Table
from mudline.language.syntax.source import Source

_HALF_PAIR = re.compile(r"[\ud800-\udfff]")


def to_json(deck: Deck) -> str:
    """The deck as JSON text: a line for each value, rows of a table on one line."""
    return "".join(_pretty(to_document(deck), "")) + "\n"


write = to_json  # as `dump` knows it


def _pretty(value: Any, indent: str) -> Iterator[str]:
    inner = f"{indent} "
    if isinstance(value, dict) and value:
        mark = "{\n"
        for key, item in value.items():
            yield f"{mark}{inner}{json.dumps(key, ensure_ascii=False)}: "
            yield from _pretty(item, inner)
            mark = ",\n"
        yield f"\n{indent}}}"
    elif isinstance(value, Table) and len(value):
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
    if isinstance(value, list | Table):
        return f"[{_cells(value)}]" if isinstance(value, list) else "[]"
    return compact(value, inf_nan_mode="constants").decode()


def _cells(row: list[Any]) -> str:
    return ", ".join(map(_inline, row))


def read(data: bytes, file: str) -> Deck:
    """The deck of a file's content; raises DeckError for what is not JSON, has a key twice, or breaks the schema."""
    text = decoded(data, file, "JSON")
    try:
        document = json.loads(text, object_pairs_hook=_unique, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        place = Range(error.lineno, error.colno, error.lineno, error.colno)
        raise refusal(file, f"not valid JSON: {error.msg}", place) from error
    except RecursionError as error:
        raise refusal(file, "nested too deeply: is this a deck?") from error
    except _UnfitError as error:
        raise refusal(file, str(error)) from error
    except ValueError as error:  # what is left is that Python reads no whole number of so many digits
        raise _too_long(text, file) from error
    places = JsonPlaces(text)
    if "\\ud" in text or "\\uD" in text:
        _refuse_half_pairs(document, file, places)
    return from_document(document, file, places.locate)


class _UnfitError(ValueError):
    """The text is JSON, but holds what a deck does not."""


_LONG = re.compile(r"-?[0-9]{1000,}")


def _too_long(text: str, file: str) -> DeckError:
    """A whole number with more digits than Python reads: the first with the most of them."""
    longest = max(_LONG.finditer(text), key=lambda number: number.end() - number.start(), default=None)
    start, end = longest.span() if longest else (0, 0)
    place = Range(*Source("", text).position(start), *Source("", text).position(end))
    return refusal(file, f"a whole number of {end - start} digits is too large", place)


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
            raise refusal(file, f"{path_text(path)}: \\uD800 to \\uDFFF are valid in pairs only", places.locate(path))


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for key, value in pairs:
        if key in values:
            raise _UnfitError(f"the key {key!r} is given twice in one object")
        values[key] = value
    return values


def _no_constant(name: str) -> None:
    raise _UnfitError(f"{name} is not a JSON number: a deck holds finite numbers only")


_BLANKS = " \t\r\n"
_decode = JSONDecoder().raw_decode


class JsonPlaces:
    """Finds places in a text that is JSON.

    What stands before a path is passed over by the decoder, which is as fast as reading it; what was found is kept.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.found: dict[int, tuple[dict[str | int, int], Iterator[tuple[str | int, int]]]] = {}
        self.ends: dict[int, int] = {}

    @cached_property
    def _source(self) -> Source:
        return Source("", self.text)

    def locate(self, path: DocumentPath) -> Range:
        """The place of a path, or of the nearest thing around it."""
        at = self._skipped(0)
        for part in path:
            below = self._below(at, part)
            if below is None:
                break
            at = below
        if at not in self.ends:
            self.ends[at] = _decode(self.text, at)[1]
        return Range(*self._source.position(at), *self._source.position(self.ends[at]))

    def _below(self, at: int, wanted: str | int) -> int | None:
        """Return the index at which a value in an object or a list begins."""
        if at not in self.found:
            self.found[at] = {}, self._values(at)
        known, further = self.found[at]
        while wanted not in known:
            if (value := next(further, None)) is None:
                return None
            known[value[0]] = value[1]
        return known[wanted]

    def _values(self, at: int) -> Iterator[tuple[str | int, int]]:
        """Yield the keys of an object, or the indices of a list, and where their values begin."""
        end = {"{": "}", "[": "]"}.get(self.text[at])
        at, index = self._skipped(at + 1) if end else at, 0
        while end and self.text[at] != end:
            key: str | int = index
            if end == "}":
                key, at = _decode(self.text, at)
                at = self._skipped(self._skipped(at) + 1)
            yield key, at
            index += 1
            at = self._skipped(_decode(self.text, at)[1])
            at = self._skipped(at + 1) if self.text[at] == "," else at

    def _skipped(self, at: int) -> int:
        while self.text[at] in _BLANKS:
            at += 1
        return at
