"""CSV files with a header: named columns, every fault with its line; elements that come from such a file."""

from __future__ import annotations

import csv
import io
import tokenize
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.basics.limits import LISTED
from mudline.language.codes import DAT001
from mudline.language.diagnostics import DeckError, Diagnostic, Span
from mudline.language.keywords.text import shown
from mudline.language.syntax.rows import read_number, read_rows
from mudline.model.scene import numbering
from mudline.model.scene.numbering import Floats, Ids

_SEPARATORS = (",", ";", "\t")
"""Separators of fields in a file that another program wrote."""

DAMAGED = (
    # damaged bytes meet the checks of zipfile, of the parsers of headers and XML, and the assumptions of libraries
    ArithmeticError,
    AttributeError,
    EOFError,
    LookupError,
    MemoryError,
    RuntimeError,
    SyntaxError,
    TypeError,
    ValueError,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)
"""Errors, besides OSError, that a damaged archive, array or workbook raises when it is read."""

_UNUSED = "\0"
"""Beginning of the name of a column that is not needed."""


class CsvTable(NamedTuple):
    """Columns of a file by name, each a list of texts, and the line of each row; `text` is the whole file."""

    file: str
    columns: dict[str, list[str]]
    lines: list[int]
    text: str
    separator: str = ","

    def numbers(self, name: str, *, optional: bool = False) -> Floats:
        """Return a column as finite numbers; an empty field of an optional column is NaN. Raises DeckError."""
        values = np.empty(len(self.lines))
        for row, text in enumerate(self.columns[name]):
            value = np.nan if optional and not text else read_number(text)
            if value is None:
                raise self.fault(row, name, f"{name}: {shown(text)} is not a number")
            values[row] = value
        return values

    def whole(self, name: str) -> Ids:
        """Return a column as whole numbers; raises DeckError with line and column for any other value."""
        return whole_numbers(name, self.numbers(name), lambda row, message: self.fault(row, name, message))

    def fault(self, row: int, name: str, message: str) -> DeckError:
        """Return the error of a field, with its line and its column, or column 1 if quotation marks hide it."""
        line, field = self.lines[row], list(self.columns).index(name)
        written = next(islice(io.StringIO(self.text, newline=""), line - 1, None))  # lines as the reader counts them
        parts = written.rstrip("\r\n").split(self.separator)
        column = 1
        if len(parts) == len(self.columns):
            blanks = len(parts[field]) - len(parts[field].lstrip())
            column += sum(len(part) + 1 for part in parts[:field]) + blanks
        return data_error(self.file, message, line, column)


class NumericTable(NamedTuple):
    """Columns of finite numbers by name, and the line of each row."""

    file: str
    columns: dict[str, Floats]
    lines: Sequence[int]


def data_error(file: str, message: str, line: int = 1, column: int = 1) -> DeckError:
    """Return the error of a data file."""
    return DeckError([Diagnostic(file, DAT001.code, DAT001.slug, DAT001.severity, message, line, column, line, column)])


def whole_numbers(name: str, column: Floats, fault: Callable[[int, str], DeckError]) -> Ids:
    """Return a column as whole numbers; raises the `fault` of a row and a message for other values, or above 2^53."""
    ids, known = numbering.whole_numbers(column)
    if not known.all():
        row = int(np.argmin(known))
        raise fault(row, f"{name}: {float(column[row])!r} is not a whole number up to 2^53")
    return ids


def read_csv(path: Path, needed: Sequence[str], known: Sequence[str] | None) -> CsvTable:
    """Return a whole file as text columns; empty rows are left out. Raises OSError, DeckError.

    If `known` is None, the file may have columns of other names, which are ignored.
    """
    file, text = path.as_posix(), _read_text(path)
    return _texts(file, text, _header(file, text, needed, known))


def read_numeric_csv(
    path: Path, needed: Sequence[str], known: Sequence[str], headings: Mapping[str, str] | None = None
) -> NumericTable:
    """Return a file of numbers, read quickly if all of them have a plain form. Raises OSError, DeckError.

    `headings` gives columns the headings that another program wrote, in upper or lower case. Such a file may be
    separated by semicolons or tabs, and have more columns, which are ignored.
    """
    file, text = path.as_posix(), _read_text(path)
    separator, names = (
        _exported(file, text, needed, known, headings) if headings else (",", _header(file, text, needed, known))
    )
    used = [name for name in names if not name.startswith(_UNUSED)]
    start = text.find("\n") + 1
    rows = read_rows(text, Span(start, len(text)), len(names)) if start and separator == "," else None
    if rows is not None and not rows.words and len(rows.lengths) and (rows.lengths == len(names)).all():
        columns = {name: rows.values[:, names.index(name)].copy() for name in used}
        return NumericTable(file, columns, range(2, len(rows.values) + 2))
    table = _texts(file, text, names, separator)
    return NumericTable(file, {name: table.numbers(name) for name in used}, table.lines)


def _read_text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise data_error(path.as_posix(), f"not a UTF-8 text file ({error.reason} at byte {error.start})") from error


def _header(file: str, text: str, needed: Sequence[str], known: Sequence[str] | None) -> list[str]:
    """Return the names in the first line, in lower case; raises DeckError for missing, unknown or repeated names.

    If `known` is None, any name may be there.
    """
    names = [name.strip().lower() for name in next(csv_rows(file, text), ([], 1))[0]]
    expected = ",".join(known or needed)
    if missing := [name for name in needed if name not in names]:
        raise data_error(file, f"the header lacks {', '.join(missing)}: expected {expected}")
    for position, name in enumerate(names):
        if known is not None and name not in known:
            raise data_error(file, f"the header has {shown(name)}: expected {expected}")
        if name in names[:position]:
            raise data_error(file, f"the header has {name} twice")
    return names


