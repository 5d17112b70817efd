"""Results as tables in Parquet, a group of rows at a time; needs the extra `frames`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pyarrow as pa
import pyarrow.parquet as pq

from mudline.model.contact.frames import arrow_of
from mudline.model.results.forms import Columns, More, ResultOutput

GROUP = 1 << 18
"""Rows from which on a group is written."""


class ParquetWriter:
    """Writer of the columns of CSV: vectors as three, missing values as null; texts are stored once per group."""

    def __init__(self, output: ResultOutput) -> None:
        self._contents, self._open = output.contents, output.open
        self._streams = dict(zip(output.contents.rows, output.streams, strict=True))
        self._writers: dict[str, pq.ParquetWriter] = {}
        self._waiting: dict[str, list[pa.Table]] = {table: [] for table in self._streams}

    def write(self, columns: Columns, start: int, count: int, _beside: Mapping[str, Sequence[object]]) -> None:
        """Write some steps. Raises OSError."""
        for table, waiting in self._waiting.items():
            flat = self._contents.timed(table, columns[table], start, count)
            waiting.append(arrow_of(flat, count, self._contents.units, self._contents.format))
            if sum(len(each) for each in waiting) >= GROUP:
                self._flush(table)

    def finish(self, _more: More) -> None:
        """Write the waiting rows; a table cannot hold `more`. Raises OSError."""
        for table in self._waiting:
            self._flush(table)

    def _flush(self, table: str) -> None:
        """Write the waiting rows as one group."""
        if not self._waiting[table]:
            return
        group = pa.concat_tables(self._waiting[table])
        if table not in self._writers:
            opened_writer = pq.ParquetWriter(self._streams[table], group.schema, compression="zstd")
            self._writers[table] = self._open.enter_context(opened_writer)
        self._writers[table].write_table(group, row_group_size=max(len(group), 1))
        self._waiting[table] = []


writer = ParquetWriter
