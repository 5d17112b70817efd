"""Archive on disk: its tables, the known decks, and the changes of a run.

Tables are written next to their places and moved there together: a run may be killed at any moment.
"""

from __future__ import annotations

import os
import shutil
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import duckdb
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from mudline.basics.files import replacement, write_atomically
from mudline.basics.paths import relative_path
from mudline.tools.archive.rows import TABLES, Rows, columns_of
from mudline.tools.running.remembered import Memory

VIEWS, LOCK, _MEMORY = "archive.duckdb", "mudline.lock", ".known"
_FORMAT = {b"mudline": b"archive/5"}
_WRITING, _WRITTEN = ".writing", ".written"
"""Folders of tables that are being written, and of tables that are complete but not all in their places."""
_TYPES: dict[Any, Any] = {str: pa.string(), int: pa.int64(), float: pa.float64(), bool: pa.bool_()}
_TYPES |= {python | None: arrow for python, arrow in _TYPES.items()} | {list[float]: pa.list_(pa.float64())}


class ArchiveError(Exception):
    """Folder that is no archive, an archive of another version, or damaged; the message names it."""


def check_folder(folder: Path) -> None:
    """Raise ArchiveError unless a folder is an archive, missing or empty; raises OSError."""
    if str(folder.absolute()) != _escaped(str(folder.absolute())):
        raise ArchiveError(f"{_escaped(str(folder))}: the path of an archive must be UTF-8: rename the folder")
    if folder.exists() and not (folder / LOCK).exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ArchiveError(f"{folder.as_posix()} has other files and is not an archive: give a new or empty folder")


class Archive:
    """Tables of an archive as written, and the decks that this run has read; no other run may change them.

    Attributes:
        counts: number of decks that are new, changed, unchanged and gone.
        memory: keys of the decks whose rows are in the tables, with the files that these depend on.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.counts: Counter[str] = Counter()
        self.memory = Memory(folder / _MEMORY)
        self._root = os.path.dirname(os.path.abspath(folder))  # noqa: PTH100, PTH120 - links stay
        self._rows: dict[str, Rows] = {}
        self._gone: list[str] = []
        _put_in_place(folder)
        self._tables = _read(folder)
        self._known = {row["file"]: row["key"] for row in self._tables["decks"].select(["file", "key"]).to_pylist()}

    def place(self, path: str) -> str:
        """Return a path relative to the folder that contains the archive, so that both may be moved together."""
        return _escaped(relative_path(path, self._root))

    def is_new(self, place: str, key: str) -> bool:
        """Count a deck, and return True if it must be read: the tables have no rows with this key."""
        known = self._known.get(place)
        holds = known == key and self.memory.get(key) is not None
        self.counts["unchanged" if holds else "changed" if known else "new"] += 1
        return not holds

    def put(self, place: str, key: str, rows: Rows, paths: Iterable[str]) -> None:
        """Add the rows of a deck, and the paths that they depend on."""
        self.memory.put(key, [], paths)
        self._rows[place] = {**rows, "decks": [row._replace(key=key) for row in rows["decks"]]}

    def remove_gone(self, seen: set[str], folders: Sequence[str], *, everywhere: bool) -> None:
        """Remove unseen decks below `folders`, and with `everywhere` decks whose files are gone; raises OSError."""
        starts = tuple(os.path.join(folder, "") for folder in folders)  # noqa: PTH118 - texts
        for place in self._known.keys() - seen:
            path = os.path.normpath(os.path.join(self._root, place))  # noqa: PTH118 - a place may be on another drive
            if path.startswith(starts) or (everywhere and not os.path.lexists(path)):
                self._gone.append(place)
        self.counts["gone"] = len(self._gone)

    def close(self) -> None:
        """Write the tables with all new rows, and the views; raises OSError."""
        dropped = pa.array([*self._rows, *self._gone], pa.string())
        if len(dropped) or not (self.folder / "decks.parquet").exists():
            (self.folder / _WRITING).mkdir()
            for name, before in self._tables.items():
                kept = before.filter(pc.invert(pc.is_in(before.column("file"), dropped)))
                new = [(place, *row) for place, rows in self._rows.items() for row in rows.get(name, ())]
                with replacement(self.folder / _WRITING / f"{name}.parquet") as stream:
                    pq.write_table(pa.concat_tables([kept, _table(name, new)]), stream, write_page_checksum=True)
            self.memory.save()
            (self.folder / _WRITING).rename(self.folder / _WRITTEN)
            _put_in_place(self.folder)
        _write_views(self.folder)


def _write_views(folder: Path) -> None:
    """Write the database with a view of each table, named by its absolute path; raises OSError."""
    # In a temporary folder: DuckDB reads a question mark in the path of a database as the start of options.
    with TemporaryDirectory(prefix="mudline-") as place:
        with duckdb.connect(str(Path(place, VIEWS))) as connection:
            for name in TABLES:
                path = (folder.absolute() / f"{name}.parquet").as_posix().replace("'", "''")
                path = "".join(f"[{letter}]" if letter in "*?[" else letter for letter in path)
                connection.execute(f"CREATE VIEW {name} AS SELECT * FROM read_parquet('{path}')")  # noqa: S608 - a path
        write_atomically(folder / VIEWS, Path(place, VIEWS).read_bytes())


def _put_in_place(folder: Path) -> None:
    """Move the tables of a complete save to their places, and remove those of an incomplete save."""
    for path in (folder / _WRITTEN).glob("*.parquet"):
        path.replace(folder / path.name)
    for name in (_WRITING, _WRITTEN):
        shutil.rmtree(folder / name, ignore_errors=True)


def _read(folder: Path) -> dict[str, Any]:
    """Return the tables, empty for a new archive; raises ArchiveError for a damaged archive or another version."""
    tables = {name: _table(name, []) for name in TABLES}
    for name in TABLES if (folder / "decks.parquet").exists() else ():
        path = folder / f"{name}.parquet"
        try:
            # pyarrow cannot open a path with a colon or an equals sign.
            tables[name] = pq.ParquetFile(pa.BufferReader(path.read_bytes()), page_checksum_verification=True).read()
        except (OSError, ValueError) as error:
            what = f"{path.as_posix()} cannot be read: {str(error).splitlines()[0]}"
            raise ArchiveError(f"{what}: index the decks into a new folder") from error
        if tables[name].schema.metadata != _FORMAT:
            raise ArchiveError(f"{path.as_posix()} is of another version: index the decks into a new folder")
    return tables


def _table(name: str, rows: Sequence[tuple[object, ...]]) -> Any:
    """Return rows as a pyarrow.Table; NaN becomes null."""
    schema = pa.schema([(column, _TYPES[kind]) for column, kind, _ in columns_of(name)], _FORMAT)
    columns = list(zip(*rows, strict=True)) or [()] * len(schema)
    texts = [[_escaped(value) if isinstance(value, str) else value for value in column] for column in columns]
    arrays = [pa.array(values, column.type, from_pandas=True) for values, column in zip(texts, schema, strict=True)]
    return pa.Table.from_arrays(arrays, schema=schema)


def _escaped(text: str) -> str:
    """Return a text that UTF-8 can hold: halves of surrogate pairs, as in names of files, are escaped."""
    return text.encode("utf-8", "backslashreplace").decode()
