"""Results beside those of another program, element by element."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.results.evaluation import Evaluation, Part
from mudline.results.reference import Reference
from mudline.scene.numbering import Floats, Indices


@dataclass(slots=True)
class Extreme:
    """A largest difference: its value, and where it is."""

    value: float = 0.0
    element: int | None = None
    time: float | None = None

    def row(self, name: str) -> dict[str, Any] | None:
        """As JSON holds it; None where nothing was compared."""
        if self.element is None:
            return None
        return {name: self.value, "element": self.element, "time": self.time}


@dataclass(slots=True)
class Difference:
    """What was found in a column: ours less theirs, and that over the larger magnitude of the two."""

    column: str
    compared: int = 0
    absolute: Extreme = field(default_factory=Extreme)
    relative: Extreme = field(default_factory=Extreme)
    squares: float = 0.0

    @property
    def rms(self) -> float | None:
        """Root of the mean square of the differences."""
        return float(np.sqrt(self.squares / self.compared)) if self.compared else None

    def row(self) -> dict[str, Any]:
        """As JSON holds it."""
        return {
            "column": self.column,
            "compared": self.compared,
            "largest_difference": self.absolute.row("difference"),
            "largest_relative": self.relative.row("relative"),
            "rms": self.rms,
        }


class Comparison:
    """Compares the steps of an evaluation with a file, as they come."""

    def __init__(self, evaluation: Evaluation, reference: Reference) -> None:
        self._evaluation, self.reference = evaluation, reference
        self.differences = [Difference(name) for name in reference.values]
        met = np.zeros(len(evaluation.scene.element_ids), dtype=bool)
        met[reference.element] = True
        self.missing = evaluation.scene.element_ids[evaluation.elements[~met[evaluation.elements]]]

    @property
    def timed(self) -> bool:
        """Whether differences have a time."""
        return self._evaluation.time is not None

    def others(self, part: Part) -> list[tuple[str, Floats]]:
        """Columns beside ours: the values of the file (steps, m), NaN where it has none."""
        rows, step, element = self._rows(part)
        shape = (part.count, len(self._evaluation.scene.element_ids))
        columns = []
        for name, theirs in self.reference.values.items():
            values = np.full(shape, np.nan)
            values[step, element] = theirs[rows]
            columns.append((f"{name}_against", values))
        return columns

    def take(self, part: Part) -> None:
        """Compare some steps."""
        rows, step, element = self._rows(part)
        for found, (name, theirs) in zip(self.differences, self.reference.values.items(), strict=True):
            ours = getattr(part.result, name)[step, element]
            self._compare(found, ours, theirs[rows], part.start + step, element)

    def _rows(self, part: Part) -> tuple[slice, Indices, Indices]:
        """The rows of the file for some steps, and where they belong."""
        reference = self.reference
        first, last = np.searchsorted(reference.step, [part.start, part.start + part.count]).tolist()
        rows = slice(first, last)
        return rows, reference.step[rows] - part.start, reference.element[rows]

    def _compare(self, found: Difference, ours: Floats, theirs: Floats, step: Indices, element: Indices) -> None:
        both = np.flatnonzero(~np.isnan(ours) & ~np.isnan(theirs))
        if not both.size:
            return
        ours, theirs = ours[both], theirs[both]
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            difference = np.nan_to_num(ours - theirs)  # what overflows is as large as it can be
            size = np.maximum(np.abs(ours), np.abs(theirs))
            relative = np.where(size > 0.0, difference / size, 0.0)
            found.squares = float(np.nan_to_num(found.squares + (difference * difference).sum()))
        found.compared += int(both.size)
        self._raise(found.absolute, difference, step[both], element[both])
        self._raise(found.relative, relative, step[both], element[both])

    def _raise(self, extreme: Extreme, values: NDArray[np.float64], step: Indices, element: Indices) -> None:
        """Keep the largest magnitude, the first of them."""
        largest = int(np.argmax(np.abs(values)))
        if extreme.element is None or abs(values[largest]) > abs(extreme.value):
            times = self._evaluation.time
            extreme.value = float(values[largest]) + 0.0
            extreme.element = int(self._evaluation.scene.element_ids[element[largest]])
            extreme.time = None if times is None else float(times[step[largest]])

    def summary(self) -> dict[str, Any]:
        """What was compared, what was found, and what either side lacks."""
        reference = self.reference
        return {
            "file": reference.file,
            "columns": [found.row() for found in self.differences],
            "elements_not_in_deck": reference.unknown.tolist(),
            "elements_not_in_file": self.missing.tolist(),
            "times_not_evaluated": reference.lost_times.tolist(),
            "times_not_in_file": reference.missing_times.tolist(),
        }
