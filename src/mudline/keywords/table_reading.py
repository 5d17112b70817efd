"""Rows of text, or lists as JSON holds them, to a table; every fault with its row and column."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple, cast

import numpy as np

from mudline.diagnostics import Span
from mudline.keywords.table import Cell, Column, Table, Word
from mudline.keywords.text import number_fault, whole_fault
from mudline.keywords.values import LARGEST_WHOLE
from mudline.syntax.rows import Rows, read_number, read_rows

WHOLE_ROW = -1
"""The column of a fault that is one of the whole row."""


class CellFault(NamedTuple):
    """What is wrong with a field of a table."""

    row: int
    column: int
    message: str

    @property
    def place(self) -> tuple[int, ...]:
        """Row and column, or the row alone."""
        return (self.row,) if self.column == WHOLE_ROW else (self.row, self.column)


Place = tuple[int, int]


class Checked(NamedTuple):
    """A table, the rows and columns where something is wrong, and where a label was taken for one without braces."""

    table: Table
    faults: list[Place]
    doubts: list[Place]


def check(raw: Rows, columns: Sequence[Column]) -> Checked:
    """A table from raw rows. A row with a wrong number of fields keeps its first alone: it still defines its number."""
    words: dict[Place, Word] = {}
    faults: list[Place] = []
    doubts: list[Place] = []
    miscounted = set(np.flatnonzero((raw.lengths < fewest(columns)) | (raw.lengths > len(columns))).tolist())
    for (row, column), word in raw.words.items():
        typed = columns[column].word_type.match(word)
        kept = row not in miscounted or column == 0
        if typed or (not word and not columns[column].required):
            words |= {(row, column): typed} if kept else {}
        elif kept and (label := columns[column].label_in(word)):
            words[row, column] = label
            doubts.append((row, column))
        elif word or kept:
            faults.append((row, column))
    faults += [(row, WHOLE_ROW) for row in miscounted]
    raw.values[list(miscounted), 1:] = math.nan
    table = Table(raw.values, np.minimum(raw.lengths, len(columns)), words)
    return Checked(table, sorted([*faults, *_not_whole(raw, columns)]), doubts)


def explain(raw: Rows, columns: Sequence[Column], row: int, column: int) -> str:
    """What is wrong at a place that `check` found, in a sentence."""
    if column == WHOLE_ROW:
        found = "1 field" if raw.lengths[row] == 1 else f"{raw.lengths[row]} fields"
        return f"{found}, expected {count(columns)}: `{wanted(columns)}`"
    label, kind = columns[column].label, columns[column].kind
    word = raw.words[row, column]
    if read_number(word) is not None:
        return whole_fault(word, label)
    return number_fault(word, label, kind.value) if word else f"{label} is missing: expected {kind.value}"


def from_text(text: str, columns: Sequence[Column]) -> tuple[Table, list[CellFault]]:
    """A table from a block of rows, as YAML holds a long one."""
    raw = read_rows(text, Span(0, len(text)), len(columns))
    table, faults, doubts = check(raw, columns)
    return table, [CellFault(*place, explain(raw, columns, *place)) for place in sorted(faults + doubts)]


def from_cells(cells: Sequence[object], columns: Sequence[Column]) -> tuple[Table, list[CellFault]]:
    """A table from lists, as JSON holds them."""
    raw, strange = _raw_rows(cells, columns)
    table, faults, doubts = check(raw, columns)
    told = {(fault.row, fault.column) for fault in strange}
    more = [CellFault(*place, explain(raw, columns, *place)) for place in faults + doubts if place not in told]
    return table, sorted(strange + more)


def _raw_rows(cells: Sequence[object], columns: Sequence[Column]) -> tuple[Rows, list[CellFault]]:
    """The rows as the reader of text gives them, and what cannot stand in a table at all."""
    if raw := _numbers(cells, len(columns)):
        return raw, []
    faults: list[CellFault] = []
    values = np.full((len(cells), len(columns)), math.nan)
    lengths = np.zeros(len(cells), dtype=np.intp)
    words: dict[tuple[int, int], str] = {}
    for row, fields in enumerate(cells):
        if not isinstance(fields, list):
            faults.append(CellFault(row, WHOLE_ROW, f"expected a list: `{wanted(columns)}`"))
            continue
        lengths[row] = len(fields)
        for column, cell in enumerate(fields[: len(columns)]):
            if cell is None or isinstance(cell, str):
                words[row, column] = cell or ""
            elif _is_number(cell):
                values[row, column] = cell
            else:
                faults.append(CellFault(row, column, f"expected {columns[column].kind.value}"))
    width = min(int(lengths.max(initial=0)), len(columns))
    return Rows(np.ascontiguousarray(values[:, :width]), lengths, words), faults


def _numbers(cells: Sequence[object], most: int) -> Rows | None:
    """Rows of one length with nothing but finite numbers; None for any others."""
    if not cells:
        return Rows(np.empty((0, most)), np.zeros(0, dtype=np.intp), {})
    if {type(row) for row in cells} != {list}:
        return None
    rows = cast("Sequence[list[Cell]]", cells)
    widths = set(map(len, rows))
    if len(widths) != 1 or max(widths) > most or not {type(cell) for row in rows for cell in row} <= {int, float}:
        return None
    try:
        values = np.array(rows, dtype=np.float64).reshape(len(rows), max(widths))
    except OverflowError:
        return None
    if not np.isfinite(values).all():
        return None
    return Rows(values, np.full(len(rows), values.shape[1], dtype=np.intp), {})


def _is_number(cell: object) -> bool:
    """A finite double or a whole number that fits into one; True and False are none."""
    if isinstance(cell, bool) or not isinstance(cell, int | float):
        return False
    try:
        return math.isfinite(float(cell))
    except OverflowError:
        return False


def _not_whole(raw: Rows, columns: Sequence[Column]) -> Iterator[Place]:
    """Numbers that are not whole where whole ones belong: from now on words. A whole number has no signed zero."""
    for index in range(raw.values.shape[1]):
        if columns[index].whole:
            values = raw.values[:, index]
            values += 0.0
            wrong = ~np.isnan(values) & ((values != np.floor(values)) | (np.abs(values) > LARGEST_WHOLE))
            for row in np.flatnonzero(wrong).tolist():
                raw.words[row, index] = repr(float(values[row]))
                values[row] = math.nan
                yield row, index


def fewest(columns: Sequence[Column]) -> int:
    """How many fields a row must have."""
    return max((index + 1 for index, column in enumerate(columns) if column.required), default=0)


def count(columns: Sequence[Column]) -> str:
    """How many fields a row may have, in words."""
    low, high = fewest(columns), len(columns)
    return f"{low}" if low == high else f"{low} to {high}"


def wanted(columns: Sequence[Column]) -> str:
    """The columns as a row shows them: `node, x, y [, z]`."""
    return row_format([column.label for column in columns], [column.required for column in columns])


def row_format(labels: Sequence[str], required: Sequence[bool]) -> str:
    """`a, [b], c [, d]`: fields in brackets may be left empty or, behind the last mandatory one, out."""
    last = max((index for index, needed in enumerate(required) if needed), default=-1)
    text = ""
    for index, (label, needed) in enumerate(zip(labels, required, strict=True)):
        if index > last:
            text += f" [, {label}]" if index else f"[{label}]"
        else:
            text += (", " if index else "") + (label if needed else f"[{label}]")
    return text
