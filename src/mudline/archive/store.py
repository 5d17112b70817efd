"""The folder of an archive: Parquet files named by the digest of their content, and a manifest for each batch of them.

A batch exists once its manifest does, which names its files. Everything is written beside its place and renamed, so
that a run may be killed at any moment; runs at the same time write different files. Nothing is ever changed: a newer
row of `files` holds before an older one, and a batch that has the rows of others names them in its manifest, so that
these are left out and removed. Small batches are made one, so that questions open few files.
"""

from __future__ import annotations

import json
import os
import re
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from hashlib import blake2b
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from mudline.archive.chunk import MOST_DECKS, ArrowTable, numbered, renumbered, schema_of
from mudline.archive.tables import FILES, STORED, TABLES
from mudline.files import write_atomically
from mudline.short_repr import cut

FORMAT = "mudline-archive/1"
MARKER = "archive.json"
DATA = "data"
BATCHES = "batches"
VIEWS = "archive.duckdb"

MOST_SMALL = 8
"""Small batches from which on they are made one."""
SMALL = 32_000_000
"""Bytes of a batch that is small."""

DAMAGED = "is damaged: mudline index --check reads its decks again"
"""What is wrong with a file whose content is not what it was written with, and what to do."""

_ABOUT = "decks in Parquet: mudline query asks it, docs/archive.md describes it"
_LEFT = 3600.0
_DIGEST = 16
_IS_MANIFEST = re.compile(f"[0-9a-f]{{{2 * _DIGEST}}}\\.json")
_IS_DATA = re.compile(f"[a-z]+-[0-9a-f]{{{2 * _DIGEST}}}\\.parquet")
_BY_NAME = {table.name: table for table in STORED}


class ArchiveError(Exception):
    """A folder is not an archive, is of another version, is damaged or cannot be read; the message names it."""


@dataclass(frozen=True, slots=True)
class Stored:
    """A Parquet file of a batch: its name in the folder of data, its rows and its size."""

    file: str
    rows: int
    bytes: int


@dataclass(frozen=True, slots=True)
class Batch:
    """A batch by the name of its manifest: its files by table, and the batches whose rows it holds now."""

    name: str
    files: Mapping[str, Stored]
    replaces: frozenset[str]

    @property
    def bytes(self) -> int:
        """Size of its files."""
        return sum(one.bytes for one in self.files.values())


