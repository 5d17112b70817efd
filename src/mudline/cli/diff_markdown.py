"""The differences of decks as Markdown for a merge request: headings, tables, what is long folded away.

All text of a deck stands in code, where neither GitHub nor GitLab makes links, mentions or HTML of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from itertools import groupby, islice

from mudline.cli.diff_folders import ComparedDeck, Folders, Status
from mudline.cli.diff_text import as_ranges, counts_of, path_in_group, summary_of, value_text
from mudline.cli.view import View
from mudline.comparison.model import Difference, Value
from mudline.comparison.superseded import Comparison
from mudline.linting.output import visible
from mudline.short_repr import counted, cut

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
    head = f"### Differences of decks\n\n{code(before)} → {code(after)}: **{summary_of(comparison)}**\n"
    return _limited(head, _groups(comparison.differences), view)


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
    head = (
        f"### Differences of decks\n\n{code(folders.before)} → {code(folders.after)}: **{counts_of(folders.counts)}**\n"
    )
    if rows:
        head += f"\n| deck | result |\n| --- | --- |\n{''.join(rows)}"
    if differing > len(rows):
        head += f"\nand {counted(differing - len(rows), 'deck')} more that differ\n"
    return _limited(head, sections, view)


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
        return f"cannot be compared: {code(one.why)}"
    if one.status is Status.CHANGED:
        return counted(len(one.comparison.differences), "difference")
    return f"**{one.status.value}**"


def _groups(differences: Sequence[Difference]) -> Iterator[str]:
    """A table for each group; long ones and long values folded away, each a piece of its own."""
    for group, members in groupby(differences, key=lambda one: one.group):
        ranges, others = as_ranges(group, list(members))
        rows = [f"| {kind} | {code(text)} | | | |\n" for kind, text in ranges]
        rows += map(_row, others)
        for start in range(0, len(rows), _AT_ONCE):
            some = rows[start : start + _AT_ONCE]
            more = " (continued)" if start else ""
            table = _HEAD + "".join(some)
            if len(rows) > _FOLDED:
                yield folded_away(f"{_in_html(group)}{more}: {counted(len(some), 'row')}", table)
            else:
                yield f"\n**{code(group)}**\n\n{table}"
        yield from (piece for one in others for piece in _long_values(one))


_AT_ONCE = 200
"""Rows of a table: one that does not fit is left out whole."""


def folded_away(summary: str, content: str) -> str:
    """Content that is shown when its summary, which is HTML, is clicked on."""
    return f"\n<details>\n<summary>{summary}</summary>\n\n{content}\n</details>\n"


def _row(one: Difference) -> str:
    if one.kind == "changed":
        values = [_cell(one.before), _cell(one.after)]
    else:
        values = ["" if value is None else _cell(value) for value in (one.before, one.after)]
    lines = [f"{side}{line}" for side, line in (("-", one.before_line), ("+", one.after_line)) if line is not None]
    return f"| {one.kind} | {code(path_in_group(one))} | {values[0]} | {values[1]} | {' '.join(lines)} |\n"


def _cell(value: Value) -> str:
    text = value_text(value)
    if len(text) <= _CELL:
        return code(text)
    return f"{_size(value)}, below" if isinstance(value, list) else f"{code(cut(text, _CELL))}"


def _size(value: list[Value]) -> str:
    return counted(len(value), "point" if all(isinstance(each, list) for each in value) else "value")


def _long_values(one: Difference) -> Iterator[str]:
    """The points of curves and other long lists, one below the other."""
    for side, value in (("before", one.before), ("after", one.after)):
        if isinstance(value, list) and len(value_text(value)) > _CELL:
            items = (", ".join(map(value_text, each)) if isinstance(each, list) else value_text(each) for each in value)
            lines = [visible(item) for item in islice(items, _AT_ONCE)]
            if len(value) > _AT_ONCE:
                lines.append(f"and {len(value) - _AT_ONCE} more")
            what = f"{_in_html(path_in_group(one))} {side}: {_size(value)}"
            yield folded_away(what, fenced("\n".join(lines)))


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
