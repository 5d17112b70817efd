"""Where the values of a JSON text stand, by their paths."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from functools import cached_property
from json import JSONDecoder

from mudline.deck.faults import DocumentPath
from mudline.deck.model import Range
from mudline.syntax.source import Source

_BLANKS = " \t\r\n"
_decode = JSONDecoder().raw_decode


class JsonPlaces:
    """Finds places in a text that is JSON.

    What stands before a path is passed over by the decoder, which is as fast as reading it; what was found is kept.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.keys: dict[int, tuple[dict[str, int], Iterator[tuple[str, int]]]] = {}
        self.items: dict[int, tuple[array[int], Iterator[int]]] = {}
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

    def _below(self, at: int, part: str | int) -> int | None:
        """Where a value in an object or a list begins."""
        if self.text[at] == "{" and isinstance(part, str):
            return self._value(at, part)
        if self.text[at] == "[" and isinstance(part, int):
            return self._item(at, part)
        return None

    def _value(self, at: int, wanted: str) -> int | None:
        if at not in self.keys:
            self.keys[at] = {}, self._members(at)
        known, further = self.keys[at]
        while wanted not in known:
            key, start = next(further, ("", -1))
            if start < 0:
                return None
            known[key] = start
        return known[wanted]

    def _item(self, at: int, wanted: int) -> int | None:
        if at not in self.items:
            self.items[at] = array("q"), self._starts(at)
        known, further = self.items[at]
        while len(known) <= wanted:
            start = next(further, -1)
            if start < 0:
                return None
            known.append(start)
        return known[wanted]

    def _members(self, at: int) -> Iterator[tuple[str, int]]:
        """Keys of an object, and where their values begin."""
        at = self._skipped(at + 1)
        while self.text[at] != "}":
            key, at = _decode(self.text, at)
            at = self._skipped(self._skipped(at) + 1)
            yield key, at
            at = self._next(at)

    def _starts(self, at: int) -> Iterator[int]:
        """Where the values of a list begin."""
        at = self._skipped(at + 1)
        while self.text[at] != "]":
            yield at
            at = self._next(at)

    def _next(self, at: int) -> int:
        """Behind a value and its comma."""
        at = self._skipped(_decode(self.text, at)[1])
        return self._skipped(at + 1) if self.text[at] == "," else at

    def _skipped(self, at: int) -> int:
        while self.text[at] in _BLANKS:
            at += 1
        return at
