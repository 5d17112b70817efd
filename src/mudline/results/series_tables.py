"""The summary of a long series as tables: elements, nodes, lines, and the largest totals, extremes with their times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from mudline.contact.columns import NO_ELEMENT, Column, ElementTable, NodeTable, Values
from mudline.contact.touchdown import LineTable
from mudline.quantities import ELEMENTS, LINES, NODES, STEPS, Quantity, time_unit
from mudline.results.forms import Tables
from mudline.results.series import COUNTS, FIGURES, Extremes, SeriesSummary
from mudline.scene.numbering import Floats, Indices

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


def series_tables(summary: SeriesSummary, more: Mapping[str, object]) -> Tables:
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
    return Tables(tables, SERIES_FORMAT, given.units, {"steps": evaluation.steps, **more})


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
    value, step = found.arrays()[side], found.arrays()[f"{side}_step"]
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
    found, ids = summary.peaks, np.append(summary.evaluation.scene.element_ids, NO_ELEMENT)
    names: Indices = np.arange(len(STEPS))
    columns = [
        Column("figure", names, (*STEPS, None), over_steps=False),
        _column("largest", np.where(found.step >= 0, found.value, np.nan)),
        _column("step", found.step, blank=_NO_STEP),
        _column("element", ids[found.element], blank=NO_ELEMENT),
    ]
    if times is not None:
        at = _column(
            "time", np.where(found.step >= 0, times[found.step], np.nan), unit=time_unit(summary.evaluation.scene.units)
        )
        columns.insert(3, at)
    return columns


def _column(name: str, values: Values, *, blank: int | None = None, unit: str = "") -> Column:
    return Column(name, values, over_steps=False, blank=blank, unit=unit)
