"""The text of an open deck: its versions, its changes, and places in the units that the editor counts in."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterator, Sequence
from itertools import count, pairwise
from pathlib import Path

import numpy as np
from lsprotocol import types
from numpy.typing import NDArray
from pygls.uris import from_fs_path, to_fs_path

from mudline.diagnostics import Span
from mudline.syntax.edits import TextEdit

LONG = 1_000_000
"""Characters of a deck from which on it is checked only when typing pauses, and its tables are left out of answers."""
LARGEST = 64_000_000
"""Characters of a deck from which on nothing is said of it."""

_LINE_END = re.compile(r"\r\n?|\n")
_SURROGATE = re.compile("[\ud800-\udfff]")
_BOM = "\ufeff"
_SHORT = 20_000
"""Characters of a text whose lines are found without arrays."""
_CHUNK = 1 << 20
_LF, _CR = b"\n\r"
_REVISIONS = count(1)
_MOST_EDITS = 1000
_MOST_COMPARED = 4000
"""Lines that are compared with each other; where more differ, they are replaced as one."""


def _valid(text: str) -> str:
    """A text in which halves of UTF-16 pairs, which no file can hold, are replacement characters."""
    return text if text.isascii() else _SURROGATE.sub("\ufffd", text)


def _ends(text: str) -> NDArray[np.int64]:
    """The offset behind each line end."""
    if len(text) < _SHORT:
        return np.fromiter((found.end() for found in _LINE_END.finditer(text)), np.int64)
    found: list[NDArray[np.int64]] = []
    for at in range(0, len(text), _CHUNK):
        letters = np.frombuffer(text[at : at + _CHUNK + 1].encode("latin-1", "replace"), np.uint8)
        ends = letters == _LF
        carriage = letters == _CR
        carriage[:-1] &= ~ends[1:]
        found.append(np.flatnonzero((ends | carriage)[: min(_CHUNK, len(text) - at)]) + (at + 1))
    return np.concatenate(found)


def units_of(text: str, encoding: str) -> int:
    """How many units a text has in a position encoding: "utf-8", "utf-16" or "utf-32"."""
    if encoding == "utf-32" or text.isascii():
        return len(text)
    if encoding == "utf-8":
        return len(text.encode())
    return len(text.encode("utf-16-le")) // 2


def characters_of(line: str, units: int, encoding: str) -> int:
    """How many characters of a line lie before a column in units; a column inside of one stands before it."""
    if units <= 0:
        return 0
    if encoding == "utf-32" or line.isascii():
        return min(units, len(line))
    if encoding == "utf-8":
        return len(line.encode()[:units].decode(errors="ignore"))
    return len(line.encode("utf-16-le")[: 2 * units].decode("utf-16-le", errors="ignore"))


class Document:
    """An open file.

    Offsets are those of the deck's source, which has no byte-order mark; `text` begins behind it, too.

    Attributes:
        uri: as the editor writes it.
        path: of the file; None for a text that is in no file.
        name: of the file, in messages and for its form.
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
        """Put another text in the place of the whole one."""
        text = _valid(text)
        self.marked = text.startswith(_BOM)
        self.text = text[1:] if self.marked else text
        self.starts: NDArray[np.int64] = np.concatenate([np.zeros(1, np.int64), _ends(self.text)])
        self.revision = next(_REVISIONS)

    def change(self, range_: types.Range, text: str) -> None:
        """Put a text in the place of a range. A range that ends before it begins is taken the other way round."""
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
        """The text as a file."""
        return self.text.encode()

    @property
    def is_long(self) -> bool:
        """Whether the text is too long to be checked at every keystroke."""
        return len(self.text) > LONG

    @property
    def is_too_large(self) -> bool:
        """Whether nothing is said of the text."""
        return len(self.text) > LARGEST

    # ---------------------------------------------------------------------------------------------------- places

    def line_at(self, offset: int) -> int:
        """The line of an offset, from 0."""
        return int(np.searchsorted(self.starts, offset, side="right")) - 1

    def line(self, number: int) -> str:
        """The text of a line (from 0) without its end; "" beyond the last one."""
        if not 0 <= number < len(self.starts):
            return ""
        return self.text[slice(*self.line_span(number))]

    def line_span(self, number: int) -> Span:
        """The place of a line (from 0) without its end."""
        start = int(self.starts[number])
        end = int(self.starts[number + 1]) if number + 1 < len(self.starts) else len(self.text)
        while end > start and self.text[end - 1] in "\r\n":
            end -= 1
        return Span(start, end)

    def offset(self, position: types.Position) -> int:
        """The offset of a position; one beyond a line or the text stands at its end."""
        if position.line >= len(self.starts):
            return len(self.text)
        span = self.line_span(position.line)
        units = position.character
        if position.line == 0 and self.marked:
            units -= units_of(_BOM, self.encoding)
        return span.start + characters_of(self.text[slice(*span)], units, self.encoding)

    def position(self, offset: int) -> types.Position:
        """The position of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line = self.line_at(offset)
        units = units_of(self.text[int(self.starts[line]) : offset], self.encoding)
        if line == 0 and self.marked:
            units += units_of(_BOM, self.encoding)
        return types.Position(line, units)

    def range(self, span: Span) -> types.Range:
        """The range of a span."""
        return types.Range(self.position(span.start), self.position(span.end))

    def point(self, line: int, column: int) -> int:
        """The offset of a line and column from 1, in characters, as diagnostics have them."""
        number = min(max(line - 1, 0), len(self.starts) - 1)
        return min(int(self.starts[number]) + column - 1, len(self.text))

    # ----------------------------------------------------------------------------------------------------- edits

    def edits(self, edits: Sequence[TextEdit]) -> list[types.TextEdit]:
        """Changes of the text as the editor makes them; of very many, neighbours are one."""
        chosen = edits if len(edits) <= _MOST_EDITS else _joined(edits)
        return [types.TextEdit(self.range(edit.span), edit.text) for edit in chosen]

    def differences(self, content: bytes) -> list[types.TextEdit]:
        """What makes the text that of a file's content, line by line."""
        return self.edits(list(differences(self.text, content.decode("utf-8-sig"))))


