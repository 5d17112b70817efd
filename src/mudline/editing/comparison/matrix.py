"""What differs in a family of decks: a row a value, a column a deck."""

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
    """A value that is not the same in all decks: its group, its path, and what each deck has, the base first."""

    group: str
    where: str
    values: Sequence[Value]


def matrix(differences: Sequence[Sequence[Difference]]) -> list[DiffRow]:
    """Return the values that differ between a base and each of some decks, from the differences of each to the base.

    Groups stand together, in the order in which they are first met. Elements that differ otherwise in one deck than in
    another have rows of their own. What is there without a value, as a block, is "given".
    """
    base: dict[_Key, Value] = {}
    others: dict[_Key, dict[int, Value]] = {}
    for deck, found in enumerate(_apart(differences)):
        for key, one in found:
            base.setdefault(key, _there(one, "added", one.before))
            others.setdefault(key, {})[deck] = _there(one, "removed", one.after)
    rows = [
        DiffRow(*key, [before, *(others[key].get(deck, before) for deck in range(len(differences)))])
        for key, before in base.items()
    ]
    with_more = {prefix for _, where in base for prefix in accumulate(where.split("/")[:-1], "{}/{}".format)}
    order = {group: place for place, group in enumerate(dict.fromkeys(row.group for row in rows))}
    listed = [row for row in rows if row.where not in with_more or any(one not in (GIVEN, None) for one in row.values)]
    return sorted(listed, key=lambda row: order[row.group])


def _apart(differences: Sequence[Sequence[Difference]]) -> list[list[tuple[_Key, Difference]]]:
    """The differences of each deck by group and path; those of elements for parts that no deck divides further."""
    parts: dict[_Key, dict[int, list[int]]] = {}  # of a quantity: for each element its differences, by deck
    found: list[list[tuple[_Key, Difference]]] = []
    for deck, those in enumerate(differences):
        found.append([])
        for place, one in enumerate(those):
            if (match := _ELEMENTS.fullmatch(one.where)) is None:
                found[deck].append(((one.group, one.where), one))
                continue
            of_element = parts.setdefault((one.group, match[2]), {})
            for number in _numbers(match[1]):
                of_element.setdefault(number, [-1] * len(differences))[deck] = place
    for (group, path), of_element in parts.items():
        alike: dict[tuple[int, ...], list[int]] = {}
        for number, places in of_element.items():
            alike.setdefault(tuple(places), []).append(number)
        for those_places, numbers in alike.items():
            key = group, f"elements {text_of(spans_of(np.sort(np.array(numbers, np.int64))))}{path}"
            for deck, place in enumerate(those_places):
                if place >= 0:
                    found[deck].append((key, differences[deck][place]))
    return found


def _numbers(text: str) -> Iterator[int]:
    """The numbers of a text like `1-20, 25, 31-99 step 2`."""
    for first, last, step in _SPAN.findall(text):
        yield from range(int(first), int(last or first) + 1, int(step or 1))


def _there(one: Difference, absent: str, value: Value) -> Value:
    """A value; what is there without having one is "given"."""
    return GIVEN if value is None and one.kind not in (absent, "changed") else value


def matrix_table(rows: Sequence[DiffRow], names: Sequence[str]) -> DisplayTable:
    """Return the matrix for people."""

    def cell(at: int, row: DiffRow) -> Cell:
        found = "-" if row.values[at] is None else value_text(row.values[at])
        return found if at == 0 or row.values[at] == row.values[0] else (found, "yellow")

    columns = [text("value", "where")]
    columns += [text(name, partial(cell, at), whole=True) for at, name in enumerate(names)]
    return DisplayTable("", columns, rows)


def value_text(value: Value) -> str:
    """A value as people read it."""
    if isinstance(value, list):
        return "(" + ", ".join(map(value_text, value)) + ")"
    if value is None:
        return "none"
    return repr(value) if isinstance(value, float) else str(value)
