"""An evaluation for people: totals by set, then the elements or nodes in contact."""

from __future__ import annotations

import numpy as np
from rich.table import Table
from rich.text import Text

from mudline.cli.console import console
from mudline.cli.tables import table
from mudline.contact import Plan
from mudline.results.evaluation import Evaluation
from mudline.results.numbers import shown
from mudline.results.tables import Row, element_rows, node_rows

_ELEMENT = ("element", "set", "law", "depth", "ratio", "force", "stiffness", "length")
_NODE = ("node", "gap", "reaction X", "reaction Y", "reaction Z")


def print_plan(plan: Plan, color: str) -> None:
    """The stages, active or not, and why."""
    rows = [(stage.stage, "yes" if stage.active else "no", stage.why) for stage in plan]
    columns = ("stage", "active", "why")
    console(color).print(table(f"Plan ({plan.steps})", columns, rows, left=columns))


def print_evaluation(evaluation: Evaluation, which: str, color: str, most: int | None) -> None:
    """One state: totals and rows. Time steps: a line each, rows are for files."""
    printer = console(color)
    units = evaluation.scene.units
    printer.print(Text(f"{units} units; force and stiffness per unit length", style="dim"))
    if evaluation.time is not None:
        printer.print(_steps(evaluation, evaluation.time.tolist()))
        return
    printer.print(_totals(evaluation))
    rows = _element_rows(evaluation) if which == "elements" else _node_rows(evaluation)
    columns = _ELEMENT if which == "elements" else _NODE
    title = f"{which.capitalize()} in contact"
    printer.print(table(title, columns, rows[:most], left=("set", "law")))
    if most is not None and len(rows) > most:
        printer.print(Text(f"{len(rows) - most} more in contact: -v shows all, -o writes all"))


def _element_rows(evaluation: Evaluation) -> list[tuple[str, ...]]:
    return [
        (
            str(row["element"]),
            row["set"] or "",
            row["law"],
            *(shown(row[name]) for name in ("depth", "ratio", "force", "stiffness", "length")),
        )
        for row in element_rows(evaluation, 0)
        if row["contact"]
    ]


def _node_rows(evaluation: Evaluation) -> list[tuple[str, ...]]:
    def touched(row: Row) -> bool:
        return any(row["reaction"])

    return [
        (str(row["node"]), shown(row["gap"]), *(shown(value) for value in row["reaction"]))
        for row in node_rows(evaluation, 0)
        if touched(row)
    ]


def _totals(evaluation: Evaluation) -> Table:
    """By law and set: elements, those in contact, the deepest, the total reaction."""
    scene, result = evaluation.scene, evaluation.result.step(0)
    groups: dict[tuple[str, str], list[int]] = {}
    for index in np.flatnonzero(result.evaluated).tolist():
        groups.setdefault((scene.law_names[index], scene.law_sets[index] or ""), []).append(index)
    rows = []
    for (law, name), members in groups.items():
        touching = [index for index in members if result.contact[index]]
        reaction = float((result.force[members] * scene.length[members]).sum())
        deepest = float(result.depth[members].max())
        rows.append((law, name, str(len(members)), str(len(touching)), shown(deepest), shown(reaction)))
    columns = ("law", "set", "elements", "in contact", "largest depth", "total reaction")
    return table(f"Contact of {scene.deck.source or scene.deck.file}", columns, rows, left=("law", "set"))


def _steps(evaluation: Evaluation, times: list[float]) -> Table:
    scene, result = evaluation.scene, evaluation.result
    rows = []
    for step, time in enumerate(times):
        touching = np.flatnonzero(result.contact[step] & result.evaluated)
        reaction = float(np.nansum(result.force[step] * scene.length))
        first, last = (str(scene.element_ids[touching[i]]) if touching.size else "" for i in (0, -1))
        deepest = float(np.nanmax(result.depth[step])) if result.evaluated.any() else None
        rows.append((shown(time), str(touching.size), first, last, shown(deepest), shown(reaction)))
    columns = ("time", "in contact", "first element", "last element", "largest depth", "total reaction")
    return table(f"Contact of {scene.deck.source or scene.deck.file}, {len(rows)} steps", columns, rows)
