"""The differences of decks for people: as text, and as Markdown for a merge request.

In Markdown there are headings and tables, and what is long is folded away. All text of a deck stands in code, where
neither GitHub nor GitLab makes links, mentions or HTML of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from html import escape
from itertools import groupby, islice

import numpy as np

from mudline.cli.diff_folders import ComparedDeck, Folders, Status
from mudline.cli.view import View
from mudline.comparison.model import Difference, Value, spans_of, text_of
from mudline.comparison.superseded import Comparison
from mudline.linting.output import visible
from mudline.short_repr import counted, cut

# ----------------------------------------------------------------------------------------------------------------- text

MOST = 20
"""Lines of a group; the rest is counted, unless all are asked for."""

_NUMBERED = ("nodes", "elements")
_FEW = 4
_NOT_COMPARED = "cannot be compared"
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}
_OF_DECKS = {
    Status.ADDED: ("+", "green", "only in the second folder"),
    Status.REMOVED: ("-", "red", "only in the first folder"),
    Status.FAILED: ("!", "red", _NOT_COMPARED),
}


def difference_lines(before: str, after: str, comparison: Comparison, view: View) -> Iterator[str | tuple[str, str]]:
    """The differences of two decks by group: lines, with their styles if they have any."""
    found = comparison.differences
    if found and not view.quiet:
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
        most = len(differences) if view.verbose else MOST
        for one in differences[:most]:
            mark, style = _MARKS[one.kind]
            yield f"  {mark} {visible(_described(one))}", style
        if len(differences) > most:
            yield f"  and {len(differences) - most} more (-v shows all)"


def folder_lines(folders: Folders, view: View) -> Iterator[str | tuple[str, str]]:
    """The differences of the decks of two folders, then how many decks differ."""
    for one in folders.compared():
        if one.status is Status.CHANGED:
            yield from difference_lines(one.before, one.after, one.comparison, replace(view, quiet=False))
        elif one.status is Status.EQUAL:
            if view.verbose:
                yield visible(f"= {one.name}: {summary_of(one.comparison)}")
        else:
            mark, style, words = _OF_DECKS[one.status]
            yield visible(f"{mark} {one.name}: {words}"), style
    if not view.quiet:
        yield _counts_of(folders.counts)


def _counts_of(counts: Mapping[Status, int]) -> str:
    """How many decks of two folders are in each state, without those in which none is."""
    words = {**{status: status.value for status in Status}, Status.FAILED: _NOT_COMPARED}
    parts = [f"{counts[status]} {words[status]}" for status in Status if counts[status]]
    return f"{counted(sum(counts.values()), 'deck')}: {', '.join(parts)}" if parts else "no deck was compared"


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


def _path_in_group(one: Difference) -> str:
    """What differs, without the name of its group."""
    return one.where.removeprefix(f"{one.group}/")


def _described(one: Difference) -> str:
    path = _path_in_group(one)
    if one.kind == "changed":
        values = f": {_value_text(one.before)} -> {_value_text(one.after)}"
    else:
        value = one.after if one.kind == "added" else one.before
        values = "" if value is None else f": {_value_text(value)}"
    return path + values + _places(one)


def _places(one: Difference) -> str:
    lines = _lines(one)
    return f"  (line {lines})" if lines else ""


def _lines(one: Difference) -> str:
    """The lines of a difference in the two decks, as `-12 +14`."""
    lines = ((side, line) for side, line in (("-", one.before_line), ("+", one.after_line)) if line is not None)
    return " ".join(f"{side}{line}" for side, line in lines)


def _value_text(value: Value) -> str:
    """A value as people read it."""
    if isinstance(value, list):
        return "(" + ", ".join(map(_value_text, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)


# ------------------------------------------------------------------------------------------------------------- Markdown

LONGEST = 60_000
"""Characters of all: a comment on GitHub holds 65,536. What is beyond is counted, unless all is asked for."""

_FOLDED = 12
"""Rows of a group from which on its table is folded away."""
_CELL = 100
"""Characters of a value in a table; a longer one is folded away below it."""
_DECKS = 200
"""Decks in the table of those that differ."""
_HEAD = "| | what | before | after | lines |\n| --- | --- | --- | --- | --- |\n"
_UNSAFE = re.compile(r"[^\w ]", re.ASCII)


def of_decks(before: str, after: str, comparison: Comparison, view: View) -> list[str]:
    """The differences of two decks."""
    return _limited(_head(before, after, summary_of(comparison)), _groups(comparison.differences), view)


def of_folders(folders: Folders, view: View) -> list[str]:
    """The differences of the decks of two folders: how many, a table of the decks, and each of them."""
    rows: list[str] = []
    sections: list[str] = []
    kept = differing = 0
    for one in folders.compared():
        if one.status is Status.EQUAL:
            continue
        differing += 1
        if view.verbose or len(rows) < _DECKS:
            rows.append(f"| {code(one.name)} | {_result(one)} |\n")
        if one.status is Status.CHANGED:
            for section in (f"\n#### {code(one.name)}\n", *_groups(one.comparison.differences)):
                if view.verbose or kept <= LONGEST:  # what is beyond is not printed
                    sections.append(section)
                    kept += len(section)
    head = _head(folders.before, folders.after, _counts_of(folders.counts))
    if rows:
        head += f"\n| deck | result |\n| --- | --- |\n{''.join(rows)}"
    if differing > len(rows):
        head += f"\nand {counted(differing - len(rows), 'deck')} more that differ\n"
    return _limited(head, sections, view)


def _head(before: str, after: str, summary: str) -> str:
    return f"### Differences of decks\n\n{code(before)} → {code(after)}: **{summary}**\n"


def _limited(head: str, pieces: Iterable[str], view: View) -> list[str]:
    """The head, and the pieces as far as they fit."""
    found = [head]
    left = LONGEST - len(head)
    for piece in pieces:
        left -= len(piece)
        if left < 0 and not view.verbose:
            found.append("\n*The rest does not fit here: `mudline diff -v` prints all.*\n")
            break
        found.append(piece)
    return found


def _result(one: ComparedDeck) -> str:
    if one.status is Status.FAILED:
        return f"{_NOT_COMPARED}: {code(one.why)}"
    if one.status is Status.CHANGED:
        return counted(len(one.comparison.differences), "difference")
    return f"**{one.status.value}**"


def _groups(differences: Sequence[Difference]) -> Iterator[str]:
    """A table for each group; long ones and long values folded away, each a piece of its own."""
    for group, members in groupby(differences, key=lambda one: one.group):
        ranges, others = _as_ranges(group, list(members))
        rows = [f"| {kind} | {code(text)} | | | |\n" for kind, text in ranges]
        rows += map(_row, others)
        for start in range(0, len(rows), _AT_ONCE):
            some = rows[start : start + _AT_ONCE]
            more = " (continued)" if start else ""
            table = _HEAD + "".join(some)
            if len(rows) > _FOLDED:
                yield _folded_away(f"{_in_html(group)}{more}: {counted(len(some), 'row')}", table)
            else:
                yield f"\n**{code(group)}**\n\n{table}"
        yield from (piece for one in others for piece in _long_values(one))


_AT_ONCE = 200
"""Rows of a table: one that does not fit is left out whole."""


def _folded_away(summary: str, content: str) -> str:
    """Content that is shown when its summary, which is HTML, is clicked on."""
    return f"\n<details>\n<summary>{summary}</summary>\n\n{content}\n</details>\n"


def _row(one: Difference) -> str:
    if one.kind == "changed":
        values = [_cell(one.before), _cell(one.after)]
    else:
        values = ["" if value is None else _cell(value) for value in (one.before, one.after)]
    return f"| {one.kind} | {code(_path_in_group(one))} | {values[0]} | {values[1]} | {_lines(one)} |\n"


def _cell(value: Value) -> str:
    text = _value_text(value)
    if len(text) <= _CELL:
        return code(text)
    return f"{_size(value)}, below" if isinstance(value, list) else f"{code(cut(text, _CELL))}"


def _size(value: list[Value]) -> str:
    return counted(len(value), "point" if all(isinstance(each, list) for each in value) else "value")


def _long_values(one: Difference) -> Iterator[str]:
    """The points of curves and other long lists, one below the other."""
    for side, value in (("before", one.before), ("after", one.after)):
        if isinstance(value, list) and len(_value_text(value)) > _CELL:
            items = (
                ", ".join(map(_value_text, each)) if isinstance(each, list) else _value_text(each) for each in value
            )
            lines = [visible(item) for item in islice(items, _AT_ONCE)]
            if len(value) > _AT_ONCE:
                lines.append(f"and {len(value) - _AT_ONCE} more")
            what = f"{_in_html(_path_in_group(one))} {side}: {_size(value)}"
            yield _folded_away(what, fenced("\n".join(lines)))


# ------------------------------------------------------------------------------------------------------------- escapes


def code(text: str) -> str:
    """A text as code within a line or a cell of a table."""
    shown = visible(text)
    if not shown.strip():
        return f"`{shown}`" if shown else ""
    if "|" in shown or "`" in shown:  # renderers do not agree on what stands for them in a code span of a table
        return _in_html(shown)
    return f"`{shown}`"


def _in_html(text: str) -> str:
    """The same in HTML, in which no character has a meaning in Markdown."""
    return f"<code>{_UNSAFE.sub(_reference, visible(text))}</code>"


def _reference(found: re.Match[str]) -> str:
    """A character other than a letter or a digit as a reference to it."""
    char = found[0]
    return f"&#{ord(char)};" if char.isascii() else escape(char)


def fenced(text: str) -> str:
    """Lines as they are, in a fence longer than any in them."""
    longest = max((len(run) for run in re.findall(r"`+", text)), default=0)
    fence = "`" * max(3, longest + 1)
    return f"{fence}text\n{text}\n{fence}\n"
