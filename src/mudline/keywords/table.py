"""Tables of rows as arrays, with the few fields that are no numbers beside them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.diagnostics import Span
from mudline.keywords.values import Equation, Kind, Label
from mudline.syntax.rows import Rows as RawRows
from mudline.syntax.rows import read_rows

Cell = float | int | str | None
LARGEST_WHOLE = 2.0**53


class Column(NamedTuple):
    """What a column holds."""

    label: str
    kind: Kind
    required: bool

    @property
    def whole(self) -> bool:
        """Whether its numbers are whole."""
        return self.kind in (Kind.WHOLE, Kind.IDENT)

    def fault(self, word: str) -> str:
        """Why a field that is no number cannot stand here, or ""."""
        if word == "":
            return f"{self.label} is missing: expected {self.kind.value}" if self.required else ""
        if self.kind is Kind.IDENT:
            return "" if Label.match(word) else f"{word!r} is no {self.label}: expected {self.kind.value}"
        return "" if Equation.match(word) else f"{word!r} is no number: expected {self.kind.value} for {self.label}"


class Table:
    """Rows of a fixed number of columns.

    `values` (rows, columns) float64 holds NaN where there is no number; `words` says what stands there instead: an
    equation, a label, or None for an empty field. A NaN without a word is a field that could not be read, or one
    beyond the row's end. `lengths` (rows,) counts the fields given in each row.
    """

    __slots__ = ("lengths", "values", "words")

    def __init__(
        self,
        values: NDArray[np.float64],
        lengths: NDArray[np.intp] | None = None,
        words: dict[tuple[int, int], Equation | Label | None] | None = None,
    ) -> None:
        self.values = values
        self.lengths = np.full(len(values), values.shape[1], dtype=np.intp) if lengths is None else lengths
        self.words = words or {}

    def __len__(self) -> int:
        return len(self.values)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Table):
            return NotImplemented
        return (
            np.array_equal(self.lengths, other.lengths)
            and self.words == other.words
            and self.values.shape == other.values.shape
            and self.values.tobytes() == other.values.tobytes()
        )

    __hash__ = None  # type: ignore[assignment]  # mutable arrays inside

    def __repr__(self) -> str:
        return f"Table({len(self)} rows of {self.values.shape[1]})"

    @property
    def equations(self) -> bool:
        """Whether any field is an equation."""
        return any(isinstance(word, Equation) for word in self.words.values())

    def column(self, index: int, default: float = math.nan) -> NDArray[np.float64]:
        """One column as an array (rows,); `default` where the row ends before it or the field is empty."""
        if index >= self.values.shape[1]:
            return np.full(len(self), default)
        values = self.values[:, index].copy()
        if not math.isnan(default):
            values[self.lengths <= index] = default
            for (row, column), word in self.words.items():
                if column == index and word is None:
                    values[row] = default
        return values

    def rows(self, columns: Sequence[Column]) -> list[list[Cell]]:
        """The rows as lists: whole numbers as int, empty fields None, equations and labels as text."""
        width = self.values.shape[1]
        lists: list[list[Cell]] = []
        bad = np.isnan(self.values)
        for index in range(width):
            whole = columns[index].whole and not bad[:, index].any()
            lists.append(self.values[:, index].astype(np.int64).tolist() if whole else self.values[:, index].tolist())
        found = [list(row) for row in zip(*lists, strict=True)]
        if self.words or (self.lengths != width).any():
            for (row, column), word in self.words.items():
                found[row][column] = None if word is None else str(word)
            for row, length in enumerate(self.lengths.tolist()):
                del found[row][length:]
                for column in range(length):
                    cell = found[row][column]
                    if columns[column].whole and isinstance(cell, float) and cell.is_integer():
                        found[row][column] = int(cell)
        return found


def from_cells(cells: Sequence[Sequence[Cell]], columns: Sequence[Column]) -> Table:
    """A table from lists, as JSON holds them. Raises ValueError naming row and column."""
    width = max((len(row) for row in cells), default=0)
    values = np.full((len(cells), width), math.nan)
    lengths = np.fromiter((len(row) for row in cells), dtype=np.intp, count=len(cells))
    words: dict[tuple[int, int], Equation | Label | None] = {}
    fewest = _fewest(columns)
    if width > len(columns) or (len(cells) and int(lengths.min()) < fewest):
        row = int(np.flatnonzero((lengths > len(columns)) | (lengths < fewest))[0])
        raise ValueError(f"row {row}: {_fields(lengths[row])}, expected {_count(columns)}")
    if len(cells) and int(lengths.min()) == width and _all_numbers(cells):
        values = np.array(cells, dtype=np.float64).reshape(len(cells), width)
    else:
        for row, fields in enumerate(cells):
            for column, cell in enumerate(fields):
                if isinstance(cell, int | float):
                    values[row, column] = cell
                    continue
                if fault := columns[column].fault(cell or ""):
                    raise ValueError(f"row {row}, column {column}: {fault}")
                words[row, column] = _word(cell or "")
    table = Table(values, lengths, words)
    for (row, column), fault in _not_whole(table, columns).items():
        raise ValueError(f"row {row}, column {column}: {fault}")
    return table


def from_text(text: str, columns: Sequence[Column]) -> Table:
    """A table from a block of rows, as YAML holds a long one. Raises ValueError naming row and column."""
    table, faults = from_rows(read_rows(text, Span(0, len(text)), len(columns)), columns)
    for (row, column), fault in sorted(faults.items()):
        raise ValueError(f"row {row}, column {column}: {fault}" if column >= 0 else f"row {row}: {fault}")
    return table


def from_rows(raw: RawRows, columns: Sequence[Column]) -> tuple[Table, dict[tuple[int, int], str]]:
    """A table from raw rows, and what is wrong in it by row and column (column -1: the whole row).

    Empty fields beyond the last column (a trailing comma) are dropped.
    """
    faults: dict[tuple[int, int], str] = {}
    words: dict[tuple[int, int], Equation | Label | None] = {}
    lengths = np.minimum(raw.lengths, len(columns))
    for (row, column), word in raw.words.items():
        if fault := columns[column].fault(word):
            faults[row, column] = fault
        else:
            words[row, column] = _word(word)
    fewest = _fewest(columns)
    for row in np.flatnonzero((raw.lengths < fewest) | (raw.lengths > len(columns))).tolist():
        faults[row, -1] = f"{_fields(raw.lengths[row])}, expected {_count(columns)}"
        raw.values[row, 1:] = math.nan  # the row still defines its number
    table = Table(raw.values, lengths, words)
    return table, faults | _not_whole(table, columns)


def _word(text: str) -> Equation | Label | None:
    return None if text == "" else Label.match(text) or Equation.match(text)


def _fewest(columns: Sequence[Column]) -> int:
    return max((index + 1 for index, column in enumerate(columns) if column.required), default=0)


def _fields(count: int) -> str:
    return "1 field" if count == 1 else f"{count} fields"


def _count(columns: Sequence[Column]) -> str:
    fewest, most = _fewest(columns), len(columns)
    return f"{fewest}" if fewest == most else f"{fewest} to {most}"


def _all_numbers(cells: Sequence[Sequence[Cell]]) -> bool:
    return {type(cell) for row in cells for cell in row} <= {int, float}


def _not_whole(table: Table, columns: Sequence[Column]) -> dict[tuple[int, int], str]:
    faults: dict[tuple[int, int], str] = {}
    for index in range(table.values.shape[1]):
        if not columns[index].whole:
            continue
        values = table.values[:, index]
        values += 0.0  # a whole number has no signed zero
        with np.errstate(invalid="ignore"):
            wrong = (values != np.floor(values)) & ~np.isnan(values) | (np.abs(values) > LARGEST_WHOLE)
        for row in np.flatnonzero(wrong).tolist():
            value = float(values[row])
            faults[row, index] = f"{value!r} is no whole number: {columns[index].label} needs one"
            values[row] = math.nan
    return faults
