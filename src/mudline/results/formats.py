"""Results as JSON, CSV and NPZ, in pieces: a long series is never in memory as text."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from itertools import chain, islice
from pathlib import Path
from tempfile import TemporaryFile
from types import TracebackType
from typing import IO, Any, BinaryIO, Protocol, Self

import numpy as np
from pydantic_core import to_json

from mudline.contact import Plan
from mudline.results.columns import Column, ElementTable, NodeTable, Table, Values
from mudline.results.evaluation import Evaluation, Part
from mudline.results.quantities import csv_lines

_BLOCK = 16384
"""Rows spelled at a time: the texts of a large model are never all in memory."""

Row = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Spelling:
    """How a format spells a name, and that there is no value."""

    name: Callable[[str], str]
    nothing: str

    def column(self, values: Values, names: tuple[str | None, ...] = ()) -> list[str]:
        """The values of a column; numbers read back to the same double, NaN is no value."""
        if not values.size:
            return []
        if names:
            spelled = [self.nothing if name is None else self.name(name) for name in names]
            return [spelled[code] for code in values.tolist()]
        numbers = to_json(values.tolist(), inf_nan_mode="null")[1:-1].decode().split(",")
        if self.nothing == "null" or values.dtype.kind != "f" or not np.isnan(values).any():
            return numbers
        return [self.nothing if text == "null" else text for text in numbers]


def step_rows(columns: list[Column], steps: int, rows: int, spelling: Spelling) -> Iterator[Iterable[Row]]:
    """The rows of each step, spelled; take those of a step before the next."""
    flat = [part for column in columns for part in column.flat()]
    if rows > _BLOCK:
        for step in range(steps):
            yield chain.from_iterable(_long(flat, step, rows, spelling))
        return
    together = max(1, _BLOCK // max(rows, 1))
    constant = {column.name: spelling.column(column.values, column.names) for column in flat if column.steady}
    for first in range(0, steps, together):
        last = min(steps, first + together)
        texts = [
            constant[column.name] * (last - first)
            if column.steady
            else spelling.column(column.cut(first, last).ravel(), column.names)
            for column in flat
        ]
        spelled = zip(*texts, strict=True)
        for _ in range(first, last):
            yield islice(spelled, rows)


def _long(columns: list[Column], step: int, rows: int, spelling: Spelling) -> Iterator[Iterator[Row]]:
    """The rows of one step of a large model, block by block."""
    for start in range(0, rows, _BLOCK):
        block = slice(start, start + _BLOCK)
        texts = [spelling.column(column.cut(step, step + 1)[0, block], column.names) for column in columns]
        yield zip(*texts, strict=True)


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
        """Some steps, after what comes before the first of them."""

    def tail(self, more: Mapping[str, object]) -> Iterator[str]:
        """What comes after the last step; `more` is what is known only then."""


class JsonForm:
    """The JSON of the contract, a row on a line; with times, the rows are under `steps`."""

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
        """The nodes that a rigid seabed restrains; nothing where there is none."""
        restrained = part.result.restrained
        if restrained is not None:
            numbers = self._evaluation.scene.node_ids[restrained[step]].tolist()
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


_PACKED = 1 << 18
"""Values that are packed at a time."""


class NpzFile:
    """The same names as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null elsewhere are empty. An archive takes one
    array after the other, so what changes is in nameless files until the end, in `folder`.
    """

    def __init__(self, evaluation: Evaluation, tables: list[Table], folder: Path) -> None:
        self._evaluation, self._tables, self._folder = evaluation, tables, folder
        self._arrays: dict[str, _Array] = {}
        self._open = ExitStack()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._open.close()

    @property
    def count(self) -> int:
        """Number of arrays, once there is a result."""
        return len(self._arrays)

    def take(self, part: Part) -> None:
        """Keep some steps. Raises OSError."""
        for table in self._tables:
            for column in table.columns(part):
                if column.name not in self._arrays:
                    self._arrays[column.name] = _Array(column, self._open, self._folder)
                self._arrays[column.name].take(column)

    def write(self, stream: BinaryIO, advance: Callable[[], None]) -> None:
        """Write the archive; `advance` is called after each array. Raises OSError."""
        time, steps = self._evaluation.time, self._evaluation.steps
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for name, array in self._arrays.items():
                shape = array.shape if time is None or not array.over_steps else (steps, *array.shape)
                _pack(archive, name, array.dtype, shape, array.pieces(steps if array.over_steps else 1))
                advance()
            if time is not None:
                _pack(archive, "time", time.dtype, time.shape, [time])


class _Array:
    """An array on its way: what no step changes in memory, the others in a file of numbers."""

    def __init__(self, column: Column, opened: ExitStack, folder: Path) -> None:
        self.over_steps = column.over_steps
        self.shape = column.values.shape if column.steady else column.values.shape[1:]
        self._texts = np.array([name or "" for name in column.names], dtype=np.str_) if column.names else None
        self._kept = column.values.dtype
        self.dtype = self._kept if self._texts is None else self._texts.dtype
        self._steady = column.values if column.steady else None
        self._file: IO[bytes] | None = None
        if not column.steady:
            self._file = opened.enter_context(TemporaryFile(dir=folder))  # noqa: SIM115 - open until all is packed

    def take(self, column: Column) -> None:
        """Keep the values of some steps."""
        if self._file is not None:
            self._file.write(np.ascontiguousarray(column.values).data)

    def pieces(self, steps: int) -> Iterator[Values]:
        """All values of so many steps, in their order, flat."""
        if self._steady is not None:
            row = self._steady.ravel()
            together = min(steps, max(1, _PACKED // max(row.size, 1)))
            block = self._spelled(np.tile(row, together))
            for first in range(0, steps, together):
                yield block[: row.size * min(together, steps - first)]
        elif self._file is not None:
            self._file.seek(0)
            while data := self._file.read(_PACKED * self._kept.itemsize):
                yield self._spelled(np.frombuffer(data, self._kept))

    def _spelled(self, values: Values) -> Values:
        return values if self._texts is None else self._texts[values]


def _pack(
    archive: zipfile.ZipFile, name: str, kind: np.dtype[Any], shape: tuple[int, ...], pieces: Iterable[Values]
) -> None:
    """Write an array as a member, piece by piece."""
    header = {"descr": np.lib.format.dtype_to_descr(kind), "fortran_order": False, "shape": shape}
    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
        np.lib.format.write_array_header_1_0(member, header)
        for piece in pieces:
            member.write(piece.tobytes())
