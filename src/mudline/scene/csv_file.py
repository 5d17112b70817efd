"""A CSV file with a header: named columns as text, every fault with its line and column."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.codes import DAT001
from mudline.diagnostics import DeckError, Diagnostic, Span
from mudline.syntax.rows import read_number, read_rows_fast


class CsvTable(NamedTuple):
    """The columns of a file by name, each a list of texts, and the line of each row."""

    file: str
    columns: dict[str, list[str]]
    lines: list[int]

    def numbers(self, name: str, *, whole: bool = False, optional: bool = False) -> NDArray[np.float64]:
        """A column as finite numbers; an empty field of an optional column is NaN. Raises DeckError with the place."""
        values = np.empty(len(self.lines))
        position = list(self.columns).index(name) + 1
        for row, text in enumerate(self.columns[name]):
            value = read_number(text)
            if value is None and optional and not text:
                value = np.nan
            if value is None or (whole and not value.is_integer()):
                what = "a whole number" if whole else "a number"
                raise data_error(self.file, f"field {position} ({name}): {text!r} is not {what}", self.lines[row])
            values[row] = value
        return values


def data_error(file: str, message: str, line: int = 1, column: int = 1) -> DeckError:
    """A fault of a data file."""
    return DeckError([Diagnostic(file, DAT001.code, DAT001.slug, DAT001.severity, message, line, column, line, column)])


def read_text(path: Path) -> str:
    """A text file; raises OSError, or DeckError when it is not UTF-8."""
    try:
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise data_error(path.as_posix(), f"not a UTF-8 text file ({error.reason} at byte {error.start})") from error


def read_header(path: Path, text: str, needed: Sequence[str], known: Sequence[str]) -> list[str]:
    """The names in the first line, in lower case; raises DeckError when one is missing, unknown or there twice."""
    first = text.partition("\n")[0]
    names = [name.strip().lower() for name in next(csv.reader([first.rstrip("\r")]), [])]
    expected = ",".join(known)
    if missing := [name for name in needed if name not in names]:
        raise data_error(path.as_posix(), f"the header lacks {', '.join(missing)}: expected {expected}")
    for position, name in enumerate(names):
        if name not in known:
            raise data_error(path.as_posix(), f"the header has {name!r}: expected {expected}", 1, position + 1)
        if name in names[:position]:
            raise data_error(path.as_posix(), f"the header has {name!r} twice", 1, position + 1)
    return names


def read_csv(path: Path, needed: Sequence[str], known: Sequence[str]) -> CsvTable:
    """A whole file as text columns; rows that are empty are left out."""
    text = read_text(path)
    names = read_header(path, text, needed, known)
    columns: dict[str, list[str]] = {name: [] for name in names}
    lines: list[int] = []
    reader = csv.reader(io.StringIO(text, newline=""))
    try:
        next(reader)
        for row in reader:
            if not any(field.strip() for field in row):
                continue
            if len(row) != len(names):
                message = f"{len(row)} fields, the header has {len(names)}"
                raise data_error(path.as_posix(), message, reader.line_num)
            lines.append(reader.line_num)
            for name, field in zip(names, row, strict=True):
                columns[name].append(field.strip())
    except csv.Error as error:
        raise data_error(path.as_posix(), f"no CSV: {error}", reader.line_num) from error
    return CsvTable(path.as_posix(), columns, lines)


def read_numeric_csv(path: Path, needed: Sequence[str], known: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    """A file of finite numbers only, as arrays by name; large files at the speed of the table reader."""
    text = read_text(path)
    names = read_header(path, text, needed, known)
    start = text.find("\n") + 1
    rows = read_rows_fast(text, Span(start, len(text)), len(names)) if start else None
    if rows is not None and rows.values.shape[1] == len(names):
        return dict(zip(names, rows.values.T.copy(), strict=True))
    table = read_csv(path, needed, known)
    return {name: table.numbers(name) for name in names}
