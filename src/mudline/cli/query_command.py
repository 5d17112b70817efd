"""`mudline query`: questions to an archive in SQL; answers as a table, CSV, JSON or Parquet."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TypeAlias

import click

from mudline.cli import DONE, WRONG_USAGE, options
from mudline.cli.index_command import lacks_libraries
from mudline.cli.streams import counted, emit, encoded, notify, writing
from mudline.cli.view import View
from mudline.display import DisplayColumn, DisplayTable
from mudline.limits import SHOWN_ROWS
from mudline.quantities import csv_lines

if TYPE_CHECKING:
    from mudline.archive.database import Database

Arrow: TypeAlias = Any
"""A reader, batch or type of pyarrow, which has no types; or a value that one holds."""
_FORMATS = ("text", "csv", "json", "parquet")


@options.command("query")
@click.argument("archive", metavar="ARCHIVE", shell_complete=options.complete_files)
@click.argument("sql", metavar="SQL")
@click.option(
    "-o", "--output", type=options.OUTPUT_FILE, metavar="OUT.csv|json|parquet", help="Write the answer to a file."
)
@options.output_format(*_FORMATS)
@click.option(
    "--memory-limit", default="2GB", show_default=True, metavar="SIZE", help="Memory that a question may use."
)
@click.option(
    "--jobs", type=click.IntRange(min=0), default=0, metavar="N", help="Threads; 0 (default): one for each processor."
)
@options.common
def command(
    *,
    archive: str,
    sql: str,
    output: str | None,
    output_format: str,
    memory_limit: str,
    jobs: int,
    view: View,
) -> int:
    """Answer a question about an archive of mudline index, in SQL.

    The tables are files, decks, keywords, sets, curves, laws, parameters and findings. A question reads the archive and
    nothing else. Needs pip install 'mudline[archive]'.
    """
    if lacks_libraries("query"):
        return WRONG_USAGE
    form = _form(output, output_format)
    from mudline.archive.database import QueryError, opened  # noqa: PLC0415 - an extra
    from mudline.archive.store import Archive, ArchiveError  # noqa: PLC0415 - an extra

    target = None if output is None else Path(output).absolute()
    try:
        found = Archive.opened(Path(archive))
        if damage := found.damage(thorough=False):
            raise click.ClickException(damage)
        with opened(found, memory_limit, jobs) as database:
            _deliver(database, database.ask(sql), form, target, view)
    except MemoryError as error:
        raise click.ClickException("the answer needs more memory than it may use: raise --memory-limit") from error
    except (ArchiveError, QueryError) as error:
        raise click.ClickException(str(error)) from error
    if target is not None and not view.quiet:
        notify(f"answer -> {output}")
    return DONE


def _deliver(database: Database, reader: Arrow, form: str, target: Path | None, view: View) -> None:
    twice = [name for name, count in Counter(reader.schema.names).items() if count > 1]
    if twice and form in {"json", "parquet"}:
        raise click.ClickException(f"several columns of the answer are called {twice[0]!r}: name them with AS")
    if target is not None:
        _write(database, reader, form, target)
    elif form == "text":
        _print_table(database, reader, view)
    else:
        for piece in _pieces(database, reader, form):
            emit([piece])


def _form(output: str | None, output_format: str) -> str:
    """The format of the answer; raises click.UsageError."""
    if output is None:
        if output_format == "parquet":
            raise click.UsageError("Parquet is a binary format: give -o OUT.parquet")
        return output_format
    return options.form_of_file(output, _FORMATS[1:])


# ----------------------------------------------------------------------------------------------------------- answers


def _batches(database: Database, reader: Arrow) -> Iterator[Arrow]:
    while (batch := database.next_batch(reader)) is not None:
        yield batch


def _values(batch: Arrow) -> list[list[Arrow]]:
    """The values of each column; raises click.ClickException for those that Python lacks, such as infinite dates."""
    found = []
    for name, column in zip(batch.schema.names, batch.columns, strict=True):
        try:
            found.append(column.to_pylist())
        except (OverflowError, ValueError) as error:
            message = f"column {name}: {error}: cast it to VARCHAR in the SQL, or give -o OUT.parquet"
            raise click.ClickException(message) from error
    return found


def _print_table(database: Database, reader: Arrow, view: View) -> None:
    """Print the first rows, all of them with -v."""
    rows: list[tuple[Arrow, ...]] = []
    count = 0
    for batch in _batches(database, reader):
        count += batch.num_rows
        part = batch if view.verbose else batch.slice(0, max(SHOWN_ROWS - len(rows), 0))
        rows += zip(*_values(part), strict=True)
    columns = [DisplayColumn(field.name, at, left=not _is_number(field.type)) for at, field in enumerate(reader.schema)]
    note = f"{counted(count - len(rows), 'more row')}: -v shows all" if count > len(rows) else counted(count, "row")
    cells = [[_cell(value) for value in row] for row in rows]
    view.printer().table(DisplayTable("Answer", columns, cells, note))


def _is_number(kind: Arrow) -> bool:
    return str(kind).startswith(("int", "uint", "double", "float", "decimal"))


def _cell(value: Arrow) -> str | int | float | None:
    """A value as a cell of a table or of CSV."""
    plain = _plain(value)
    if isinstance(plain, bool):
        return "true" if plain else "false"
    if plain is None or isinstance(plain, str | int | float):
        return plain
    return json.dumps(plain, ensure_ascii=False)


def _plain(value: Arrow) -> Arrow:
    """A value as JSON has it: None for NaN and infinite numbers, text for what is neither a number nor a list."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Decimal):
        return int(value) if value == value.to_integral_value() else float(value)
    if isinstance(value, Mapping):
        return {str(name): _plain(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value if value is None or isinstance(value, str | int) else str(value)


def _pieces(database: Database, reader: Arrow, form: str) -> Iterator[str]:
    """The answer as text in pieces."""
    columns = list(reader.schema.names)
    if form == "csv":
        yield from csv_lines([columns])
        for batch in _batches(database, reader):
            yield from csv_lines([_cell(value) for value in row] for row in zip(*_values(batch), strict=True))
        return
    mark = "["
    for batch in _batches(database, reader):
        for row in zip(*_values(batch), strict=True):
            content = dict(zip(columns, map(_plain, row), strict=True))
            yield f"{mark}\n {json.dumps(content, ensure_ascii=False, allow_nan=False)}"
            mark = ","
    yield "[]\n" if mark == "[" else "\n]\n"


def _write(database: Database, reader: Arrow, form: str, target: Path) -> None:
    """Write the answer to a file, which is whole or not there."""
    with writing(target) as stream, _parquet(reader, stream, form) as writer:
        if writer is None:
            stream.writelines(encoded(piece) for piece in _pieces(database, reader, form))
        else:
            for batch in _batches(database, reader):
                writer.write_batch(batch)


def _parquet(reader: Arrow, stream: BinaryIO, form: str) -> AbstractContextManager[Any]:
    if form != "parquet":
        return nullcontext()
    import pyarrow.parquet as pq  # noqa: PLC0415 - an extra

    try:
        writer: AbstractContextManager[Any] = pq.ParquetWriter(stream, reader.schema)
    except NotImplementedError as error:
        raise click.ClickException(f"Parquet has no such type: cast the column in the SQL: {error}") from error
    return writer
