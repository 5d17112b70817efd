"""Formats of result files: their contents, and the writers they share.

Each format has a module, imported when needed, with `writer(output)`, which returns a `Writer`. It takes columns of a
few steps at a time and writes them at once, so that a long series is never in memory as text.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, Protocol

from mudline.basics.installed import install_hint
from mudline.basics.quantities import RESULT_FORMAT
from mudline.model.contact import Plan
from mudline.model.contact.columns import ResultColumn, timed
from mudline.model.contact.frames import array_name
from mudline.model.contact.lines import LineSummary
from mudline.model.contact.result import ResultPart
from mudline.model.results.against import ResultComparison
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.totals import line_steps
from mudline.model.results.warnings import ContactWarning
from mudline.model.scene.numbering import Floats


class ResultForm(NamedTuple):
    """A format of result files.

    Attributes:
        summary: contents of a file, for the documentation, Markdown.
        separate: whether each table has a file of its own.
        library: library that writes it; "" if none is needed.
        extra: extra of mudline that installs the library; "" if none is needed.
    """

    summary: str
    separate: bool = False
    library: str = ""
    extra: str = ""


FORMS = {
    "csv": ResultForm("elements; the nodes in `...-nodes.csv`, the lines in `...-summary.csv`", separate=True),
    "json": ResultForm("everything: units, plan, elements, nodes, `restrained`, `summary`, `warnings`, `against`"),
    "npz": ResultForm(
        "an array of each column: (elements,) or (steps, elements), (nodes,) or (steps, nodes), vectors with a last "
        "axis of 3; `node_` before what elements have too, `summary_` before (lines,) or (steps, lines); `units` and "
        "`format`"
    ),
    "parquet": ResultForm(
        "the same columns, in groups of rows; the nodes in `...-nodes.parquet`, the lines in `...-summary.parquet`; "
        f"`{install_hint('frames')}`",
        separate=True,
        library="pyarrow",
        extra="frames",
    ),
    "xlsx": ResultForm(
        "sheets `elements`, `nodes` and `summary`, with units below the names of the columns; "
        f"`{install_hint('excel')}`",
        library="xlsxwriter",
        extra="excel",
    ),
}
"""Formats by suffix."""
TABLES = ("elements", "nodes", "summary")
"""Tables of results."""
TEXTS = ("csv", "json")
"""Formats that standard output has too."""

More = Mapping[str, object]
"""Additional keys of JSON with their values."""
Columns = Mapping[str, Sequence[ResultColumn]]
"""The columns of some steps, by table name."""
Write = Callable[[Iterator[str]], None]
"""Function that writes text in pieces."""


class FormError(ValueError):
    """A format cannot hold so many rows."""


@dataclass(frozen=True, slots=True)
class FileContent:
    """Contents of a file in any format.

    Attributes:
        rows: number of rows of a step, by table name.
        units: the unit system.
        format: name and version.
        head: keys of JSON in front of the tables.
        times: (steps,) the time of each step; None without steps.
        array_name: returns the name of an array from the names of a table and a column.
    """

    rows: Mapping[str, int]
    units: str
    format: str = RESULT_FORMAT
    head: More = field(default_factory=dict)
    times: Floats | None = None
    array_name: Callable[[str, str], str] = array_name

    @property
    def steps(self) -> int:
        """Number of steps; 1 without times."""
        return 1 if self.times is None else len(self.times)

    def timed(self, table: str, columns: Sequence[ResultColumn], start: int, count: int) -> list[ResultColumn]:
        """Return the flat columns of a table, after a column of times if there are any."""
        clock = None if self.times is None else self.times[start : start + count]
        return timed(columns, clock, self.rows[table], self.units)


class Writer(Protocol):
    """Writer of the columns of all tables of a file, or of several, a few steps at a time."""

    def write(self, columns: Columns, start: int, count: int, beside: Mapping[str, Sequence[object]], /) -> None:
        """Write the steps from `start` on; `beside` are values for each of them that only JSON can hold."""

    def finish(self, more: More, /) -> None:
        """Write values that are known only after the last step."""


class Sink:
    """Consumer that passes the results of an evaluation to a writer, as the columns of tables.

    JSON has the lines of all steps after them, and no table of lines. With a comparison the elements have the values of
    its file too.
    """

    def __init__(
        self,
        evaluation: Evaluation,
        form: str,
        open_writer: Callable[[FileContent], Writer],
        comparison: ResultComparison | None = None,
        only: str | None = None,
    ) -> None:
        """Open the writer of a format for all tables, or of CSV for one table. Raises what `open_writer` does."""
        self._evaluation, self._form, self._comparison = evaluation, form, comparison
        names = TABLES if only is None else (only,)
        self._tables = {name: evaluation.table(name) for name in (("elements", "nodes") if form == "json" else names)}
        rows = {name: table.rows for name, table in self._tables.items()}
        plan = {"plan": plan_rows(evaluation.model.plan)}
        self._writer = open_writer(FileContent(rows, evaluation.scene.units, head=plan, times=evaluation.time))
        self._lines: list[LineSummary] = []

    def take(self, part: ResultPart) -> None:
        """Write some steps. Raises OSError."""
        columns = {name: table.columns(part) for name, table in self._tables.items()}
        if self._comparison is not None and "elements" in columns:
            columns["elements"] += self._comparison.columns(part)
        if self._form == "json":
            self._lines += line_steps(self._evaluation, part)
        restrained, beside = part.result.restrained, {}
        if restrained is not None:
            ids = self._evaluation.scene.node_ids
            beside = {"restrained": [ids[step].tolist() for step in restrained]}
        self._writer.write(columns, part.start, part.count, beside)

    def finish(self, warnings: Sequence[ContactWarning] = ()) -> None:
        """Write the data that follow the last step. Raises OSError."""
        more: dict[str, object] = {
            "summary": [row.row() for row in self._lines],
            "positions": self._evaluation.source,
            "contents_case": self._evaluation.contents_case,
            "warnings": [warning.row() for warning in warnings],
        }
        self._writer.finish(more if self._comparison is None else more | {"against": self._comparison.summary()})


@dataclass(frozen=True, slots=True)
class ResultOutput:
    """Destination of the contents of a file: its format, and open files in a folder, one for each table or one for all.

    `open` closes what a writer opens besides, in front of the files. `tracked` shows the progress of a long loop over a
    list.
    """

    form: str
    contents: FileContent
    streams: Sequence[BinaryIO]
    folder: Path
    open: ExitStack
    tracked: Callable[[Sequence[Any]], Iterable[Any]] = iter

    def writer(self) -> Writer:
        """Return the writer. Raises FormError, OSError, and ImportError without the library that the format needs."""
        module = "text" if self.form in TEXTS else self.form
        writer: Writer = import_module(f"{__name__}.{module}").writer(self)
        return writer


def plan_rows(plan: Plan) -> list[dict[str, Any]]:
    """Return the stages of a plan as rows."""
    return [{"stage": stage.stage, "active": stage.active, "why": stage.why} for stage in plan]


# --------------------------------------------------------------------------------------------------------- whole tables


@dataclass(frozen=True, slots=True)
class ResultTables:
    """Whole tables by name: flat columns (rows,) without steps; `more` are additional keys of JSON."""

    columns: Columns
    format: str
    units: str
    more: More

    @property
    def contents(self) -> FileContent:
        """Contents of a file with these tables; the name of an array begins with that of its table."""
        rows = {name: len(columns[0].values) for name, columns in self.columns.items()}
        return FileContent(rows, self.units, self.format, self.more, array_name=lambda table, name: f"{table}_{name}")

    def write(self, open_writer: Callable[[FileContent], Writer]) -> None:
        """Write the tables. Raises OSError, and what `open_writer` does."""
        writer = open_writer(self.contents)
        writer.write(self.columns, 0, 1, {})
        writer.finish({})
