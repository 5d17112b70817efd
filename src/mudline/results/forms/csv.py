"""Results as tables of CSV."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext

import numpy as np

from mudline.contact.columns import Column, Table
from mudline.contact.result import Part
from mudline.quantities import csv_lines
from mudline.results.evaluation import Evaluation
from mudline.results.forms import More, Output, Sink, Spelling, Together, Write, batched, step_rows, text_into

SUMMARY = "elements; the nodes in `...-nodes.csv`, the lines in `...-summary.csv`"
BESIDE = ("nodes", "summary")


def _spelling(*, as_text: bool) -> Spelling:
    """Names as fields of CSV, quoted where they have to be; `as_text` for spreadsheets."""
    return Spelling(lambda name: next(csv_lines([[name]], as_text=as_text)).removesuffix("\n"), "")


def opened(output: Output) -> AbstractContextManager[Sink]:
    """What takes the results."""
    pairs = zip(output.tables.values(), output.streams, strict=True)
    made = [Text(output.evaluation, table, text_into(stream), as_text=output.as_text) for table, stream in pairs]
    return nullcontext(Together(made))


class Text:
    """The rows of a table as CSV, with a column `time` in front when there are times."""

    def __init__(self, evaluation: Evaluation, table: Table, write: Write, *, as_text: bool = False) -> None:
        self._table, self._write, self._spelling = table, write, _spelling(as_text=as_text)
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
        for step, rows in enumerate(step_rows(columns, part.count, self._table.rows, self._spelling), part.start):
            before = "" if self._times is None else f"{self._times[step]!r},"
            for piece in batched(rows):
                yield "".join([f"{before}{','.join(row)}\n" for row in piece])
