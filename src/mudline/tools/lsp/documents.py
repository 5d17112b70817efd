"""Text of an open deck: its versions, its changes, and places in the units of the editor."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from itertools import count, takewhile
from pathlib import Path

from lsprotocol import types
from pygls.uris import from_fs_path, to_fs_path

from mudline.basics.limits import LARGEST_AT_ONCE, LARGEST_OPEN
from mudline.language.diagnostics import Span
from mudline.language.syntax.source import Source

_SURROGATE = re.compile("[\ud800-\udfff]")
_BOM = "\ufeff"
_REVISIONS = count(1)


def _valid(text: str) -> str:
    """Return a text in which halves of UTF-16 pairs, which no file can hold, are replacement characters."""
    return text if text.isascii() else _SURROGATE.sub("\ufffd", text)


def units_of(text: str) -> int:
    """Return the number of UTF-16 units of a text, in which editors count columns."""
    return len(text) if text.isascii() else len(text.encode("utf-16-le")) // 2


def characters_of(line: str, units: int) -> int:
    """Return the number of characters before a column in units; a column inside a character counts as before it."""
    return len(line.encode("utf-16-le")[: 2 * max(units, 0)].decode("utf-16-le", errors="ignore"))


class OpenDocument:
    """An open file.

    Offsets are those of the deck's source, which has no byte-order mark; `text` has none either.

    Attributes:
        uri: address as written by the editor.
        path: path of the file; None for a text that is in no file.
        name: name of the file, in messages and for its form.
        version: the editor's number of the text.
        revision: a number that no other text has in this process.
    """

    def __init__(self, uri: str, text: str, version: int, language: str = "") -> None:
        self.uri = uri
        self.path = file_of(uri)
        self.name = self.path.as_posix() if self.path else _name_of(uri, language)
        self.version = version
        self.replace(text)

    def replace(self, text: str) -> None:
        """Replace the whole text."""
        text = _valid(text)
        self.marked = text.startswith(_BOM)
        self._take(text[1:] if self.marked else text)

    def change(self, range_: types.Range, text: str) -> None:
        """Replace a range by a text. A range that ends before it begins is reversed."""
        start, end = sorted((self.offset(range_.start), self.offset(range_.end)))
        self._take(self.text[:start] + _valid(text) + self.text[end:])

    def _take(self, text: str) -> None:
        self.text = text
        self.source = Source(self.name, text)
        self.revision = next(_REVISIONS)

    def as_file(self) -> bytes:
        """Return the text as the bytes of a file."""
        return self.text.encode()

    @property
    def is_long(self) -> bool:
        """True if the text is too long to be read between two keystrokes."""
        return len(self.text) > LARGEST_AT_ONCE

    @property
    def is_too_large(self) -> bool:
        """True if the text is too long to be checked at all."""
        return len(self.text) > LARGEST_OPEN

    # ---------------------------------------------------------------------------------------------------- places

    def line_at(self, offset: int) -> int:
        """Return the line of an offset, from 0."""
        return self.source.position(offset)[0] - 1

    def offset(self, position: types.Position) -> int:
        """Return the offset of a position; a position beyond a line or the text counts as its end."""
        if position.line >= len(self.source.line_starts):
            return len(self.text)
        span = self.source.line_span(position.line + 1)
        units = position.character - (self.marked and position.line == 0)
        return span.start + characters_of(self.text[slice(*span)], units)

    def position(self, offset: int) -> types.Position:
        """Return the position of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line, column = self.source.position(offset)
        units = units_of(self.text[offset - column + 1 : offset])
        return types.Position(line - 1, units + (self.marked and line == 1))

    def range(self, span: Span) -> types.Range:
        """Return the range of a span."""
        return types.Range(self.position(span.start), self.position(span.end))

    def point(self, line: int, column: int) -> int:
        """Return the offset of a line and column from 1, in characters, as diagnostics have them."""
        return min(self.source.offset(min(line, len(self.source.line_starts)), column), len(self.text))

    # ----------------------------------------------------------------------------------------------------- edits

    def difference(self, content: bytes) -> list[types.TextEdit]:
        """Return the edit that gives a file's content: one change from the first to the last differing line."""
        old, new = self.source.lines(), Source(self.name, content.decode("utf-8-sig")).lines()
        first = _same(zip(old, new, strict=False))
        last = _same(zip(reversed(old[first:]), reversed(new[first:]), strict=False))
        start = sum(map(len, old[:first]))
        replaced, text = "".join(old[first : len(old) - last]), "".join(new[first : len(new) - last])
        if replaced == text:
            return []
        return [types.TextEdit(self.range(Span(start, start + len(replaced))), text)]


def _same(pairs: Iterable[tuple[str, str]]) -> int:
    """Return the number of pairs of equal lines before the first unequal pair."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))


# --------------------------------------------------------------------------------------------------------- addresses


def file_of(uri: str) -> Path | None:
    """Return the file of an address; None for an invalid address, or anything but a file on this machine."""
    if not uri.startswith("file:///") or "%00" in uri:
        return None
    try:
        path = to_fs_path(uri)
    except ValueError:
        return None
    return Path(path) if path and "\0" not in path else None


def address_of(path: Path) -> str:
    """Return the address of a file."""
    whole = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    return from_fs_path(whole) or Path(whole).as_uri()


def _name_of(uri: str, language: str) -> str:
    """Return a name for a text that is in no file; its suffix gives the form."""
    name = uri.rpartition("/")[2].rpartition(":")[2][:100] or "untitled"
    return f"{name}.{language}" if language in ("json", "yaml") and not name.endswith(f".{language}") else name
