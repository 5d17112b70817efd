"""Sheets of workbooks (XLSX, with the extra `excel`) and CSV files: rows of cells, every fault with its place."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any, BinaryIO, NamedTuple

from mudline.basics.limits import LARGEST_FILE
from mudline.basics.short_repr import cut
from mudline.language.diagnostics import DeckError
from mudline.language.syntax.source import Source
from mudline.model.scene.csv_file import DAMAGED, csv_rows, data_error, separator_of


@contextmanager
def opened_workbook(stream: BinaryIO, file: str, *, formulas: bool = False) -> Iterator[Any]:
    """Yield the workbook in a stream: the values that formulas had, or with `formulas` their texts.

    Raises DeckError for a file that is not a workbook, also when its sheets are read in the block; ImportError without
    openpyxl.
    """
    from openpyxl import load_workbook  # noqa: PLC0415 - only who reads a workbook needs it
    from openpyxl.utils.exceptions import InvalidFileException  # noqa: PLC0415 - as above

    try:
        with zipfile.ZipFile(stream) as archive:
            unpacked = sum(part.file_size for part in archive.infolist())
        if unpacked > LARGEST_FILE:
            raise data_error(file, f"unpacks to more than {LARGEST_FILE} bytes: export the sheet as CSV")
        yield load_workbook(stream, read_only=True, data_only=not formulas)
    except DeckError:
        raise
    except (*DAMAGED, OSError, InvalidFileException) as error:
        raise data_error(file, f"not a workbook that can be read: {cut(str(error), 100)}") from error


class Cell(NamedTuple):
    """Cell: row and column from 1, its value, and True if a formula in it was never calculated."""

    row: int
    column: int
    value: object
    uncalculated: bool = False


@dataclass(frozen=True)
class WorkbookSheet:
    """Rows of a sheet, each the cells with a value; the only sheet of a CSV file has the name of the file."""

    file: str
    title: str
    rows: Sequence[Sequence[Cell]]
    is_workbook: bool

    def fault(self, row: int, column: int, message: str) -> DeckError:
        """Return the error about the cell in a row and a column, from 1."""
        if not self.is_workbook:
            heading = next((str(cell.value) for cell in self.rows[0] if cell.column == column), str(column))
            return data_error(self.file, f"column {cut(heading, 40)}: {message}", row)
        from openpyxl.utils import get_column_letter  # noqa: PLC0415 - as above

        where = f"sheet {cut(self.title, 40)}, cell {get_column_letter(column)}{row}"
        return data_error(self.file, f"{where}: {message}", row, column)


def workbook_sheets(data: bytes, file: str) -> list[WorkbookSheet]:
    """Return the sheets of a workbook with the values that formulas had when it was saved.

    Raises DeckError for a file that is not a workbook; ImportError without openpyxl.
    """
    with (
        opened_workbook(io.BytesIO(data), file) as book,
        opened_workbook(io.BytesIO(data), file, formulas=True) as written,
    ):
        pairs = zip(book.worksheets, written.worksheets, strict=True)
        return [WorkbookSheet(file, sheet.title, list(_rows(sheet, texts)), is_workbook=True) for sheet, texts in pairs]


def _rows(sheet: Any, texts: Any) -> Iterator[list[Cell]]:  # noqa: ANN401 - openpyxl has no types
    """Yield the rows of a sheet whose cells have a value, or a formula without one."""
    for view in (sheet, texts):
        view.reset_dimensions()
    for number, (values, formulas) in enumerate(zip(sheet.iter_rows(), texts.iter_rows(), strict=True), 1):
        cells = []
        for column, (value, formula) in enumerate(zip(values, formulas, strict=True), 1):
            uncalculated = value.value is None and formula.value is not None
            if uncalculated or (value.value is not None and str(value.value).strip()):
                cells.append(Cell(number, column, value.value, uncalculated))
        yield cells


def csv_sheet(data: bytes, file: str) -> WorkbookSheet:
    """Return a CSV file as a sheet; its first row shows the separator: comma, semicolon or tab.

    Raises DeckError for a file that is not text.
    """
    source = Source.from_bytes(data, file)
    if not source.readable:
        raise data_error(file, source.problems[0].message)
    rows: list[list[Cell]] = []
    for fields, line in csv_rows(file, source.unified, separator_of(source.unified)):
        cells = ((column, text.strip()) for column, text in enumerate(fields, 1))
        rows.append([Cell(line, column, text) for column, text in cells if text])
    return WorkbookSheet(file, PurePath(file).stem, rows, is_workbook=False)
