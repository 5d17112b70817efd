"""Element results of another program, from a CSV file, and the differences of our results from them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mudline.model.contact.columns import ResultColumn, kept
from mudline.model.contact.result import ResultPart
from mudline.model.results.evaluation import Evaluation
from mudline.model.scene.csv_file import CsvTable, data_error, read_csv
from mudline.model.scene.numbering import Floats, Indices

COMPARED = ("force", "stiffness", "ratio")
_NEAR = 1e-2
"""Tolerance of equal times, as a part of the shortest step."""


class ResultComparison:
    """Comparison of the steps of an evaluation with a file, a few steps at a time.

    Attributes:
        file: name of the file.
        timed: True if differences have a time.
        differences: a row of JSON for each column: the number of values compared, the largest difference (ours less
            the other) and the largest relative to the larger magnitude of the two, with their places; None without any.
        unmatched: numbers of elements, and times, that one side lacks, by their keys in JSON.
    """

    def __init__(self, path: Path, evaluation: Evaluation) -> None:
        """Read `element` and any of `force`, `stiffness`, `ratio`, with `time` for steps; ignore other columns.

        Raises OSError, or DeckError for a file with faults: fields that are no numbers, an element twice, no time that
        matches those of the evaluation.
        """
        table = read_csv(path, ("element",), None)
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
        repeated = np.flatnonzero((np.diff(step[used]) == 0) & (np.diff(element[used]) == 0))
        if repeated.size:
            row = int(max(used[repeated[0]], used[repeated[0] + 1]))
            at = f" at time {table.columns['time'][row]}" if "time" in table.columns else ""
            raise table.fault(row, "element", f"element {ids[row]} is given twice{at}")
        self._evaluation, self.file, self.timed = evaluation, table.file, evaluation.time is not None
        self._step, self._element = step[used], element[used]
        self._values = {name: column[used] for name, column in values.items()}
        nothing = {"compared": 0, "largest_difference": None, "largest_relative": None, "rms": None}
        self.differences: list[dict[str, Any]] = [{"column": name, **nothing} for name in names]
        self._squares = dict.fromkeys(names, 0.0)
        lacking = evaluation.elements[~np.isin(evaluation.elements, self._element)]
        clock = evaluation.time if evaluation.time is not None else np.zeros(0)
        self.unmatched: dict[str, list[float]] = {
            "elements_not_in_deck": np.unique(ids[element < 0]).tolist(),
            "elements_not_in_file": evaluation.scene.element_ids[lacking].tolist(),
            "times_not_evaluated": [] if times is None else np.unique(times[step < 0]).tolist(),
            "times_not_in_file": clock[~np.isin(np.arange(len(clock)), step)].tolist(),
        }

    def columns(self, part: ResultPart) -> list[ResultColumn]:
        """Return the values of the file for the evaluated elements at some steps, NaN where it has none."""
        rows, step, element = self._rows(part)
        shape = (part.count, len(self._evaluation.scene.element_ids))
        columns = []
        for name, theirs in self._values.items():
            values = np.full(shape, np.nan)
            values[step, element] = theirs[rows]
            columns.append(ResultColumn(f"{name}_against", kept(values, self._evaluation.elements)))
        return columns

    def take(self, part: ResultPart) -> None:
        """Compare some steps."""
        rows, step, element = self._rows(part)
        for row in self.differences:
            ours, theirs = getattr(part.result, row["column"])[step, element], self._values[row["column"]]
            self._compare(row, ours, theirs[rows], part.start + step, element)

    def _rows(self, part: ResultPart) -> tuple[slice, Indices, Indices]:
        """Return the rows of the file for some steps, and their steps and elements."""
        rows = slice(*np.searchsorted(self._step, [part.start, part.start + part.count]).tolist())
        return rows, self._step[rows] - part.start, self._element[rows]

    def _compare(self, row: dict[str, Any], ours: Floats, theirs: Floats, step: Indices, element: Indices) -> None:
        both = np.flatnonzero(~np.isnan(ours) & ~np.isnan(theirs))
        if not both.size:
            return
        ours, theirs, squares = ours[both], theirs[both], self._squares
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            difference = np.nan_to_num(ours - theirs)  # an overflow becomes the largest number
            size = np.maximum(np.abs(ours), np.abs(theirs))
            relative = np.where(size > 0.0, difference / size, 0.0)
            squares[row["column"]] = float(np.nan_to_num(squares[row["column"]] + (difference * difference).sum()))
        row["compared"] += int(both.size)
        row["rms"] = float(np.sqrt(squares[row["column"]] / row["compared"]))
        for name, values in (("difference", difference), ("relative", relative)):
            before, largest = row[f"largest_{name}"], int(np.argmax(np.abs(values)))  # the first of several equal ones
            if before is None or abs(values[largest]) > abs(before[name]):
                times, at = self._evaluation.time, both[largest]
                number = int(self._evaluation.scene.element_ids[element[at]])
                time = None if times is None else float(times[step[at]])
                row[f"largest_{name}"] = {name: float(values[largest]) + 0.0, "element": number, "time": time}

    def summary(self) -> dict[str, Any]:
        """Return file, differences, and the elements and times missing on either side."""
        return {"file": self.file, "columns": self.differences, **self.unmatched}


def _steps(table: CsvTable, times: Floats | None, evaluation: Evaluation) -> Indices:
    """Return the step of each row, -1 if its time is not evaluated."""
    clock = evaluation.time
    if times is None:
        if evaluation.steps > 1:
            raise data_error(table.file, f"no column time, to compare with {evaluation.steps} time steps")
    elif clock is None and len(np.unique(times)) > 1:
        raise data_error(table.file, "several times, to compare with one state: give --positions with the same times")
    if times is None or clock is None:
        return np.zeros(len(table.lines), dtype=np.intp)
    order = np.argsort(clock, kind="stable")
    after = np.searchsorted(clock[order], times).clip(0, len(clock) - 1)
    before = (after - 1).clip(0)
    near = np.where(np.abs(clock[order][before] - times) < np.abs(clock[order][after] - times), before, after)
    apart = np.diff(clock[order])
    apart = apart[apart > 0.0]
    allowed = _NEAR * float(apart.min()) if apart.size else _NEAR * max(1.0, float(np.abs(clock).max()))
    steps = np.where(np.abs(clock[order][near] - times) <= allowed, order[near], -1)
    if (steps < 0).all():
        first, last = float(clock.min()), float(clock.max())
        raise data_error(table.file, f"none of its times is evaluated: these are from {first!r} to {last!r}")
    return steps
