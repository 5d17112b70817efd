"""Results as one JSON document."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from pathlib import Path
from typing import BinaryIO

from mudline.contact.columns import Column, Table
from mudline.contact.result import Part
from mudline.quantities import RESULT_FORMAT
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
