"""Results as tables of pandas and Arrow and as data sets of xarray, with the columns of result files."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from mudline.basics.arguments import expect_word
from mudline.basics.html_repr import html_page, html_table
from mudline.basics.installed import install_hint
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.quantities import ELEMENTS, LINES, RESULT_FORMAT, labelled
from mudline.basics.short_repr import counted
from mudline.basics.units import UNITS
from mudline.model.contact.columns import ResultColumn, ResultTable, Values, timed
from mudline.model.contact.result import ContactResult, ResultPart, TableName
from mudline.model.contact.touchdown import result_table

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    import xarray as xr

FORMAT_KEY, UNITS_KEY = b"mudline.format", b"mudline.units"
"""Metadata of Arrow tables and Parquet files."""
UNIT_KEY = b"unit"
"""Metadata of the fields of Arrow tables and Parquet files."""

_COORDINATES = frozenset({"set", "law", "line", "arc_length", "diameter", "length", "node1", "node2"})
"""Columns that identify elements and nodes, next to their numbers."""

_SHOWN = (
    *("time", "line", "touchdown_points", "first_touchdown", "last_touchdown", "contact_length"),
    *("largest_force", "largest_force_element", "reaction", "submerged_weight"),
)
"""Columns of lines shown in notebooks."""


def dataframe(result: ContactResult, table: TableName) -> pd.DataFrame:
    """Return a table as a pandas frame, see `ContactResult.to_dataframe`."""
    pandas = _library("pandas")
    rows, columns, steps = _columns(result, table)
    frame: pd.DataFrame = pandas.DataFrame({column.name: _series(pandas, column, steps) for column in columns})
    frame.attrs["units"] = rows.units
    frame.attrs["unit"] = {column.name: column.unit for column in columns if column.unit}
    return frame


def arrow_table(result: ContactResult, table: TableName) -> pa.Table:
    """Return a table as an Arrow table, see `ContactResult.to_arrow`."""
    rows, columns, steps = _columns(result, table)
    return arrow_of(columns, steps, rows.units)


def arrow_of(columns: list[ResultColumn], steps: int, units: str, form: str = RESULT_FORMAT) -> pa.Table:
    """Return flat columns over some steps as an Arrow table; raises ImportError."""
    arrow = _library("pyarrow")
    arrays = [_array(arrow, column, steps) for column in columns]
    fields = [
        arrow.field(column.name, array.type, metadata={UNIT_KEY: column.unit} if column.unit else None)
        for column, array in zip(columns, arrays, strict=True)
    ]
    about = {FORMAT_KEY: form, UNITS_KEY: units}
    return arrow.table(arrays, schema=arrow.schema(fields, metadata=about))


def dataset(result: ContactResult) -> xr.Dataset:
    """Return a result as an xarray data set, see `ContactResult.to_xarray`."""
    xarray = _library("xarray")
    single = result.depth.ndim == 1
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {"axis": ["x", "y", "z"]}
    for which, kind in (("elements", "element"), ("nodes", "node")):
        table, part = _table(result, which), ResultPart(0, result.as_series())
        for column in table.columns(part):
            into = coordinates if column.name in _COORDINATES or column.name == kind else variables
            into[array_name(which, column.name)] = _variable(column, kind, None if single else part.count)
    if result.times is not None:
        about = {"units": UNITS[result.known.units].unit("T")}
        coordinates["time"] = (() if single else ("time",), np.asarray(result.times), _given(about))
    data: xr.Dataset = xarray.Dataset(variables, coordinates, {"units": result.known.units, "format": RESULT_FORMAT})
    return data


def html(result: ContactResult) -> str:
    """Return the touchdown of lines at the first steps as HTML, for notebooks."""
    series = result.as_series()
    counts = [("step", len(series.depth)), ("element", series.depth.shape[1]), ("node", series.gap.shape[1])]
    summary = ", ".join(counted(number, kind) for kind, number in counts[result.depth.ndim == 1 :])
    if result.given is None:
        return html_page("ContactResult", summary)
    units = result.given.units
    lines = _table(result, "summary").rows
    _, columns, steps = _columns(series.steps(0, -(-SHOWN_ROWS // max(lines, 1))), "summary")
    shown = {column.name: column for column in columns if column.name in _SHOWN}
    headings = [LINES[name].axis(units) if name in LINES else labelled(name, each.unit) for name, each in shown.items()]
    values = (column.cut(0, steps).ravel().tolist() for column in shown.values())
    table = html_table(headings, zip(*values, strict=True), len(series.depth) * lines)
    return html_page("ContactResult", f"{summary}, {units}", table)


def array_name(table: str, column: str) -> str:
    """Return the name of an array: `node_` before a node's name that elements have too, `summary_` before a line's."""
    if table == "summary":
        return f"summary_{column}"
    return f"node_{column}" if table == "nodes" and column in ELEMENTS else column


def spelled(column: ResultColumn) -> Values:
    """Return the values of a column, with texts as numpy strings; "" for no text."""
    if not column.names:
        return column.values
    return np.array([name or "" for name in column.names], dtype=np.str_)[column.values]


def _table(result: ContactResult, name: str) -> ResultTable:
    return result_table(result.known, name, result.evaluated, result.present)


def _columns(result: ContactResult, name: TableName) -> tuple[ResultTable, list[ResultColumn], int]:
    """Return a table, its flat columns after times or numbers of steps if there are any, and the number of steps."""
    expect_word(name, "table", get_args(TableName))
    table, part = _table(result, name), ResultPart(0, result.as_series())
    clock: Values | None = part.result.times
    named = "time"
    if clock is None and result.depth.ndim == 2:
        clock, named = np.arange(part.count), "step"
    return table, timed(table.columns(part), clock, table.rows, table.units, named), part.count


def _given(about: Mapping[str, str]) -> dict[str, str]:
    return {name: value for name, value in about.items() if value}


def _series(pandas: ModuleType, column: ResultColumn, steps: int) -> Any:  # noqa: ANN401 - pandas takes arrays of many kinds
    values = column.cut(0, steps).ravel()
    if column.names:
        return pandas.Categorical.from_codes(values, categories=list(column.names[:-1]))
    if column.blank is None:
        return values
    return pandas.arrays.IntegerArray(values.astype(np.int64), values == column.blank)


def _array(arrow: ModuleType, column: ResultColumn, steps: int) -> pa.Array:
    values = column.cut(0, steps).ravel()
    if column.blank is not None:
        return arrow.array(values, mask=values == column.blank)
    if not column.names:
        return arrow.array(values, from_pandas=True)  # NaN means no value
    codes = arrow.array(values.astype(np.int32), mask=values < 0)
    return arrow.DictionaryArray.from_arrays(codes, arrow.array(column.names[:-1], arrow.string()))


def _variable(column: ResultColumn, kind: str, steps: int | None) -> tuple[tuple[str, ...], Values, dict[str, str]]:
    """Return dimensions, values and attributes of a variable of xarray; `steps` is None for a single state."""
    values = spelled(column)
    dimensions = (kind, "axis") if column.vector else (kind,)
    if steps is None:
        values = values if column.steady else values[0]
    elif column.over_steps and not (column.steady and column.name in _COORDINATES):
        values = np.broadcast_to(values, (steps, *values.shape)) if column.steady else values
        dimensions = ("time", *dimensions)
    return dimensions, values, _given({"units": column.unit})


def _library(name: str) -> ModuleType:
    """Return an optional library; raise ImportError with the command that installs it."""
    try:
        return import_module(name)
    except ImportError as error:
        message = f"this needs {name}, which is not installed: {install_hint('frames')}"
        raise ImportError(message, name=name) from error
