"""Results as a workbook of spreadsheets; needs the extra `excel`."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, BinaryIO

import numpy as np
import xlsxwriter
from xlsxwriter.exceptions import XlsxWriterException
from xlsxwriter.worksheet import Worksheet

from mudline.contact.columns import Column, Table
from mudline.contact.result import Part
from mudline.quantities import RESULT_FORMAT, time_unit
from mudline.results.evaluation import Evaluation
from mudline.results.forms import More, Output, Sink, Tables
from mudline.scene.csv_file import data_error
from mudline.short_repr import cut

SUMMARY = (
    "sheets `elements`, `nodes` and `summary`, with units below the names of the columns; "
    "`pip install 'mudline[excel]'`"
)
BESIDE = ()

MOST_ROWS = 1_048_576
"""Rows of a sheet."""
_HEADINGS = 2
"""Rows of them: names and units."""
_LONGEST = 32_767
"""Characters of a cell."""
_NARROW, _WIDE = 10, 40
"""Widths of columns in characters."""
_BLOCK = 4096
"""Rows written at a time."""

_CREATED = datetime(2000, 1, 1, tzinfo=UTC)
"""The date in a workbook of tables, which says nothing."""
_FORMAT, _UNITS = "mudline.format", "mudline.units"
"""Properties of the workbook."""


@contextmanager
def opened(output: Output) -> Iterator[Sink]:
    """What takes the results. Raises DeckError where a sheet has no place for all rows of a table."""
    for name, table in output.tables.items():
        _require_place(output.evaluation, name, table)
    with TemporaryDirectory(prefix=".mudline-", dir=output.folder, ignore_cleanup_errors=True) as folder:
        options = {"constant_memory": True, "tmpdir": folder}
        book = xlsxwriter.Workbook(output.streams[0], options)
        try:
            yield Workbook(book, output)
        finally:
            for sheet in book.worksheets():
                sheet.row_data_fh.close()
            book.fileclosed = True  # after a fault it must not write itself when it is thrown away


def _require_place(evaluation: Evaluation, name: str, table: Table) -> None:
    rows = evaluation.steps * table.rows
    if rows > MOST_ROWS - _HEADINGS:
        raise evaluation.scene.refusal(_too_many(rows, name))


def _too_many(rows: int, name: str) -> str:
    return f"{rows} rows of {name}: a sheet of a workbook holds {MOST_ROWS - _HEADINGS}; write .parquet instead"


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write a sheet for each table; the same tables give the same bytes. Raises OSError, DeckError."""
    with TemporaryDirectory(prefix=".mudline-", dir=folder, ignore_cleanup_errors=True) as temporary:
        book = xlsxwriter.Workbook(streams[0], {"tmpdir": temporary})
        book.set_properties({"created": _CREATED})
        book.set_custom_property(_FORMAT, tables.format)
        book.set_custom_property(_UNITS, tables.units)
        formats = _formats(book)
        for name, columns in tables.columns.items():
            rows = len(columns[0].values)
            if rows > MOST_ROWS - _HEADINGS:
                raise data_error(name, _too_many(rows, name))
            sheet = book.add_worksheet(name, worksheet_class=_Sheet)
            _head(sheet, columns, formats, frozen=1)
            cells = [_cells(column, 0, slice(None)) for column in columns]
            for row, values in enumerate(zip(*cells, strict=True), _HEADINGS):
                _write_row(sheet, row, values)
        try:
            book.close()
        except XlsxWriterException as error:
            raise OSError(str(error)) from error


