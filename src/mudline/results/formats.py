"""Results as JSON, CSV and NPZ."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact import Plan
from mudline.results.evaluation import Evaluation
from mudline.results.tables import (
    ELEMENT_COLUMNS,
    NODE_COLUMNS,
    Row,
    element_rows,
    flat_columns,
    flat_values,
    node_rows,
)


def plan_rows(plan: Plan) -> list[Row]:
    """The stages of a plan."""
    return [{"stage": stage.stage, "active": stage.active, "why": stage.why} for stage in plan]


def json_text(evaluation: Evaluation) -> Iterator[str]:
    """The JSON of the contract in pieces, a row on a line; with times, the rows stand under `steps`."""
    yield f'{{"units": {json.dumps(evaluation.scene.units)},\n "plan": '
    yield from _json_list(plan_rows(evaluation.model.plan), "  ")
    if evaluation.time is None:
        yield ",\n"
        yield from _json_tables(evaluation, 0, " ")
        yield "}\n"
        return
    yield ',\n "steps": ['
    for step, time in enumerate(evaluation.time.tolist()):
        yield ("," if step else "") + f'\n  {{"time": {json.dumps(time)},\n'
        yield from _json_tables(evaluation, step, "   ")
        yield "}"
    yield "]}\n"


def _json_tables(evaluation: Evaluation, step: int, indent: str) -> Iterator[str]:
    yield f'{indent}"elements": '
    yield from _json_list(element_rows(evaluation, step), indent + " ")
    yield f',\n{indent}"nodes": '
    yield from _json_list(node_rows(evaluation, step), indent + " ")


def _json_list(rows: Iterable[Row], indent: str) -> Iterator[str]:
    mark = "["
    for row in rows:
        yield f"{mark}\n{indent}{json.dumps(row, ensure_ascii=False, allow_nan=False)}"
        mark = ","
    yield "]" if mark == "," else "[]"


def csv_text(evaluation: Evaluation, table: str) -> Iterator[str]:
    """The rows of `elements` or `nodes` as CSV in pieces, with a column `time` in front when there are times."""
    rows, columns = (element_rows, ELEMENT_COLUMNS) if table == "elements" else (node_rows, NODE_COLUMNS)
    time = [] if evaluation.time is None else evaluation.time.tolist()
    yield _csv_lines([(["time"] if time else []) + flat_columns(columns)])
    for step in range(len(evaluation.result.depth)):
        before = [repr(time[step])] if time else []
        lines = ([*before, *map(_csv_value, flat_values(row))] for row in rows(evaluation, step))
        yield _csv_lines(lines)


def _csv_lines(rows: Iterable[list[str]]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerows(rows)
    return buffer.getvalue()


def _csv_value(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


def npz_bytes(evaluation: Evaluation) -> bytes:
    """The same names as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null elsewhere are empty.
    """
    scene, result = evaluation.scene, evaluation.result
    steps = len(result.depth)
    laws = np.array([evaluation.law_names(step) for step in range(steps)], dtype=np.str_).reshape(result.depth.shape)
    friction = np.zeros(result.gap.shape)
    arrays: dict[str, NDArray[Any]] = {
        "element": scene.element_ids,
        "set": np.array([name or "" for name in scene.law_sets], dtype=np.str_),
        "diameter": scene.diameter,
        "length": scene.length,
        **{name: getattr(result, name) for name in ("depth", "ratio", "contact", "force", "slope", "stiffness")},
        "law": laws,
        "state": np.zeros(result.depth.shape, dtype="<U11"),
        "node": scene.node_ids,
        **{name: getattr(result, name) for name in ("gap", "normal", "reaction", "normal_force")},
        "axial_force": friction,
        "lateral_force": friction,
        "axial_state": np.zeros(result.gap.shape, dtype="<U5"),
        "lateral_state": np.zeros(result.gap.shape, dtype="<U5"),
    }
    if evaluation.time is None:
        arrays = {name: array[0] if name in _PER_STEP else array for name, array in arrays.items()}
    else:
        arrays["time"] = evaluation.time
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **arrays)
    return buffer.getvalue()


_PER_STEP = frozenset({*ELEMENT_COLUMNS, *NODE_COLUMNS} - {"element", "set", "diameter", "length", "node"})
