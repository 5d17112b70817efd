"""Numbered things of a deck, nodes or elements: later definitions win, numbers lead to indices, indices to lines."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Where
from mudline.short_repr import short_repr

Ids = NDArray[np.int64]
Indices = NDArray[np.intp]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

MOST_GENERATED = 10_000_000
"""Nodes or elements that the GEN= lines of a deck may make together: a slip of a digit must not fill the memory."""

LARGEST = 2**53
"""The largest whole number that a field may hold."""

_FEW = 4096


def whole_numbers(column: Floats) -> tuple[Ids, Mask]:
    """A column of a table as whole numbers, and where it holds one; what could not be read is 0."""
    known = np.abs(column) <= LARGEST
    known &= column == np.floor(column)
    return np.where(known, column, 0.0).astype(np.int64), known


@dataclass(frozen=True, slots=True)
class Batch:
    """Definitions that stand together: rows of a table, or all of one generator (`table` "").

    `rows` are their places in the table; None stands for all of them in order.
    """

    ids: Ids
    values: Floats
    where: Where
    table: str = ""
    rows: Indices | None = None

    __repr__ = short_repr

    def place(self, index: int) -> Where:
        """Where a definition of the batch stands."""
        if not self.table:
            return self.where
        row = index if self.rows is None else int(self.rows[index])
        return self.where._replace(path=(*self.where.path, self.table, row))


@dataclass(slots=True)
class Gathered:
    """Definitions in the order of the file, numbered through as rows."""

    batches: list[Batch] = field(default_factory=list)
    generated: int = 0
    _starts: list[int] = field(default_factory=lambda: [0])
    _indexed: int = 0
    _ids: Ids = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    _rows: Indices = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    _recent: dict[int, int] = field(default_factory=dict)

    __repr__ = short_repr

    def add(self, batch: Batch) -> None:
        """Take in a batch."""
        self.batches.append(batch)
        self._starts.append(self._starts[-1] + len(batch.ids))
        self.generated += 0 if batch.table else len(batch.ids)

    def find(self, number: int) -> Floats | None:
        """The values of the definition of a number that holds so far."""
        self._index()
        row = self._recent.get(number)
        if row is None and len(self._ids):
            at = int(np.searchsorted(self._ids, number))
            row = int(self._rows[at]) if at < len(self._ids) and self._ids[at] == number else None
        if row is None:
            return None
        batch = bisect_right(self._starts, row) - 1
        values: Floats = self.batches[batch].values[row - self._starts[batch]]
        return values

    def _index(self) -> None:
        """Take in the batches added since: into a dictionary, and when that grows, into a sorted table of all."""
        first, self._indexed = self._indexed, len(self.batches)
        pending = self._starts[-1] - self._starts[first] + len(self._recent)
        if pending <= max(_FEW, len(self._ids)):
            for batch in range(first, len(self.batches)):
                ids = self.batches[batch].ids.tolist()
                self._recent.update(zip(ids, range(self._starts[batch], self._starts[batch + 1]), strict=True))
            return
        ids = np.concatenate([batch.ids for batch in self.batches])
        order = np.argsort(ids, kind="stable")
        last = np.append(np.flatnonzero(np.diff(ids[order])), len(ids) - 1)
        self._rows = order[last]
        self._ids = ids[self._rows]
        self._recent = {}

    def settle(self, width: int) -> Numbered:
        """The definitions that hold, in the order in which their numbers first appear, and those given twice.

        `width` is the number of values of a definition.
        """
        ids = np.concatenate([batch.ids for batch in self.batches] or [np.zeros(0, dtype=np.int64)])
        values = np.concatenate([batch.values for batch in self.batches] or [np.zeros((0, width))])
        starts = np.array(self._starts, dtype=np.intp)
        if (np.diff(ids) > 0).all():
            rows = np.arange(len(ids), dtype=np.intp)
            return Numbered(ids, values, rows, rows, rows[:0], starts, self.batches, (rows, ids))
        order = np.argsort(ids, kind="stable")
        new = np.append(True, np.diff(ids[order]) > 0)
        begins = np.flatnonzero(new)
        firsts = order[begins]
        lasts = order[np.append(begins[1:], len(ids)) - 1]
        appearing = np.argsort(firsts)
        repeats = np.sort(order[~new])
        firsts, lasts = firsts[appearing], lasts[appearing]
        return Numbered(ids[firsts], values[lasts], firsts, lasts, repeats, starts, self.batches)


@dataclass(slots=True)
class Numbered:
    """Numbers and values of the definitions that hold.

    `firsts` and `rows` say which definition of a number is the first and which one holds, `repeats` which ones come
    after another of their number; all count the rows of all definitions of the file.
    """

    ids: Ids
    values: Floats
    firsts: Indices
    rows: Indices
    repeats: Indices
    starts: Indices
    batches: list[Batch]
    _order: tuple[Indices, Ids] | None = None

    __repr__ = short_repr

    def __len__(self) -> int:
        return len(self.ids)

    def where(self, index: int) -> Where:
        """Where the definition that holds for an index stands."""
        return self.where_row(int(self.rows[index]))

    def where_row(self, row: int) -> Where:
        """Where a definition stands."""
        batch = int(self.batches_of(row))
        return self.batches[batch].place(row - int(self.starts[batch]))

    def batches_of(self, rows: Indices | int) -> Indices:
        """The batches that definitions belong to."""
        return np.searchsorted(self.starts, rows, side="right") - 1

    def ids_of(self, rows: Indices) -> Ids:
        """The numbers that definitions define."""
        batches = self.batches_of(rows).tolist()
        inside = zip(rows.tolist(), batches, strict=True)
        return np.array([self.batches[b].ids[row - int(self.starts[b])] for row, b in inside], dtype=np.int64)

    def indices(self, ids: Ids) -> Indices:
        """Indices of numbers, -1 for those not defined."""
        if not len(self.ids):
            return np.full(ids.shape, -1, dtype=np.intp)
        order, ordered = self._sorted()
        at = np.minimum(np.searchsorted(ordered, ids), len(ordered) - 1)
        return np.where(ordered[at] == ids, order[at], -1)

    def between(self, start: int, end: int, step: int) -> Indices:
        """Indices of the numbers start, start + step, ... up to end, in ascending order."""
        order, ordered = self._sorted()
        first, last = np.searchsorted(ordered, [start, end + 1])
        found = order[first:last]
        return np.sort(found if step == 1 else found[(ordered[first:last] - start) % step == 0])

    def _sorted(self) -> tuple[Indices, Ids]:
        """Indices in ascending order of their numbers, and the numbers in that order."""
        if self._order is None:
            order = np.argsort(self.ids, kind="stable")
            self._order = (order, self.ids[order])
        return self._order