@dataclass
class Archive:
    """An archive on disk; `damaged` are the batches that are left out, with what is wrong with them."""

    folder: Path
    batches: dict[str, Batch] = field(default_factory=dict)
    damaged: dict[str, str] = field(default_factory=dict)
    _superseded: set[str] = field(default_factory=set)

    @classmethod
    def opened(cls, folder: Path) -> Archive:
        """The archive in a folder; raises ArchiveError where there is none, or one of another version."""
        _check_name(folder)
        marker = folder / MARKER
        try:
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
        if form is None:
            raise ArchiveError(f"{marker.as_posix()} is damaged: index the decks into a new folder")
        if form != FORMAT:
            message = f"{folder.as_posix()} has the format {cut(str(form), 40)!r}, this mudline reads {FORMAT!r}"
            raise ArchiveError(f"{message}: index the decks into a new folder")
        archive = cls(folder)
        archive.load()
        return archive

    @classmethod
    def made(cls, folder: Path) -> Archive:
        """The archive in a folder, a new one where that is missing or empty; raises ArchiveError, OSError."""
        _check_name(folder)
        if not (folder / MARKER).exists():
            if folder.exists() and not folder.is_dir():
                raise ArchiveError(f"{folder.as_posix()} is a file: give a folder for the archive")
            others = [path.name for path in folder.iterdir()] if folder.exists() else []
            if any(not name.startswith(f".{MARKER}.") for name in others):
                message = f"{folder.as_posix()} has other files and is not an archive: give a new or empty folder"
                raise ArchiveError(message)
            folder.mkdir(parents=True, exist_ok=True)
            write_atomically(folder / MARKER, json.dumps({"format": FORMAT, "about": _ABOUT}).encode())
        (folder / DATA).mkdir(exist_ok=True)
        (folder / BATCHES).mkdir(exist_ok=True)
        return cls.opened(folder)

    def load(self) -> None:
        """Read the manifests; those that are damaged, or whose files are, are left out. Raises ArchiveError."""
        self.batches, self.damaged = {}, {}
        for path in sorted(self._manifests()):
            try:
                batch = _batch(path)
                self._check_files(batch)
            except FileNotFoundError:  # another run has just replaced it
                continue
            except ArchiveError as error:
                self.damaged[path.stem] = str(error)
            except OSError as error:  # it may be sound: nothing is dropped
                raise ArchiveError(f"{path.as_posix()} cannot be read: {error.strerror}") from error
            else:
                self.batches[batch.name] = batch
        self._superseded = {name for batch in self.batches.values() for name in batch.replaces}
        for name in self._superseded:
            self.batches.pop(name, None)
            self.damaged.pop(name, None)

    def _check_files(self, batch: Batch) -> None:
        for stored in batch.files.values():
            path = self.folder / DATA / stored.file
            try:
                size = path.stat().st_size
            except FileNotFoundError:
                if (self.folder / BATCHES / f"{batch.name}.json").exists():
                    raise ArchiveError(_damaged(path, "is missing")) from None
                raise
            if size != stored.bytes:
                raise ArchiveError(_damaged(path, f"has {size} bytes and not {stored.bytes}"))

    def verified(self) -> None:
        """Leave out each batch with a file whose content is not what its name says."""
        for batch in list(self.batches.values()):
            for table, stored in batch.files.items():
                path = self.folder / DATA / stored.file
                if stored.file != _file_name(table, path.read_bytes()):
                    self.damaged[batch.name] = _damaged(path, "has changed since it was written")
                    self.batches.pop(batch.name, None)

    def paths(self, table: str) -> list[str]:
        """The files of a table, from the folder, each once."""
        found = {batch.files[table].file: None for batch in self.batches.values() if table in batch.files}
        return [f"{DATA}/{name}" for name in found]

    def read(self, table: str, batches: Sequence[Batch] | None = None) -> ArrowTable:
        """All rows of a table, or those of some batches; raises ArchiveError for a damaged file."""
        chosen = self.batches.values() if batches is None else batches
        names = {batch.files[table].file: None for batch in chosen if table in batch.files}
        schema = schema_of(_BY_NAME[table])
        parts = [schema.empty_table()]
        for name in names:
            path = self.folder / DATA / name
            try:
                data = path.read_bytes()
            except OSError as error:
                raise ArchiveError(f"{path.as_posix()} cannot be read: {error.strerror}") from error
            try:
                parts.append(pq.read_table(pa.BufferReader(data), partitioning=None).cast(schema))
            except (OSError, ValueError) as error:
                raise ArchiveError(f"{path.as_posix()} {DAMAGED}") from error
        return pa.concat_tables(parts)

    def write(self, tables: Mapping[str, ArrowTable], links: ArrowTable, replaces: Sequence[str] = ()) -> None:
        """Write a batch, whose decks are numbered from 0; raises OSError.

        `links` are further rows of `files`: those of decks in other batches, and of files that are gone.
        """
        ready = numbered(dict(tables))
        ready[FILES.name] = pa.concat_tables([table for table in (ready.get(FILES.name), links) if table is not None])
        files = {name: self._put(name, table) for name, table in ready.items() if table.num_rows}
        gone = sorted({*replaces, *(name for one in replaces for name in self._known(one))})
        self._put_manifest({name: [one.file, one.rows, one.bytes] for name, one in files.items()}, gone)

    def _known(self, name: str) -> frozenset[str]:
        return self.batches[name].replaces if name in self.batches else frozenset()

    def _put(self, name: str, table: ArrowTable) -> Stored:
        sink = pa.BufferOutputStream()
        pq.write_table(table, sink, compression="zstd", compression_level=1)
        data = sink.getvalue().to_pybytes()
        stored = Stored(_file_name(name, data), table.num_rows, len(data))
        write_atomically(self.folder / DATA / stored.file, data)
        return stored

    def _put_manifest(self, files: Mapping[str, Sequence[object]], replaces: Sequence[str]) -> None:
        content = {"format": FORMAT, "files": files, "replaces": list(replaces)}
        data = json.dumps(content, indent=1, sort_keys=True).encode()
        name = _digest(data)
        write_atomically(self.folder / BATCHES / f"{name}.json", data)
        self.batches[name] = Batch(name, {table: Stored(*row) for table, row in files.items()}, frozenset(replaces))  # type: ignore[arg-type]
        for one in replaces:
            self.batches.pop(one, None)
            self._superseded.add(one)

    def tidy(self) -> None:
        """Remove replaced batches, and files of no batch that were left an hour ago or more."""
        for name in self._superseded:
            with suppress(OSError):
                (self.folder / BATCHES / f"{name}.json").unlink(missing_ok=True)
        named = {stored.file for batch in self._on_disk() for stored in batch.files.values()}
        data = (path for path in (self.folder / DATA).glob("*.parquet") if _IS_DATA.fullmatch(path.name))
        files = [*data, *self.folder.glob(f".{VIEWS}.*")]
        for path in files:
            with suppress(OSError):
                if path.name not in named and time.time() - path.stat().st_mtime > _LEFT:
                    path.unlink()

    def drop_damaged(self) -> None:
        """Remove the manifests of damaged batches: their decks have been read again."""
        for name in self.damaged:
            with suppress(OSError):
                (self.folder / BATCHES / f"{name}.json").unlink(missing_ok=True)

    def _manifests(self) -> Iterator[Path]:
        """The manifests; other files that somebody has put there are left alone. Raises ArchiveError."""
        folder = self.folder / BATCHES
        try:
            names = os.listdir(folder)  # noqa: PTH208 - glob finds nothing where it may not look
        except OSError as error:
            raise ArchiveError(f"{folder.as_posix()} cannot be read: {error.strerror}") from error
        return (folder / name for name in names if _IS_MANIFEST.fullmatch(name))

    def _on_disk(self) -> Iterator[Batch]:
        for path in self._manifests():
            with suppress(ArchiveError, OSError):
                yield _batch(path)


