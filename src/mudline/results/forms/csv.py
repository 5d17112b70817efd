"""Results as two tables of CSV."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import AbstractContextManager, nullcontext

from mudline.results.columns import Table
from mudline.results.evaluation import Evaluation, Part
from mudline.results.forms import More, Output, Sink, Spelling, Together, Write, batched, step_rows, text_into
from mudline.results.quantities import csv_lines

SUMMARY = "elements; the nodes in `...-nodes.csv`"
BESIDE = True


def _quoted(name: str) -> str:
    """A name as a field of CSV: quoted where it has to be."""
    return next(csv_lines([[name]])).removesuffix("\n")


_SPELLING = Spelling(_quoted, "")


def opened(output: Output) -> AbstractContextManager[Sink]:
    """What takes the results."""
    pairs = zip(output.tables, output.streams, strict=True)
    return nullcontext(Together([Text(output.evaluation, table, text_into(stream)) for table, stream in pairs]))


class Text:
    """The rows of a table as CSV, with a column `time` in front when there are times."""

    def __init__(self, evaluation: Evaluation, table: Table, write: Write) -> None:
        self._table, self._write = table, write
        self._times = None if evaluation.time is None else evaluation.time.tolist()

    def take(self, part: Part) -> None:
        """Write some steps; before the first, the names of the columns."""
        self._write(self._steps(part))

    def finish(self, more: More) -> None:
        """Write nothing: a table has no place for more."""

    def _steps(self, part: Part) -> Iterator[str]:
        columns = self._table.columns(part)
        if part.start == 0:
            names = [flat.name for column in columns for flat in column.flat()]
            yield ",".join(names if self._times is None else ["time", *names]) + "\n"
        for step, rows in enumerate(step_rows(columns, part.count, self._table.rows, _SPELLING), part.start):
            before = "" if self._times is None else f"{self._times[step]!r},"
            for piece in batched(rows):
                yield "".join([f"{before}{','.join(row)}\n" for row in piece])
