"""Small batches made one: the rows of them that hold, so that questions open few files."""

from __future__ import annotations

import pyarrow as pa
import pyarrow.compute as pc

from mudline.archive.chunk import MOST_DECKS, ArrowTable, renumbered
from mudline.archive.store import Archive, newest
from mudline.archive.tables import FILES, TABLES

MOST_SMALL = 8
"""Small batches from which on they are made one."""
SMALL = 32_000_000
"""Bytes of a batch that is small."""


def compact(archive: Archive) -> None:
    """Make one batch of the small ones, where there are many; raises ArchiveError, OSError.

    The decks get new numbers, so that two runs that do this at the same time write no row twice: the rows of files that
    name them are written again, newer by a nanosecond.
    """
    small = [batch for batch in archive.batches.values() if batch.bytes < SMALL]
    if len(small) < MOST_SMALL:
        return
    files, given = newest(archive.read(FILES.name)), archive.read(FILES.name, small)
    decks = archive.read(TABLES[0].name, small)
    moving = pc.fill_null(pc.is_in(files.column("deck"), _unique(decks.column("deck"))), fill_value=False)
    moved, others = files.filter(moving), files.filter(pc.invert(moving))
    links = others.filter(pc.is_in(_row_names(others), _unique(_row_names(given))))
    if len(small) == len(archive.batches):  # no other batch has an older row of a file that is gone
        links = links.filter(pc.is_valid(links.column("deck")))
    live = _unique(moved.column("deck"))
    if len(live) >= MOST_DECKS:
        return
    at = FILES.columns[-1].name
    newer = pc.add(moved.column(at), 1)
    tables = {FILES.name: moved.set_column(moved.schema.get_field_index(at), moved.schema.field(at), newer)}
    for table in TABLES:
        rows = archive.read(table.name, small)
        tables[table.name] = rows.filter(pc.is_in(rows.column("deck"), live))
    archive.write(renumbered(tables), links, [batch.name for batch in small])


def _unique(column: ArrowTable) -> ArrowTable:
    found = pc.unique(column)
    return found.combine_chunks() if isinstance(found, pa.ChunkedArray) else found


def _row_names(files: ArrowTable) -> ArrowTable:
    """What a row of files is known by: the file and the time of the row."""
    return pc.binary_join_element_wise(files.column("file"), pc.cast(files.column("written"), pa.string()), "\n")