def _exported(
    file: str, text: str, needed: Sequence[str], known: Sequence[str], headings: Mapping[str, str]
) -> tuple[str, list[str]]:
    """Return the separator of a file with other headings, and a name for each of its columns. Raises DeckError."""
    headings_wanted = {name: headings.get(name, name) for name in known if name in headings or name in needed}
    separator = separator_of(text)
    header = [field.strip() for field in next(csv_rows(file, text, separator), ([], 1))[0]]
    names_found = [field.casefold() for field in header]
    names = [f"{_UNUSED}{column}" for column in range(len(header))]
    optional = {name: name for name in known if name not in headings_wanted and name in names_found}
    for name, heading in (headings_wanted | optional).items():
        sought = heading.strip().casefold()
        if sought not in names_found:
            what = "" if heading == name else f" for {name}"
            listed = ", ".join(map(shown, header[:LISTED])) or "nothing"
            more = f" and {len(header) - LISTED} more" if len(header) > LISTED else ""
            raise data_error(file, f"the header lacks {shown(heading)}{what}: it has {listed}{more}")
        if names_found.count(sought) > 1:
            raise data_error(file, f"the header has {shown(heading)} twice")
        column = names_found.index(sought)
        if not names[column].startswith(_UNUSED):
            raise data_error(file, f"the column {shown(heading)} is taken for {names[column]} and for {name}")
        names[column] = name
    return separator, names


def _texts(file: str, text: str, names: Sequence[str], separator: str = ",") -> CsvTable:
    """Return the rows below the header, whose columns have these names."""
    columns: dict[str, list[str]] = {name: [] for name in names}
    lines: list[int] = []
    rows = csv_rows(file, text, separator)
    next(rows)
    for row, line in rows:
        if not any(field.strip() for field in row):
            continue
        if len(row) != len(names):
            raise data_error(file, f"{len(row)} fields, the header has {len(names)}", line)
        lines.append(line)
        for name, field in zip(names, row, strict=True):
            columns[name].append(field.strip())
    return CsvTable(file, columns, lines, text, separator)


def separator_of(text: str) -> str:
    """Return the separator that gives the first row the most fields: comma, semicolon or tab."""

    def fields(separator: str) -> int:
        try:
            return len(next(csv_rows("", text, separator), ([], 1))[0])
        except DeckError:  # reported when the lines are read
            return 0

    return max(_SEPARATORS, key=fields)


def csv_rows(file: str, text: str, separator: str = ",") -> Iterator[tuple[list[str], int]]:
    """Yield the rows of a text, each with the number of its last line."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        for row in reader:
            yield row, reader.line_num
    except csv.Error as error:
        raise data_error(file, f"not a CSV file: {error}", max(1, reader.line_num)) from error


def finite(file: str, name: str, array: NDArray[np.floating]) -> Floats:
    """Return an array as float64, one-dimensional; raises DeckError for a number that is not finite."""
    values = array.astype(np.float64).ravel()
    for value in values[~np.isfinite(values)][:1].tolist():
        raise data_error(file, f"{name} holds {value!r}, expected finite numbers")
    return values


@dataclass(frozen=True, slots=True)
class ExternalElements:
    """Elements (m): numbers, node numbers (m, 2), external diameters, lengths (NaN if not given), sets by name."""

    file: str
    ids: Ids
    nodes: Ids
    diameter: Floats
    length: Floats
    sets: dict[str, Ids]


def read_external(path: Path) -> ExternalElements:
    """Return elements from `element,node1,node2,diameter[,length][,sets]`, with sets separated by semicolons.

    A diameter or length may be empty. Raises OSError, or DeckError for a file with faults.
    """
    needed = ("element", "node1", "node2", "diameter")
    table = read_csv(path, needed, (*needed, "length", "sets"))
    if not table.lines:
        raise data_error(table.file, "no row below the header", 2)
    ids, first, second = map(table.whole, ("element", "node1", "node2"))
    _, firsts = np.unique(ids, return_index=True)
    if len(repeated := np.setdiff1d(np.arange(len(ids)), firsts)):
        row = int(repeated[0])
        raise data_error(table.file, f"element {ids[row]} is given twice", table.lines[row])
    diameter = _positive("diameter", table)
    length = _positive("length", table) if "length" in table.columns else np.full(len(ids), np.nan)
    members: dict[str, list[int]] = {}
    for number, text in zip(ids.tolist(), table.columns.get("sets", [""] * len(ids)), strict=True):
        for name in filter(None, map(str.strip, text.split(";"))):
            members.setdefault(name, []).append(number)
    sets = {name: np.array(numbers, dtype=np.int64) for name, numbers in members.items()}
    return ExternalElements(table.file, ids, np.column_stack([first, second]), diameter, length, sets)


def _positive(name: str, table: CsvTable) -> Floats:
    values = table.numbers(name, optional=True)
    for row in np.flatnonzero(values <= 0)[:1].tolist():
        value = float(values[row])
        raise data_error(table.file, f"{name} is {value!r}: it must be greater than 0", table.lines[row])
    return values
