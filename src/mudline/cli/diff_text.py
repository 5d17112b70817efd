"""The differences of decks as text for people."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby

import numpy as np

from mudline.cli.diff_folders import Folders, Status
from mudline.cli.view import View
from mudline.comparison.model import Difference, Value, spans_of, text_of
from mudline.comparison.superseded import Comparison
from mudline.linting.output import visible
from mudline.short_repr import counted

MOST = 20
"""Lines of a group; the rest is counted, unless all are asked for."""

_NUMBERED = ("nodes", "elements")
_FEW = 4
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}
_OF_DECKS = {
    Status.ADDED: ("+", "green", "only in the second folder"),
    Status.REMOVED: ("-", "red", "only in the first folder"),
    Status.FAILED: ("!", "red", "cannot be compared"),
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
            ranges, differences = as_ranges(group, differences)
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
        yield counts_of(folders.counts)


def counts_of(counts: Mapping[Status, int]) -> str:
    """How many decks of two folders are in each state, without those in which none is."""
    words = {**{status: status.value for status in Status}, Status.FAILED: "cannot be compared"}
    parts = [f"{counts[status]} {words[status]}" for status in Status if counts[status]]
    return f"{counted(sum(counts.values()), 'deck')}: {', '.join(parts)}" if parts else "no deck was compared"


def summary_of(comparison: Comparison) -> str:
    """How many differences there are, and how many of spelling."""
    found, spelling = (len(part) for part in comparison)
    if not spelling:
        return counted(found, "difference") if found else "no difference"
    beside = f"{counted(spelling, 'difference')} of spelling in superseded keywords"
    return f"{counted(found, 'difference')}, and {beside} (--strict lists them)" if found else f"equivalent: {beside}"


def as_ranges(group: str, differences: Sequence[Difference]) -> tuple[list[tuple[str, str]], list[Difference]]:
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


def path_in_group(one: Difference) -> str:
    """What differs, without the name of its group."""
    return one.where.removeprefix(f"{one.group}/")


def _described(one: Difference) -> str:
    path = path_in_group(one)
    if one.kind == "changed":
        values = f": {value_text(one.before)} -> {value_text(one.after)}"
    else:
        value = one.after if one.kind == "added" else one.before
        values = "" if value is None else f": {value_text(value)}"
    return path + values + _places(one)


def _places(one: Difference) -> str:
    lines = [f"{side}{line}" for side, line in (("-", one.before_line), ("+", one.after_line)) if line is not None]
    return f"  (line {' '.join(lines)})" if lines else ""


def value_text(value: Value) -> str:
    """A value as people read it."""
    if isinstance(value, list):
        return "(" + ", ".join(map(value_text, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)
