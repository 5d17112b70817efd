"""The differences of two decks for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

import numpy as np
from rich.text import Text

from mudline.cli.console import console, say
from mudline.cli.options import View
from mudline.comparison.model import Difference, Value
from mudline.comparison.spans import spans_of, text_of
from mudline.linting.output.visible import visible

MOST = 20
"""Lines of a group; the rest is counted, unless all are asked for."""

_NUMBERED = ("nodes", "elements")
_FEW = 4
_MARKS = {"added": ("+", "green"), "removed": ("-", "red"), "changed": ("~", "yellow")}


def print_differences(before: str, after: str, found: Sequence[Difference], view: View) -> None:
    """The differences by group, then how many there are."""
    say(console(view.color), _lines(before, after, found, view))


def _lines(before: str, after: str, found: Sequence[Difference], view: View) -> Iterator[Text]:
    if found and not view.quiet:
        yield Text(visible(f"--- {before}"), style="bold")
        yield Text(visible(f"+++ {after}"), style="bold")
    for group, members in groupby(found, key=lambda one: one.group):
        differences = list(members)
        yield Text(visible(group), style="cyan")
        if group in _NUMBERED and not view.verbose:
            runs, differences = _runs(group, differences)
            yield from runs
        most = len(differences) if view.verbose else MOST
        for one in differences[:most]:
            mark, style = _MARKS[one.kind]
            yield Text(f"  {mark} {visible(_told(one))}", style=style)
        if len(differences) > most:
            yield Text(f"  and {len(differences) - most} more (-v shows all)")
    if not view.quiet:
        count = f"{len(found)} difference{'' if len(found) == 1 else 's'}"
        yield Text(count if found else "no difference")


def _runs(group: str, differences: Sequence[Difference]) -> tuple[list[Text], list[Difference]]:
    """Nodes or elements that only one deck has, as ranges of numbers where they are many; and the other differences."""
    lines: list[Text] = []
    left = list(differences)
    for kind in ("removed", "added"):
        numbers = [number for one in differences if one.kind == kind and (number := _number(one)) is not None]
        if len(numbers) >= _FEW:
            mark, style = _MARKS[kind]
            text = f"  {mark} {text_of(spans_of(np.array(numbers, dtype=np.int64)))}: {len(numbers)} {group}"
            lines.append(Text(text, style=style))
            left = [one for one in left if one.kind != kind or _number(one) is None]
    return lines, left


def _number(one: Difference) -> int | None:
    """The number of a node or an element; None for one with a label."""
    last = one.where.rpartition("/")[2]
    return int(last) if last.lstrip("-").isdecimal() else None


def _told(one: Difference) -> str:
    path = one.where.removeprefix(f"{one.group}/")
    if one.kind == "changed":
        values = f": {_value(one.before)} -> {_value(one.after)}"
    else:
        value = one.after if one.kind == "added" else one.before
        values = "" if value is None else f": {_value(value)}"
    return path + values + _places(one)


def _places(one: Difference) -> str:
    lines = [f"{side}{line}" for side, line in (("-", one.before_line), ("+", one.after_line)) if line is not None]
    return f"  (line {' '.join(lines)})" if lines else ""


def _value(value: Value) -> str:
    if isinstance(value, list):
        return "(" + ", ".join(map(_value, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)
