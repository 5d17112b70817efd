"""Where the values of a JSON text stand, by their paths."""

from __future__ import annotations

from array import array
from json import JSONDecoder

from mudline.deck.faults import DocumentPath
from mudline.deck.model import Range
from mudline.syntax.source import Source

_BLANKS = " \t\r\n"
_decode = JSONDecoder().raw_decode


class JsonPlaces:
    """Finds places in a text that is JSON.

    What stands beside a path is passed over by the decoder, which is as fast as reading it; what was found is kept.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.source = Source("", text)
        self.keys: dict[int, dict[str, int]] = {}
        self.items: dict[int, array[int]] = {}

    def locate(self, path: DocumentPath) -> Range:
        """The place of a path, or of the nearest thing around it."""
        at = self._skipped(0)
        for part in path:
            below = self._below(at, part)
            if below is None:
                break
            at = below
        end: int = _decode(self.text, at)[1]
        return Range(*self.source.position(at), *self.source.position(end))

    def _below(self, at: int, part: str | int) -> int | None:
        """Where a value in an object or a list begins."""
        if self.text[at] == "{" and isinstance(part, str):
            if at not in self.keys:
                self.keys[at] = self._object(at)
            return self.keys[at].get(part)
        if self.text[at] == "[" and isinstance(part, int):
            if at not in self.items:
                self.items[at] = self._list(at)
            found = self.items[at]
            return found[part] if part < len(found) else None
        return None

    def _object(self, at: int) -> dict[str, int]:
        found: dict[str, int] = {}
        at = self._skipped(at + 1)
        while self.text[at] != "}":
            key, at = _decode(self.text, at)
            found[key] = at = self._skipped(self._skipped(at) + 1)
            at = self._next(at)
        return found

    def _list(self, at: int) -> array[int]:
        found = array("q")
        at = self._skipped(at + 1)
        while self.text[at] != "]":
            found.append(at)
            at = self._next(at)
        return found

    def _next(self, at: int) -> int:
        """Behind a value and its comma."""
        at = self._skipped(_decode(self.text, at)[1])
        return self._skipped(at + 1) if self.text[at] == "," else at

    def _skipped(self, at: int) -> int:
        while self.text[at] in _BLANKS:
            at += 1
        return at
