"""Results as one JSON document."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, NoReturn

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.columns import Column, Table
from mudline.contact.result import Part
from mudline.diagnostics import DeckError
from mudline.quantities import QUANTITIES, RESULT_FORMAT
from mudline.results.evaluation import Evaluation
from mudline.results.forms import (
    More,
    Output,
    Row,
    Sink,
    Spelling,
    Tables,
    Write,
    batched,
    plain_values,
    plan_rows,
    step_rows,
    text_into,
)
from mudline.results.stored import (
    TABLES,
    Stacked,
    Stored,
    StoredTable,
    checked_format,
    checked_units,
    column_of,
    require_names,
)
from mudline.scene.csv_file import data_error
from mudline.short_repr import cut

SUMMARY = "everything: units, plan, elements, nodes, `restrained`, `summary`, `warnings`, `against`"
BESIDE = ()

_SPELLING = Spelling(partial(json.dumps, ensure_ascii=False), "null")


def opened(output: Output) -> AbstractContextManager[Sink]:
    """What takes the results."""
    return nullcontext(Text(output.evaluation, output.elements, text_into(output.streams[0])))


def write_tables(tables: Tables, streams: Sequence[BinaryIO], folder: Path) -> None:
    """Write one document, a row of a table on a line."""
    del folder
    text_into(streams[0])(tables_text(tables))


def tables_text(tables: Tables, table: str = "") -> Iterator[str]:
    """The document, with all tables."""
    del table
    yield f'{{"format": {_dumped(tables.format)},\n "units": {_dumped(tables.units)}'
    yield from (f',\n "{name}": {_dumped(value)}' for name, value in tables.more.items())
    for name, columns in tables.columns.items():
        rows = zip(*map(plain_values, columns), strict=True)
        names = [column.name for column in columns]
        yield f',\n "{name}": '
        yield from _list((_dumped(dict(zip(names, row, strict=True))) for row in rows), "  ")
    yield "}\n"


class Text:
    """The JSON of the contract, a row on a line; with times, the rows are under `steps`."""

    def __init__(self, evaluation: Evaluation, elements: Table, write: Write) -> None:
        self._evaluation, self._write = evaluation, write
        self._tables: dict[str, Table] = {"elements": elements, "nodes": evaluation.node_table()}
        self._times = None if evaluation.time is None else evaluation.time.tolist()

    def take(self, part: Part) -> None:
        """Write some steps; before the first, units and plan."""
        self._write(self._steps(part))

    def finish(self, more: More) -> None:
        """Write the end, with further keys."""
        further = (f',\n "{name}": {_dumped(value)}' for name, value in more.items())
        self._write(iter(["" if self._times is None else "]", *further, "}\n"]))

    def _steps(self, part: Part) -> Iterator[str]:
        if part.start == 0:
            yield from self._head()
        columns = {name: table.columns(part) for name, table in self._tables.items()}
        rows = {
            name: step_rows(columns[name], part.count, table.rows, _SPELLING) for name, table in self._tables.items()
        }
        indent = " " if self._times is None else "   "
        for step in range(part.start, part.start + part.count):
            if self._times is not None:
                yield ("," if step else "") + f'\n  {{"time": {json.dumps(self._times[step])},\n'
            for index, name in enumerate(self._tables):
                yield (",\n" if index else "") + f'{indent}"{name}": '
                yield from _list(_objects(columns[name], next(rows[name])), indent + " ")
            restrained = part.result.restrained
            if restrained is not None:
                numbers = self._evaluation.scene.node_ids[restrained[step - part.start]].tolist()
                yield f',\n{indent}"restrained": {json.dumps(numbers)}'
            if self._times is not None:
                yield "}"

    def _head(self) -> Iterator[str]:
        yield f'{{"format": "{RESULT_FORMAT}",\n "units": {json.dumps(self._evaluation.scene.units)},\n "plan": '
        yield from _list(map(_dumped, plan_rows(self._evaluation.model.plan)), "  ")
        yield ",\n" if self._times is None else ',\n "steps": ['


def read(path: Path) -> Stored:
    """What a file holds. Raises OSError, DeckError."""
    file = path.as_posix()
    try:
        held = json.loads(path.read_bytes(), parse_constant=_no_constant)
    except RecursionError as error:
        raise data_error(file, "not a file of results: lists within lists within lists") from error
    except ValueError as error:
        raise data_error(file, f"not a JSON file: {error}") from error
    if not isinstance(held, dict):
        raise data_error(file, f"not a file of results: expected an object, found {type(held).__name__}")
    checked_format(file, held.get("format"))
    units = checked_units(file, held.get("units"))
    steps = held.get("steps", [held])
    if not isinstance(steps, list) or not all(isinstance(step, dict) for step in steps):
        raise data_error(file, "steps: expected a list of objects")
    times = None
    if "steps" in held:
        given = [step.get("time", _ABSENT) for step in steps]
        times = np.asarray(column_of(given, "number", "time", lambda row, why: data_error(file, f"step {row}: {why}")))
    return Stored(units, *(_stored_table(file, table, steps, times) for table in TABLES))


def _stored_table(file: str, table: str, steps: list[dict[str, Any]], times: FloatArray | None) -> StoredTable:
    """The rows of a table at all steps."""
    places: list[tuple[int, int]] = []
    rows: list[dict[str, Any]] = []
    for number, step in enumerate(steps):
        listed = step.get(table)
        if not isinstance(listed, list) or not all(isinstance(row, dict) for row in listed):
            raise data_error(file, f"step {number}: expected {table} as a list of objects")
        rows += listed
        places += [(number, row) for row in range(len(listed))]
    if rows:
        _require_keys(file, table, rows[0])

    def fault(index: int, message: str) -> DeckError:
        step, row = places[index]
        return data_error(file, f"step {step}, row {row} of {table}: {message}")

    columns: dict[str, Stacked] = {}
    for quantity in QUANTITIES[table].values():
        name = quantity.name
        values = [row.get(name, _ABSENT) for row in rows]
        if not quantity.vector:
            columns[name] = column_of(values, quantity.kind, name, fault)
            continue
        for index, value in enumerate(values):
            if not isinstance(value, list) or len(value) != 3:
                raise fault(index, f"{name}: expected a list of three numbers, found {cut(repr(value), 40)}")
        for axis, suffix in enumerate(("_x", "_y", "_z")):
            columns[name + suffix] = column_of([value[axis] for value in values], quantity.kind, name, fault)
    return StoredTable(file, columns, None if times is None else times[np.array([step for step, _ in places], np.intp)])


class _Absent:
    """Stands for a key that is not there."""

    def __repr__(self) -> str:
        return "nothing"


_ABSENT = _Absent()


def _require_keys(file: str, table: str, row: dict[str, Any]) -> None:
    """Raise DeckError where the first row of a table lacks keys."""
    vectors = [name for name, value in row.items() if isinstance(value, list)]
    require_names(file, table, [*row, *(f"{name}_{axis}" for name in vectors for axis in "xyz")])


def _no_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is not a number of JSON")


def _dumped(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _objects(columns: list[Column], rows: Iterable[Row]) -> Iterator[str]:
    fields = (f'"{column.name}": {"[%s, %s, %s]" if column.vector else "%s"}' for column in columns)
    template = "{" + ", ".join(fields) + "}"
    return (template % row for row in rows)


def _list(objects: Iterable[str], indent: str) -> Iterator[str]:
    mark = "["
    for piece in batched(objects):
        yield "".join([f"{',' if i else mark}\n{indent}{text}" for i, text in enumerate(piece)])
        mark = ","
    yield "]" if mark == "," else "[]"
