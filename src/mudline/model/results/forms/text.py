"""Results as text: CSV, one file per table, and JSON, one document."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from typing import BinaryIO, TypeVar

import numpy as np
from pydantic_core import to_json

from mudline.basics.quantities import csv_lines
from mudline.model.contact.columns import ResultColumn, Values
from mudline.model.results.forms import Columns, FileContent, More, ResultOutput, Write, Writer

_BLOCK = 8192
"""Rows formatted at a time: the text of a large model is never in memory as a whole."""
_PIECE = 1000
"""Rows written at a time."""

T = TypeVar("T")
Row = tuple[str, ...]


def writer(output: ResultOutput) -> Writer:
    """Return the writer of a CSV for each table, or of one JSON."""
    writes = dict(zip(output.contents.rows, map(text_into, output.streams), strict=False))  # JSON has one stream
    return text_writer(output.form, output.contents, writes)


def text_writer(form: str, contents: FileContent, writes: Mapping[str, Write]) -> Writer:
    """Return the writer of some tables as "csv", or of all tables as "json" into the first of the texts."""
    return CsvWriter(contents, writes) if form == "csv" else JsonWriter(contents, next(iter(writes.values())))


def text_into(stream: BinaryIO) -> Write:
    """Return a function that writes text into a file as UTF-8; half a surrogate pair, as in a name, is escaped."""
    return lambda pieces: stream.writelines(piece.encode("utf-8", "backslashreplace") for piece in pieces)


@dataclass(frozen=True, slots=True)
class Spelling:
    """Text of a name, and of a missing value, in a format."""

    name: Callable[[str], str]
    nothing: str

    def column(self, values: Values, names: tuple[str | None, ...] = (), blank: int | None = None) -> list[str]:
        """Return the values of a column as text, numbers with all digits; NaN, inf and `blank` are missing values."""
        if not values.size:
            return []
        if blank is not None:
            return [self.nothing if number == blank else str(number) for number in values.tolist()]
        if names:
            spelled = [self.nothing if name is None else self.name(name) for name in names]
            return [spelled[code] for code in values.tolist()]
        numbers = to_json(values.tolist(), inf_nan_mode="null")[1:-1].decode().split(",")
        if self.nothing == "null" or values.dtype.kind != "f" or np.isfinite(values).all():
            return numbers
        return [self.nothing if text == "null" else text for text in numbers]

    def rows(self, columns: Sequence[ResultColumn], steps: int, rows: int) -> Iterator[Row]:
        """Yield the rows of some steps, one step after the other, from flat columns."""
        for first, last, block in blocks(steps, rows, _BLOCK):
            texts = [
                self.column(column.values[block], column.names, column.blank) * (last - first)
                if column.steady
                else self.column(column.cut(first, last)[:, block].ravel(), column.names, column.blank)
                for column in columns
            ]
            yield from zip(*texts, strict=True)


def blocks(steps: int, rows: int, most: int) -> Iterator[tuple[int, int, slice]]:
    """Yield pieces of steps with at most so many rows: several whole steps, or a part of the rows of one step."""
    together = max(1, most // max(rows, 1))
    for first in range(0, steps, together):
        yield from ((first, min(steps, first + together), slice(at, at + most)) for at in range(0, rows, most))


def _batched(rows: Iterable[T]) -> Iterator[list[T]]:
    """Yield rows in lists that are written together."""
    remaining = iter(rows)
    while piece := list(islice(remaining, _PIECE)):
        yield piece


# ------------------------------------------------------------------------------------------------------------------ CSV

_CSV = Spelling(lambda name: next(csv_lines([[name]])).removesuffix("\n"), "")


class CsvWriter:
    """Writer of one file per table: `time` in front if there are times, `units` at the end."""

    def __init__(self, contents: FileContent, writes: Mapping[str, Write]) -> None:
        self._contents, self._writes = contents, writes

    def write(self, columns: Columns, start: int, count: int, _beside: Mapping[str, Sequence[object]]) -> None:
        """Write some steps; before the first, the names of the columns."""
        for table, write in self._writes.items():
            write(self._pieces(table, columns[table], start, count))

    def finish(self, more: More) -> None:
        """Write nothing: a table cannot hold `more`."""

    def _pieces(self, table: str, columns: Sequence[ResultColumn], start: int, count: int) -> Iterator[str]:
        rows = self._contents.rows[table]
        units = ResultColumn("units", np.zeros(rows, np.int32), (self._contents.units, None), over_steps=False)
        flat = [*self._contents.timed(table, columns, start, count), units]
        if start == 0:
            yield ",".join(column.name for column in flat) + "\n"
        for piece in _batched(_CSV.rows(flat, count, rows)):
            yield "".join([f"{','.join(row)}\n" for row in piece])


# ----------------------------------------------------------------------------------------------------------------- JSON

_JSON = Spelling(partial(json.dumps, ensure_ascii=False), "null")


class JsonWriter:
    """Writer of one document, a row on a line; with times, the rows are under `steps`."""

    def __init__(self, contents: FileContent, write: Write) -> None:
        self._contents, self._write = contents, write

    def write(self, columns: Columns, start: int, count: int, beside: Mapping[str, Sequence[object]]) -> None:
        """Write some steps; before the first, the head."""
        self._write(self._steps(columns, start, count, beside))

    def finish(self, more: More) -> None:
        """Write the end, with additional keys."""
        end = "" if self._contents.times is None else "]"
        self._write(iter([end, *(f",\n {_pair(key, value)}" for key, value in more.items()), "}\n"]))

    def _steps(self, columns: Columns, start: int, count: int, beside: Mapping[str, Sequence[object]]) -> Iterator[str]:
        contents, times = self._contents, self._contents.times
        if start == 0:
            about = {"format": contents.format, "units": contents.units, **contents.head}
            yield "{" + ",\n ".join(_pair(key, value) for key, value in about.items())
            yield "" if times is None else ',\n "steps": ['
        flat = {table: [part for column in each for part in column.flat()] for table, each in columns.items()}
        rows = {table: _JSON.rows(each, count, contents.rows[table]) for table, each in flat.items()}
        indent = " " if times is None else "   "
        for step in range(count):
            if times is not None:
                yield ("," if start + step else "") + f'\n  {{"time": {json.dumps(float(times[start + step]))}'
            for table, each in columns.items():
                yield f',\n{indent}"{table}": '
                yield from _list(_objects(each, islice(rows[table], contents.rows[table])), indent + " ")
            yield "".join(f",\n{indent}{_pair(key, values[step])}" for key, values in beside.items())
            yield "" if times is None else "}"


def _pair(key: str, value: object) -> str:
    """Return a key with its value; a list of objects has a line for each."""
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return f'"{key}": ' + "".join(_list(map(_dumped, value), "  "))
    return f'"{key}": {_dumped(value)}'


def _dumped(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _objects(columns: Sequence[ResultColumn], rows: Iterable[Row]) -> Iterator[str]:
    fields = (f'"{column.name}": {"[%s, %s, %s]" if column.vector else "%s"}' for column in columns)
    template = "{" + ", ".join(fields) + "}"
    return (template % row for row in rows)


def _list(objects: Iterable[str], indent: str) -> Iterator[str]:
    mark = "["
    for piece in _batched(objects):
        yield "".join([f"{',' if i else mark}\n{indent}{text}" for i, text in enumerate(piece)])
        mark = ","
    yield "]" if mark == "," else "[]"
