"""Results as JSON and CSV, in pieces: a long series is never in memory as text."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from itertools import islice
from typing import Any, Protocol

from mudline.contact import Plan
from mudline.results.columns import Column, ElementTable, NodeTable, Table
from mudline.results.csv_lines import csv_lines
from mudline.results.evaluation import Evaluation, Part
from mudline.results.tables import Row, Spelling, step_rows

_PIECE = 1000
"""Rows written at a time."""

_JSON = Spelling(partial(json.dumps, ensure_ascii=False), "null")


def _quoted(name: str) -> str:
    """A name as a field of CSV: quoted where it has to be."""
    return next(csv_lines([[name]])).removesuffix("\n")


_CSV = Spelling(_quoted, "")


def plan_rows(plan: Plan) -> list[dict[str, Any]]:
    """The stages of a plan."""
    return [{"stage": stage.stage, "active": stage.active, "why": stage.why} for stage in plan]


class TextForm(Protocol):
    """Spells results as they come."""

    def body(self, part: Part) -> Iterator[str]:
        """Some steps, behind what stands before the first of them."""

    def tail(self, more: Mapping[str, object]) -> Iterator[str]:
        """What stands behind the last step; `more` is what is known only then."""


class JsonForm:
    """The JSON of the contract, a row on a line; with times, the rows stand under `steps`."""

    def __init__(self, evaluation: Evaluation, elements: ElementTable) -> None:
        self._evaluation = evaluation
        self._tables: dict[str, Table] = {"elements": elements, "nodes": NodeTable(evaluation)}
        self._times = None if evaluation.time is None else evaluation.time.tolist()

    def body(self, part: Part) -> Iterator[str]:
        """Some steps; before the first, units and plan."""
        if part.start == 0:
            yield from self._head()
        columns = {name: table.columns(part) for name, table in self._tables.items()}
        rows = {name: step_rows(columns[name], part.count, table.rows, _JSON) for name, table in self._tables.items()}
        indent = " " if self._times is None else "   "
        for step in range(part.start, part.start + part.count):
            if self._times is not None:
                yield ("," if step else "") + f'\n  {{"time": {json.dumps(self._times[step])},\n'
            for index, name in enumerate(self._tables):
                yield (",\n" if index else "") + f'{indent}"{name}": '
                yield from _list(_objects(columns[name], next(rows[name])), indent + " ")
            yield from self._restrained(part, step - part.start, indent)
            if self._times is not None:
                yield "}"

    def tail(self, more: Mapping[str, object]) -> Iterator[str]:
        """The end, with further keys."""
        yield "" if self._times is None else "]"
        for name, value in more.items():
            yield f',\n "{name}": {json.dumps(value, ensure_ascii=False, allow_nan=False)}'
        yield "}\n"

    def _restrained(self, part: Part, step: int, indent: str) -> Iterator[str]:
        """The nodes that a rigid bed restrains; nothing where there is none."""
        held = part.result.restrained
        if held is not None:
            numbers = self._evaluation.scene.node_ids[held[step]].tolist()
            yield f',\n{indent}"restrained": {json.dumps(numbers)}'

    def _head(self) -> Iterator[str]:
        plan = (json.dumps(row, ensure_ascii=False) for row in plan_rows(self._evaluation.model.plan))
        yield f'{{"units": {json.dumps(self._evaluation.scene.units)},\n "plan": '
        yield from _list(plan, "  ")
        yield ",\n" if self._times is None else ',\n "steps": ['


class CsvForm:
    """The rows of a table as CSV, with a column `time` in front when there are times."""

    def __init__(self, evaluation: Evaluation, table: Table) -> None:
        self._table = table
        self._times = None if evaluation.time is None else evaluation.time.tolist()

    def body(self, part: Part) -> Iterator[str]:
        """Some steps; before the first, the names of the columns."""
        columns = self._table.columns(part)
        if part.start == 0:
            names = [flat.name for column in columns for flat in column.flat()]
            yield ",".join(names if self._times is None else ["time", *names]) + "\n"
        for step, rows in enumerate(step_rows(columns, part.count, self._table.rows, _CSV), part.start):
            before = "" if self._times is None else f"{self._times[step]!r},"
            rest = iter(rows)
            while piece := list(islice(rest, _PIECE)):
                yield "".join([f"{before}{','.join(row)}\n" for row in piece])

    def tail(self, more: Mapping[str, object]) -> Iterator[str]:
        """Nothing: a table has no place for more."""
        del more
        yield from ()


def _objects(columns: list[Column], rows: Iterable[Row]) -> Iterator[str]:
    fields = (f'"{column.name}": {"[%s, %s, %s]" if column.vector else "%s"}' for column in columns)
    template = "{" + ", ".join(fields) + "}"
    return (template % row for row in rows)


def _list(objects: Iterable[str], indent: str) -> Iterator[str]:
    rest = iter(objects)
    mark = "["
    while piece := list(islice(rest, _PIECE)):
        yield "".join([f"{',' if i else mark}\n{indent}{text}" for i, text in enumerate(piece)])
        mark = ","
    yield "]" if mark == "," else "[]"
