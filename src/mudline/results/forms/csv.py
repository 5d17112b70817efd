"""Results as tables of CSV."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from itertools import chain
from pathlib import Path
from typing import BinaryIO

import numpy as np

from mudline.contact.columns import Column, Table
from mudline.contact.result import Part
from mudline.quantities import csv_lines
from mudline.results.evaluation import Evaluation
from mudline.results.forms import (
    More,
    Output,
    Sink,
    Spelling,
    Tables,
    Together,
    Write,
    batched,
    plain_values,
    step_rows,
    text_into,
)

SUMMARY = "elements; the nodes in `...-nodes.csv`, the lines in `...-summary.csv`"
BESIDE = ("nodes", "summary")

_SPELLING = Spelling(lambda name: next(csv_lines([[name]])).removesuffix("\n"), "")


def opened(output: Output) -> AbstractContextManager[Sink]:
    """What takes the results."""
    pairs = zip(output.tables.values(), output.streams, strict=True)
    made = [Text(output.evaluation, table, text_into(stream)) for table, stream in pairs]
    return nullcontext(Together(made))


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write a file for each table."""
    del folder
    for table, stream in zip(tables.columns, streams, strict=True):
        text_into(stream)(tables_text(tables, table))


def tables_text(tables: Tables, table: str) -> Iterator[str]:
    """The lines of a table, with a column `units` at the end."""
    columns = tables.columns[table]
    rows = zip(*map(plain_values, columns), strict=True)
    head = [[*(column.name for column in columns), "units"]]
    return csv_lines(chain(head, ((*row, tables.units) for row in rows)))


class Text:
    """The rows of a table as CSV, with a column `time` in front when there are times."""

    def __init__(self, evaluation: Evaluation, table: Table, write: Write) -> None:
        self._table, self._write = table, write
        self._times = None if evaluation.time is None else evaluation.time.tolist()
        self._units = Column("units", np.zeros(table.rows, np.int32), (table.units, None), over_steps=False)

    def take(self, part: Part) -> None:
        """Write some steps; before the first, the names of the columns."""
        self._write(self._steps(part))

    def finish(self, more: More) -> None:
        """Write nothing: a table has no place for more."""

    def _steps(self, part: Part) -> Iterator[str]:
        columns = [*self._table.columns(part), self._units]
        if part.start == 0:
            names = [flat.name for column in columns for flat in column.flat()]
            yield ",".join(names if self._times is None else ["time", *names]) + "\n"
        for step, rows in enumerate(step_rows(columns, part.count, self._table.rows, _SPELLING), part.start):
            before = "" if self._times is None else f"{self._times[step]!r},"
            for piece in batched(rows):
                yield "".join([f"{before}{','.join(row)}\n" for row in piece])
