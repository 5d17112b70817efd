"""Where the values of a JSON text stand: the text is read again, along the wanted paths only."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import NamedTuple

from mudline.deck.document_places import DocumentPath, Wanted
from mudline.deck.model import Range
from mudline.syntax.source import Source

_SPACE = re.compile(r"[ \t\r\n]*")
_VALUE = json.JSONDecoder()


class Member(NamedTuple):
    """An item of a list or an object: its index or key, and where the item with its key begins, its value, its end."""

    name: str | int
    start: int
    value: int
    end: int


class JsonPlaces:
    """Finds values in a JSON text that has been read once, so that it is well formed."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.source = Source("", text)

    def at(self, offset: int) -> Range:
        """The place of an offset."""
        return self._range(offset, offset)

    def ranges(self, wanted: Wanted) -> dict[DocumentPath, Range]:
        """The places of the values on the wanted paths, as far as there are such values."""
        start = _behind_space(self.text, 0)
        found: dict[DocumentPath, Range] = {(): self._range(start, len(self.text.rstrip()))}
        waiting: list[tuple[DocumentPath, int, Wanted]] = [((), start, wanted)] if wanted else []
        while waiting:
            path, start, below = waiting.pop()
            for member in members(self.text, start):
                if member.name in below:
                    inner = (*path, member.name)
                    found[inner] = self._range(member.value, member.end)
                    waiting.append((inner, member.value, below[member.name]))
        return found

    def _range(self, start: int, end: int) -> Range:
        return Range(*self.source.position(start), *self.source.position(end))


def members(text: str, start: int) -> Iterator[Member]:
    """The items of the list or object that begins at an offset; none for any other value."""
    if text[start : start + 1] not in ("[", "{"):
        return
    keyed = text[start] == "{"
    at = _behind_space(text, start + 1)
    index = 0
    while text[at] not in "]}":
        name: str | int = index
        value = at
        if keyed:
            name, behind = _VALUE.raw_decode(text, at)
            value = _behind_space(text, _behind_space(text, behind) + 1)
        end = _VALUE.raw_decode(text, value)[1]
        yield Member(name, at, value, end)
        index += 1
        at = _behind_space(text, end)
        at = _behind_space(text, at + 1) if text[at] == "," else at


def repeated_key(text: str) -> tuple[str, int]:
    """The first key that stands twice in its object, in a text that has one, and where it stands the second time."""
    return next(_repeated(text))


def _repeated(text: str) -> Iterator[tuple[str, int]]:
    waiting = [_behind_space(text, 0)]
    while waiting:
        seen: set[str | int] = set()
        inner: list[int] = []
        for member in members(text, waiting.pop()):
            if member.name in seen:
                yield str(member.name), member.start
            seen.add(member.name)
            inner.append(member.value)
        waiting += reversed(inner)


def _behind_space(text: str, at: int) -> int:
    found = _SPACE.match(text, at)
    return found.end() if found else at
