"""Nodes and elements of two decks, by number."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.comparison.model import Difference, Tolerance, Value, plain
from mudline.comparison.side import Side
from mudline.diagnostics import Where
from mudline.keywords.table import Table
from mudline.keywords.values import Label
from mudline.scene.numbering import Floats, Indices, Numbered


def nodes(one: Side, other: Side, tolerance: Tolerance) -> Iterator[Difference]:
    """Coordinates of the nodes."""
    yield from _numbered("nodes", (one, one.scene.nodes), (other, other.scene.nodes), tolerance)
    yield from _labelled("NODE", "nodes", "nodes", one, other)


def elements(one: Side, other: Side) -> Iterator[Difference]:
    """Nodes of the elements; numbers are names here, so no tolerance holds."""
    pair = (one, one.scene.table.numbered), (other, other.scene.table.numbered)
    yield from _numbered("elements", *pair, Tolerance())
    yield from _labelled("ELEMENT", "elements", "elements", one, other)


def common(one: Numbered, other: Numbered) -> tuple[Indices, Indices]:
    """Indices in each of the numbers that both have."""
    if np.array_equal(one.ids, other.ids):
        same = np.arange(len(one.ids), dtype=np.intp)
        return same, same
    at = other.indices(one.ids)
    here = np.flatnonzero(at >= 0)
    return here, at[here]


def _numbered(
    group: str, before: tuple[Side, Numbered], after: tuple[Side, Numbered], tolerance: Tolerance
) -> Iterator[Difference]:
    (one, first), (other, second) = before, after
    here, there = common(first, second)
    differing = np.flatnonzero(~tolerance.arrays(first.values[here], second.values[there]).all(axis=1))
    for i, j in zip(here[differing].tolist(), there[differing].tolist(), strict=True):
        values = _values(group, first.values[i]), _values(group, second.values[j])
        lines = one.line(first.where(i)), other.line(second.where(j))
        yield Difference("changed", group, f"{group}/{first.ids[i]}", *values, *lines)
    for i in np.flatnonzero(second.indices(first.ids) < 0).tolist():
        where, line = f"{group}/{first.ids[i]}", one.line(first.where(i))
        yield Difference("removed", group, where, _values(group, first.values[i]), None, line, None)
    for j in np.flatnonzero(first.indices(second.ids) < 0).tolist():
        where, line = f"{group}/{second.ids[j]}", other.line(second.where(j))
        yield Difference("added", group, where, None, _values(group, second.values[j]), None, line)


def _values(group: str, row: Floats) -> Value:
    """Coordinates of a node, or the whole numbers of an element's nodes."""
    values = [plain(value) for value in row.tolist()]
    return [int(value) if group == "elements" and isinstance(value, float) else value for value in values]


def _labelled(keyword: str, table: str, group: str, one: Side, other: Side) -> Iterator[Difference]:
    """Rows with a {label}, which have no place among the numbers."""
    first, second = _label_rows(one, keyword, table), _label_rows(other, keyword, table)
    for key in sorted(first.keys() - second.keys()):
        cells, where = first[key]
        yield Difference("removed", group, f"{group}/{cells[0]}", cells, None, one.line(where), None)
    for key in sorted(second.keys() - first.keys()):
        cells, where = second[key]
        yield Difference("added", group, f"{group}/{cells[0]}", None, cells, None, other.line(where))


def _label_rows(side: Side, keyword: str, name: str) -> dict[tuple[str, ...], tuple[list[Value], Where]]:
    found: dict[tuple[str, ...], tuple[list[Value], Where]] = {}
    for where, block in side.scene.deck.blocks(keyword):
        for index, entry in enumerate(block.entries):
            table = getattr(entry, name, None)
            if not isinstance(table, Table):
                continue
            rows = sorted({row for (row, _), word in table.words.items() if isinstance(word, Label)})
            for row in rows:
                numbers = enumerate(table.values[row, : table.lengths[row]].tolist())
                cells: list[Value] = [table.words.get((row, column)) or plain(number) for column, number in numbers]
                key = tuple(str(cell).casefold() for cell in cells)
                found[key] = (cells, where._replace(path=("entries", index, name, row)))
    return found
