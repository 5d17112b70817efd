"""An evaluation for people: totals by law, then the elements or nodes in contact."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from rich.console import Console

from mudline.cli.console import console
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.contact import Plan
from mudline.results.evaluation import Evaluation
from mudline.results.numbers import shown
from mudline.results.totals import Total, step_totals, totals
from mudline.results.units import headed, unit_names

MOST_ROWS = 40
_Cells = tuple[str, ...]


def print_plan(plan: Plan, view: View) -> None:
    """The stages, active or not, and why."""
    rows = [(stage.stage, "yes" if stage.active else "no", stage.why) for stage in plan]
    columns = ("stage", "active", "why")
    print_table(console(view.color), f"Plan, {plan.steps}", columns, rows, left=columns)


def print_evaluation(evaluation: Evaluation, which: str, view: View) -> None:
    """One state: totals and rows. Time steps: a line each, rows are for files."""
    printer = console(view.color)
    most = None if view.verbose else MOST_ROWS
    if evaluation.time is not None:
        _print_steps(printer, evaluation, most)
        return
    _print_totals(printer, evaluation)
    columns, rows = _elements(evaluation) if which == "elements" else _nodes(evaluation)
    told = list(rows if view.verbose else _joined(rows))
    left = len(told) - len(told[:most])
    note = f"{left} more lines: -v shows all, -o writes all" if left else ""
    print_table(printer, f"{which.capitalize()} in contact", columns, told[:most], left=("law",), note=note)


def _elements(evaluation: Evaluation) -> tuple[_Cells, Iterator[_Cells]]:
    names = unit_names(evaluation.scene.units)
    columns = (
        "element",
        "law",
        headed("depth", names.length),
        "ratio",
        headed("force", names.line_force),
        headed("stiffness", names.stiffness),
        headed("length", names.length),
    )
    scene, result = evaluation.scene, evaluation.result.step(0)
    laws = evaluation.law_names(0)
    touching = np.flatnonzero(result.contact[evaluation.elements])
    index = evaluation.elements[touching]
    numbers = (result.depth, result.ratio, result.force, result.stiffness, evaluation.length)
    return columns, zip(
        map(str, scene.element_ids[index].tolist()),
        [laws[i] for i in touching.tolist()],
        *([shown(value) for value in column[index].tolist()] for column in numbers),
        strict=True,
    )


def _nodes(evaluation: Evaluation) -> tuple[_Cells, Iterator[_Cells]]:
    names = unit_names(evaluation.scene.units)
    axes = (headed(f"reaction {axis}", names.force) for axis in "XYZ")
    columns = ("node", headed("gap", names.length), *axes)
    scene, result = evaluation.scene, evaluation.result.step(0)
    index = evaluation.nodes[(result.reaction[evaluation.nodes] != 0.0).any(axis=1)]
    numbers = (result.gap, *result.reaction.T)
    return columns, zip(
        map(str, scene.node_ids[index].tolist()),
        *([shown(value) for value in column[index].tolist()] for column in numbers),
        strict=True,
    )


def _joined(rows: Iterable[_Cells]) -> Iterator[_Cells]:
    """Rows that show the same, with numbers one after the other, as one row."""
    first = last = 0
    same: _Cells | None = None
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


def _print_totals(printer: Console, evaluation: Evaluation) -> None:
    names = unit_names(evaluation.scene.units)
    found = totals(evaluation)
    rows: list[_Cells] = [
        (each.law, each.set_name, str(each.elements), str(each.touching), _depth(each), shown(each.reaction))
        for each in found
    ]
    if len(found) > 1:
        sums = (sum(each.elements for each in found), sum(each.touching for each in found))
        reaction = shown(sum(each.reaction for each in found))
        rows.append(("total", "", *map(str, sums), _depth(max(found, key=lambda each: each.deepest)), reaction))
    depth, force = headed("largest\ndepth", names.length), headed("total\nreaction", names.force)
    columns = ("law", "set", "elements", "in\ncontact", depth, force)
    print_table(printer, _title(evaluation), columns, rows, left=("law", "set"))


def _depth(total: Total) -> str:
    """The largest depth, where anything is in contact."""
    return shown(total.deepest) if total.touching else ""


def _print_steps(printer: Console, evaluation: Evaluation, most: int | None) -> None:
    names = unit_names(evaluation.scene.units)
    found = step_totals(evaluation, most)
    rows = [
        (
            shown(each.time),
            str(each.touching),
            *("" if number is None else str(number) for number in (each.first, each.last)),
            shown(each.deepest),
            shown(each.reaction),
        )
        for each in found
    ]
    depth, force = headed("largest\ndepth", names.length), headed("total\nreaction", names.force)
    columns = ("time\n[s]" if names.length else "time", "in\ncontact", "first\nelement", "last\nelement", depth, force)
    left = evaluation.steps - len(found)
    note = f"{left} more steps: -v shows all, -o writes all" if left else ""
    print_table(printer, f"{_title(evaluation)}, {evaluation.steps} steps", columns, rows, note=note)


def _title(evaluation: Evaluation) -> str:
    deck = evaluation.scene.deck
    return f"Contact of {deck.source or deck.file} ({deck.units} units)"
