"""Element results of another program, from a CSV file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mudline.results.evaluation import Evaluation
from mudline.scene.csv_file import CsvTable, data_error, read_csv
from mudline.scene.numbering import Floats, Ids, Indices

COMPARED = ("force", "stiffness", "ratio")
_NEAR = 1e-2
"""Times are the same that are this close, as a part of the shortest step."""


@dataclass(frozen=True, slots=True)
class Reference:
    """Rows of a file that belong to elements of the deck, in the order of the steps.

    `step` and `element` are indices (rows,), `values` columns (rows,) by name, NaN for an empty field. `unknown` are
    elements that the deck lacks, `lost_times` times of the file at which nothing is evaluated, `missing_times` times
    evaluated that the file lacks.
    """

    file: str
    step: Indices
    element: Indices
    values: dict[str, Floats]
    unknown: Ids
    lost_times: Floats
    missing_times: Floats


def read_reference(path: Path, evaluation: Evaluation) -> Reference:
    """`element` and any of `force`, `stiffness`, `ratio`, with `time` for steps; other columns are read past.

    Raises OSError, or DeckError for a file with faults: numbers that are none, an element twice, times that do not
    match those of the evaluation at all.
    """
    table = read_csv(path, ("element",), (), others=True)
    names = [name for name in COMPARED if name in table.columns]
    if not names:
        raise data_error(table.file, f"the header has none of {', '.join(COMPARED)} to compare")
    if not table.lines:
        raise data_error(table.file, "no row below the header", 2)
    ids = table.whole("element")
    values = {name: table.numbers(name, optional=True) for name in names}
    times = table.numbers("time") if "time" in table.columns else None
    step = _steps(table, times, evaluation)
    element = evaluation.scene.table.numbered.indices(ids)
    used = np.flatnonzero((step >= 0) & (element >= 0))
    used = used[np.lexsort((element[used], step[used]))]
    _once(table, ids, step[used], element[used], used)
    clock = evaluation.time if evaluation.time is not None else np.zeros(0)
    return Reference(
        table.file,
        step[used],
        element[used],
        {name: column[used] for name, column in values.items()},
        np.unique(ids[element < 0]),
        np.unique(times[step < 0]) if times is not None else np.zeros(0),
        clock[~np.isin(np.arange(len(clock)), step)],
    )


def _steps(table: CsvTable, times: Floats | None, evaluation: Evaluation) -> Indices:
    """The step of each row, -1 where nothing is evaluated at its time."""
    clock = evaluation.time
    if times is None:
        if evaluation.steps > 1:
            raise data_error(table.file, f"no column time, to compare with {evaluation.steps} time steps")
        return np.zeros(len(table.lines), dtype=np.intp)
    if clock is None:
        if len(np.unique(times)) > 1:
            raise data_error(
                table.file, "several times, to compare with one state: give --positions with the same times"
            )
        return np.zeros(len(table.lines), dtype=np.intp)
    order = np.argsort(clock, kind="stable")
    after = np.searchsorted(clock[order], times).clip(0, len(clock) - 1)
    before = (after - 1).clip(0)
    near = np.where(np.abs(clock[order][before] - times) < np.abs(clock[order][after] - times), before, after)
    apart = np.diff(clock[order])
    apart = apart[apart > 0.0]
    allowed = _NEAR * float(apart.min()) if apart.size else _NEAR * max(1.0, float(np.abs(clock).max()))
    found = np.where(np.abs(clock[order][near] - times) <= allowed, order[near], -1)
    if (found < 0).all():
        first, last = float(clock.min()), float(clock.max())
        raise data_error(table.file, f"none of its times is evaluated: these are from {first!r} to {last!r}")
    return found


def _once(table: CsvTable, ids: Ids, step: Indices, element: Indices, used: Indices) -> None:
    """An element has one row a step."""
    again = np.flatnonzero((np.diff(step) == 0) & (np.diff(element) == 0))
    if again.size:
        row = int(max(used[again[0]], used[again[0] + 1]))
        raise table.fault(
            row,
            "element",
            f"element {ids[row]} is given twice"
            + (f" at time {table.columns['time'][row]}" if "time" in table.columns else ""),
        )