def differences(old: str, new: str) -> Iterator[TextEdit]:
    """The lines in which two texts differ, as changes of the old one."""
    before, after = _lines(old), _lines(new)
    first = next((i for i, (a, b) in enumerate(zip(before, after, strict=False)) if a != b), None)
    if first is None:
        first = min(len(before), len(after))
    last = 0
    while last < min(len(before), len(after)) - first and before[-1 - last] == after[-1 - last]:
        last += 1
    one, other = before[first : len(before) - last], after[first : len(after) - last]
    at = sum(map(len, before[:first]))
    if len(one) == len(other):
        for line, changed in zip(one, other, strict=True):
            if line != changed:
                yield TextEdit(Span(at, at + len(line)), changed)
            at += len(line)
    elif max(len(one), len(other)) > _MOST_COMPARED:
        yield TextEdit(Span(at, at + sum(map(len, one))), "".join(other))
    else:
        offsets = [at]
        for line in one:
            offsets.append(offsets[-1] + len(line))
        for tag, i, k, j, m in difflib.SequenceMatcher(None, one, other, autojunk=False).get_opcodes():
            if tag != "equal":
                yield TextEdit(Span(offsets[i], offsets[k]), "".join(other[j:m]))


def _joined(edits: Sequence[TextEdit]) -> list[TextEdit]:
    """Changes in which those that touch each other are one."""
    runs: list[list[TextEdit]] = []
    for edit in sorted(edits, key=lambda edit: edit.span):
        if runs and runs[-1][-1].span.end == edit.span.start:
            runs[-1].append(edit)
        else:
            runs.append([edit])
    return [TextEdit(Span(run[0].span.start, run[-1].span.end), "".join(edit.text for edit in run)) for run in runs]


def _lines(text: str) -> list[str]:
    """The lines of a text with their ends; `str.splitlines` knows more line ends than decks have."""
    edges = [0, *(found.end() for found in _LINE_END.finditer(text))]
    edges += [len(text)] if edges[-1] < len(text) else []
    return [text[start:end] for start, end in pairwise(edges)]


# --------------------------------------------------------------------------------------------------------- addresses


def file_of(uri: str) -> Path | None:
    """The file of an address; None for one that is not a file on this machine, or that cannot be read as an address."""
    if not uri.startswith("file:///") or "%00" in uri:
        return None
    try:
        path = to_fs_path(uri)
    except ValueError:
        return None
    return Path(path) if path and "\0" not in path else None


def address_of(path: Path) -> str:
    """The address of a file."""
    whole = os.path.abspath(path)  # noqa: PTH100 - links stay what they are called
    return from_fs_path(whole) or Path(whole).as_uri()


def _name_of(uri: str, language: str) -> str:
    """A name for a text that is in no file; its suffix says of which form it is."""
    name = uri.rpartition("/")[2].rpartition(":")[2][:100] or "untitled"
    return f"{name}.{language}" if language in ("json", "yaml") and not name.endswith(f".{language}") else name
