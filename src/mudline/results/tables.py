"""Rows of elements and nodes, spelled for a text format."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np
from pydantic_core import to_json

from mudline.results.columns import Column, Values

_BLOCK = 16384
"""Rows spelled at a time: the texts of a large model are never all in memory."""

Row = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Spelling:
    """How a format spells a name, and that there is no value."""

    name: Callable[[str], str]
    nothing: str

    def column(self, values: Values, names: tuple[str | None, ...] = ()) -> list[str]:
        """The values of a column; numbers read back to the same double, NaN is no value."""
        if not values.size:
            return []
        if names:
            spelled = [self.nothing if name is None else self.name(name) for name in names]
            return [spelled[code] for code in values.tolist()]
        numbers = to_json(values.tolist(), inf_nan_mode="null")[1:-1].decode().split(",")
        if self.nothing == "null" or values.dtype.kind != "f" or not np.isnan(values).any():
            return numbers
        return [self.nothing if text == "null" else text for text in numbers]


def step_rows(columns: list[Column], steps: int, rows: int, spelling: Spelling) -> Iterator[Iterable[Row]]:
    """The rows of each step, spelled; take those of a step before the next."""
    flat = [part for column in columns for part in column.flat()]
    if rows > _BLOCK:
        for step in range(steps):
            yield chain.from_iterable(_long(flat, step, rows, spelling))
        return
    together = max(1, _BLOCK // max(rows, 1))
    constant = {column.name: spelling.column(column.values, column.names) for column in flat if column.steady}
    for first in range(0, steps, together):
        last = min(steps, first + together)
        texts = [
            constant[column.name] * (last - first)
            if column.steady
            else spelling.column(column.cut(first, last).ravel(), column.names)
            for column in flat
        ]
        spelled = zip(*texts, strict=True)
        for _ in range(first, last):
            yield islice(spelled, rows)


def _long(columns: list[Column], step: int, rows: int, spelling: Spelling) -> Iterator[Iterator[Row]]:
    """The rows of one step of a large model, block by block."""
    for start in range(0, rows, _BLOCK):
        block = slice(start, start + _BLOCK)
        texts = [spelling.column(column.cut(step, step + 1)[0, block], column.names) for column in columns]
        yield zip(*texts, strict=True)
