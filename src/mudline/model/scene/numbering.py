"""Numbered objects of a deck, nodes or elements: later definitions win, numbers lead to indices, indices to lines."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from mudline.basics.short_repr import short_repr
from mudline.language.diagnostics import Where
from mudline.language.keywords.table import LARGEST_WHOLE

Ids = NDArray[np.int64]
Indices = NDArray[np.intp]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


_FEW_RUNS = 8
_AT_ONCE = 1 << 17

_Kind = TypeVar("_Kind", bound=np.generic)
_Run = tuple[Indices, Ids]
"""Indices, and their numbers in ascending order."""


def looked_up(table: NDArray[_Kind], indices: Indices) -> NDArray[_Kind]:
    """Return `table[indices]`, which must not be written to; one index for all, as from `later_wins`, stays compact."""
    if len(indices) and indices.strides == (0,):
        return np.broadcast_to(table[indices[0]], indices.shape)
    return table[indices]


def first_of(thing: str, numbers: Ids, one: str = "", many: str = "") -> str:
    """Return numbered things with a verb in words: `node 3 lies`, or `4 nodes (first: 3) lie`."""
    what = (
        f"{thing} {numbers[0]} {one}" if len(numbers) == 1 else f"{len(numbers)} {thing}s (first: {numbers[0]}) {many}"
    )
    return what.rstrip()


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
        if len(self.batches) == 1:
            ids, values = self.batches[0].ids, self.batches[0].values
        else:
            ids = np.concatenate([batch.ids for batch in self.batches] or [np.zeros(0, dtype=np.int64)])
            values = np.concatenate([batch.values for batch in self.batches] or [np.zeros((0, width))])
        starts = np.array(self._starts, dtype=np.intp)
        ascending = _is_ascending(ids)
        if ascending or np.diff(np.sort(ids)).all():
            rows = np.arange(len(ids), dtype=np.intp)
            if len(self.batches) > 1:  # they keep no memory of their own
                bounds = zip(self.batches, self._starts, self._starts[1:], strict=False)
                self.batches = [batch._replace(ids=ids[a:b], values=values[a:b]) for batch, a, b in bounds]
            runs = [(rows, ids)] if ascending and len(ids) else None
            return Numbered(ids, values, rows, rows, rows[:0], starts, self.batches, runs)
        order = np.argsort(ids, kind="stable")
        new = np.append(True, np.diff(ids[order]) > 0)
        begins = np.flatnonzero(new)
        firsts = order[begins]
        lasts = order[np.append(begins[1:], len(ids)) - 1]
        appearing = np.argsort(firsts)
        repeats = np.sort(order[~new])
        firsts, lasts = firsts[appearing], lasts[appearing]
        return Numbered(ids[firsts], values[lasts], firsts, lasts, repeats, starts, self.batches)


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
    _runs: list[_Run] | None = None

    __repr__ = short_repr

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
        indices = np.full(ids.shape, -1, dtype=np.intp)
        for order, ordered in self._ascending():
            at = np.minimum(ordered.searchsorted(ids), len(ordered) - 1)
            np.copyto(indices, order[at], where=ordered[at] == ids)
        return indices

    def between(self, start: int, end: int, step: int) -> Indices:
        """Return indices of the numbers start, start + step, ... up to end, in ascending order."""
        parts = []
        for order, ordered in self._ascending():
            within = slice(ordered.searchsorted(start), ordered.searchsorted(end, side="right"))
            parts.append(order[within] if step == 1 else order[within][(ordered[within] - start) % step == 0])
        indices = parts[0] if len(parts) == 1 else np.concatenate([np.zeros(0, dtype=np.intp), *parts])
        return indices if _is_ascending(indices) else np.sort(indices)

    def _ascending(self) -> list[_Run]:
        """Return the numbers in ascending order: as they are if they form few runs, which takes no memory."""
        if self._runs is None:
            begins = np.flatnonzero(self.ids[1:] <= self.ids[:-1]) + 1
            if len(begins) < _FEW_RUNS:
                rows = np.arange(len(self.ids), dtype=np.intp)
                bounds = pairwise([0, *begins.tolist(), len(self.ids)])
                self._runs = [(rows[a:b], self.ids[a:b]) for a, b in bounds if b > a]
            else:
                order = np.argsort(self.ids, kind="stable")
                self._runs = [(order, self.ids[order])]
        return self._runs


def _is_ascending(numbers: Ids | Indices) -> bool:
    return not np.count_nonzero(numbers[1:] <= numbers[:-1])


def picked(values: Iterable[float], index: Indices) -> Floats:
    """Return the value of each index; NaN for -1."""
    return np.array([*values, np.nan], dtype=np.float64)[index]


def marked(flags: Iterable[bool], index: Indices) -> Mask:
    """Return the flag of each index; False for -1."""
    return np.array([*flags, False], dtype=np.bool_)[index]


def distinct(indices: Indices) -> Indices:
    """Return indices in ascending order, each once.

    `np.unique` imports `numpy.ma`, which takes longer than all sets of most decks.
    """
    flat = indices if indices.ndim == 1 else indices.reshape(-1)
    if not np.count_nonzero(flat[1:] <= flat[:-1]):
        return flat
    ordered = np.sort(flat)
    firsts: Indices = ordered[np.concatenate([[True], ordered[1:] != ordered[:-1]])]
    return firsts


def at_nodes(of_element: Indices, element_nodes: Indices, nodes: int) -> Indices:
    """Return for each node the last block, by the order of the file, that one of its elements follows; -1 for none."""
    last = np.full(nodes, -1, dtype=np.intp)
    for end in element_nodes.T:
        np.maximum.at(last, end, of_element)
    return last
