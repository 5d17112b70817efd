"""What is kept of a long series, as tables too: extremes of elements, nodes and lines, counts, the largest totals.

Memory does not grow with the number of steps.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.contact.columns import NO_ELEMENT, Column, ElementTable, NodeTable, Values, kept
from mudline.contact.result import ContactResult, Part
from mudline.contact.touchdown import LineTable, Touchdown
from mudline.quantities import ELEMENTS, LINES, NODES, SLIDING, STEPS, Quantity, time_unit
from mudline.results.evaluation import Evaluation
from mudline.results.forms import Tables, plan_rows
from mudline.results.totals import FOLLOWED, HELD, Extent, LineWatch, Peak, SlowSuction, StepSummary
from mudline.results.warnings import ContactWatch
from mudline.scene.numbering import Floats, Indices

FIGURES = {
    "elements": ("force", "depth", "stiffness"),
    "nodes": ("gap", "normal_force", "axial_force", "lateral_force"),
    "summary": FOLLOWED,
}
"""Figures whose extremes are kept, by table."""
COUNTS = {
    "elements": ("contact_steps", "suction_steps"),
    "nodes": ("contact_steps", "slip_steps"),
    "summary": ("contact_steps", "touchdown_steps"),
}
"""Numbers of steps that are counted, by table."""


class Extremes:
    """The least and the largest value of columns (k,) over steps, and the steps where they were first.

    Infinite values and the step -1 stand for none.
    """

    def __init__(self, columns: int) -> None:
        self.least, self.largest = np.full(columns, np.inf), np.full(columns, -np.inf)
        self.least_step, self.largest_step = (np.full(columns, -1, np.int64) for _ in range(2))

    def take(self, start: int, values: Floats) -> None:
        """Look at the values (steps, k) of the steps `start` and on; NaN is none."""
        low, high = np.fmin.reduce(values, axis=0), np.fmax.reduce(values, axis=0)
        for found, better, value, step in (
            (low, low < self.least, self.least, self.least_step),
            (high, high > self.largest, self.largest, self.largest_step),
        ):
            column = np.flatnonzero(better)
            if column.size:
                row = (values[:, column] == found[column]).argmax(axis=0)
                value[column], step[column] = values[row, column], start + row


class SeriesSummary:
    """Takes the steps of an evaluation a few at a time, and keeps their extremes.

    Attributes:
        elements, nodes, lines: indices of what the rows of the tables are about.
        extremes: by table and figure. counts: numbers of steps, by table and name.
        totals: the largest of each figure of `STEPS`.
        watch: what the warnings need. slow: where suction is pulled slower than its law resolves.
    """

    def __init__(self, evaluation: Evaluation) -> None:
        given = evaluation.model.input
        self.evaluation = evaluation
        self.elements, self.nodes = evaluation.elements, evaluation.nodes
        self.lines: Indices = np.unique(given.lines.of_element[self.elements])
        rows = {"elements": len(self.elements), "nodes": len(self.nodes), "summary": len(self.lines)}
        self.extremes = {(table, each): Extremes(rows[table]) for table, names in FIGURES.items() for each in names}
        self.counts = {
            (table, each): np.zeros(rows[table], np.int64) for table, names in COUNTS.items() for each in names
        }
        self.totals = StepSummary(evaluation, 0)
        self.watch, self.slow = ContactWatch.of(evaluation), SlowSuction()
        self._finder = Touchdown(given)

    def take(self, part: Part) -> None:
        """Look at some steps."""
        result = part.result
        for name in FIGURES["elements"]:
            self.extremes["elements", name].take(part.start, kept(getattr(result, name), self.elements))
        self._count("elements", "contact_steps", kept(result.contact, self.elements))
        if result.state is not None:
            self._count("elements", "suction_steps", np.isin(kept(result.state, self.elements), HELD))
        self._take_nodes(part.start, result)
        self._take_lines(part)
        self.totals.take(part)
        self.watch.take(part)
        self.slow.take(part)

    def _take_nodes(self, start: int, result: ContactResult) -> None:
        gap = kept(result.gap, self.nodes)
        self.extremes["nodes", "gap"].take(start, gap)
        self.extremes["nodes", "normal_force"].take(start, kept(result.normal_force, self.nodes))
        touches = gap < 0.0
        if result.restrained is not None:
            touches |= kept(result.restrained, self.nodes)
        self._count("nodes", "contact_steps", touches)
        for side, name in enumerate(("axial_force", "lateral_force")):
            found = np.zeros((1, len(self.nodes)))  # as in the results without friction
            if result.friction is not None:
                found = kept(result.friction[..., side], self.nodes)
            self.extremes["nodes", name].take(start, found)
        if result.friction_state is not None:
            slips = (result.friction_state == SLIDING.index("slip")).any(axis=-1)
            self._count("nodes", "slip_steps", kept(slips, self.nodes))

    def _take_lines(self, part: Part) -> None:
        found = self._finder.series(part)
        if not found:
            return
        for name in FOLLOWED:
            values = np.stack([getattr(line, name) for line in found], axis=1)
            self.extremes["summary", name].take(part.start, values)
        self._count("summary", "contact_steps", np.stack([line.contact_length > 0.0 for line in found], axis=1))
        self._count("summary", "touchdown_steps", np.stack([line.points > 0 for line in found], axis=1))

    def _count(self, table: str, name: str, holds: NDArray[np.bool_]) -> None:
        self.counts[table, name] += np.count_nonzero(holds, axis=0)

    def line_watch(self, most: int | None) -> LineWatch:
        """The extents of the figures of lines, as the terminal shows them; at most so many rows."""
        extents = {
            (line, name): Extent(*(array[row].item() for array in _sides(self.extremes["summary", name])))
            for name in FOLLOWED
            for row, line in enumerate(self.lines.tolist())
            if self.extremes["summary", name].least_step[row] >= 0
        }
        return LineWatch(self.evaluation, most, extents=extents)


def _sides(extremes: Extremes) -> tuple[NDArray[Any], ...]:
    return extremes.least, extremes.least_step, extremes.largest, extremes.largest_step


# --------------------------------------------------------------------------------------------------------------- tables

SERIES_FORMAT = "mudline-series/1"
"""Name and version of the form of files with the summary of a series."""

_OF_LINES = {
    "first": "first_touchdown",
    "last": "last_touchdown",
    "force": "largest_force",
    "uplift": "largest_uplift",
}
"""The quantities of `LINES` whose names are not those of the figures of a line."""
_NO_STEP = -1


def series_tables(summary: SeriesSummary) -> Tables:
    """The tables of a summary, with what JSON has besides them."""
    evaluation = summary.evaluation
    given, times = evaluation.model.input, evaluation.time
    facts = {
        "elements": ElementTable(given, summary.elements).facts(),
        "nodes": NodeTable(given, summary.nodes).facts(),
        "summary": LineTable(given, summary.elements).facts(),
    }
    tables = {table: [*facts[table], *_extremes(summary, table, times), *_counts(summary, table)] for table in FIGURES}
    tables["totals"] = _totals(summary, times)
    more = {
        "steps": evaluation.steps,
        "plan": plan_rows(evaluation.model.plan),
        "positions": "file",
        "warnings": [one.row() for one in summary.watch.warnings()],
    }
    return Tables(tables, SERIES_FORMAT, given.units, more)


def _quantity(table: str, figure: str) -> Quantity:
    if table == "summary":
        return LINES[_OF_LINES.get(figure, figure)]
    return (ELEMENTS if table == "elements" else NODES)[figure]


def _extremes(summary: SeriesSummary, table: str, times: Floats | None) -> Iterator[Column]:
    """Of each figure the least and the largest value, its step and its time."""
    units = summary.evaluation.scene.units
    for figure in FIGURES[table]:
        quantity, found = _quantity(table, figure), summary.extremes[table, figure]
        for side in ("least", "largest"):
            yield from _timed(f"{quantity.name}_{side}", *_side(found, side), times, quantity, units)


def _side(found: Extremes, side: str) -> tuple[Floats, NDArray[np.int64]]:
    value, step = getattr(found, side), getattr(found, f"{side}_step")
    return np.where(step >= 0, value, np.nan), step


def _timed(
    name: str, values: Floats, steps: NDArray[np.int64], times: Floats | None, quantity: Quantity, units: str
) -> Iterator[Column]:
    yield _column(name, values, unit=quantity.unit_name(units))
    yield _column(f"{name}_step", steps, blank=_NO_STEP)
    if times is not None:
        yield _column(f"{name}_time", np.where(steps >= 0, times[steps], np.nan), unit=time_unit(units))


def _counts(summary: SeriesSummary, table: str) -> Iterator[Column]:
    return (_column(name, summary.counts[table, name]) for name in COUNTS[table])


def _totals(summary: SeriesSummary, times: Floats | None) -> list[Column]:
    """A row for each figure of `STEPS`: its largest value over all steps."""
    none = Peak(np.nan, _NO_STEP, None)
    found = [summary.totals.peaks.get(name, none) for name in STEPS]
    steps = np.array([peak.step for peak in found], np.int64)
    elements = np.array([NO_ELEMENT if peak.element is None else peak.element for peak in found], np.int64)
    columns = [
        Column("figure", np.arange(len(STEPS)), (*STEPS, None), over_steps=False),
        _column("largest", np.array([peak.value for peak in found])),
        _column("step", steps, blank=_NO_STEP),
        _column("element", elements, blank=NO_ELEMENT),
    ]
    if times is not None:
        unit = time_unit(summary.evaluation.scene.units)
        columns.insert(3, _column("time", np.where(steps >= 0, times[steps], np.nan), unit=unit))
    return columns


def _column(name: str, values: Values, *, blank: int | None = None, unit: str = "") -> Column:
    return Column(name, values, over_steps=False, blank=blank, unit=unit)
