"""Text of an open deck: its versions, its changes, and places in the units of the editor."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable
from itertools import count, pairwise, takewhile
from pathlib import Path

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray
from pygls.uris import from_fs_path, to_fs_path

from mudline.basics.limits import LARGEST_AT_ONCE, LARGEST_OPEN
from mudline.language.diagnostics import Span

_LINE_END = re.compile(r"\r\n?|\n")
_SURROGATE = re.compile("[\ud800-\udfff]")
_BOM = "\ufeff"
_REVISIONS = count(1)


def _valid(text: str) -> str:
    """Return a text in which halves of UTF-16 pairs, which no file can hold, are replacement characters."""
    return text if text.isascii() else _SURROGATE.sub("\ufffd", text)


def _ends(text: str) -> NDArray[np.int64]:
    """Return the offset after each line end."""
    return np.fromiter((match.end() for match in _LINE_END.finditer(text)), np.int64)


def units_of(text: str, encoding: str) -> int:
    """Return the number of units of a text in a position encoding: "utf-8", "utf-16" or "utf-32"."""
    if encoding == "utf-32" or text.isascii():
        return len(text)
    if encoding == "utf-8":
        return len(text.encode())
    return len(text.encode("utf-16-le")) // 2


def characters_of(line: str, units: int, encoding: str) -> int:
    """Return the number of characters before a column in units; a column inside a character counts as before it."""
    if units <= 0:
        return 0
    if encoding == "utf-32" or line.isascii():
        return min(units, len(line))
    if encoding == "utf-8":
        return len(line.encode()[:units].decode(errors="ignore"))
    return len(line.encode("utf-16-le")[: 2 * units].decode("utf-16-le", errors="ignore"))


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

    def __init__(self, uri: str, text: str, version: int, language: str = "", encoding: str = "utf-16") -> None:
        self.uri = uri
        self.path = file_of(uri)
        self.name = self.path.as_posix() if self.path else _name_of(uri, language)
        self.version = version
        self.encoding = encoding
        self.replace(text)

    def replace(self, text: str) -> None:
        """Replace the whole text."""
        text = _valid(text)
        self.marked = text.startswith(_BOM)
        self.text = text[1:] if self.marked else text
        self.starts: NDArray[np.int64] = np.concatenate([np.zeros(1, np.int64), _ends(self.text)])
        self.revision = next(_REVISIONS)

    def change(self, range_: types.Range, text: str) -> None:
        """Replace a range by a text. A range that ends before it begins is reversed."""
        start, end = sorted((self.offset(range_.start), self.offset(range_.end)))
        text = _valid(text)
        starts = self.starts
        first, last = self.line_at(max(start - 1, 0)), self.line_at(end)
        begin = int(starts[first])
        stop = int(starts[last + 1]) if last + 1 < len(starts) else len(self.text)
        piece = self.text[begin:start] + text + self.text[end:stop]
        ends = begin + _ends(piece)
        if last + 1 < len(starts) and len(ends) and ends[-1] == begin + len(piece):
            ends = ends[:-1]
        behind = starts[last + 1 :] + (len(piece) - (stop - begin))
        self.starts = np.concatenate([starts[: first + 1], ends, behind])
        self.text = self.text[:begin] + piece + self.text[stop:]
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
        return int(np.searchsorted(self.starts, offset, side="right")) - 1

    def line(self, number: int) -> str:
        """Return the text of a line (from 0) without its end; "" beyond the last line."""
        if not 0 <= number < len(self.starts):
            return ""
        return self.text[slice(*self.line_span(number))]

    def line_span(self, number: int) -> Span:
        """Return the span of a line (from 0) without its end."""
        start = int(self.starts[number])
        end = int(self.starts[number + 1]) if number + 1 < len(self.starts) else len(self.text)
        while end > start and self.text[end - 1] in "\r\n":
            end -= 1
        return Span(start, end)

    def offset(self, position: types.Position) -> int:
        """Return the offset of a position; a position beyond a line or the text counts as its end."""
        if position.line >= len(self.starts):
            return len(self.text)
        span = self.line_span(position.line)
        units = position.character
        if position.line == 0 and self.marked:
            units -= units_of(_BOM, self.encoding)
        return span.start + characters_of(self.text[slice(*span)], units, self.encoding)

    def position(self, offset: int) -> types.Position:
        """Return the position of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line = self.line_at(offset)
        units = units_of(self.text[int(self.starts[line]) : offset], self.encoding)
        if line == 0 and self.marked:
            units += units_of(_BOM, self.encoding)
        return types.Position(line, units)

    def range(self, span: Span) -> types.Range:
        """Return the range of a span."""
        return types.Range(self.position(span.start), self.position(span.end))

    def point(self, line: int, column: int) -> int:
        """Return the offset of a line and column from 1, in characters, as diagnostics have them."""
        number = min(max(line - 1, 0), len(self.starts) - 1)
        return min(int(self.starts[number]) + column - 1, len(self.text))

    # ----------------------------------------------------------------------------------------------------- edits

    def difference(self, content: bytes) -> list[types.TextEdit]:
        """Return the edit that gives a file's content: one change from the first to the last differing line."""
        old, new = _lines(self.text), _lines(content.decode("utf-8-sig"))
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


def _lines(text: str) -> list[str]:
    """Return the lines of a text with their ends; `str.splitlines` knows more line ends than decks have."""
    edges = [0, *(match.end() for match in _LINE_END.finditer(text)), len(text)]
    return [text[start:end] for start, end in pairwise(edges)]


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
