"""Rows of some decks on their way into an archive: collected by deck, then made columns of Arrow."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from hashlib import blake2b
from typing import Any, TypeAlias, cast

import numpy as np
import pyarrow as pa

from mudline.archive.tables import DECK, STORED, TABLES, Column, Table

ArrowTable: TypeAlias = Any
"""A pyarrow.Table; pyarrow has no types."""
Values: TypeAlias = "Sequence[object] | np.ndarray[Any, Any]"

NUMBER_BITS = 24
"""Bits of the number of a deck within its batch; those above are the batch's."""
MOST_DECKS = 1 << NUMBER_BITS
_BATCH_BITS = 63 - NUMBER_BITS

_TYPES = {
    "text": pa.string(),
    "whole": pa.int64(),
    "number": pa.float64(),
    "flag": pa.bool_(),
    "time": pa.timestamp("us"),
}


def schema_of(table: Table) -> Any:
    """The schema of a table's files."""
    return pa.schema([(column.name, _TYPES[column.kind]) for column in (DECK, *table.columns)])


@dataclass
class Chunk:
    """Rows of decks, which have the numbers from 0 on.

    `rows` has single rows, `blocks` columns of many rows: a sequence or an array for each column, NaN for no value.
    """

    decks: int = 0
    rows: dict[str, list[tuple[object, ...]]] = field(default_factory=lambda: {table.name: [] for table in STORED})
    blocks: dict[str, list[tuple[int, int, Sequence[Values]]]] = field(default_factory=dict)

    def add(self, table: str, *values: object) -> None:
        """Add a row of the deck of this number."""
        self.rows[table].append((self.decks, *values))

    def add_columns(self, table: str, count: int, columns: Sequence[Values]) -> None:
        """Add so many rows of it at once."""
        if count:
            self.blocks.setdefault(table, []).append((self.decks, count, columns))

    def finished(self) -> dict[str, ArrowTable]:
        """The tables that have rows."""
        found = {}
        for table in STORED:
            parts = [_of_rows(table, self.rows[table.name])] if self.rows[table.name] else []
            if blocks := self.blocks.get(table.name):
                parts.append(_of_blocks(table, blocks))
            if parts:
                found[table.name] = pa.concat_tables(parts)
        return found


def _of_rows(table: Table, rows: list[tuple[object, ...]]) -> ArrowTable:
    columns = (DECK, *table.columns)
    return _table(
        table, [_array(list(values), column) for column, values in zip(columns, zip(*rows, strict=True), strict=True)]
    )


def _of_blocks(table: Table, blocks: Sequence[tuple[int, int, Sequence[Values]]]) -> ArrowTable:
    numbers = np.repeat([number for number, _, _ in blocks], [count for _, count, _ in blocks])
    arrays = [pa.array(numbers, pa.int64())]
    for at, column in enumerate(table.columns):
        pieces = [columns[at] for _, _, columns in blocks]
        if all(isinstance(piece, np.ndarray) for piece in pieces):
            arrays.append(
                pa.array(
                    np.concatenate(cast("list[np.ndarray[Any, Any]]", pieces)), _TYPES[column.kind], from_pandas=True
                )
            )
        else:
            arrays.append(_array([value for piece in pieces for value in piece], column))
    return _table(table, arrays)


def _table(table: Table, arrays: list[Any]) -> ArrowTable:
    return pa.Table.from_arrays(arrays, schema=schema_of(table))


def _array(values: list[Any], column: Column) -> Any:
    """A column; NaN is no value, and what UTF-8 cannot hold, as file names may, is escaped."""
    try:
        return pa.array(values, _TYPES[column.kind], from_pandas=column.kind == "number")
    except UnicodeEncodeError:
        clean = (value and str(value).encode("utf-8", "backslashreplace").decode() for value in values)
        return pa.array(list(clean), _TYPES[column.kind])


def together(chunks: Iterable[dict[str, ArrowTable]], counts: Iterable[int]) -> dict[str, ArrowTable]:
    """The tables of finished chunks, which have so many decks, as those of one."""
    parts: dict[str, list[ArrowTable]] = {}
    start = 0
    for tables, count in zip(chunks, counts, strict=True):
        for name, table in tables.items():
            parts.setdefault(name, []).append(_moved(table, start))
        start += count
    return {name: pa.concat_tables(tables).combine_chunks() for name, tables in parts.items()}


def numbered(tables: dict[str, ArrowTable]) -> dict[str, ArrowTable]:
    """The tables with numbers of decks that no other batch has: the digest of all of them comes before each."""
    digest = blake2b(digest_size=8)
    for name in sorted(tables):
        digest.update(f"{name} {tables[name].num_rows} ".encode())
        for chunk in (chunk for column in tables[name].columns for chunk in column.chunks):
            for buffer in chunk.buffers():
                digest.update(b"" if buffer is None else buffer)
    batch = int.from_bytes(digest.digest()) >> (64 - _BATCH_BITS)
    return {name: _moved(table, batch << NUMBER_BITS) for name, table in tables.items()}


def _moved(table: ArrowTable, by: int) -> ArrowTable:
    import pyarrow.compute as pc  # noqa: PLC0415 - slow to import, and chunks are made without it

    return table.set_column(0, table.schema.field(0), pc.add(table.column(0), by)) if by else table


def renumbered(tables: dict[str, ArrowTable]) -> dict[str, ArrowTable]:
    """The tables with the numbers of their decks counted from 0 again, in ascending order."""
    import pyarrow.compute as pc  # noqa: PLC0415 - as above

    known = pc.unique(tables[TABLES[0].name].column(0)).sort()
    found = {}
    for name, table in tables.items():
        index = pc.cast(pc.index_in(table.column(0), known), pa.int64())
        found[name] = table.set_column(0, table.schema.field(0), index).combine_chunks()
    return found
