"""An archive in DuckDB: views over its Parquet files, locked so that a question reads nothing else.

Deck text is never part of a statement: the statements here name tables, columns and files, whose names are digests.
"""

from __future__ import annotations

import json
import os
import re
import sys
import threading
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import duckdb

from mudline.archive.store import AGAIN, DATA, VIEWS, Archive
from mudline.archive.tables import DECK, FILES, STORED, TABLES, Table
from mudline.files import write_atomically

BATCH = 100_000
"""Rows of an answer that are fetched at once."""
_TYPES = {"text": "VARCHAR", "whole": "BIGINT", "number": "DOUBLE", "flag": "BOOLEAN", "numbers": "DOUBLE[]"}
_CONFIG = {
    "autoinstall_known_extensions": "false",
    "autoload_known_extensions": "false",
    "allow_community_extensions": "false",
    "python_enable_replacements": "false",
    "errors_as_json": "true",
    "temp_directory": "",
}
_PATIENCE = 30.0
"""Seconds for a question to end that is interrupted; a second Ctrl-C ends it at once."""
_BESIDE = 1 << 28
"""Bytes at least that a question may use besides what DuckDB counts."""
_TOO_MUCH = "the question needs more memory than it may use: ask for less, or raise --memory-limit"
_DATA_FILE = re.compile(rf"(?<=['\"]){DATA}/[a-z]+-[0-9a-f]+\.parquet(?=['\"])")
_READING = ("SELECT", "EXPLAIN")
_DISABLED = "file system operations are disabled"


class QueryError(Exception):
    """A question that cannot be answered: the message says why, and where in the SQL."""


@dataclass
class Database:
    """An open archive that answers questions."""

    connection: duckdb.DuckDBPyConnection

    def ask(self, sql: str) -> Any:
        """The answer as a pyarrow.RecordBatchReader; raises QueryError. Ctrl-C ends a long question."""
        statement = self._checked(sql)

        def answer() -> Any:
            with warnings.catch_warnings():
                # A relation would spare a copy, and lack the place of an error in the SQL.
                warnings.simplefilter("ignore", UserWarning)
                return self.connection.execute(statement).to_arrow_reader(BATCH)

        return self._interruptible(answer, sql)

    def next_batch(self, reader: Any) -> Any:
        """The next rows of an answer, None behind the last; raises QueryError."""

        def read() -> Any:
            try:
                return reader.read_next_batch()
            except StopIteration:
                return None

        return self._interruptible(read, "")

    def _checked(self, sql: str) -> duckdb.Statement:
        """The one statement of a text, which must only read; raises QueryError."""
        try:
            statements = self.connection.extract_statements(sql)
        except duckdb.Error as error:
            raise _explained(error, sql) from error
        if len(statements) != 1:
            raise QueryError(f"expected one SQL statement, found {len(statements)}: ask one question at a time")
        kind = statements[0].type.name
        if kind not in _READING or (kind == "EXPLAIN" and "analy" in sql.casefold()):
            raise QueryError(f"a question only reads the archive: {kind} is not allowed; use SELECT")
        return statements[0]

    def _interruptible(self, work: Any, sql: str) -> Any:
        """What a function returns in a thread, while this one waits for it or for Ctrl-C."""
        made: list[Any] = []
        failed: list[BaseException] = []

        def run() -> None:
            try:
                made.append(work())
            except BaseException as error:  # noqa: BLE001 - raised again by the thread that waits
                failed.append(error)
            done.set()

        done = threading.Event()  # a thread whose `join` is interrupted is taken for ended
        try:
            threading.Thread(target=run, daemon=True).start()
            while not done.wait(0.1):
                pass
        except KeyboardInterrupt:
            self.connection.interrupt()
            done.wait(_PATIENCE)
            raise
        if failed:
            error = failed[0]
            if isinstance(error, MemoryError):
                raise QueryError(_TOO_MUCH) from error
            if isinstance(error, duckdb.Error | OSError):
                raise _explained(error, sql) from error
            raise error
        return made[0]


@contextmanager
def opened(archive: Archive, memory: str, threads: int) -> Iterator[Database]:
    """The archive's views in a database in memory that can read its files and nothing else, and write nothing.

    The working folder is the archive's until the block ends: the views name files from there, so that it may be moved.
    On Linux this process may take about twice `memory` until then: MemoryError is raised for what needs more.
    Raises QueryError for a size of memory that DuckDB does not know.
    """
    before = Path.cwd()
    os.chdir(archive.folder)
    try:
        config: dict[str, Any] = {**_CONFIG, "memory_limit": memory}
        if threads:
            config["threads"] = threads
        try:
            connection = duckdb.connect(":memory:", config=config)
        except duckdb.Error as error:
            raise _explained(error, "") from error
        try:
            connection.execute("SET allowed_directories = ['.']")
            try:
                _create_views(connection, archive)
            except duckdb.Error as error:
                raise _explained(error, "") from error
            connection.execute("SET enable_external_access = false")
            connection.execute("SET lock_configuration = true")
            with _limited(connection):
                yield Database(connection)
        finally:
            with suppress(duckdb.Error):  # it may still be busy with a question that was interrupted
                connection.close()
    finally:
        os.chdir(before)


