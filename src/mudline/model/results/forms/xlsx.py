"""Results as a workbook of spreadsheets; needs the extra `excel`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from tempfile import TemporaryDirectory
from typing import Any

import xlsxwriter
from xlsxwriter.exceptions import XlsxWriterException
from xlsxwriter.worksheet import Worksheet

from mudline.basics.quantities import finite
from mudline.basics.short_repr import cut
from mudline.model.contact.columns import ResultColumn
from mudline.model.results.forms import Columns, FormError, More, ResultOutput
from mudline.model.results.forms.text import blocks

SHEET_ROWS = 1_048_576
"""Rows of a sheet, at most."""
_HEADINGS = 2
"""Rows of headings: names and units."""
_CELL_LETTERS = 32_767
"""Characters of a cell, at most."""
_NARROW, _WIDE = 10, 40
"""Widths of columns in characters."""
_BLOCK = 4096
"""Rows written at a time."""
_CREATED = datetime(2000, 1, 1, tzinfo=UTC)
"""Fixed date of workbooks: the same results give the same bytes."""


class WorkbookWriter:
    """Writer of one sheet per table: names, units, then the rows; `time` in front if there are times.

    A text stays a text whatever its first character. Numbers read back to the same double; a missing value is an empty
    cell. The rows are in temporary files in the folder of the workbook until the end.
    """

    def __init__(self, output: ResultOutput) -> None:
        """Raise FormError if a sheet cannot hold all rows of a table."""
        contents = output.contents
        for table, rows in contents.rows.items():
            if contents.steps * rows > SHEET_ROWS - _HEADINGS:
                most = f"a sheet of a workbook holds {SHEET_ROWS - _HEADINGS}; write .parquet instead"
                raise FormError(f"{contents.steps * rows} rows of {table}: {most}")
        folder = TemporaryDirectory(prefix=".mudline-", dir=output.folder, ignore_cleanup_errors=True)
        memory = {"constant_memory": True, "tmpdir": output.open.enter_context(folder)}
        plain = {"strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
        self._book, self._contents = xlsxwriter.Workbook(output.streams[0], memory | plain), contents
        output.open.callback(self._discard)
        self._book.use_zip64()
        self._book.set_properties({"created": _CREATED})
        self._book.set_custom_property("mudline.format", contents.format)
        self._book.set_custom_property("mudline.units", contents.units)
        self._bold, self._italic = (self._book.add_format({style: True}) for style in ("bold", "italic"))
        self._sheets = {name: self._book.add_worksheet(name, worksheet_class=_ExactSheet) for name in contents.rows}
        self._rows = dict.fromkeys(contents.rows, _HEADINGS)

    def _discard(self) -> None:
        """Close the temporary files; after an error the workbook must not write itself when it is deleted."""
        for sheet in self._book.worksheets():
            sheet.row_data_fh.close()
        self._book.fileclosed = True

    def write(self, columns: Columns, start: int, count: int, _beside: Mapping[str, Sequence[object]]) -> None:
        """Write some steps. Raises OSError."""
        for table, sheet in self._sheets.items():
            flat = self._contents.timed(table, columns[table], start, count)
            if start == 0:
                self._head(sheet, flat)
            for first, last, block in blocks(count, self._contents.rows[table], _BLOCK):
                for row in zip(*(_cells(column, first, last, block) for column in flat), strict=True):
                    sheet.write_row(self._rows[table], 0, row)
                    self._rows[table] += 1

    def finish(self, _more: More) -> None:
        """Write the workbook; it cannot hold `more`. Raises OSError."""
        try:
            self._book.close()
        except XlsxWriterException as error:
            raise OSError(str(error)) from error

    def _head(self, sheet: Any, columns: Sequence[ResultColumn]) -> None:  # noqa: ANN401 - as above
        """Write names and units, which stay in view, as do the first columns."""
        for place, column in enumerate(columns):
            longest = max((len(name) for name in column.names if name), default=_NARROW)
            sheet.set_column(place, place, min(max(_NARROW, len(column.name), longest) + 2, _WIDE))
        sheet.write_row(0, 0, [column.name for column in columns], self._bold)
        sheet.write_row(1, 0, [f"[{column.unit}]" if column.unit else None for column in columns], self._italic)
        sheet.freeze_panes(_HEADINGS, 1 + (self._contents.times is not None))


class _ExactSheet(Worksheet):  # type: ignore[misc] # xlsxwriter has no types
    """A sheet whose numbers have all their digits; xlsxwriter writes 16."""

    def _xml_number_element(self, number: float, attributes: Sequence[tuple[str, object]] = ()) -> None:
        about = "".join(f' {key}="{value}"' for key, value in attributes)
        self.fh.write(f"<c{about}><v>{number!r}</v></c>")


writer = WorkbookWriter


def _cells(column: ResultColumn, first: int, last: int, block: slice) -> Sequence[object]:
    """Return the values of some rows of some steps; None for a missing value."""
    values: list[Any] = column.cut(first, last)[:, block].ravel().tolist()
    if column.names:
        texts = [None if name is None else _text(name) for name in column.names]
        return [texts[code] for code in values]
    if column.blank is not None:
        return [None if value == column.blank else value for value in values]
    return [finite(value) for value in values] if column.values.dtype.kind == "f" else values


def _text(name: str) -> str:
    """Return a name as a cell can hold it; half a surrogate pair is escaped."""
    return cut(name.encode("utf-8", "backslashreplace").decode(), _CELL_LETTERS)
