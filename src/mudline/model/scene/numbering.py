"""Numbered objects of a deck, nodes or elements: later definitions win, numbers lead to indices, indices to lines."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Where
from mudline.language.keywords.table import LARGEST_WHOLE

Ids = NDArray[np.int64]
Indices = NDArray[np.intp]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


_AT_ONCE = 1 << 17
_NO_VALUES = np.zeros((0, 0))


def blocks_of(count: int) -> Iterator[slice]:
    """Return slices of at most some thousand rows, which limit the size of temporary arrays."""
    return (slice(start, min(start + _AT_ONCE, count)) for start in range(0, count, _AT_ONCE))


def whole_numbers(column: Floats) -> tuple[Ids, Mask]:
    """Return a column of a table as whole numbers, and a mask of rows with one; other rows are 0."""
    known = np.abs(column) <= LARGEST_WHOLE
    known &= column == np.floor(column)
    return np.where(known, column, 0.0).astype(np.int64), known


class DefinitionBatch(NamedTuple):
    """Definitions that were given together: rows of a table, or all of one generator (`table` "").

    `rows` are their places in the table.
    """

    ids: Ids
    values: Floats
    where: Where
    table: str = ""
    rows: Indices | range = range(0)

    def place(self, index: int) -> Where:
        """Return the place of a definition of the batch."""
        return self.where.inside(self.table, int(self.rows[index])) if self.table else self.where


@dataclass(slots=True, repr=False, eq=False)
class Definitions:
    """Definitions in the order of the file, numbered through as rows."""

    batches: list[DefinitionBatch] = field(default_factory=list)
    generated: int = 0
    _starts: list[int] = field(default_factory=lambda: [0])
    _rows: dict[int, int] = field(default_factory=dict)
    _indexed: int = 0

    __repr__ = short_repr

    def add(self, batch: DefinitionBatch) -> None:
        """Add a batch."""
        self.batches.append(batch)
        self._starts.append(self._starts[-1] + len(batch.ids))
        self.generated += 0 if batch.table else len(batch.ids)

    def find(self, number: int) -> Floats | None:
        """Return the values of the current definition of a number."""
        for batch in range(self._indexed, len(self.batches)):
            rows = range(self._starts[batch], self._starts[batch + 1])
            self._rows.update(zip(self.batches[batch].ids.tolist(), rows, strict=True))
        self._indexed = len(self.batches)
        row = self._rows.get(number)
        if row is None:
            return None
        batch = bisect_right(self._starts, row) - 1
        values: Floats = self.batches[batch].values[row - self._starts[batch]]
        return values

    def resolve(self, width: int) -> Numbered:
        """Return the valid definitions, in the order in which their numbers first appear, and those given twice.

        `width` is the number of values of a definition.
        """
        ids = np.concatenate([np.zeros(0, dtype=np.int64), *(batch.ids for batch in self.batches)])
        values = np.concatenate([np.zeros((0, width)), *(batch.values for batch in self.batches)])
        order = np.argsort(ids, kind="stable")
        ends = np.ones(len(ids) + 1, dtype=np.bool_)
        ends[1:-1] = np.diff(ids[order]) > 0
        firsts, lasts = order[ends[:-1]], order[ends[1:]]
        appearing = np.argsort(firsts)
        firsts, lasts = firsts[appearing], lasts[appearing]
        starts = np.array(self._starts, dtype=np.intp)
        batches = [batch._replace(values=_NO_VALUES) for batch in self.batches]  # they keep no memory of their own
        return Numbered(ids[firsts], values[lasts], firsts, lasts, np.sort(order[~ends[:-1]]), starts, batches)


@dataclass(slots=True, repr=False, eq=False)
class Numbered:
    """Numbers and values of the valid definitions; indices of definitions count all rows of the file.

    ids: the numbers.
    values: their values.
    firsts: first definition of each number.
    rows: valid definition of each number.
    repeats: definitions after another one of their number.
    starts: first row of each batch.
    batches: the batches of definitions.
    """

    ids: Ids
    values: Floats
    firsts: Indices
    rows: Indices
    repeats: Indices
    starts: Indices
    batches: list[DefinitionBatch]
    _order: Indices = field(init=False)
    _ordered: Ids = field(init=False)

    __repr__ = short_repr

    def __post_init__(self) -> None:
        self._order = np.argsort(self.ids)
        self._ordered = self.ids[self._order]

    def __len__(self) -> int:
        return len(self.ids)

    def where(self, index: int) -> Where:
        """Return the place of the valid definition of an index."""
        return self.where_row(int(self.rows[index]))

    def where_row(self, row: int) -> Where:
        """Return the place of a definition."""
        batch = int(self.batches_of(row))
        return self.batches[batch].place(row - int(self.starts[batch]))

    def batches_of(self, rows: Indices | int) -> Indices:
        """Return the batches that definitions belong to."""
        return self.starts.searchsorted(rows, side="right") - 1

    def indices(self, ids: Ids) -> Indices:
        """Return indices of numbers, -1 for those not defined."""
        if not len(self.ids):
            return np.full(ids.shape, -1, dtype=np.intp)
        at = np.minimum(self._ordered.searchsorted(ids), len(self.ids) - 1)
        return np.where(self._ordered[at] == ids, self._order[at], -1)

    def between(self, start: int, end: int, step: int) -> Indices:
        """Return indices of the numbers start, start + step, ... up to end, in ascending order."""
        within = slice(self._ordered.searchsorted(start), self._ordered.searchsorted(end, side="right"))
        return np.sort(self._order[within][(self._ordered[within] - start) % step == 0])


def picked(values: Iterable[float], index: Indices) -> Floats:
    """Return the value of each index; NaN for -1."""
    return np.array([*values, np.nan], dtype=np.float64)[index]


def marked(flags: Iterable[bool], index: Indices) -> Mask:
    """Return the flag of each index; False for -1."""
    return np.array([*flags, False], dtype=np.bool_)[index]


def at_nodes(of_element: Indices, element_nodes: Indices, nodes: int) -> Indices:
    """Return for each node the last block, by the order of the file, that one of its elements follows; -1 for none."""
    last = np.full(nodes, -1, dtype=np.intp)
    for end in element_nodes.T:
        np.maximum.at(last, end, of_element)
    return last


def summed(values: Floats, element_nodes: Indices, nodes: int) -> Floats:
    """Return the sum of the values (m,) of each node's elements."""
    total = np.zeros(nodes)
    for end in element_nodes.T:
        np.add.at(total, end, values)
    return total


def touched(elements: Mask, element_nodes: Indices, nodes: int) -> Mask:
    """Return a mask of the nodes with a marked element."""
    marked_nodes = np.zeros(nodes, dtype=np.bool_)
    marked_nodes[element_nodes[elements].ravel()] = True
    return marked_nodes
