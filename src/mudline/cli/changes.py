"""What would change in a file, as a unified diff, in little more than linear time."""

from __future__ import annotations

import sys
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mudline.cli.streams import emit
from mudline.cli.view import View
from mudline.linting.output import visible, visible_lines
from mudline.syntax.source import Source

_CONTEXT = 3
_NO_END = "\n\\ No newline at end of file\n"
_STYLES = {"+++": "bold", "---": "bold", "@@ ": "cyan", "+": "green", "-": "red"}


class _Change(NamedTuple):
    """Lines `start` to `end` of the old text become lines `new_start` to `new_end` of the new one."""

    start: int
    end: int
    new_start: int
    new_end: int


def print_changes(old: bytes, new: bytes, name: str, view: View, *, created: bool = False) -> None:
    """Print how a file changes, coloured on a terminal; a pipe gets a patch. `created`: the file is new."""
    before, after = (Source.from_bytes(data, name).text for data in (old, new))
    lines = unified_diff(before, after, visible(name), created=created)
    if view.color == "always" or (view.color == "auto" and sys.stdout.isatty()):
        view.printer().lines((visible_lines(line.rstrip("\r\n")), _style(line)) for line in lines)
    else:
        emit(lines)


def _style(line: str) -> str:
    return next((style for mark, style in _STYLES.items() if line.startswith(mark)), "")


def unified_diff(old: str, new: str, name: str, *, created: bool = False) -> Iterator[str]:
    """The lines of a unified diff of two texts in which only LF ends a line; `created`: there was no old file."""
    before, after = _lines(old), _lines(new)
    hunks = list(_hunks(_changes(before, after)))
    if hunks:
        yield from (f"--- {'/dev/null' if created else name}\n", f"+++ {name}\n")
    for hunk in hunks:
        yield from _hunk(before, after, hunk)


def _lines(text: str) -> list[str]:
    *lines, last = text.split("\n")
    return [f"{line}\n" for line in lines] + ([last] if last else [])


def _changes(before: Sequence[str], after: Sequence[str]) -> Iterator[_Change]:
    """Lines that differ, in pairs between the lines that each text has once; blank ones in pairs with blank ones."""
    at = new_at = 0
    for following, new_following in [*_anchors(before, after), (len(before), len(after))]:
        while at < following and new_at < new_following and before[at] == after[new_at]:
            at, new_at = at + 1, new_at + 1
        end, new_end = following, new_following
        while at < end and new_at < new_end and before[end - 1] == after[new_end - 1]:
            end, new_end = end - 1, new_end - 1
        for number in range(at, end):
            paired = new_at < new_end and bool(before[number].strip()) == bool(after[new_at].strip())
            if not paired or before[number] != after[new_at]:
                yield _Change(number, number + 1, new_at, new_at + paired)
            new_at += paired
        if new_at < new_end:
            yield _Change(end, end, new_at, new_end)
        at, new_at = following, new_following


def _anchors(before: Sequence[str], after: Sequence[str]) -> list[tuple[int, int]]:
    """Where lines stand that each text has once, ascending in both; as many as there can be."""
    counts, new_counts = Counter(before), Counter(after)
    places = {line: place for place, line in enumerate(after) if new_counts[line] == 1}
    ends: list[int] = []  # where the runs of 1, 2, ... such lines end earliest in the new text
    lasts: list[int] = []  # and in the old one
    previous: dict[int, int] = {}
    for number, line in enumerate(before):
        if counts[line] == 1 and (place := places.get(line)) is not None:
            length = bisect_left(ends, place)
            previous[number] = lasts[length - 1] if length else -1
            ends[length : length + 1], lasts[length : length + 1] = [place], [number]
    found: list[tuple[int, int]] = []
    number = lasts[-1] if lasts else -1
    while number >= 0:
        found.append((number, places[before[number]]))
        number = previous[number]
    return found[::-1]


def _hunks(changes: Iterator[_Change]) -> Iterator[list[_Change]]:
    """Changes that share their context, those of neighbouring lines joined to one."""
    hunk: list[_Change] = []
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


def _hunk(before: Sequence[str], after: Sequence[str], changes: list[_Change]) -> Iterator[str]:
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
        yield mark + (line if line.endswith("\n") else line + _NO_END)
