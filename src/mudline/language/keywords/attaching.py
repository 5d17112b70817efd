"""Assignment of comments, and of lines that are passed through unchanged, to the records that contain them."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace
from operator import attrgetter
from typing import NamedTuple

from mudline.language.codes.fields import SYN002, SYN003, SYN015
from mudline.language.codes.lines import SYN001, SYN004, SYN005
from mudline.language.diagnostics import Problem, Severity, Span
from mudline.language.keywords.grammar import ROW, Content
from mudline.language.keywords.parsed import ParsedRecord
from mudline.language.keywords.text import reads_as_name


class Between(NamedTuple):
    """Comment or `kept` line between other lines; `text` is that of a comment without its C."""

    position: int
    text: str
    span: Span
    kept: bool = False


_Held = tuple[int, Between]
"""Index of the item that follows a line in its record, and the line."""


def attach(comments: Sequence[Between], kept: Sequence[Between], block: ParsedRecord) -> list[str]:
    """Add each comment to the innermost record with lines on both sides of it, before the item that follows.

    A kept line is added to the innermost record that can keep it and begins before it; so is a comment that follows a
    kept line there. Returns the texts of the comments behind the last line of the block: they belong to the next block.
    """
    trailing: list[str] = []
    whole = _Places(block)
    held: dict[int, tuple[ParsedRecord, list[_Held]]] = {}
    for line in sorted(kept):
        path = whole.path(line.position, within=False)
        while len(path) > 1 and "unread" not in path[-1].record.part.model_fields:
            path.pop()
        _hold(held, path[-1], line)
        for places in path:
            places.record.reach(line.position)
    for comment in comments:
        if block.last is not None and comment.position < block.last:
            _hold(held, whole.path(comment.position, within=True)[-1], comment)
        else:
            trailing.append(comment.text)
    for record, lines in held.values():  # settings may be written in another order than read
        _write(record, sorted(lines))
    return trailing


def _hold(held: dict[int, tuple[ParsedRecord, list[_Held]]], places: _Places, line: Between) -> None:
    record = places.record
    held.setdefault(id(record), (record, []))[1].append((places.index(line.position), line))


def _write(record: ParsedRecord, lines: list[_Held]) -> None:
    """Add the lines of a record to its values: comments, then all lines from the first kept one on."""
    kept_before = -1
    for before, line in lines:
        kept_before = before if line.kept else kept_before
        if kept_before == before:
            texts = [each.removesuffix("\r") for each in line.text.removesuffix("\n").split("\n")]
            texts = texts if line.kept else [f"C{line.text}"]
            record.values.setdefault("unread", []).extend({"before": before, "text": text} for text in texts)
        else:
            record.values.setdefault("comments", []).append({"before": before, "text": line.text})


class _Places:
    """Positions for comments and kept lines in a record, in tables that are computed once for all lines."""

    def __init__(self, record: ParsedRecord) -> None:
        self.record = record
        self.within = sorted(
            (child for children in record.children.values() for child in children if child.last is not None),
            key=attrgetter("first"),
        )
        self.starts = [child.first for child in self.within]
        self.inner: dict[int, _Places] = {}
        self.items = sorted(record.items, key=attrgetter("position"))
        self.positions = [item.position for item in self.items]
        self.count = 0
        self.before: dict[tuple[int, int], int] = {}
        for item in sorted(record.items, key=attrgetter("order", "position")):
            self.before.setdefault((item.order, item.position), self.count)
            self.count += item.size

    def path(self, position: int, *, within: bool) -> list[_Places]:
        """Return this record and the inner ones that begin before a position and, if `within`, end behind it."""
        at = bisect_left(self.starts, position) - 1
        if at < 0 or (within and (self.within[at].last or 0) <= position):
            return [self]
        if at not in self.inner:
            self.inner[at] = _Places(self.within[at])
        return [self, *self.inner[at].path(position, within=within)]

    def index(self, position: int) -> int:
        """Return the index, in order of writing, of the first item behind a position, else the number of items."""
        at = bisect_right(self.positions, position)
        if at == len(self.items):
            return self.count
        return self.before[self.items[at].order, self.items[at].position]


_OF_OTHER_FORMS = frozenset({SYN001, SYN002, SYN003, SYN004, SYN005})
"""Faults that a line of an unknown form may cause."""
_KEPT = "; the line is passed through unchanged"


def of_other_form(
    text: str, problems: Sequence[Problem], contents: Sequence[Content], *, tabular: bool
) -> set[Content]:
    """Return the lines of an open block that have an unknown form; lines with a certain fault are not among them.

    Certain faults are a number with a wrong letter, too few or too many numbers, an empty value, and any fault of a
    table.
    """
    starts = [content.span.start for content in contents]
    possible: set[Content] = set()
    certain: set[Content] = set()
    for problem in problems:
        at = bisect_right(starts, problem.span.start) - 1 if problem.span else -1
        if at < 0 or (tabular and contents[at].type == ROW):
            continue
        if problem.code is SYN015:
            certain.add(contents[at])
        elif problem.weight is Severity.ERROR and _may_be(problem, text, contents[at]):
            possible.add(contents[at])
    return possible - certain


def _may_be(problem: Problem, text: str, content: Content) -> bool:
    span = problem.span
    if problem.code not in _OF_OTHER_FORMS or span is None or span.start >= content.span.end:
        return False
    written = text[slice(*span)]
    if problem.code is SYN002:
        return written[:1].isalpha() and reads_as_name(written)
    if problem.code is SYN003 and content.type == ROW:
        return any(reads_as_name(field.strip()) for field in written.split(","))
    return problem.code is not SYN003 or bool(written.partition("=")[2].strip()) or "=" not in written


def doubtful(problems: Sequence[Problem]) -> list[Problem]:
    """Return the problems of unknown words in kept lines: a warning for a word that may be misspelt, else an info."""
    return [
        problem
        if problem.weight is not Severity.ERROR
        else replace(
            problem,
            message=problem.message + _KEPT,
            severity=Severity.WARNING if problem.repair else Severity.INFO,
        )
        for problem in problems
        if problem.code is SYN005 or (problem.code is SYN004 and problem.repair)
    ]
