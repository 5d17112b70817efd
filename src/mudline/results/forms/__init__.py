"""The forms of result files, a module each with the name of the suffix, imported when it is asked for.

A module is a form by being here: `SUMMARY` says in the documentation what is in a file, `opened(output)` is a context
with the `Sink` that writes it, `BESIDE` names the tables that go to files of their own; `write_tables(tables, streams,
folder)` writes tables without steps. Results come a few steps at a time and are written as they come: a long series is
never in memory as text.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import chain, islice
from pathlib import Path
from pkgutil import iter_modules
from types import ModuleType
from typing import Any, BinaryIO, Protocol, TypeVar, cast

import numpy as np
from pydantic_core import to_json

from mudline.contact import Plan
from mudline.contact.columns import Column, Table, Values
from mudline.contact.result import Part
from mudline.quantities import finite
from mudline.results.evaluation import Evaluation

_BLOCK = 16384
"""Rows spelled at a time: the texts of a large model are never all in memory."""
_PIECE = 1000
"""Rows written at a time."""

T = TypeVar("T")
Row = tuple[str, ...]
More = Mapping[str, object]
"""What is known only after the last step, by its key in JSON."""
Write = Callable[[Iterator[str]], None]
"""Writes text in pieces."""


class ResultConsumer(Protocol):
    """Takes the results of a few steps at a time."""

    def take(self, part: Part) -> None:
        """Take some steps."""


class Sink(ResultConsumer, Protocol):
    """A file or standard output."""

    def finish(self, more: More) -> None:
        """Write what comes after the last step."""


@dataclass(frozen=True, slots=True)
class Together:
    """Several tables, or none, as one; a table has no place for more."""

    tables: Sequence[Sink] = ()

    def take(self, part: Part) -> None:
        """Pass some steps on to each table."""
        for table in self.tables:
            table.take(part)

    def finish(self, more: More) -> None:
        """End each table."""
        for table in self.tables:
            table.finish(more)


@dataclass(frozen=True, slots=True)
class Output:
    """What is written, and the open files of `folder`; `tracked` shows how far a long loop over a list is."""

    evaluation: Evaluation
    elements: Table
    streams: Sequence[BinaryIO]
    folder: Path
    tracked: Callable[[Sequence[Any]], Iterable[Any]] = iter

    @property
    def tables(self) -> dict[str, Table]:
        """The tables of elements, nodes and lines, by their names."""
        return {
            "elements": self.elements,
            "nodes": self.evaluation.node_table(),
            "summary": self.evaluation.line_table(),
        }


@dataclass(frozen=True, slots=True)
class Tables:
    """Tables that are whole, by their names: flat columns (rows,) without steps.

    `format` is the name and the version of their form, `more` what JSON has besides them.
    """

    columns: Mapping[str, Sequence[Column]]
    format: str
    units: str
    more: More


def form_names() -> list[str]:
    """Return the name of every form, found without importing one."""
    return sorted(found.name for found in iter_modules(__path__))


def table_path(path: Path, table: str) -> Path:
    """Return the file of another table beside that of the elements."""
    return path.with_name(f"{path.stem}-{table}{path.suffix}")


def form_module(name: str) -> ModuleType:
    """Return the module of a form; raises ImportError without the library that it needs."""
    return import_module(f"{__name__}.{name}")


def plain_values(column: Column) -> list[Any]:
    """The values of a flat column (rows,) as those of Python; None for no value."""
    values: list[Any] = column.values.tolist()
    if column.names:
        return [column.names[code] for code in values]
    if column.blank is not None:
        return [None if value == column.blank else value for value in values]
    return [finite(value) for value in values] if column.values.dtype.kind == "f" else values


# ----------------------------------------------------------------------------------------------------- rows as text


def text_form(name: str) -> Callable[[Evaluation, Table, Write], Sink]:
    """Return what writes a table (JSON: that of elements, and the nodes) as text: "csv" or "json"."""
    return cast("Callable[..., Sink]", form_module(name).Text)


def tables_as_text(tables: Tables, name: str, table: str) -> Iterator[str]:
    """The text of tables as "json", or of one of them as "csv"."""
    found: Iterator[str] = form_module(name).tables_text(tables, table)
    return found


def text_into(stream: BinaryIO) -> Write:
    """Return what writes text into a file as UTF-8; half a surrogate pair, as a name may hold, is escaped."""
    return lambda pieces: stream.writelines(piece.encode("utf-8", "backslashreplace") for piece in pieces)


@dataclass(frozen=True, slots=True)
class Spelling:
    """How a form spells a name, and that there is no value."""

    name: Callable[[str], str]
    nothing: str

    def column(self, values: Values, names: tuple[str | None, ...] = (), blank: int | None = None) -> list[str]:
        """The values of a column; numbers read back to the same double; NaN, inf and `blank` are no value."""
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


def step_rows(columns: list[Column], steps: int, rows: int, spelling: Spelling) -> Iterator[Iterable[Row]]:
    """The rows of each step, spelled; take those of a step before the next."""
    flat = [part for column in columns for part in column.flat()]
    if rows > _BLOCK:
        for step in range(steps):
            yield chain.from_iterable(_long(flat, step, rows, spelling))
        return
    together = max(1, _BLOCK // max(rows, 1))
    constant = {
        column.name: spelling.column(column.values, column.names, column.blank) for column in flat if column.steady
    }
    for first in range(0, steps, together):
        last = min(steps, first + together)
        texts = [
            constant[column.name] * (last - first)
            if column.steady
            else spelling.column(column.cut(first, last).ravel(), column.names, column.blank)
            for column in flat
        ]
        spelled = zip(*texts, strict=True)
        for _ in range(first, last):
            yield islice(spelled, rows)


def _long(columns: list[Column], step: int, rows: int, spelling: Spelling) -> Iterator[Iterator[Row]]:
    """The rows of one step of a large model, block by block."""
    for start in range(0, rows, _BLOCK):
        block = slice(start, start + _BLOCK)
        texts = [
            spelling.column(column.cut(step, step + 1)[0, block], column.names, column.blank) for column in columns
        ]
        yield zip(*texts, strict=True)


def batched(rows: Iterable[T]) -> Iterator[list[T]]:
    """Rows in lists that are written at once."""
    rest = iter(rows)
    while piece := list(islice(rest, _PIECE)):
        yield piece


def plan_rows(plan: Plan) -> list[dict[str, Any]]:
    """The stages of a plan."""
    return [{"stage": stage.stage, "active": stage.active, "why": stage.why} for stage in plan]
