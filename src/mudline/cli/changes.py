"""New content of a file: written, printed, or shown as a unified diff."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from difflib import Match, SequenceMatcher

from mudline.checks.output import visible, visible_lines
from mudline.cli.inputs import Input, Inputs
from mudline.cli.streams import emit, emit_deck
from mudline.cli.view import View
from mudline.language.syntax.source import Source

_LONG = 2000
"""Lines from which on texts with equally many lines are compared in pairs, as the search for moved lines takes long."""
_NO_END = "\n\\ No newline at end of file\n"
_STYLES = {"+++": "bold", "---": "bold", "@@ ": "cyan", "+": "green", "-": "red"}


def deliver(
    inputs: Inputs, file: Input, old: bytes, new: bytes, view: View, *, check: str = "", diff: bool = False
) -> bool:
    """Write the new content to the file, or print it for standard input.

    With `check`, only name the file under that word; with `diff`, show a diff. Return False for a file that could not
    be written, which is reported.
    """
    if file.path is None and not (check or diff):
        emit_deck(new)
    elif new != old:
        if check:
            emit([f"{check}: {file.name}\n"])
        if diff:
            print_changes(old, new, file.name, view)
        return bool(check) or diff or inputs.replaced(file, old, new)
    return True


def print_changes(old: bytes, new: bytes, name: str, view: View, *, created: bool = False) -> None:
    """Print the changes of a file, coloured on a terminal, as a patch for a pipe. `created`: the file is new."""
    before, after = (Source.from_bytes(data, name).text for data in (old, new))
    lines = unified_diff(before, after, visible(name), created=created)
    if view.color == "always" or (view.color == "auto" and sys.stdout.isatty()):
        styles = ((line, next((_STYLES[mark] for mark in _STYLES if line.startswith(mark)), "")) for line in lines)
        view.lines([(visible_lines(line.rstrip("\r\n")), style)] for line, style in styles)
    else:
        emit(lines)


def unified_diff(old: str, new: str, name: str, *, created: bool = False) -> Iterator[str]:
    """Yield the lines of a unified diff of two texts in which only LF ends a line; `created`: there was no old file."""
    before, after = _lines(old), _lines(new)
    matcher = _Matcher(before, after)
    if before != after:
        yield from (f"--- {'/dev/null' if created else name}\n", f"+++ {name}\n")
        for hunk in matcher.get_grouped_opcodes():
            (_, start, _, new_start, _), (_, _, end, _, new_end) = hunk[0], hunk[-1]
            yield f"@@ -{_range(start, end)} +{_range(new_start, new_end)} @@\n"
            for kind, first, last, new_first, new_last in hunk:
                if kind == "equal":
                    yield from _marked(" ", before[first:last])
                else:
                    yield from _marked("-", before[first:last])
                    yield from _marked("+", after[new_first:new_last])


class _Matcher(SequenceMatcher[str]):
    """Matcher that compares long texts with equally many lines line by line, in linear time."""

    def __init__(self, old: Sequence[str], new: Sequence[str]) -> None:
        self.old, self.new = old, new
        super().__init__(None, old, new, autojunk=False)

    def get_matching_blocks(self) -> list[Match]:
        """Return the blocks of equal lines."""
        size = len(self.old)
        if size != len(self.new) or size < _LONG:
            return super().get_matching_blocks()
        matches = [Match(size, size, 0)]
        for i in range(size - 1, -1, -1):
            if self.old[i] == self.new[i]:
                joined = matches[-1].a == i + 1 and matches[-1].size
                matches[-1:] = [Match(i, i, matches[-1].size + 1)] if joined else [matches[-1], Match(i, i, 1)]
        return matches[::-1]


def _lines(text: str) -> list[str]:
    *lines, last = text.split("\n")
    return [f"{line}\n" for line in lines] + ([last] if last else [])


def _range(start: int, end: int) -> str:
    length = end - start
    if length == 1:
        return str(start + 1)
    return f"{start + 1 if length else start},{length}"


def _marked(mark: str, lines: Sequence[str]) -> Iterator[str]:
    for line in lines:
        yield mark + (line if line.endswith("\n") else line + _NO_END)