@contextmanager
def _limited(connection: duckdb.DuckDBPyConnection) -> Iterator[None]:
    """Limit the memory of this process: DuckDB does not count long texts, nor the answer when it is handed over."""
    if sys.platform != "linux":
        yield
        return
    import resource  # noqa: PLC0415 - not on every system

    (counted,) = connection.execute("SELECT parse_formatted_bytes(current_setting('memory_limit'))").fetchone() or (0,)
    now = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[5]) * resource.getpagesize()
    before, most = resource.getrlimit(resource.RLIMIT_DATA)
    wanted = now + counted + max(counted, _BESIDE)
    limits = [one for one in (wanted, before, most) if one != resource.RLIM_INFINITY]
    resource.setrlimit(resource.RLIMIT_DATA, (min(limits), most))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_DATA, (before, most))


def write_views(archive: Archive) -> None:
    """Write the database of views again, for a shell of DuckDB that is started in the folder. Raises OSError."""
    before = Path.cwd()
    os.chdir(archive.folder)
    try:
        # Not in the archive: DuckDB takes a question mark in the path of a database for the start of options.
        with TemporaryDirectory(prefix="mudline-") as folder:
            with duckdb.connect(str(Path(folder, VIEWS)), config=dict(_CONFIG)) as connection:
                _create_views(connection, archive)
            write_atomically(Path(VIEWS), Path(folder, VIEWS).read_bytes())
    except duckdb.Error as error:
        raise OSError(f"the views cannot be written: {str(error).splitlines()[0]}") from error
    finally:
        os.chdir(before)


def _create_views(connection: duckdb.DuckDBPyConnection, archive: Archive) -> None:
    """Create `stored.TABLE` over the files, and of each table a view with the deck's file."""
    connection.execute("CREATE SCHEMA stored")
    for table in STORED:
        path = archive.path(table.name)
        rows = f"SELECT * FROM read_parquet('{path}')" if path else _nothing(table)  # noqa: S608 - names of ours
        connection.execute(f"CREATE VIEW stored.{table.name} AS {rows}")
    modified = "CASE WHEN modified >= 0 THEN make_timestamp(modified // 1000) END AS modified"
    connection.execute(f"CREATE VIEW files AS SELECT file, deck, bytes, {modified}, digest FROM stored.{FILES.name}")  # noqa: S608 - as above
    for table in TABLES:
        connection.execute(
            f"CREATE VIEW {table.name} AS SELECT f.file, t.* "  # noqa: S608 - as above
            f"FROM stored.{FILES.name} AS f JOIN stored.{table.name} AS t USING (deck)"
        )


def _nothing(table: Table) -> str:
    values = ", ".join(f"CAST(NULL AS {_TYPES[column.kind]}) AS {column.name}" for column in (DECK, *table.columns))
    return f"SELECT {values} WHERE false"


def _explained(error: BaseException, sql: str) -> QueryError:
    """An error of DuckDB in words of ours, with line and column of the SQL where it knows them."""
    text = str(error)
    start = text.find("{")
    try:
        found = json.loads(text[start:]) if start >= 0 else {}
    except ValueError:
        found = {}
    message = " ".join(str(found.get("exception_message", text)).split())
    kind = found.get("exception_type", "")
    if kind == "Out of Memory" or isinstance(error, duckdb.OutOfMemoryException):
        return QueryError(_TOO_MUCH)
    if kind == "IO" and "No files found" in message:
        return QueryError(f"{message}: another run has replaced it: ask again")
    if (file := _DATA_FILE.search(message)) and "Cannot open" not in message:
        return QueryError(f"{file[0]} is damaged: {AGAIN}")
    if _DISABLED in message:
        what = message.partition(" - ")[0]
        message = f"{what}: a question reads the tables of the archive and nothing else"
    message = message.partition(' Use "SET ')[0]  # no setting may be changed
    position = str(found.get("position", ""))
    if sql and position.isdigit():
        before = sql.encode()[: int(position)].decode("utf-8", "replace")
        line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
        message = f"line {line}, column {column} of the SQL: {message}"
    return QueryError(message)
