"""What formatting changes, as a unified diff; in linear time."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mudline.deck.forms import form_of

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+")
_CONTEXT = 3
_NO_END = "\n\\ No newline at end of file\n"


class Change(NamedTuple):
    """Lines `start` to `end` of the old text become lines `new_start` to `new_end` of the new one."""

    start: int
    end: int
    new_start: int
    new_end: int


def unified_diff(old: str, new: str, name: str) -> Iterator[str]:
    """The lines of a unified diff, each with a LF; a line that ends with a CR keeps it."""
    before, after = _LINE.findall(old), _LINE.findall(new)
    changes = _line_by_line(before, after) if form_of(name) == "keyword" else _middle(before, after)
    hunks = list(_hunks(changes))
    if hunks:
        yield from (f"--- {name}\n", f"+++ {name}\n")
    for hunk in hunks:
        yield from _hunk(before, after, hunk)


def _line_by_line(before: Sequence[str], after: Sequence[str]) -> Iterator[Change]:
    """Formatting a keyword text keeps its lines in order and removes some of the blank ones."""
    at = 0
    for number, line in enumerate(before):
        if at < len(after) and bool(line.strip()) == bool(after[at].strip()):
            if line != after[at]:
                yield Change(number, number + 1, at, at + 1)
            at += 1
        else:
            yield Change(number, number + 1, at, at)


def _middle(before: Sequence[str], after: Sequence[str]) -> Iterator[Change]:
    """All between the first and the last line that differ."""
    shorter = min(len(before), len(after))
    first = next((number for number in range(shorter) if before[number] != after[number]), shorter)
    most = shorter - first
    last = next((number for number in range(most) if before[-1 - number] != after[-1 - number]), most)
    if first < max(len(before), len(after)) - last:
        yield Change(first, len(before) - last, first, len(after) - last)


def _hunks(changes: Iterator[Change]) -> Iterator[list[Change]]:
    """Changes that share their context, those of neighbouring lines joined to one."""
    hunk: list[Change] = []
    for change in changes:
        if hunk and change.start - hunk[-1].end > 2 * _CONTEXT:
            yield hunk
            hunk = []
        if hunk and change.start == hunk[-1].end and change.new_start == hunk[-1].new_end:
            hunk[-1] = hunk[-1]._replace(end=change.end, new_end=change.new_end)
        else:
            hunk.append(change)
    if hunk:
        yield hunk


def _hunk(before: Sequence[str], after: Sequence[str], changes: list[Change]) -> Iterator[str]:
    lead = min(_CONTEXT, changes[0].start)
    tail = min(_CONTEXT, len(before) - changes[-1].end)
    start, end = changes[0].start - lead, changes[-1].end + tail
    new_start, new_end = changes[0].new_start - lead, changes[-1].new_end + tail
    yield f"@@ -{_range(start, end)} +{_range(new_start, new_end)} @@\n"
    at = start
    for change in changes:
        yield from _marked(" ", before[at : change.start])
        yield from _marked("-", before[change.start : change.end])
        yield from _marked("+", after[change.new_start : change.new_end])
        at = change.end
    yield from _marked(" ", before[at:end])


def _range(start: int, end: int) -> str:
    length = end - start
    if length == 1:
        return str(start + 1)
    return f"{start + 1 if length else start},{length}"


def _marked(mark: str, lines: Sequence[str]) -> Iterator[str]:
    for line in lines:
        yield mark + line.removesuffix("\n") + ("\n" if line[-1] in "\r\n" else _NO_END)
