"""Figures followed over the steps of an evaluation, and the tables of a long series.

The extremes of each figure are kept, with the steps of their first occurrence; of a condition the number of steps.
Memory does not grow with the number of steps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import SLIDING, STEPS, Quantity
from mudline.basics.units import UNITS
from mudline.model.contact.columns import NO_ELEMENT, ResultColumn, Values, kept
from mudline.model.contact.input import LawKind
from mudline.model.contact.result import ResultPart
from mudline.model.contact.touchdown import LineSeries, side_by_side
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.extremes import NO_STEP, Extremes, PeakValue, StepValues
from mudline.model.results.forms import TABLES, FileContent, ResultTables, Writer, plan_rows
from mudline.model.results.totals import HELD, carried, step_figures
from mudline.model.results.warnings import ContactWarning
from mudline.model.scene.numbering import Floats, Mask

Figures = Mapping[str, StepValues]


def _of_elements(evaluation: Evaluation, part: ResultPart) -> Figures:
    result, chosen = part.result, evaluation.elements
    held = np.zeros((1, len(chosen)), np.bool_)
    if result.state is not None:
        held = np.isin(kept(result.state, chosen), HELD)
    return {
        **{name: StepValues(kept(getattr(result, name), chosen)) for name in ("force", "depth", "stiffness")},
        "contact_steps": StepValues(kept(result.contact, chosen)),
        "suction_steps": StepValues(held),
    }


def _of_nodes(evaluation: Evaluation, part: ResultPart) -> Figures:
    result, chosen = part.result, evaluation.nodes
    gap = kept(result.gap, chosen)
    touches = gap < 0.0
    if result.restrained is not None:
        touches |= kept(result.restrained, chosen)
    friction = np.zeros((1, len(chosen), 2))  # as in the results without friction
    if result.friction is not None:
        friction = kept(result.friction, chosen)
    slips = np.zeros((1, len(chosen)), np.bool_)
    if result.friction_state is not None:
        slips = kept((result.friction_state == SLIDING.index("slip")).any(axis=-1), chosen)
    return {
        "gap": StepValues(gap),
        "normal_force": StepValues(kept(result.normal_force, chosen)),
        "axial_force": StepValues(friction[..., 0]),
        "lateral_force": StepValues(friction[..., 1]),
        "contact_steps": StepValues(touches),
        "slip_steps": StepValues(slips),
    }


OF_LINES = ("first_touchdown", "last_touchdown", "contact_length", "largest_force", "largest_uplift", "reaction")
"""Quantities of `LINES` that are followed."""


def _of_lines(evaluation: Evaluation, part: ResultPart) -> Figures:
    lines = evaluation.touchdown.series(part)
    of_lines = partial(_of_each, lines, part)
    values = {name: StepValues(of_lines(name)) for name in OF_LINES}
    return values | {
        "contact_steps": StepValues(values["contact_length"].values > 0.0),
        "touchdown_steps": StepValues(of_lines("touchdown_points") > 0),
    }


def _of_each(lines: Sequence[LineSeries], part: ResultPart, name: str) -> Values:
    return side_by_side([getattr(line, name) for line in lines], part.count)


def _of_case(evaluation: Evaluation, part: ResultPart) -> Figures:
    """Return the figures of `CASES` over all lines that may lie on the seabed, or all lines if only nodes may."""
    law = evaluation.model.input.law
    series = evaluation.touchdown.series(part)
    lying = [line for line in series if (law[evaluation.touchdown.lines.elements[line.number]] != LawKind.NONE).any()]
    lines = lying or (series if evaluation.has_seabed_law else [])
    touching = np.count_nonzero(carried(part.result)[:, evaluation.elements], axis=1)
    figures = {"in_contact": StepValues(touching.astype(np.float64)[:, np.newaxis])}
    if not lines:
        return figures
    of_lines = partial(_of_each, lines, part)
    with np.errstate(over="ignore", invalid="ignore"):
        length, reaction, weight, empty = (
            of_lines(name).sum(axis=1, keepdims=True)
            for name in ("contact_length", "reaction", "submerged_weight", "empty_weight")
        )
    known = np.where(np.isnan(reaction), np.inf, reaction)  # an unknown one stays unknown
    return figures | {
        "touchdown_from": StepValues(of_lines("first_touchdown")),
        "touchdown_to": StepValues(of_lines("last_touchdown")),
        "contact_length": StepValues(length),
        "largest_force": StepValues(of_lines("largest_force"), of_lines("force_at")),
        "largest_uplift": StepValues(of_lines("largest_uplift"), of_lines("uplift_at")),
        "reaction": StepValues(known, weight),
        "reaction_empty": StepValues(known, empty),
    }


def _of_suction(_: Evaluation, part: ResultPart) -> Figures:
    """Return the elements with suction at velocities below REGULARISATION."""
    slow = part.result.regularised
    if slow is None:
        return {}
    some: Mask = np.logical_or.reduce(slow, axis=1, keepdims=True)
    return {
        "slow": StepValues(np.where(some, 1.0, np.nan), slow.argmax(axis=1, keepdims=True)),
        "slow_steps": StepValues(some),
    }


FIGURES: Mapping[str, Callable[[Evaluation, ResultPart], Figures]] = {
    "elements": _of_elements,
    "nodes": _of_nodes,
    "summary": _of_lines,
    "totals": lambda _, part: step_figures(part),
    "case": _of_case,
    "suction": _of_suction,
}
"""Functions for the figures of some steps, by table; a figure has one column for each row of the table."""


class SeriesSummary:
    """Consumer of the steps of an evaluation that keeps the extremes and counts of the figures of tables.

    Attributes:
        extremes: extremes by table and figure.
        counts: numbers of steps by table and condition.
    """

    def __init__(self, evaluation: Evaluation, *tables: str) -> None:
        self.evaluation = evaluation
        self._tables = tables
        self.extremes: dict[tuple[str, str], Extremes] = {}
        self.counts: dict[tuple[str, str], NDArray[np.int64]] = {}

    def take(self, part: ResultPart) -> None:
        """Add some steps."""
        for table in self._tables:
            for name, figure in FIGURES[table](self.evaluation, part).items():
                columns, key = figure.values.shape[1], (table, name)
                if figure.values.dtype == np.bool_:
                    before = self.counts.setdefault(key, np.zeros(columns, np.int64))
                    before += np.count_nonzero(figure.values, axis=0)
                else:
                    self.extremes.setdefault(key, Extremes(columns)).take(part.start, figure)

    def of(self, table: str, figure: str) -> Extremes:
        """Return the extremes of a figure; empty extremes if no step has it."""
        return self.extremes.get((table, figure), Extremes(0))

    def totals(self) -> dict[str, PeakValue]:
        """Return the largest value of each figure of `STEPS` that has one; of `force` by its magnitude."""
        extremes = {name: self.of("totals", name) for name in STEPS}
        peaks = {name: each.farthest() if name == "force" else each.largest.peak() for name, each in extremes.items()}
        return {name: peak for name, peak in peaks.items() if peak is not None}

    def number(self, peak: PeakValue | None) -> int | None:
        """Return the number of the element of a peak; None without one."""
        if peak is None or not peak.at >= 0:
            return None
        return int(self.evaluation.scene.element_ids[int(peak.at)])


class SeriesSink:
    """Consumer that passes the summary of a series to a writer after the last step."""

    def __init__(self, evaluation: Evaluation, open_writer: Callable[[FileContent], Writer]) -> None:
        self._summary, self._open_writer = SeriesSummary(evaluation, *SERIES), open_writer

    def take(self, part: ResultPart) -> None:
        """Add some steps."""
        self._summary.take(part)

    def finish(self, warnings: Sequence[ContactWarning] = ()) -> None:
        """Write the tables. Raises OSError."""
        series_tables(self._summary, warnings).write(self._open_writer)


# --------------------------------------------------------------------------------------------------------------- tables

SERIES_FORMAT = "mudline-series/1"
"""Name and version of the format of files with the summary of a series."""
SERIES = (*TABLES, "totals")
"""Tables with the figures of `series_tables`."""


def series_tables(summary: SeriesSummary, warnings: Sequence[ContactWarning]) -> ResultTables:
    """Return the tables of a summary, with the additional keys of JSON."""
    evaluation = summary.evaluation
    times = evaluation.time
    of_rows = {name: evaluation.table(name) for name in TABLES}
    tables = {
        name: [*each.facts(), *_extremes(summary, name, each.quantities, times)] for name, each in of_rows.items()
    }
    for (table, name), counts in summary.counts.items():
        if table in tables:
            tables[table].append(ResultColumn(name, counts))
    tables["totals"] = _totals(summary, times)
    more = {
        "steps": evaluation.steps,
        "plan": plan_rows(evaluation.model.plan),
        "positions": evaluation.source,
        "warnings": [warning.row() for warning in warnings],
    }
    return ResultTables(tables, SERIES_FORMAT, evaluation.scene.units, more)


def _extremes(
    summary: SeriesSummary, table: str, quantities: Mapping[str, Quantity], times: Floats | None
) -> Iterator[ResultColumn]:
    """Yield the least and the largest value of each figure, with step and time."""
    units = summary.evaluation.scene.units
    for figure, extremes in [(name, each) for (of, name), each in summary.extremes.items() if of == table]:
        quantity = quantities[figure]
        for side, best in (("least", extremes.least), ("largest", extremes.largest)):
            name, steps = f"{quantity.name}_{side}", best.steps
            yield ResultColumn(name, best.values, unit=quantity.unit_name(units))
            yield ResultColumn(f"{name}_step", steps, blank=NO_STEP)
            if times is not None:
                time = np.where(steps >= 0, times[steps], np.nan)
                yield ResultColumn(f"{name}_time", time, unit=UNITS[units].unit("T"))


def _totals(summary: SeriesSummary, times: Floats | None) -> list[ResultColumn]:
    """Return a row for each figure of `STEPS` with its largest value over all steps."""
    peaks = summary.totals()
    largest = [peaks.get(name, PeakValue(np.nan, NO_STEP)) for name in STEPS]
    numbers = [summary.number(peak) for peak in largest]
    steps = np.array([peak.step for peak in largest], np.int64)
    elements = np.array([NO_ELEMENT if number is None else number for number in numbers], np.int64)
    columns = [
        ResultColumn("figure", np.arange(len(STEPS)), (*STEPS, None)),
        ResultColumn("largest", np.array([peak.value for peak in largest])),
        ResultColumn("step", steps, blank=NO_STEP),
        ResultColumn("element", elements, blank=NO_ELEMENT),
    ]
    if times is not None:
        unit = UNITS[summary.evaluation.scene.units].unit("T")
        columns.insert(3, ResultColumn("time", np.where(steps >= 0, times[steps], np.nan), unit=unit))
    return columns
