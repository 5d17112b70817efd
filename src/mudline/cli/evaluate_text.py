"""An evaluation for people: totals by law, what is in contact, summaries of steps, the plan, a comparison."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from mudline.cli.view import View
from mudline.contact import Plan
from mudline.contact.input import LawKind
from mudline.contact.lines import LineSummary
from mudline.contact.result import Part
from mudline.limits import SHOWN_ROWS
from mudline.quantities import SLIDING, STATES, UnitNames, headed, shown, unit_names
from mudline.results.against import Comparison
from mudline.results.evaluation import Evaluation, ResultConsumer
from mudline.results.series import SeriesSummary
from mudline.results.totals import (
    NOT_KNOWN,
    First,
    Total,
    acted_on,
    element_steps,
    line_steps,
    node_steps,
    reaction,
    states,
    totals,
    touchdown_words,
)
from mudline.scene.numbering import Floats, Indices
from mudline.short_repr import counted

if TYPE_CHECKING:
    from mudline.cli.printing import Cell, Printer

Cells = tuple[str, ...]
_LEFT = ("law", "state", "axial", "lateral")
"""Columns of text."""


def print_plan(plan: Plan, view: View) -> None:
    """Print the stages, active or not, and why."""
    rows = [(stage.stage, "yes" if stage.active else "no", stage.why) for stage in plan]
    columns = ("stage", "active", "why")
    view.printer().table(f"Plan, {plan.steps}", columns, rows, left=columns)


class Screen:
    """Keeps of the results what the terminal shows: the first state, rows of steps and lines, extremes of a series."""

    def __init__(self, evaluation: Evaluation, which: str, view: View) -> None:
        self.evaluation, self.most = evaluation, None if view.verbose else SHOWN_ROWS
        self.of_nodes = which == "nodes"
        self.first = First(lambda part: iter([Part(part.start, part.result.steps(0, 1))]), 1)
        self.steps = First(partial(node_steps if self.of_nodes else element_steps, evaluation), self.most)
        self.lines = First(partial(line_steps, evaluation), self.most)
        self.series = SeriesSummary(evaluation, *([] if evaluation.time is None else ["totals", "summary"]))
        self.consumers: list[ResultConsumer] = [self.first, self.steps, self.lines, self.series]


def print_evaluation(screen: Screen, which: str, view: View) -> None:
    """Print totals and rows of one state; of time steps a line each, as rows are for files.

    Where no element has a law, a line says so in their place; `view.verbose` shows them too.
    """
    printer, evaluation = view.printer(), screen.evaluation
    if _no_law(evaluation):
        elements = counted(len(evaluation.elements), "element")
        printer.line(f"{_title(evaluation)}: none of {elements} has a seabed law, so there are no forces")
        if not view.verbose:
            return
    if which == "summary":
        _print_lines(printer, screen)
    elif evaluation.time is not None:
        _print_steps(printer, screen)
        _print_peaks(printer, screen.series)
    if which == "summary" or evaluation.time is not None:
        if evaluation.steps > 1:
            _print_extents(printer, screen.series, screen.most)
        return
    first = screen.first.rows[0]
    _print_totals(printer, evaluation, first)
    _print_lines(printer, screen)
    _print_states(printer, evaluation, first)
    rows = _touching_elements if which == "elements" else _touching_nodes
    columns, cells = rows(evaluation, first)
    shown_rows = list(cells if view.verbose else _joined(cells))
    if not shown_rows:
        printer.line(f"No {which} in contact")
        return
    left = len(shown_rows) - len(shown_rows[: screen.most])
    note = f"{left} more lines: -v shows all, -o writes all" if left else ""
    printer.table(f"{which.capitalize()} in contact", columns, shown_rows[: screen.most], left=_LEFT, note=note)


def print_series(series: SeriesSummary, view: View) -> None:
    """Print the largest of all steps, and between which values the figures of the lines were."""
    printer = view.printer()
    printer.line(f"{_title(series.evaluation)}, {series.evaluation.steps} steps")
    _print_peaks(printer, series)
    _print_extents(printer, series, None if view.verbose else SHOWN_ROWS)


def _no_law(evaluation: Evaluation) -> bool:
    """Whether nothing acts on any of the elements: none has a law, a nodal spring or suction."""
    scene = evaluation.scene
    springs = bool(scene.nodal.any()) or "SEABED SUCTION" in scene.extensions
    lawless = scene.law[evaluation.elements] == LawKind.NONE
    return bool(lawless.size) and bool(lawless.all()) and not springs


def _joined(rows: Iterable[Cells]) -> Iterator[Cells]:
    """Rows that show the same, with numbers one after the other, as one row."""
    first = last = 0
    same: Cells | None = None
    for number, *rest in rows:
        if same != tuple(rest) or int(number) != last + 1:
            if same is not None:
                yield (_span(first, last), *same)
            first, same = int(number), tuple(rest)
        last = int(number)
    if same is not None:
        yield (_span(first, last), *same)


def _span(first: int, last: int) -> str:
    return str(first) if first == last else f"{first} to {last}"


def _print_totals(printer: Printer, evaluation: Evaluation, part: Part) -> None:
    names = unit_names(evaluation.scene.units)
    found = totals(evaluation, part)
    rows: list[tuple[Cell, ...]] = [
        (each.law, each.set_name, each.elements, each.touching, _depth(each), each.reaction) for each in found
    ]
    if len(found) > 1 or any(each.law == "nodal" for each in found):
        sums = (sum(each.elements for each in found), sum(each.touching for each in found))
        deepest = max((each for each in found if each.deepest is not None), key=_by_depth, default=found[0])
        rows.append(("total", "", *sums, _depth(deepest), _known(reaction(evaluation, part.result.step(0)))))
    depth, force = headed("largest\ndepth", names.length), headed("total\nreaction", names.force)
    columns = ("law", "set", "elements", "in\ncontact", depth, force)
    printer.table(_title(evaluation), columns, rows, left=("law", "set"))


def _known(reaction: float | None) -> Cell:
    return NOT_KNOWN if reaction is None or math.isnan(reaction) else reaction


def _by_depth(total: Total) -> float:
    return -math.inf if total.deepest is None else total.deepest


def _depth(total: Total) -> float | None:
    """The largest depth, where anything is in contact."""
    return total.deepest if total.touching else None


def _print_states(printer: Printer, evaluation: Evaluation, part: Part) -> None:
    """How many elements and nodes are in each state, where a law has states."""
    rows = states(evaluation, part.result.step(0))
    if rows:
        printer.table("States", ("law", "state", "count"), rows, left=("law", "state"))


def _print_steps(printer: Printer, screen: Screen) -> None:
    """Print a line for each step: of the elements, or of the nodes."""
    evaluation, rows = screen.evaluation, screen.steps.rows
    names = unit_names(evaluation.scene.units)
    which = "node" if screen.of_nodes else "element"
    depth, gap = headed("largest\ndepth", names.length), headed("smallest\ngap", names.length)
    largest, total = headed("largest\non a node", names.force), headed("total\nreaction", names.force)
    figures = (gap, largest, total) if screen.of_nodes else (depth, total)
    more = ("nodes\nslipping",) if screen.of_nodes else ("suction\nor hold", "nodes\nslipping")
    columns = (_time(names), "in\ncontact", f"first\n{which}", f"last\n{which}", *figures, *more)
    left = evaluation.steps - len(rows)
    note = f"{left} more steps: -v shows all, -o writes all" if left else ""
    printer.table(f"{_title(evaluation)}, {evaluation.steps} steps", columns, rows, optional=more, note=note)


def _print_peaks(printer: Printer, series: SeriesSummary) -> None:
    """The largest of all steps, also of those that are not listed."""
    evaluation, times, peaks = series.evaluation, series.evaluation.time, series.totals()
    names = unit_names(evaluation.scene.units)
    units = {
        "reaction": ("total reaction", names.force),
        "force": ("force of an element", names.line_force),
        "pull": ("suction force of an element", names.line_force),
        "touching": ("elements in contact", ""),
        "deepest": ("depth", names.length),
    }
    rows = []
    for key, (what, unit) in units.items():
        peak = peaks.get(key)
        if peak is not None and times is not None and not (key in {"force", "pull"} and peak.value == 0.0):
            rows.append((what, peak.value, unit, float(times[peak.step]), series.number(peak)))
    columns = ("largest", "value", "unit", _time(names), "element")
    printer.table("Over all steps", columns, rows, left=("largest", "unit"))


_SHOWN_POINTS = 3
"""Touchdown points that a cell shows."""


def _print_lines(printer: Printer, screen: Screen) -> None:
    """Print touchdown, largest forces, reaction and weight of lines, a row for each at each step."""
    evaluation, lines = screen.evaluation, screen.lines.rows
    names, timed = unit_names(evaluation.scene.units), evaluation.time is not None
    pulled = any(row.largest_uplift is not None for row in lines)
    rows = []
    for row in lines:
        push, pull = row.largest_force, row.largest_uplift
        cells: list[Cell] = [row.time] if timed else []
        cells += [row.line, _span(row.first_element, row.last_element), _touchdown(row), row.contact_length]
        cells += [None, ""] if push is None else [push.force, push.element]
        if pulled:
            cells += [None, ""] if pull is None else [pull.force, pull.element]
        rows.append((*cells, _known(row.reaction), row.submerged_weight, row.ratio))
    uplift = (headed("largest\nuplift", names.line_force), "element")
    columns = (
        *((_time(names),) if timed else ()),
        "line",
        "elements",
        headed("touchdown\nat", names.length),
        headed("length in\ncontact", names.length),
        headed("largest\nforce", names.line_force),
        "element",
        *(uplift if pulled else ()),
        headed("total\nreaction", names.force),
        headed("submerged\nweight", names.force),
        "ratio",
    )
    if not rows:
        return
    left = len(evaluation.lines) * evaluation.steps - len(rows)
    note = f"{left} more lines: -v shows all, -o writes all" if left else ""
    printer.table("Touchdown", columns, rows, left=("elements",), note=note)


def _touchdown(row: LineSummary) -> str:
    places = [point.arc_length for point in row.touchdown]
    return touchdown_words(places, row.contact_length, row.length, _SHOWN_POINTS)


def _print_extents(printer: Printer, series: SeriesSummary, most: int | None) -> None:
    """Print between which values touchdown, length in contact, forces and reaction of lines were."""
    evaluation, times = series.evaluation, series.evaluation.time
    names, lines = unit_names(evaluation.scene.units), evaluation.lines.tolist()
    figures = {
        "first": ("touchdown point", names.length),
        "last": ("last touchdown point", names.length),
        "contact_length": ("length in contact", names.length),
        "force": ("largest force", names.line_force),
        "uplift": ("uplift, negative", names.line_force),
        "reaction": ("total reaction", names.force),
    }
    found = {
        (line, name): (extremes.least[at], extremes.least_step[at], extremes.largest[at], extremes.largest_step[at])
        for at, line in enumerate(lines)
        for name in figures
        if (extremes := series.of("summary", name)).least_step[at] >= 0
    }
    if times is None or not found:
        return
    rows = []
    for (line, name), extent in found.items():
        if name == "last" and found.get((line, "first")) == extent:
            continue
        what, unit = figures[name]
        if name == "first" and found.get((line, "last"), extent) != extent:
            what = f"first {what}"
        least, low, largest, high = extent
        number = (line + 1,) if len(lines) > 1 else ()
        rows.append((*number, what, unit, float(least), float(times[low]), float(largest), float(times[high])))
    columns: Cells = ("figure", "unit", "least", _time(names), "largest", _time(names))
    if len(lines) > 1:
        columns = ("line", *columns)
    left = len(rows) - len(rows[:most])
    note = f"{left} more rows: -v shows all" if left else ""
    printer.table("Lines over all steps", columns, rows[:most], left=("figure", "unit"), note=note)


def _time(names: UnitNames) -> str:
    return "time\n[s]" if names.length else "time"


def _title(evaluation: Evaluation) -> str:
    deck = evaluation.scene.deck
    return f"Contact of {deck.source or deck.file} ({deck.units} units)"


# ----------------------------------------------------------------------------------------------- rows of one state


def _touching_elements(evaluation: Evaluation, part: Part) -> tuple[Cells, Iterator[Cells]]:
    """Elements in contact, or with a force above the seabed, at the first step of a part."""
    names = unit_names(evaluation.scene.units)
    columns: Cells = (
        "element",
        "law",
        headed("depth", names.length),
        "ratio",
        headed("force", names.line_force),
        headed("stiffness", names.stiffness),
        headed("length", names.length),
    )
    result, chosen = part.result.step(0), evaluation.elements
    held = np.flatnonzero(result.contact[chosen] | (np.nan_to_num(result.force[chosen]) != 0.0))
    index = chosen[held]
    law = next(column for column in evaluation.element_table().columns(part) if column.name == "law")
    cells = [
        [str(number) for number in evaluation.scene.element_ids[index].tolist()],
        [law.names[code] or "" for code in law.cut(0, 1)[0, held].tolist()],
        *(_numbers(column, index) for column in (result.depth, result.ratio, result.force, result.stiffness)),
        _numbers(evaluation.length, index),
    ]
    if result.state is not None:
        columns = (*columns, "state")
        cells.append([STATES[code] or "" for code in result.state[index].tolist()])
    return columns, zip(*cells, strict=True)


def _touching_nodes(evaluation: Evaluation, part: Part) -> tuple[Cells, Iterator[Cells]]:
    """Nodes on which the seabed acts, also by restraining them, at the first step of a part."""
    names = unit_names(evaluation.scene.units)
    axes = (headed(f"reaction {axis}", names.force) for axis in "XYZ")
    columns: Cells = ("node", headed("gap", names.length), *axes)
    result = part.result.step(0)
    index = acted_on(evaluation, result)
    cells = [
        [str(number) for number in evaluation.scene.node_ids[index].tolist()],
        *(_numbers(column, index) for column in (result.gap, *result.reaction.T)),
    ]
    if result.friction is not None:
        columns = (*columns, headed("axial\nforce", names.force), headed("lateral\nforce", names.force))
        cells += [_numbers(column, index) for column in result.friction.T]
    if result.friction_state is not None:
        columns = (*columns, "axial", "lateral")
        cells += [[SLIDING[code] or "" for code in column[index].tolist()] for column in result.friction_state.T]
    return columns, zip(*cells, strict=True)


def _numbers(column: Floats, index: Indices) -> list[str]:
    return [shown(value) for value in column[index].tolist()]


# ------------------------------------------------------------------------------------------------------ comparison


def print_comparison(comparison: Comparison, view: View) -> None:
    """Print for each column how many values were compared, the largest differences and where they are."""
    timed = comparison.timed
    place = ("at\nelement", "at\ntime") if timed else ("at\nelement",)
    columns = ("column", "compared", "largest\ndifference", *place, "largest\nrelative", *place, "rms\ndifference")
    rows = []
    for found in comparison.differences:
        row = found.row()
        absolute = _cells(row["largest_difference"], "difference", timed=timed)
        relative = _cells(row["largest_relative"], "relative", timed=timed)
        rows.append((found.column, found.compared, *absolute, *relative, shown(found.rms, 4)))
    view.printer().table(f"Compared with {comparison.reference.file}", columns, rows, left=("column",))


def _cells(extreme: dict[str, Any] | None, name: str, *, timed: bool) -> tuple[Cell, ...]:
    """Value, element and time of a largest difference; nothing where nothing was compared."""
    if extreme is None:
        return ("",) * (2 + timed)
    cells = (shown(extreme[name], 4), extreme["element"])
    return (*cells, extreme["time"]) if timed else cells