def _check_name(folder: Path) -> None:
    """Raise ArchiveError for a folder that DuckDB cannot open."""
    try:
        str(folder.absolute()).encode()
    except UnicodeEncodeError as error:
        name = os.fsencode(folder).decode(errors="backslashreplace")
        raise ArchiveError(f"{name}: the path of an archive must be UTF-8: rename the folder") from error


def _damaged(path: Path, how: str) -> str:
    return f"{path.as_posix()} {how}: mudline index reads its decks again"


def _batch(path: Path) -> Batch:
    """A batch of its manifest; raises ArchiveError, OSError."""
    data = path.read_bytes()
    if path.stem != _digest(data):
        raise ArchiveError(_damaged(path, "is damaged"))
    content: Any = json.loads(data)
    if content["format"] != FORMAT:
        raise ArchiveError(_damaged(path, f"has the format {cut(str(content['format']), 40)!r}"))
    return Batch(
        path.stem, {name: Stored(*row) for name, row in content["files"].items()}, frozenset(content["replaces"])
    )


def _file_name(table: str, data: bytes) -> str:
    return f"{table}-{_digest(data)}.parquet"


def _digest(data: bytes) -> str:
    return blake2b(data, digest_size=_DIGEST).hexdigest()


def newest(files: ArrowTable) -> ArrowTable:
    """The row of each file that holds: the newest one."""
    order = files.sort_by([(FILES.columns[-1].name, "ascending"), ("deck", "ascending")])
    index = {file: at for at, file in enumerate(order.column("file").to_pylist())}
    return order.take(pa.array(index.values(), pa.int64()))


# -------------------------------------------------------------------------------------------------------- small batches


def compact(archive: Archive) -> None:
    """Make one batch of the small ones, where there are many; raises ArchiveError, OSError.

    The decks get new numbers, so that two runs that do this at the same time write no row twice: the rows of files that
    name them are written again, newer by a nanosecond.
    """
    import pyarrow.compute as pc  # noqa: PLC0415 - slow to import, and questions are asked without it

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
    import pyarrow.compute as pc  # noqa: PLC0415 - as above

    found = pc.unique(column)
    return found.combine_chunks() if isinstance(found, pa.ChunkedArray) else found


def _row_names(files: ArrowTable) -> ArrowTable:
    """What a row of files is known by: the file and the time of the row."""
    import pyarrow.compute as pc  # noqa: PLC0415 - as above

    return pc.binary_join_element_wise(files.column("file"), pc.cast(files.column("written"), pa.string()), "\n")
