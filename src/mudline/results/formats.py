"""Results as JSON, CSV and NPZ, in pieces: a long series is never in memory as text."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from itertools import islice
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from mudline.contact import Plan
from mudline.results.csv_lines import csv_lines
from mudline.results.evaluation import Evaluation
from mudline.results.tables import ELEMENT_COLUMNS, NODE_COLUMNS, VECTORS, Row, Spelling, element_rows, node_rows

_Rows = Callable[[Evaluation, int, Spelling], Iterator[Row]]
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


def json_text(evaluation: Evaluation) -> Iterator[str]:
    """The JSON of the contract, a row on a line; with times, the rows stand under `steps`."""
    plan = (json.dumps(row, ensure_ascii=False) for row in plan_rows(evaluation.model.plan))
    yield f'{{"units": {json.dumps(evaluation.scene.units)},\n "plan": '
    yield from _list(plan, "  ")
    if evaluation.time is None:
        yield ",\n"
        yield from _tables(evaluation, 0, " ")
        yield "}\n"
        return
    yield ',\n "steps": ['
    for step, time in enumerate(evaluation.time.tolist()):
        yield ("," if step else "") + f'\n  {{"time": {json.dumps(time)},\n'
        yield from _tables(evaluation, step, "   ")
        yield "}"
    yield "]}\n"


def _tables(evaluation: Evaluation, step: int, indent: str) -> Iterator[str]:
    yield f'{indent}"elements": '
    yield from _list(_objects(ELEMENT_COLUMNS, element_rows(evaluation, step, _JSON)), indent + " ")
    yield f',\n{indent}"nodes": '
    yield from _list(_objects(NODE_COLUMNS, node_rows(evaluation, step, _JSON)), indent + " ")


def _objects(columns: tuple[str, ...], rows: Iterator[Row]) -> Iterator[str]:
    fields = (f'"{name}": {"[%s, %s, %s]" if name in VECTORS else "%s"}' for name in columns)
    template = "{" + ", ".join(fields) + "}"
    return (template % row for row in rows)


def _list(objects: Iterable[str], indent: str) -> Iterator[str]:
    rest = iter(objects)
    mark = "["
    while piece := list(islice(rest, _PIECE)):
        yield "".join(f"{',' if i else mark}\n{indent}{text}" for i, text in enumerate(piece))
        mark = ","
    yield "]" if mark == "," else "[]"


def csv_text(evaluation: Evaluation, table: str) -> Iterator[str]:
    """The rows of `elements` or `nodes` as CSV, with a column `time` in front when there are times."""
    rows: _Rows = element_rows if table == "elements" else node_rows
    columns = ELEMENT_COLUMNS if table == "elements" else NODE_COLUMNS
    flat = [name + axis for name in columns for axis in (("_x", "_y", "_z") if name in VECTORS else ("",))]
    times = None if evaluation.time is None else evaluation.time.tolist()
    yield ",".join(flat if times is None else ["time", *flat]) + "\n"
    for step in range(evaluation.steps):
        before = "" if times is None else f"{times[step]!r},"
        spelled = rows(evaluation, step, _CSV)
        while piece := list(islice(spelled, _PIECE)):
            yield "".join(f"{before}{','.join(row)}\n" for row in piece)


def write_npz(evaluation: Evaluation, stream: BinaryIO) -> None:
    """The same names as arrays: elements (steps, m), nodes (steps, n), vectors (steps, n, 3).

    A single state without a time has no axis for steps. Texts that are null elsewhere are empty.
    """
    scene, result = evaluation.scene, evaluation.result
    steps, elements, nodes = evaluation.steps, evaluation.elements, evaluation.nodes
    friction = np.broadcast_to(0.0, (steps, len(nodes)))
    state = np.broadcast_to("", (steps, len(nodes)))
    over_steps: dict[str, NDArray[Any]] = {
        **{name: _kept(getattr(result, name), elements) for name in ("depth", "ratio", "contact", "force")},
        **{name: _kept(getattr(result, name), elements) for name in ("slope", "stiffness")},
        "law": _laws(evaluation),
        "state": np.broadcast_to("", (steps, len(elements))),
        **{name: _kept(getattr(result, name), nodes) for name in ("gap", "normal", "reaction", "normal_force")},
        "axial_force": friction,
        "lateral_force": friction,
        "axial_state": state,
        "lateral_state": state,
    }
    names = [scene.law_sets[index] or "" for index in elements.tolist()]
    arrays: dict[str, NDArray[Any]] = {
        "element": scene.element_ids[elements],
        "set": np.array(names, dtype=np.str_),
        "diameter": scene.diameter[elements],
        "length": evaluation.length[elements],
        "node": scene.node_ids[nodes],
        **(over_steps if evaluation.time is not None else {name: array[0] for name, array in over_steps.items()}),
    }
    if evaluation.time is not None:
        arrays["time"] = evaluation.time
    np.savez_compressed(stream, allow_pickle=False, **arrays)


def _kept(array: NDArray[Any], chosen: NDArray[np.intp]) -> NDArray[Any]:
    """The columns (steps, k, ...) of those elements or nodes that have a position; no copy when all have one."""
    return array if array.shape[1] == len(chosen) else array[:, chosen]


def _laws(evaluation: Evaluation) -> NDArray[np.str_]:
    """Names of the laws (steps, m); one row for all steps when nothing is cut."""
    shape = (evaluation.steps, len(evaluation.elements))
    if not evaluation.result.cut.any():
        return np.broadcast_to(np.array(evaluation.law_names(0), dtype=np.str_), shape)
    return np.array([evaluation.law_names(step) for step in range(evaluation.steps)], dtype=np.str_).reshape(shape)
