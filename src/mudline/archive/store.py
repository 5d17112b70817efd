"""The folder of an archive: a Parquet file for each table, named by the digest of its content, and their list.

Everything is written beside its place and renamed, the list last: a run may be killed at any moment.
"""

from __future__ import annotations

import json
import os
import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from hashlib import blake2b
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import pyarrow as pa
import pyarrow.parquet as pq

from mudline.archive.tables import DECK, Table
from mudline.files import alone_at, write_atomically
from mudline.overwriting import reading
from mudline.short_repr import cut

ArrowTable: TypeAlias = Any
"""A pyarrow.Table; pyarrow has no types."""

FORMAT = "mudline-archive/3"
MARKER = "archive.json"
DATA = "data"
VIEWS = "archive.duckdb"
LOCK = "archive.lock"
AGAIN = "mudline index reads the decks again"

_ABOUT = "decks in Parquet: mudline query asks it, docs/archive.md describes it"
_LEFT = 3600.0
"""Seconds after which a file that no list names is that of a killed run."""
_IS_DATA = re.compile("[a-z]+-[0-9a-f]{32}\\.parquet")
_TYPES = {
    "text": pa.string(),
    "whole": pa.int64(),
    "number": pa.float64(),
    "numbers": pa.list_(pa.float64()),
    "flag": pa.bool_(),
}


class ArchiveError(Exception):
    """A folder is not an archive, is of another version, is damaged or cannot be read; the message names it."""


class Stored(NamedTuple):
    """A Parquet file: its name in the folder of data, and its size."""

    file: str
    bytes: int


@dataclass
class Archive:
    """An archive on disk, with the file of each table."""

    folder: Path
    files: dict[str, Stored] = field(default_factory=dict)

    @classmethod
    def opened(cls, folder: Path) -> Archive:
        """The archive in a folder; raises ArchiveError where there is none, or one of another version."""
        _check_name(folder)
        marker = folder / MARKER
        try:
            reading(marker)
            found = json.loads(marker.read_bytes())
        except FileNotFoundError:
            what = "does not exist" if not folder.exists() else f"has no {MARKER}, so it is not an archive"
            raise ArchiveError(f"{folder.as_posix()} {what}: give the folder that mudline index wrote") from None
        except NotADirectoryError:
            message = f"{folder.as_posix()} is a file, not an archive: give the folder that mudline index wrote"
            raise ArchiveError(message) from None
        except OSError as error:
            raise ArchiveError(f"{marker.as_posix()} cannot be read: {error.strerror}") from error
        except (ValueError, RecursionError):
            found = None
        form = found.get("format") if isinstance(found, dict) else None
        if form is not None and form != FORMAT:
            message = f"{folder.as_posix()} has the format {cut(str(form), 40)!r}, this mudline reads {FORMAT!r}"
            raise ArchiveError(f"{message}: index the decks into a new folder")
        try:
            return cls(folder, {name: Stored(*row) for name, row in found["tables"].items()})
        except (AttributeError, KeyError, TypeError) as error:
            raise ArchiveError(f"{marker.as_posix()} is damaged: index the decks into a new folder") from error

    @classmethod
    @contextmanager
    def for_one_run(cls, folder: Path, waiting: Callable[[], None]) -> Iterator[Archive]:
        """The archive in a folder, a new one where that is missing or empty; raises ArchiveError, OSError.

        No other run changes it until the block ends; one that does so now is waited for, after `waiting` is called.
        """
        _check_name(folder)
        if not (folder / MARKER).exists():
            _check_new(folder)
        folder.mkdir(parents=True, exist_ok=True)
        with alone_at(folder / LOCK, waiting, made=True):
            yield cls.made(folder)

    @classmethod
    def made(cls, folder: Path) -> Archive:
        """The archive in a folder that this run alone changes; raises ArchiveError, OSError."""
        folder.mkdir(parents=True, exist_ok=True)
        if not (folder / MARKER).exists():
            cls(folder).write({})
        (folder / DATA).mkdir(exist_ok=True)
        return cls.opened(folder)

    def damage(self, *, thorough: bool) -> str:
        """What is wrong with a file, or ""; `thorough` compares its content with the digest in its name, too.

        Raises ArchiveError for one that cannot be opened: it may be sound.
        """
        for table, stored in self.files.items():
            path = self.folder / DATA / stored.file
            reading(path)
            try:
                size = path.stat().st_size
                if size == stored.bytes and thorough and _file_name(table, path.read_bytes()) != stored.file:
                    return f"{path.as_posix()} has changed since it was written: {AGAIN}"
            except FileNotFoundError:
                return f"{path.as_posix()} is missing: {AGAIN}"
            except OSError as error:
                raise ArchiveError(f"{path.as_posix()} cannot be read: {error.strerror}") from error
            if size != stored.bytes:
                return f"{path.as_posix()} has {size} bytes and not {stored.bytes}: {AGAIN}"
        return ""

    def path(self, table: str) -> str | None:
        """The file of a table, from the folder; None while there is none."""
        return f"{DATA}/{self.files[table].file}" if table in self.files else None

    def read(self, table: Table) -> ArrowTable:
        """All rows of a table; raises ArchiveError for a file that cannot be read."""
        path = self.path(table.name)
        if path is None:
            return schema_of(table).empty_table()
        try:
            data = (self.folder / path).read_bytes()
            return pq.read_table(pa.BufferReader(data), partitioning=None).cast(schema_of(table))
        except (OSError, ValueError) as error:
            raise ArchiveError(f"{(self.folder / path).as_posix()} cannot be read: run mudline index again") from error

    def write(self, tables: Mapping[str, ArrowTable]) -> None:
        """Replace all tables, and remove the files that held them; raises OSError."""
        before = {one.file for one in self.files.values()}
        self.files = {name: self._put(name, table) for name, table in tables.items()}
        content = {"format": FORMAT, "about": _ABOUT, "tables": self.files}
        write_atomically(self.folder / MARKER, json.dumps(content, indent=1).encode())
        named = {one.file for one in self.files.values()}
        for path in (self.folder / DATA).glob("*.parquet"):
            with suppress(OSError):
                is_left = _IS_DATA.fullmatch(path.name) and time.time() - path.stat().st_mtime > _LEFT
                if path.name not in named and (path.name in before or is_left):
                    path.unlink()

    def _put(self, name: str, table: ArrowTable) -> Stored:
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink, compression="zstd", compression_level=1)
        data = sink.getvalue().to_pybytes()
        stored = Stored(_file_name(name, data), len(data))
        write_atomically(self.folder / DATA / stored.file, data)
        return stored


