"""Results as tables in Parquet, a group of rows at a time; needs the extra `parquet`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import BinaryIO

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from mudline.contact.columns import Table
from mudline.contact.frames import FORMAT_KEY, arrow_of
from mudline.contact.result import Part
from mudline.results.evaluation import Evaluation
from mudline.results.forms import More, Output, Sink, Tables, Together

SUMMARY = (
    "the same columns, in groups of rows; the nodes in `...-nodes.parquet`, the lines in `...-summary.parquet`; "
    "`pip install 'mudline[parquet]'`"
)
BESIDE = ("nodes", "summary")

GROUP = 1 << 18
"""Rows of a group, as soon as there are so many."""


@contextmanager
def opened(output: Output) -> Iterator[Sink]:
    """What takes the results."""
    pairs = zip(output.tables.values(), output.streams, strict=True)
    with ExitStack() as files:
        yield Together([files.enter_context(closing(ParquetFile(output.evaluation, *pair))) for pair in pairs])


class ParquetFile:
    """The columns of CSV: vectors as three, no value as null; texts are kept once in each group of rows."""

    def __init__(self, evaluation: Evaluation, table: Table, stream: BinaryIO) -> None:
        self._table, self._times, self._stream = table, evaluation.time, stream
        self._writer: pq.ParquetWriter | None = None
        self._waiting: list[pa.Table] = []

    def take(self, part: Part) -> None:
        """Write some steps. Raises OSError."""
        flat = [column for vector in self._table.columns(part) for column in vector.flat()]
        times = {} if self._times is None else {"time": np.repeat(self._times[part.steps], self._table.rows)}
        self._waiting.append(arrow_of(flat, part.count, times, self._table.units))
        if sum(len(table) for table in self._waiting) >= GROUP:
            self._flush()

    def finish(self, more: More) -> None:
        """Write what waits; a table has no place for more. Raises OSError."""
        del more
        self._flush()

    def close(self) -> None:
        """End the file, after a fault too."""
        if self._writer is not None:
            self._writer.close()

    def _flush(self) -> None:
        """Write what waits as one group of rows."""
        if self._waiting:
            group = pa.concat_tables(self._waiting)
            self._writer = self._writer or pq.ParquetWriter(self._stream, group.schema, compression="zstd")
            self._writer.write_table(group, row_group_size=max(len(group), 1))
            self._waiting = []


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write a file for each table."""
    del folder
    for columns, stream in zip(tables.columns.values(), streams, strict=True):
        table = arrow_of(list(columns), 1, {}, tables.units)
        named = table.replace_schema_metadata({**table.schema.metadata, FORMAT_KEY: tables.format})
        pq.write_table(named, stream, compression="zstd")
