"""Evaluation for people: totals by law, contact, summaries of steps, a comparison."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mudline.basics.display import DisplayColumn, DisplayTable, number, text
from mudline.basics.limits import SHOWN_ROWS
from mudline.basics.quantities import LINES, NODES, STEPS, shown
from mudline.basics.short_repr import counted
from mudline.basics.units import UNITS
from mudline.cli.view import View
from mudline.model.contact import ContactResult
from mudline.model.contact.columns import ResultColumn
from mudline.model.contact.lines import LineSummary
from mudline.model.contact.result import ResultPart
from mudline.model.results.against import ResultComparison
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.series import OF_LINES, SeriesSummary
from mudline.model.results.summary_tables import law_table, span, state_table, touchdown_table, weight_note
from mudline.model.results.totals import (
    NOT_KNOWN,
    acted_on,
    carried,
    line_steps,
    reaction,
    states,
    step_totals,
    totals,
    touchdown_words,
)
from mudline.model.scene.numbering import Floats

if TYPE_CHECKING:
    from mudline.cli.printing import Printer

Cells = tuple[Any, ...]
"""Texts and numbers of a row."""
_DIGITS = 4
"""Digits of the largest number of a column; the others have as many decimals."""
_ALIKE = 0.005
"""Share of the largest number of a column by which rows may differ that are shown as one, with the largest."""
_MORE_LINES, _MORE_STEPS = (f"more {rows}: -v shows all, -o writes all" for rows in ("lines", "steps"))
_FARTHER = "more lines, farther from touchdown: --table elements shows all, -o writes all"
_SHOWN_POINTS = 3
"""Touchdown points that a cell shows."""


class Screen:
    """Consumer that keeps what the terminal shows: the first state, rows of steps and lines, extremes of a series."""

    def __init__(self, evaluation: Evaluation, which: str, view: View, *, every: bool) -> None:
        self.evaluation, self.which = evaluation, which
        self.most = view.most
        self.every = every or view.verbose
        self.first: ResultPart | None = None
        self.steps: list[dict[str, Any]] = []
        self.lines: list[LineSummary] = []
        self.series = SeriesSummary(evaluation, *([] if evaluation.time is None else ["totals", "summary"]))

    def take(self, part: ResultPart) -> None:
        """Add some steps; their rows up to the limit."""
        self.first = self.first or ResultPart(part.start, part.result.steps(0, 1))
        steps = step_totals(self.evaluation, part, of_nodes=self.which == "nodes")
        self.steps += islice(steps, self.most - len(self.steps))
        self.lines += islice(line_steps(self.evaluation, part), self.most - len(self.lines))
        self.series.take(part)


def print_evaluation(screen: Screen, view: View) -> None:
    """Print totals and rows of one state, or a line for each time step, with the columns of result files.

    If no element has a law, a line reports it instead; `view.verbose` shows totals and rows too.
    """
    printer, evaluation = view.printer(), screen.evaluation
    if not evaluation.has_seabed_law:
        elements = counted(len(evaluation.elements), "element")
        printer.line(f"{_title(evaluation)}: none of {elements} has a seabed law, so there are no forces")
        if not view.verbose:
            return
    if screen.which == "summary":
        _print_lines(printer, screen)
    elif evaluation.time is None:
        _print_state(printer, screen)
    else:
        _print_steps(printer, screen)
        _print_peaks(printer, screen.series)
    if evaluation.steps > 1:
        _print_extents(printer, screen.series, screen.most)


def print_series(series: SeriesSummary, view: View) -> None:
    """Print the extremes over all steps, and the range of each figure of the lines."""
    printer = view.printer()
    printer.line(f"{_title(series.evaluation)}, {series.evaluation.steps} steps")
    _print_peaks(printer, series)
    _print_extents(printer, series, view.most)


def _title(evaluation: Evaluation) -> str:
    deck = evaluation.scene.deck
    return f"Contact of {deck.source or deck.file} ({deck.units} units)"


# --------------------------------------------------------------------------------------------------------- one state


def _print_state(printer: Printer, screen: Screen) -> None:
    """Print totals by law, touchdown, states of laws with states, and the elements or nodes in contact."""
    evaluation, first = screen.evaluation, screen.first
    if first is None:
        return
    result = first.result.step(0)
    _print_totals(printer, evaluation, result)
    _print_lines(printer, screen)
    if rows_of_states := states(evaluation, result):
        printer.table(state_table(rows_of_states))
    if screen.which == "elements":
        acts = (carried(result) | (np.nan_to_num(result.force) != 0.0))[evaluation.elements]
        distance = _from_touchdown(screen)[evaluation.elements[acts]]
    else:
        acts = np.isin(evaluation.nodes, acted_on(evaluation, result))
        distance = np.zeros(int(acts.sum()))
    names = _OF_ELEMENT if screen.which == "elements" else _OF_NODE
    lacking = {"state"} if result.state is None else set()
    lacking |= {name for name in names if "_force" in name and result.friction is None}
    lacking |= {name for name in names if "_state" in name and result.friction_state is None}
    table = evaluation.table(screen.which)
    available = {each.name: each for each in table.columns(first)}
    columns: list[DisplayColumn] = []
    listed: list[list[str | float]] = []
    for name in names:
        for each in available[name].flat() if name not in lacking else ():
            column = table.quantities[name].column(evaluation.scene.units, len(columns), left=bool(each.names))
            axis = each.name.removeprefix(name).replace("_", " ").upper()
            columns.append(replace(column, heading=column.heading + axis))
            listed.append(_cells(each, each.cut(0, 1)[0, acts], every=screen.every))
    rows: list[Cells] = list(zip(*listed, strict=True))
    note = ""
    if not screen.every:
        joined = list(_joined(rows, distance.tolist()))
        nearest = sorted(range(len(joined)), key=lambda row: joined[row][1])[:SHOWN_ROWS]
        alike = [f"rows alike to {_ALIKE * 100.0:g} % are one, with the largest numbers"]
        notes = alike if any(differ for _, _, differ in joined) else []
        left = len(joined) - len(nearest)
        notes += [f"{left} {_FARTHER if screen.which == 'elements' else _MORE_LINES}"] if left else []
        note, rows = "; ".join(notes), [joined[row][0] for row in sorted(nearest)]
    in_part = any(row.contact_length for row in screen.lines) and not result.contact.any()
    if rows:
        printer.table(DisplayTable(f"{screen.which.capitalize()} in contact", columns, rows, note))
    elif screen.which == "elements" and in_part:
        printer.line("No element is in contact in the mean of its nodes")
    else:
        printer.line(f"No {screen.which} in contact")


def _from_touchdown(screen: Screen) -> Floats:
    """Return the distances (m,) of elements along their line from a touchdown point; infinite without one."""
    lines = screen.evaluation.model.input.lines
    distances = np.full(len(lines.element_arc), np.inf)
    for row in screen.lines:
        elements = lines.elements[row.line - 1]
        for point in row.touchdown:
            apart = np.abs(lines.element_arc[elements] - point.arc_length)
            distances[elements] = np.minimum(distances[elements], apart)
    return distances


_OF_ELEMENT = ("element", "law", "depth", "ratio", "force", "stiffness", "length", "state")
_OF_NODE = ("node", "gap", "reaction", "axial_force", "lateral_force", "axial_state", "lateral_state")
"""Columns of elements and nodes that are shown."""


def _cells(column: ResultColumn, of: NDArray[np.generic], *, every: bool) -> list[str | float]:
    """Return the cells of a column, with all digits if `every`, else with the significant digits of the column."""
    values = of.tolist()
    if column.names:
        return [column.names[code] or "" for code in values]
    sizes = [abs(value) for value in values if isinstance(value, float) and 0.0 < abs(value) < math.inf]
    if sizes and not every:
        decimals = _DIGITS - 1 - math.floor(math.log10(max(sizes)))
        values = [round(value, decimals) + 0.0 if isinstance(value, float) else value for value in values]
    return list(values)


def _print_totals(printer: Printer, evaluation: Evaluation, result: ContactResult) -> None:
    rows = totals(evaluation, result)
    if len(rows) > 1 or any(each["law"] == "nodal" for each in rows):
        total = reaction(evaluation, result)
        known = NOT_KNOWN if math.isnan(total) else total
        sums = {name: sum(each[name] for each in rows) for name in ("elements", "touching")}
        deepest = max((each["deepest"] for each in rows if each["deepest"] is not None), default=None)
        rows.append({"law": "total", "set_name": "", **sums, "deepest": deepest, "reaction": known})
    printer.table(law_table(_title(evaluation), rows, evaluation.scene.units))


def _joined(rows: Sequence[Cells], near: Sequence[float]) -> Iterator[tuple[Cells, float, bool]]:
    """Join consecutive rows with nearly equal values, and yield each with the least of their distances.

    The first cells are the numbers. A joined row has the largest of its values; the last value is True if some differ.
    """
    tolerances = [
        None if isinstance(column[0], str) else _ALIKE * max(map(abs, column)) for column in zip(*rows, strict=True)
    ]

    def alike(row: Cells, other: Cells) -> bool:
        cells = zip(row[1:], other[1:], tolerances[1:], strict=True)
        return all(a == b or (tolerance is not None and abs(a - b) <= tolerance) for a, b, tolerance in cells)

    numbers = [int(row[0]) for row in rows]
    starts: list[int] = []
    for at, row in enumerate(rows):
        follows = at > 0 and numbers[at] == numbers[at - 1] + 1
        if not (follows and alike(row, rows[starts[-1]])):
            starts.append(at)
    for start, end in pairwise([*starts, len(rows)]):
        _, *columns = zip(*rows[start:end], strict=True)
        largest = (each[0] if isinstance(each[0], str) else shown(max(each, key=abs)) for each in columns)
        yield (
            (span(numbers[start], numbers[end - 1]), *largest),
            min(near[start:end]),
            any(len(set(column)) > 1 for column in columns),
        )


# ------------------------------------------------------------------------------------------------------------- steps


def _print_steps(printer: Printer, screen: Screen) -> None:
    """Print a row for each step: of the elements, or of the nodes."""
    evaluation, rows = screen.evaluation, screen.steps
    units, of_nodes = evaluation.scene.units, screen.which == "nodes"
    which = "node" if of_nodes else "element"
    of_gap = [
        number("smallest\ngap", "gap", NODES["gap"].unit_name(units)),
        number("largest\non a node", "largest", NODES["normal_force"].unit_name(units)),
    ]
    columns = [
        _time(evaluation, "time"),
        STEPS["touching"].column(units),
        number(f"first\n{which}", "first"),
        number(f"last\n{which}", "last"),
        *(of_gap if of_nodes else [STEPS["deepest"].column(units)]),
        STEPS["reaction"].column(units),
        *([] if of_nodes else [number("suction\nor hold", "sucked", optional=True)]),
        number("nodes\nslipping", "slipping", optional=True),
    ]
    left = evaluation.steps - len(rows)
    note = f"{left} {_MORE_STEPS}" if left else ""
    printer.table(DisplayTable(f"{_title(evaluation)}, {evaluation.steps} steps", columns, rows, note))


def _time(evaluation: Evaluation, value: str | int) -> DisplayColumn:
    return number("time", value, UNITS[evaluation.scene.units].unit("T"))


def _print_peaks(printer: Printer, series: SeriesSummary) -> None:
    """Print the extremes over all steps, including those not listed."""
    evaluation, times, peaks = series.evaluation, series.evaluation.time, series.totals()
    figures = {
        "reaction": "total reaction",
        "force": "force of an element",
        "pull": "suction force of an element",
        "touching": "elements in contact",
        "deepest": "depth",
    }
    rows = [
        (what, peak.value, STEPS[key].unit_name(evaluation.scene.units), float(times[peak.step]), series.number(peak))
        for key, what in figures.items()
        if times is not None and (peak := peaks.get(key)) and not (key in {"force", "pull"} and peak.value == 0.0)
    ]
    columns = (text("largest", 0), number("value", 1), text("unit", 2), _time(evaluation, 3), number("element", 4))
    printer.table(DisplayTable("Over all steps", columns, rows))


# ------------------------------------------------------------------------------------------------------------- lines


def _print_lines(printer: Printer, screen: Screen) -> None:
    """Print touchdown, largest forces, reaction and weight of lines, a row for each line and step."""
    evaluation, rows = screen.evaluation, screen.lines
    left = len(evaluation.lines) * evaluation.steps - len(rows)
    if rows:
        notes = [
            f"{left} {_MORE_LINES}" if left else "",
            weight_note(evaluation.weights_without, evaluation.contents_case),
        ]
        lines, note = [row.row() for row in rows], "; ".join(filter(None, notes))
        timed = evaluation.time is not None
        printer.table(touchdown_table(lines, evaluation.scene.units, _touchdown, note, timed=timed))


def _touchdown(row: dict[str, Any]) -> str:
    places = [point["arc_length"] for point in row["touchdown"]]
    return touchdown_words(places, row["contact_length"], row["length"], _SHOWN_POINTS)


def _print_extents(printer: Printer, series: SeriesSummary, most: int) -> None:
    """Print the ranges of touchdown, length in contact, forces and reaction of each line."""
    evaluation, times, lines = series.evaluation, series.evaluation.time, series.evaluation.lines.tolist()
    rows = []
    for at, line in enumerate(lines):
        extents = {name: extent for name in OF_LINES if (extent := series.of("summary", name).extent(at, times))}
        first, last = extents.get("first_touchdown"), extents.get("last_touchdown")
        if last == first:
            extents.pop("last_touchdown", None)
        for name, extent in extents.items():
            what, unit = LINES[name].label, LINES[name].unit_name(evaluation.scene.units)
            both = name == "first_touchdown" and "last_touchdown" in extents
            rows.append((line + 1, f"first {what}" if both else what, unit, *extent))
    columns = [
        *([number("line", 0)] if len(lines) > 1 else []),
        text("figure", 1),
        text("unit", 2),
        number("least", 3),
        _time(evaluation, 4),
        number("largest", 5),
        _time(evaluation, 6),
    ]
    if rows:
        printer.table(DisplayTable("Lines over all steps", columns, rows).first(most))


# -------------------------------------------------------------------------------------------------------- comparison


def print_comparison(comparison: ResultComparison, view: View) -> None:
    """Print for each column the number of compared values, and the largest differences with their places."""

    def columns_of(name: str) -> Iterator[DisplayColumn]:
        yield number(f"largest\n{name}", f"largest_{name}.{name}", digits=4)
        yield number("at\nelement", f"largest_{name}.element")
        if comparison.timed:
            yield number("at\ntime", f"largest_{name}.time")

    columns = [
        text("column", "column"),
        number("compared", "compared"),
        *columns_of("difference"),
        *columns_of("relative"),
        number("rms\ndifference", "rms", digits=4),
    ]
    title = f"Compared with {comparison.file}"
    view.printer().table(DisplayTable(title, columns, comparison.differences))
