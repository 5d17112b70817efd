"""Results as tables of CSV."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from itertools import chain, islice
from pathlib import Path
from typing import BinaryIO

import numpy as np

from mudline.contact.columns import Column, Table, Values
from mudline.contact.result import Part
from mudline.keywords.text import shown
from mudline.quantities import RESULT_FORMAT, Kind, csv_lines
from mudline.results.evaluation import Evaluation
from mudline.results.forms import (
    More,
    Output,
    Sink,
    Spelling,
    Tables,
    Together,
    Write,
    batched,
    plain_values,
    step_rows,
    tables_of,
    text_into,
)
from mudline.results.stored import Coder, Stacked, Stored, StoredTable, Texts, checked_units, flat_kinds, require_names
from mudline.scene.csv_file import data_error

SUMMARY = "elements; the nodes in `...-nodes.csv`, the lines in `...-summary.csv`"
BESIDE = ("nodes", "summary")

_BLOCK = 16384
"""Rows read at a time."""


def _spelling(*, as_text: bool) -> Spelling:
    """Names as fields of CSV, quoted where they have to be; `as_text` for spreadsheets."""
    return Spelling(lambda name: next(csv_lines([[name]], as_text=as_text)).removesuffix("\n"), "")


def opened(output: Output) -> AbstractContextManager[Sink]:
    """What takes the results."""
    pairs = zip(output.tables.values(), output.streams, strict=True)
    made = [Text(output.evaluation, table, text_into(stream), as_text=output.as_text) for table, stream in pairs]
    return nullcontext(Together(made))


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write a file for each table."""
    del folder
    for table, stream in zip(tables.columns, streams, strict=True):
        text_into(stream)(tables_text(tables, table))


def tables_text(tables: Tables, table: str) -> Iterator[str]:
    """The lines of a table, with a column `units` at the end."""
    columns = tables.columns[table]
    rows = zip(*map(plain_values, columns), strict=True)
    head = [[*(column.name for column in columns), "units"]]
    return csv_lines(chain(head, ((*row, tables.units) for row in rows)), as_text=tables.as_text)


def read(path: Path) -> Stored:
    """What the file of the elements and that of the nodes beside it hold. Raises OSError, DeckError."""
    elements, nodes, units = tables_of(path, _read_table)
    return Stored(checked_units(path.as_posix(), units), elements, nodes)


def _read_table(path: Path, table: str) -> tuple[StoredTable, str | None]:
    """A table and its units, None where it has no row."""
    file = path.as_posix()
    try:
        with path.open(encoding="utf-8-sig", newline="") as stream:
            return _Reader(file, table, csv.reader(stream)).read()
    except UnicodeDecodeError as error:
        raise data_error(file, f"not a UTF-8 text file ({error.reason} at byte {error.start})") from error
    except csv.Error as error:
        raise data_error(file, f"not a CSV file: {error}") from error


class _Reader:
    """Reads the rows of a table some at a time, so that its texts are never all in memory."""

    def __init__(self, file: str, table: str, rows: Iterator[list[str]]) -> None:
        self._file, self._rows = file, rows
        self._header = [name.strip() for name in next(rows, [])]
        require_names(file, table, self._header)
        if "units" not in self._header:
            raise data_error(file, f"no column units: expected the columns of {RESULT_FORMAT}; evaluate the deck again")
        self._kinds = flat_kinds(table)
        if "time" in self._header:
            self._kinds = {"time": "number", **self._kinds}
        self._coders = {name: Coder() for name, kind in self._kinds.items() if kind == "text"}

    def read(self) -> tuple[StoredTable, str | None]:
        """The table and its units."""
        found: dict[str, list[Values]] = {name: [] for name in self._kinds}
        units: set[str] = set()
        line = 2
        while block := list(islice(self._rows, _BLOCK)):
            self._require_widths(block, line)
            columns = dict(zip(self._header, zip(*block, strict=True), strict=True))
            units.update(columns["units"])
            for name, parts in found.items():
                parts.append(self._column(name, columns[name], line))
            line += len(block)
        if len(units) > 1:
            several = " and ".join(sorted(units)[:2])
            raise data_error(self._file, f"units: {several} in one file, expected one system")
        joined = {name: np.concatenate(parts) if parts else np.zeros(0) for name, parts in found.items()}
        times = joined.pop("time", None)
        columns_of: dict[str, Stacked] = {
            name: Texts(values.astype(np.int32), self._coders[name].names) if name in self._coders else values
            for name, values in joined.items()
        }
        return StoredTable(self._file, columns_of, times), next(iter(units), None)

    def _require_widths(self, block: list[list[str]], line: int) -> None:
        width = len(self._header)
        if set(map(len, block)) != {width}:
            row = next(row for row, fields in enumerate(block) if len(fields) != width)
            message = f"{len(block[row])} fields, the header has {width}: the file is cut off or edited"
            raise data_error(self._file, message, line + row)

    def _column(self, name: str, texts: Sequence[str], line: int) -> Values:
        if name in self._coders:
            return self._coders[name].coded(texts)
        kind = self._kinds[name]
        letters, convert = _READ[kind]
        with suppress(ValueError, LookupError, OverflowError):
            if letters.issuperset("".join(texts)):
                return convert(texts)
        blank = kind == "number"
        row = next(row for row, text in enumerate(texts) if not (_SPELLED[kind](text) or (blank and not text)))
        raise data_error(self._file, f"{name}: {shown(texts[row])} is not {_EXPECTED[kind]}", line + row)


_READ: dict[Kind, tuple[frozenset[str], Callable[[Sequence[str]], Values]]] = {
    "number": (frozenset("0123456789+-.eE"), lambda texts: np.array([float(text or "nan") for text in texts])),
    "whole": (frozenset("0123456789+-"), lambda texts: np.array([int(text) for text in texts], np.int64)),
    "flag": (
        frozenset("truefalse"),
        lambda texts: np.array([{"true": True, "false": False}[text] for text in texts], np.bool_),
    ),
}
"""The letters that the values of a kind may have, and what reads them; it raises where they have another form."""
_SPELLED: dict[Kind, Callable[[str], object]] = {
    "number": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII).fullmatch,
    "whole": re.compile(r"[+-]?\d{1,18}", re.ASCII).fullmatch,
    "flag": {"true", "false"}.__contains__,
}
_EXPECTED: dict[Kind, str] = {"number": "a number", "whole": "a whole number", "flag": "true or false"}


class Text:
    """The rows of a table as CSV, with a column `time` in front when there are times."""

    def __init__(self, evaluation: Evaluation, table: Table, write: Write, *, as_text: bool = False) -> None:
        self._table, self._write, self._spelling = table, write, _spelling(as_text=as_text)
        self._times = None if evaluation.time is None else evaluation.time.tolist()
        self._units = Column("units", np.zeros(table.rows, np.int32), (table.units, None), over_steps=False)

    def take(self, part: Part) -> None:
        """Write some steps; before the first, the names of the columns."""
        self._write(self._steps(part))

    def finish(self, more: More) -> None:
        """Write nothing: a table has no place for more."""

    def _steps(self, part: Part) -> Iterator[str]:
        columns = [*self._table.columns(part), self._units]
        if part.start == 0:
            names = [flat.name for column in columns for flat in column.flat()]
            yield ",".join(names if self._times is None else ["time", *names]) + "\n"
        for step, rows in enumerate(step_rows(columns, part.count, self._table.rows, self._spelling), part.start):
            before = "" if self._times is None else f"{self._times[step]!r},"
            for piece in batched(rows):
                yield "".join([f"{before}{','.join(row)}\n" for row in piece])