def schema_of(table: Table) -> Any:
    """The schema of a table's file."""
    return pa.schema([(column.name, _TYPES[column.kind]) for column in (DECK, *table.columns)])


def table_of(table: Table, rows: Iterable[tuple[object, ...]]) -> ArrowTable:
    """Rows as a table: the number of the deck, then the values of the columns; NaN is no value."""
    schema = schema_of(table)
    columns = list(zip(*rows, strict=True)) or [() for _ in schema]
    arrays = [_array(column, kind.type) for column, kind in zip(columns, schema, strict=True)]
    return pa.Table.from_arrays(arrays, schema=schema)


def _array(values: tuple[object, ...], kind: Any) -> Any:
    try:
        return pa.array(values, kind, from_pandas=True)
    except UnicodeEncodeError:
        return pa.array([escaped(one) if isinstance(one, str) else one for one in values], kind, from_pandas=True)


def escaped(text: str) -> str:
    """A text as UTF-8 holds it: halves of surrogate pairs, which names of files may have, are written out."""
    return text.encode("utf-8", "backslashreplace").decode()


def _check_name(folder: Path) -> None:
    """Raise ArchiveError for a folder that DuckDB cannot open."""
    try:
        str(folder.absolute()).encode()
    except UnicodeEncodeError as error:
        name = os.fsencode(folder).decode(errors="backslashreplace")
        raise ArchiveError(f"{name}: the path of an archive must be UTF-8: rename the folder") from error


def _check_new(folder: Path) -> None:
    """Raise ArchiveError for a folder with files that no archive has; raises OSError."""
    if folder.exists() and not folder.is_dir():
        raise ArchiveError(f"{folder.as_posix()} is a file: give a folder for the archive")
    names = [path.name for path in folder.iterdir()] if folder.exists() else []
    others = [name for name in names if name != LOCK and not name.startswith(f".{MARKER}.")]
    if others and not (folder / MARKER).exists():  # another run may just have made it
        raise ArchiveError(f"{folder.as_posix()} has other files and is not an archive: give a new or empty folder")


def _file_name(table: str, data: bytes) -> str:
    return f"{table}-{blake2b(data, digest_size=16).hexdigest()}.parquet"
