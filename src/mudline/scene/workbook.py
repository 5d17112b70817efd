"""Workbooks of spreadsheets (XLSX): opened for reading, every fault with its cell; needs the extra `excel`."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, BinaryIO
from xml.etree.ElementTree import ParseError

from mudline.diagnostics import DeckError
from mudline.scene.csv_file import data_error
from mudline.short_repr import cut

_UNREADABLE = (
    # damaged bytes meet the checks of zipfile, of the parser of XML, and the assumptions of openpyxl
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    NotImplementedError,
    OSError,
    ParseError,
    RuntimeError,
    TypeError,
    ValueError,
    zipfile.BadZipFile,
    zlib.error,
)


@contextmanager
def opened_workbook(stream: BinaryIO, file: str, *, formulas: bool = False) -> Iterator[Any]:
    """The workbook in a stream: the values that formulas had, or with `formulas` their texts.

    Raises DeckError for what is not a workbook, also in the block, where its sheets are read; ImportError without
    openpyxl.
    """
    from openpyxl import load_workbook  # noqa: PLC0415 - only who reads a workbook needs it
    from openpyxl.utils.exceptions import InvalidFileException  # noqa: PLC0415 - as above

    try:
        book = load_workbook(stream, read_only=True, data_only=not formulas)
        yield book
    except DeckError:
        raise
    except (*_UNREADABLE, InvalidFileException) as error:
        raise data_error(file, f"not a workbook that can be read: {cut(str(error), 100)}") from error


def cell_fault(file: str, sheet: str, place: tuple[int, int], message: str) -> DeckError:
    """The error about the cell in a row and a column, from 1."""
    from openpyxl.utils import get_column_letter  # noqa: PLC0415 - as above

    row, column = place
    where = f"sheet {cut(sheet, 40)}, cell {get_column_letter(column)}{row}"
    return data_error(file, f"{where}: {message}", row, column)