class Workbook:
    """A sheet of each table: names, units, then the rows; `time` in front when there are times.

    Texts are texts whatever they begin with, numbers read back to the same double; no value is an empty cell. The rows
    are in temporary files in the folder of the output until the end.
    """

    def __init__(self, book: Any, output: Output) -> None:  # noqa: ANN401 - xlsxwriter has no types
        self._book, self._tables, self._times = book, output.tables, output.evaluation.time
        book.use_zip64()
        book.set_custom_property(_FORMAT, RESULT_FORMAT)
        book.set_custom_property(_UNITS, output.elements.units)
        self._formats = _formats(book)
        self._sheets = {name: book.add_worksheet(name, worksheet_class=_Sheet) for name in self._tables}
        self._rows = dict.fromkeys(self._tables, _HEADINGS)

    def take(self, part: Part) -> None:
        """Write some steps. Raises OSError."""
        for name, table in self._tables.items():
            flat = [column for vector in table.columns(part) for column in vector.flat()]
            if self._times is not None:
                times = np.repeat(self._times[part.steps, np.newaxis], table.rows, axis=1)
                flat.insert(0, Column("time", times, unit=time_unit(table.units)))
            if part.start == 0:
                _head(self._sheets[name], flat, self._formats, frozen=1 + (self._times is not None))
            cells = chain.from_iterable(
                zip(*(_cells(column, step, block) for column in flat), strict=True)
                for step in range(part.count)
                for block in _blocks(table.rows)
            )
            for row in cells:
                _write_row(self._sheets[name], self._rows[name], row)
                self._rows[name] += 1

    def finish(self, more: More) -> None:
        """Write the workbook; it has no place for more. Raises OSError."""
        del more
        try:
            self._book.close()
        except XlsxWriterException as error:
            raise OSError(str(error)) from error


def _formats(book: Any) -> tuple[Any, Any]:  # noqa: ANN401 - as above
    """The formats of names and of units."""
    return book.add_format({"bold": True}), book.add_format({"italic": True})


def _head(sheet: Any, columns: Sequence[Column], formats: tuple[Any, Any], *, frozen: int) -> None:  # noqa: ANN401
    """Write names and units, which stay in sight as so many columns do."""
    for place, column in enumerate(columns):
        longest = max((len(name) for name in column.names if name), default=_NARROW)
        sheet.set_column(place, place, min(max(_NARROW, len(column.name), longest) + 2, _WIDE))
        sheet.write_string(0, place, column.name, formats[0])
    for place, column in enumerate(columns):
        if column.unit:
            sheet.write_string(1, place, f"[{column.unit}]", formats[1])
    sheet.freeze_panes(_HEADINGS, frozen)


class _Sheet(Worksheet):  # type: ignore[misc] # xlsxwriter has no types
    """A sheet whose numbers have all their digits; those of xlsxwriter have 16."""

    def _xml_number_element(self, number: float, attributes: Sequence[tuple[str, object]] = ()) -> None:
        about = "".join(f' {key}="{value}"' for key, value in attributes)
        self.fh.write(f"<c{about}><v>{number!r}</v></c>")


def _blocks(rows: int) -> Iterator[slice]:
    return (slice(start, start + _BLOCK) for start in range(0, rows, _BLOCK))


def _cells(column: Column, step: int, block: slice) -> Sequence[object]:
    """The values of some rows of a step; None for no value."""
    values: list[Any] = column.cut(step, step + 1)[0, block].tolist()
    if column.names:
        texts = [None if name is None else _text(name) for name in column.names]
        return [texts[code] for code in values]
    if column.blank is not None:
        return [None if value == column.blank else value for value in values]
    return values


def _text(name: str) -> str:
    """A name as a cell can hold it; half a surrogate pair is escaped."""
    return cut(name.encode("utf-8", "backslashreplace").decode(), _LONGEST)


def _write_row(sheet: Any, row: int, values: Sequence[object]) -> None:  # noqa: ANN401 - as above
    for place, value in enumerate(values):
        if isinstance(value, bool):
            sheet.write_boolean(row, place, value)
        elif isinstance(value, str):
            sheet.write_string(row, place, value)
        elif value is not None and not math.isnan(value):  # type: ignore[arg-type] # it is a number
            sheet.write_number(row, place, value)
