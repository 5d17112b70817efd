"""Numbered things of a deck, nodes or elements: later definitions win, numbers lead to indices, indices to deck lines."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Where

Ids = NDArray[np.int64]
Indices = NDArray[np.intp]
Floats = NDArray[np.float64]

MOST_GENERATED = 10_000_000
"""Nodes or elements that one GEN= may make: a slip of a digit must not fill the memory."""


@dataclass(frozen=True, slots=True)
class Batch:
    """Definitions that stand together: a table (one row each) or a generator (row -1)."""

    ids: Ids
    values: Floats
    where: Where
    table: str = ""

    def place(self, row: int) -> Where:
        """Where a definition of the batch stands."""
        return self.where._replace(path=(*self.where.path, self.table, row)) if self.table else self.where


@dataclass(slots=True)
class Gathered:
    """Definitions in the order of the file."""

    batches: list[Batch] = field(default_factory=list)
    _rows: dict[int, tuple[int, int]] | None = None

    def add(self, batch: Batch) -> None:
        """Take in a batch."""
        self.batches.append(batch)
        if self._rows is not None:
            self._note(len(self.batches) - 1)

    def find(self, number: int) -> Floats | None:
        """The values of the definition that holds so far."""
        if self._rows is None:
            self._rows = {}
            for index in range(len(self.batches)):
                self._note(index)
        found = self._rows.get(number)
        return None if found is None else self.batches[found[0]].values[found[1]]

    def _note(self, index: int) -> None:
        assert self._rows is not None
        for row, number in enumerate(self.batches[index].ids.tolist()):
            self._rows[number] = (index, row)

    def settle(self, width: int) -> Numbered:
        """The definitions that hold, in the order in which their numbers first appear, and those given twice."""
        ids = np.concatenate([batch.ids for batch in self.batches] or [np.zeros(0, dtype=np.int64)])
        values = np.concatenate([batch.values for batch in self.batches] or [np.zeros((0, width))])
        starts = np.cumsum([0, *(len(batch.ids) for batch in self.batches)])
        _, first, inverse = np.unique(ids, return_index=True, return_inverse=True)
        last = np.zeros(len(first), dtype=np.intp)
        last[inverse] = np.arange(len(ids))
        order = np.argsort(first, kind="stable")
        again = np.ones(len(ids), dtype=bool)
        again[first] = False
        return Numbered(ids[first[order]], values[last[order]], last[order], np.flatnonzero(again), starts, self.batches)


@dataclass(slots=True)
class Numbered:
    """Numbers and values; `rows` says which definition holds, `repeats` which ones come after another of their number."""

    ids: Ids
    values: Floats
    rows: Indices
    repeats: Indices
    starts: NDArray[np.intp]
    batches: list[Batch]
    _order: Indices | None = None

    def __len__(self) -> int:
        return len(self.ids)

    def where(self, index: int) -> Where:
        """Where the definition that holds for an index stands."""
        return self.where_row(int(self.rows[index]))

    def where_row(self, row: int) -> Where:
        """Where a definition stands, by its row among all definitions."""
        batch = int(np.searchsorted(self.starts, row, side="right")) - 1
        return self.batches[batch].place(row - int(self.starts[batch]))

    def id_of_row(self, row: int) -> int:
        """The number that a definition defines."""
        batch = int(np.searchsorted(self.starts, row, side="right")) - 1
        return int(self.batches[batch].ids[row - int(self.starts[batch])])

    def indices(self, ids: Ids) -> Indices:
        """Indices of numbers, -1 for those not defined."""
        if self._order is None:
            self._order = np.argsort(self.ids, kind="stable")
        if not len(self.ids):
            return np.full(ids.shape, -1, dtype=np.intp)
        ordered = self.ids[self._order]
        at = np.minimum(np.searchsorted(ordered, ids), len(ordered) - 1)
        return np.where(ordered[at] == ids, self._order[at], -1)
