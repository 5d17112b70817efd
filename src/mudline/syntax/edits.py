"""Changes of a text: replacements of spans, applied all at once; untouched text keeps its bytes."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, replace

from mudline.diagnostics import Span
from mudline.syntax.source import Source

_LONE_LF = re.compile(r"(?<!\r)\n")


@dataclass(frozen=True, slots=True)
class TextEdit:
    """Put `text` in the place of `span`, offsets of the text before any edit; an empty span inserts."""

    span: Span
    text: str


class OverlapError(ValueError):
    """Two edits that want the same characters."""

    def __init__(self, first: TextEdit, second: TextEdit) -> None:
        self.first = first
        self.second = second
        super().__init__(f"edits overlap: {tuple(first.span)} and {tuple(second.span)}")


def apply_edits(text: str, edits: Iterable[TextEdit]) -> str:
    """The text with all edits made; their texts are taken literally.

    Edits may come in any order. Insertions at one place keep theirs, and stand before a replacement that begins there.
    Raises OverlapError, or ValueError for a span that does not lie in the text.
    """
    pieces: list[str] = []
    at = 0
    before: TextEdit | None = None
    for edit in sorted(edits, key=lambda edit: edit.span):
        start, end = edit.span
        if not 0 <= start <= end <= len(text):
            raise ValueError(f"an edit of {tuple(edit.span)} does not lie in a text of {len(text)} characters")
        if before is not None and start < at:
            raise OverlapError(before, edit)
        pieces += (text[at:start], edit.text)
        at, before = end, edit
    pieces.append(text[at:])
    return "".join(pieces)


def with_line_ends(source: Source, edits: Iterable[TextEdit]) -> list[TextEdit]:
    """The edits with every LF that they bring turned into the line end of the nearest line before (CRLF stays)."""
    return [
        replace(edit, text=_LONE_LF.sub(line_end_before(source, edit.span.start), edit.text))
        if "\n" in edit.text
        else edit
        for edit in edits
    ]


def line_end_before(source: Source, offset: int) -> str:
    """The end of the last line that ends before an offset, of the first line where there is none; LF by default."""
    starts = source.line_starts
    line = max(bisect_right(starts, offset) - 1, 1)
    if line == len(starts):
        return "\n"
    end = starts[line]
    return "\r\n" if source.text[end - 2 : end] == "\r\n" else source.text[end - 1]


def edited_text(source: Source, edits: Iterable[TextEdit]) -> str:
    """The text of a source with edits whose lines end with LF made in its own line ends. Raises as `apply_edits`."""
    return apply_edits(source.text, with_line_ends(source, edits))


def edited_bytes(source: Source, edits: Iterable[TextEdit]) -> bytes:
    """`edited_text` in the encoding of the file, with its byte-order mark if it had one: untouched bytes stay.

    Raises as `apply_edits`, and UnicodeEncodeError where an edit brings a character that the encoding lacks.
    """
    return source.to_bytes(edited_text(source, edits))
