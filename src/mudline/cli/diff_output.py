"""The differences of decks for people: as text, and as Markdown for a merge request."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from enum import StrEnum
from html import escape
from itertools import groupby
from typing import NamedTuple

import numpy as np

from mudline.cli.view import View
from mudline.comparison.model import Difference, Value, spans_of, text_of
from mudline.comparison.superseded import Comparison
from mudline.limits import SHOWN_ROWS
from mudline.linting.output import visible
from mudline.short_repr import counted

_NUMBERED = ("nodes", "elements")
_FEW = 4
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}


class Status(StrEnum):
    """What a comparison says of a name; the order is that of a summary."""

    CHANGED = "changed"
    ADDED = "added"
    REMOVED = "removed"
    EQUAL = "equal"
    FAILED = "failed"


class ComparedDeck(NamedTuple):
    """A name below two folders, what became of it, and why it could not be compared, where it could not."""

    name: str
    status: Status
    before: str = ""
    after: str = ""
    comparison: Comparison = Comparison([], [])
    why: str = ""


_NOT_COMPARED = "cannot be compared"
_OF_DECKS = {
    Status.ADDED: ("+", "green", "only in the second folder"),
    Status.REMOVED: ("-", "red", "only in the first folder"),
    Status.FAILED: ("!", "red", _NOT_COMPARED),
}
Line = str | tuple[str, str]
"""A line, or a line and its style."""


def difference_lines(before: str, after: str, comparison: Comparison, view: View) -> Iterator[Line]:
    """The differences of two decks by group, under the names of the decks if they have any."""
    found = comparison.differences
    if found and before:
        yield visible(f"--- {before}"), "bold"
        yield visible(f"+++ {after}"), "bold"
    for group, members in groupby(found, key=lambda one: one.group):
        differences = list(members)
        yield visible(group), "cyan"
        if not view.verbose:
            ranges, differences = _as_ranges(group, differences)
            for kind, text in ranges:
                mark, style = _MARKS[kind]
                yield f"  {mark} {text}", style
        most = len(differences) if view.verbose else SHOWN_ROWS
        for one in differences[:most]:
            mark, style = _MARKS[one.kind]
            yield f"  {mark} {visible(_described(one))}", style
        if len(differences) > most:
            yield f"  and {len(differences) - most} more (-v shows all)"


def folder_lines(compared: Iterable[ComparedDeck], counts: Mapping[Status, int], view: View) -> Iterator[Line]:
    """The differences of the decks of two folders, then how many decks differ, of which `counts` are whole then."""
    for one in compared:
        if one.status is Status.CHANGED:
            yield from difference_lines(one.before, one.after, one.comparison, view)
        elif one.status is Status.EQUAL:
            if view.verbose:
                yield visible(f"= {one.name}: {summary_of(one.comparison)}")
        else:
            mark, style, words = _OF_DECKS[one.status]
            yield visible(f"{mark} {one.name}: {words}"), style
    if not view.quiet:
        names = {**{status: status.value for status in Status}, Status.FAILED: _NOT_COMPARED}
        parts = [f"{counts[status]} {names[status]}" for status in Status if counts[status]]
        yield f"{counted(sum(counts.values()), 'deck')}: {', '.join(parts)}" if parts else "no deck was compared"


def summary_of(comparison: Comparison) -> str:
    """How many differences there are, and how many of spelling."""
    found, spelling = (len(part) for part in comparison)
    if not spelling:
        return counted(found, "difference") if found else "no difference"
    beside = f"{counted(spelling, 'difference')} of spelling in superseded keywords"
    return f"{counted(found, 'difference')}, and {beside} (--strict lists them)" if found else f"equivalent: {beside}"


def _as_ranges(group: str, differences: Sequence[Difference]) -> tuple[list[tuple[str, str]], list[Difference]]:
    """Nodes or elements that only one deck has, where they are many: kind and ranges of numbers; and the others."""
    found: list[tuple[str, str]] = []
    left = list(differences)
    for kind in ("removed", "added") if group in _NUMBERED else ():
        numbers = [number for one in differences if one.kind == kind and (number := _number(one)) is not None]
        if len(numbers) >= _FEW:
            ranges = text_of(spans_of(np.array(numbers, dtype=np.int64)))
            found.append((kind, f"{ranges}: {len(numbers)} {group}"))
            left = [one for one in left if one.kind != kind or _number(one) is None]
    return found, left


def _number(one: Difference) -> int | None:
    """The number of a node or an element; None for one with a label."""
    last = one.where.rpartition("/")[2]
    return int(last) if last.lstrip("-").isdecimal() else None


def _described(one: Difference) -> str:
    """What differs, without the name of its group; its values, and its lines in the two decks as `-12 +14`."""
    if one.kind == "changed":
        values = f": {_value_text(one.before)} -> {_value_text(one.after)}"
    else:
        value = one.after if one.kind == "added" else one.before
        values = "" if value is None else f": {_value_text(value)}"
    numbers = (("-", one.before_line), ("+", one.after_line))
    lines = " ".join(f"{side}{line}" for side, line in numbers if line is not None)
    return one.where.removeprefix(f"{one.group}/") + values + (f"  (line {lines})" if lines else "")


def _value_text(value: Value) -> str:
    """A value as people read it."""
    if isinstance(value, list):
        return "(" + ", ".join(map(_value_text, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)


# ------------------------------------------------------------------------------------------------------------- Markdown

LONGEST = 60_000
"""Characters of all: a comment on GitHub holds 65,536. What is beyond is left out, unless all is asked for."""

_UNSAFE = re.compile(r"[^\w ]", re.ASCII)


def markdown(before: str, after: str, summary: str, lines: Iterable[Line], view: View) -> list[str]:
    """What is compared, the result, and the lines of the text, which GitHub and GitLab colour.

    All text of a deck stands in code, where neither of them makes links, mentions or HTML of it.
    """
    head = f"### Differences of decks\n\n{code(before)} → {code(after)}: **{summary}**\n"
    texts = [(line if isinstance(line, str) else line[0]).removeprefix("  ") for line in lines]
    left = LONGEST - len(head)
    kept = 0
    for text in texts:
        left -= len(text) + 1
        if left < 0 and not view.verbose:
            break
        kept += 1
    more = "" if kept == len(texts) else "\n*The rest does not fit here: `mudline diff -v` prints all.*\n"
    return [head, f"\n{fenced(texts[:kept])}" if texts else "", more]


def code(text: str) -> str:
    """A text as code within a line."""
    shown = visible(text)
    if "`" not in shown:
        return f"`{shown}`" if shown else ""
    return f"<code>{_UNSAFE.sub(_reference, shown)}</code>"


def _reference(found: re.Match[str]) -> str:
    """A character other than a letter or a digit as a reference to it, which has no meaning in Markdown."""
    char = found[0]
    return f"&#{ord(char)};" if char.isascii() else escape(char)


def fenced(lines: Sequence[str]) -> str:
    """Lines as they are, in a fence longer than any in them."""
    longest = max((len(run) for line in lines for run in re.findall(r"`+", line)), default=0)
    fence = "`" * max(3, longest + 1)
    return "\n".join([f"{fence}diff", *lines, fence, ""])
