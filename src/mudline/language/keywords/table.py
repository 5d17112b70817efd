"""Tables of rows as arrays, with their few texts in a dict; tables and lists of documents."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple, cast, overload

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError, to_json

from mudline.basics.short_repr import counted
from mudline.language.diagnostics import Span
from mudline.language.keywords.values import WHOLE_KINDS, Equation, Kind, Label
from mudline.language.syntax.rows import RawRows, read_rows

Cell = float | int | str | None
LARGEST_WHOLE = 2**53
_ROWS_AT_ONCE = 1 << 14
"""Number of rows whose intermediate results fit into the fast memory of a processor."""


def not_whole(written: str, value: float, label: str) -> str:
    """Return the message for a number in place of a whole one; `written` is its spelling."""
    if value.is_integer():
        return f"{written} is too large: {label} needs a whole number of at most 2^53 ({LARGEST_WHOLE})"
    return f"{written} is not a whole number: {label} needs one"


def misfit(message: str, *path: str | int) -> ValidationError:
    """Return the error to be raised for a fault inside a value, at a row, or at a row and a column."""
    kind = PydanticCustomError("table", "{fault}", {"fault": message})
    return ValidationError.from_exception_data("table", [InitErrorDetails(type=kind, loc=path, input=None)])


class Column(NamedTuple):
    """Column of a table: label, kind of its values, and whether it is required."""

    label: str
    kind: Kind
    required: bool

    @property
    def whole(self) -> bool:
        """True if the numbers are whole."""
        return self.kind in WHOLE_KINDS

    def fault(self, word: str) -> str:
        """Return the fault of a field that is not a number, or ""."""
        if word == "":
            return f"{self.label} is missing: expected {self.kind.value}" if self.required else ""
        if self.kind is Kind.IDENT:
            return "" if Label.match(word) else f"{word!r} is not allowed for {self.label}: expected {self.kind.value}"
        return "" if Equation.match(word) else f"{word!r} is not a number: expected {self.kind.value} for {self.label}"


class Table:
    """Rows of a fixed number of columns; iteration gives tuples.

    Attributes:
        values: (rows, columns) float64; NaN in a field without a number.
        words: contents of such a field: an equation, a label, or None if it is empty. A field without word and number
            could not be read, or is beyond the end of its row.
        lengths: (rows,) number of fields in each row; without them, all rows have all fields.
        columns: columns of a table in a block.
    """

    __slots__ = ("columns", "lengths", "values", "words")

    def __init__(
        self,
        values: NDArray[np.float64],
        lengths: NDArray[np.intp] | None = None,
        words: dict[tuple[int, int], Equation | Label | None] | None = None,
        columns: Sequence[Column] = (),
    ) -> None:
        self.values = values
        self.lengths = np.full(len(values), values.shape[1], dtype=np.intp) if lengths is None else lengths
        self.words = words or {}
        self.columns = columns

    if TYPE_CHECKING:  # a field is assigned from rows, as `read_table` takes them, and some from None

        def __get__(self, part: object, kind: type | None = None) -> Table: ...
        def __set__(
            self, part: object, rows: Table | Sequence[Sequence[Cell]] | NDArray[np.generic] | str | None
        ) -> None: ...

    def __len__(self) -> int:
        return len(self.values)

    def __iter__(self) -> Iterator[tuple[Cell, ...]]:
        for rows, _ in self._parts():
            yield from map(tuple, rows)

    @overload
    def __getitem__(self, at: int) -> tuple[Cell, ...]: ...
    @overload
    def __getitem__(self, at: slice) -> list[tuple[Cell, ...]]: ...
    def __getitem__(self, at: int | slice) -> tuple[Cell, ...] | list[tuple[Cell, ...]]:
        numbers = np.atleast_1d(np.arange(len(self))[at])
        rows = [*self.chosen(numbers)]
        return rows if isinstance(at, slice) else rows[0]

    def chosen(self, numbers: Sequence[int] | NDArray[np.intp]) -> Table:
        """Return the table of the rows with these numbers, in that order."""
        rows = np.asarray(numbers, dtype=np.intp)
        place = {row: number for number, row in enumerate(rows.tolist())}
        words = {(place[row], column): word for (row, column), word in self.words.items() if row in place}
        return Table(self.values[rows], self.lengths[rows], words, self.columns)

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
        """True if any field is an equation."""
        return bool(self.words) and any(isinstance(word, Equation) for word in self.words.values())

    @property
    def unknown(self) -> bool:
        """True if any field could not be read."""
        left_out = len(self.words) + int((self.values.shape[1] - self.lengths).sum())
        return int(np.isnan(self.values).sum()) > left_out

    def column(self, index: int, default: float = math.nan) -> NDArray[np.float64]:
        """Return a column as an array (rows,), `default` where the row is too short or the field empty."""
        if index >= self.values.shape[1]:
            return np.full(len(self), default)
        values = self.values[:, index].copy()
        if not math.isnan(default):
            values[self.lengths <= index] = default
            for (row, column), word in self.words.items():
                if column == index and word is None:
                    values[row] = default
        return values

    def cell(self, row: int, column: int) -> float | Equation | Label | None:
        """Return the contents of a cell; None if the row does not exist or is too short."""
        if (row, column) in self.words:
            return self.words[row, column]
        inside = row < len(self) and column < self.values.shape[1]
        return float(self.values[row, column]) if inside else None

    def rows(self) -> list[list[Cell]]:
        """Return the rows as lists: whole numbers as int, empty fields None, equations and labels as text."""
        return [row for rows, _ in self._parts() for row in rows]

    def lines(self, spelled: Callable[[list[Cell]], str]) -> Iterator[str]:
        """Yield the rows as text, in chunks of some thousand, separated by line feeds.

        Cells are separated by a comma and a space; `spelled` writes a row with other contents than numbers.
        """
        for rows, plain in self._parts():
            if plain:
                text = to_json(rows).decode("ascii")
                yield text[2:-2].replace("],[", "\n").replace(",", ", ")
            else:
                yield "\n".join(map(spelled, rows))

    def _parts(self) -> Iterator[tuple[list[list[Cell]], bool]]:
        """Yield the rows as lists, in chunks of some thousand; True if they are only numbers, in the full width."""
        odd = (self.lengths != self.values.shape[1]) | np.isnan(self.values).any(axis=1)
        words: dict[int, list[tuple[int, int]]] = {}
        for place in self.words:
            words.setdefault(place[0] // _ROWS_AT_ONCE, []).append(place)
        for number, start in enumerate(range(0, len(self), _ROWS_AT_ONCE)):
            part = slice(start, start + _ROWS_AT_ONCE)
            plain = not odd[part].any()
            rows = _lists(self.values[part], self.columns)
            if not plain:
                for row, column in words.get(number, ()):
                    word = self.words[row, column]
                    rows[row - start][column] = None if word is None else str(word)
                for cells, length in zip(rows, self.lengths[part].tolist(), strict=True):
                    del cells[length:]
            yield rows, plain


def _lists(values: NDArray[np.float64], columns: Sequence[Column]) -> list[list[Cell]]:
    """Return rows of numbers as lists."""
    whole = [column.whole for column in columns[: values.shape[1]]]
    if not any(whole):
        return cast("list[list[Cell]]", values.tolist())
    by_column: list[list[Cell]] = []
    for column, needed in zip(values.T, whole, strict=True):
        exact = needed and not np.isnan(column).any()
        cells = (column.astype(np.int64) if exact else column).tolist()
        by_column.append([cell if math.isnan(cell) else int(cell) for cell in cells] if needed and not exact else cells)
    return [list(row) for row in zip(*by_column, strict=True)]


def from_cells(cells: list[object], columns: Sequence[Column]) -> Table:
    """Return a table from lists, as in JSON; raises ValidationError for the first row or cell that does not fit."""
    for row, fields in enumerate(cells):
        if type(fields) is not list:
            raise misfit(f"expected a row: a list of {_count(columns)} values", row)
    rows = cast("list[list[object]]", cells)
    lengths = np.fromiter(map(len, rows), dtype=np.intp, count=len(rows))
    fewest, width = fewest_of(columns), int(lengths.max(initial=0))
    if width > len(columns) or (len(rows) and int(lengths.min()) < fewest):
        row = int(np.flatnonzero((lengths > len(columns)) | (lengths < fewest))[0])
        raise misfit(f"{counted(int(lengths[row]), 'field')}, expected {_count(columns)}", row)
    table = _numbers(rows, lengths, width, columns) or _cells(rows, lengths, width, columns)
    for (row, column), fault in _not_whole(table).items():
        raise misfit(fault, row, column)
    return table


def _numbers(
    rows: list[list[object]], lengths: NDArray[np.intp], width: int, columns: Sequence[Column]
) -> Table | None:
    """Return the table of rows that only hold finite numbers; None for other rows."""
    if not set(map(type, chain.from_iterable(rows))) <= {int, float}:
        return None
    try:
        flat = np.fromiter(chain.from_iterable(rows), dtype=np.float64, count=int(lengths.sum()))
    except OverflowError:
        return None
    if not np.isfinite(flat).all():
        return None
    values = np.full((len(rows), width), math.nan)
    values[np.arange(width) < lengths[:, np.newaxis]] = flat
    return Table(values, lengths, columns=columns)


def _cells(rows: list[list[object]], lengths: NDArray[np.intp], width: int, columns: Sequence[Column]) -> Table:
    """Return the table of rows that contain words."""
    values = np.full((len(rows), width), math.nan)
    words: dict[tuple[int, int], Equation | Label | None] = {}
    for row, fields in enumerate(rows):
        for column, value in enumerate(fields):
            cell = value.item() if isinstance(value, np.generic) else value
            if isinstance(cell, int | float) and not isinstance(cell, bool):
                values[row, column] = _finite(cell, row, column)
            elif cell is not None and (not isinstance(cell, str) or not cell):
                raise misfit(f"{cell!r} is not allowed here: expected {columns[column].kind.value}", row, column)
            elif fault := columns[column].fault(cell or ""):
                raise misfit(fault, row, column)
            else:
                words[row, column] = _word(cell or "")
    return _without_empty_ends(Table(values, lengths, words, columns))


def _finite(cell: float, row: int, column: int) -> float:
    try:
        value = float(cell)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        raise misfit("the number is not finite, or too large for double precision", row, column)
    return value


def from_rows(raw: RawRows, columns: Sequence[Column]) -> tuple[Table, dict[tuple[int, int], str]]:
    """Return a table from raw rows, and its faults by row and column (column -1: the whole row).

    Empty fields behind the last non-empty one, which trailing commas leave, are dropped.
    """
    fewest, width = fewest_of(columns), raw.values.shape[1]
    if not raw.words and fewest <= width <= len(columns) and (raw.lengths == width).all():
        table = Table(raw.values, raw.lengths, columns=columns)
        return table, _not_whole(table)
    faults: dict[tuple[int, int], str] = {}
    words: dict[tuple[int, int], Equation | Label | None] = {}
    lengths = np.minimum(raw.lengths, len(columns))
    for (row, column), word in raw.words.items():
        if fault := columns[column].fault(word):
            faults[row, column] = fault
        else:
            words[row, column] = _word(word)
    wrong = (raw.lengths < fewest) | (raw.lengths > len(columns))
    for row in np.flatnonzero(wrong).tolist() if wrong.any() else ():
        faults[row, -1] = f"{counted(int(raw.lengths[row]), 'field')}, expected {_count(columns)}"
        raw.values[row, 1:] = math.nan  # the row still defines its number
    table = _without_empty_ends(Table(raw.values, lengths, words, columns))
    return table, faults | _not_whole(table)


def _without_empty_ends(table: Table) -> Table:
    """Return the table without optional empty fields at the ends of its rows."""
    fewest = max(fewest_of(table.columns), 1)
    empty = [(row, column) for (row, column), word in table.words.items() if word is None and column >= fewest]
    lengths = table.lengths.copy() if empty else table.lengths
    for row, column in sorted(empty, reverse=True):
        if column == lengths[row] - 1:
            lengths[row] = column
            del table.words[row, column]
    width = int(lengths.max(initial=0)) if len(lengths) else table.values.shape[1]
    return Table(np.ascontiguousarray(table.values[:, :width]), lengths, table.words, table.columns)


def _word(text: str) -> Equation | Label | None:
    return None if text == "" else Label.match(text) or Equation.match(text)


def fewest_fields(required: Iterable[bool]) -> int:
    """Return the least number of fields in a row: all up to the last that is required."""
    return max((index + 1 for index, needed in enumerate(required) if needed), default=0)


def fewest_of(columns: Sequence[Column]) -> int:
    """Return the least number of fields in a row of these columns."""
    return fewest_fields(column.required for column in columns)


def _count(columns: Sequence[Column]) -> str:
    fewest, most = fewest_of(columns), len(columns)
    return f"{fewest}" if fewest == most else f"{fewest} to {most}"


def _not_whole(table: Table) -> dict[tuple[int, int], str]:
    faults: dict[tuple[int, int], str] = {}
    columns = table.columns
    for index in range(table.values.shape[1]):
        if not columns[index].whole:
            continue
        values = table.values[:, index]
        values += 0.0  # a whole number has no signed zero
        wrong = (values > np.floor(values)) | (np.abs(values) > LARGEST_WHOLE)  # False for NaN
        for row in wrong.nonzero()[0].tolist():
            value = float(values[row])
            faults[row, index] = not_whole(repr(value), value, columns[index].label)
            values[row] = math.nan
    return faults


AS_TABLES = "as tables"
"""Serialization context in which a table stays one: lists of a million rows would take half a second more."""


def read_table(rows: object, columns: Sequence[Column]) -> Table:
    """Return the table of rows, or of a text of rows; raises ValidationError with row and column, or ValueError."""
    if isinstance(rows, Table):
        rows.columns = columns
        return rows
    if isinstance(rows, str):
        table, faults = from_rows(read_rows(rows, Span(0, len(rows)), len(columns)), columns)
        for (row, column), fault in sorted(faults.items()):
            raise misfit(fault, row, *([column] if column >= 0 else []))
        return table
    if isinstance(rows, list) and set(map(type, rows)) <= {list}:
        return from_cells(rows, columns)
    if isinstance(rows, list | tuple | np.ndarray):
        return from_cells(plain(list(rows)), columns)
    raise ValueError("expected rows: a list of lists, or a text with a row a line")


def plain(value: Any) -> Any:
    """Return a value in the types of documents: arrays, tables and tuples as lists, numpy numbers as Python's."""
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    if isinstance(value, list | tuple | Table):
        return [plain(each) for each in value]
    return {name: plain(each) for name, each in value.items()} if isinstance(value, dict) else value


def row_format(labels: list[str], required: list[bool]) -> str:
    """Return the format of a row, `a, b [, c]`: optional fields before the last required one in brackets."""
    fewest = fewest_fields(required)
    text = ""
    for index, (label, needed) in enumerate(zip(labels, required, strict=True)):
        comma = ", " if index else ""
        if index >= fewest:
            text += f" [{comma.strip()} {label}]" if index else f"[{label}]"
        else:
            text += comma + (label if needed else f"[{label}]")
    return text
