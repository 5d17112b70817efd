"""Differences within a family of decks: a row for each value, a column for each deck."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import accumulate

import numpy as np

from mudline.basics.display import Cell, DisplayTable, text
from mudline.editing.comparison.model import Difference, Value, spans_of, text_of

MATRIX_FORMAT = "mudline-diff-matrix/1"
GIVEN = "given"
_ELEMENTS = re.compile(r"elements ([-\d, step]+)(/.*)")
_SPAN = re.compile(r"(-?\d+)(?:-(-?\d+))?(?: step (\d+))?")
_Key = tuple[str, str]
"""Group and path of a value."""


@dataclass(frozen=True, slots=True)
class DiffRow:
    """A value that differs between decks: its group, its path, and its value in each deck, the base first."""

    group: str
    where: str
    values: Sequence[Value]


def matrix(differences: Sequence[Sequence[Difference]]) -> list[DiffRow]:
    """Return the values that differ between a base and other decks, from the differences of each deck to the base.

    Groups are kept together, in the order of their first value. Elements that differ in different ways in several decks
    have separate rows. Something that exists without a value, such as a block, is "given".
    """
    base: dict[_Key, Value] = {}
    others: dict[_Key, dict[int, Value]] = {}
    for deck, of_deck in enumerate(_apart(differences)):
        for key, difference in of_deck:
            base.setdefault(key, _there(difference, "added", difference.before))
            others.setdefault(key, {})[deck] = _there(difference, "removed", difference.after)
    rows = [
        DiffRow(*key, [before, *(others[key].get(deck, before) for deck in range(len(differences)))])
        for key, before in base.items()
    ]
    with_more = {prefix for _, where in base for prefix in accumulate(where.split("/")[:-1], "{}/{}".format)}
    order = {group: place for place, group in enumerate(dict.fromkeys(row.group for row in rows))}
    listed = [
        row for row in rows if row.where not in with_more or any(each not in (GIVEN, None) for each in row.values)
    ]
    return sorted(listed, key=lambda row: order[row.group])


def _apart(differences: Sequence[Sequence[Difference]]) -> list[list[tuple[_Key, Difference]]]:
    """Return the differences of each deck by group and path; ranges of elements are divided so that all decks agree."""
    parts: dict[_Key, dict[int, list[int]]] = {}  # by quantity and element: the index of its difference in each deck
    keyed: list[list[tuple[_Key, Difference]]] = []
    for deck, deck_differences in enumerate(differences):
        keyed.append([])
        for place, difference in enumerate(deck_differences):
            if (match := _ELEMENTS.fullmatch(difference.where)) is None:
                keyed[deck].append(((difference.group, difference.where), difference))
                continue
            of_element = parts.setdefault((difference.group, match[2]), {})
            for number in _numbers(match[1]):
                of_element.setdefault(number, [-1] * len(differences))[deck] = place
    for (group, path), of_element in parts.items():
        alike: dict[tuple[int, ...], list[int]] = {}
        for number, places in of_element.items():
            alike.setdefault(tuple(places), []).append(number)
        for common_places, numbers in alike.items():
            key = group, f"elements {text_of(spans_of(np.sort(np.array(numbers, np.int64))))}{path}"
            for deck, place in enumerate(common_places):
                if place >= 0:
                    keyed[deck].append((key, differences[deck][place]))
    return keyed


def _numbers(text: str) -> Iterator[int]:
    """Yield the numbers in a text such as `1-20, 25, 31-99 step 2`."""
    for first, last, step in _SPAN.findall(text):
        yield from range(int(first), int(last or first) + 1, int(step or 1))


def _there(difference: Difference, absent: str, value: Value) -> Value:
    """Return a value; "given" for something that exists without a value."""
    return GIVEN if value is None and difference.kind not in (absent, "changed") else value


def matrix_table(rows: Sequence[DiffRow], names: Sequence[str]) -> DisplayTable:
    """Return the matrix for people."""

    def cell(at: int, row: DiffRow) -> Cell:
        shown = "-" if row.values[at] is None else value_text(row.values[at])
        return shown if at == 0 or row.values[at] == row.values[0] else (shown, "yellow")

    columns = [text("value", "where")]
    columns += [text(name, partial(cell, at), whole=True) for at, name in enumerate(names)]
    return DisplayTable("", columns, rows)


def value_text(value: Value) -> str:
    """Return a value as people read it."""
    if isinstance(value, list):
        return "(" + ", ".join(map(value_text, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)
