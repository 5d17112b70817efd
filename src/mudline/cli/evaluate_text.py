"""An evaluation for people: totals by law, then the elements or nodes in contact."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from rich.console import Console

from mudline.cli.console import console
from mudline.cli.evaluate_rows import LEFT, Cells, touching_elements, touching_nodes
from mudline.cli.options import View
from mudline.cli.tables import print_table
from mudline.contact import Plan
from mudline.results.evaluation import Evaluation, Part
from mudline.results.quantities import SLIDING, STATES, UnitNames, headed, shown, unit_names
from mudline.results.totals import Digest, Total, counts, reaction, totals


def print_plan(plan: Plan, view: View) -> None:
    """The stages, active or not, and why."""
    rows = [(stage.stage, "yes" if stage.active else "no", stage.why) for stage in plan]
    columns = ("stage", "active", "why")
    print_table(console(view.color), f"Plan, {plan.steps}", columns, rows, left=columns)


def print_evaluation(digest: Digest, which: str, view: View) -> None:
    """One state: totals and rows. Time steps: a line each, rows are for files."""
    printer = console(view.color)
    if digest.evaluation.time is not None:
        _print_steps(printer, digest)
        return
    if digest.first is None:
        return
    _print_totals(printer, digest.evaluation, digest.first)
    _print_states(printer, digest.evaluation, digest.first)
    rows = touching_elements if which == "elements" else touching_nodes
    columns, cells = rows(digest.evaluation, digest.first)
    told = list(cells if view.verbose else _joined(cells))
    if not told:
        printer.print(f"No {which} in contact", highlight=False)
        return
    left = len(told) - len(told[: digest.most])
    note = f"{left} more lines: -v shows all, -o writes all" if left else ""
    print_table(printer, f"{which.capitalize()} in contact", columns, told[: digest.most], left=LEFT, note=note)


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


def _print_totals(printer: Console, evaluation: Evaluation, part: Part) -> None:
    names = unit_names(evaluation.scene.units)
    found = totals(evaluation, part)
    rows: list[Cells] = [
        (each.law, each.set_name, str(each.elements), str(each.touching), _depth(each), shown(each.reaction))
        for each in found
    ]
    if len(found) > 1 or any(each.law == "nodal" for each in found):
        sums = (sum(each.elements for each in found), sum(each.touching for each in found))
        deepest = max((each for each in found if each.deepest is not None), key=_by_depth, default=found[0])
        total = shown(reaction(evaluation, part.result.step(0)))
        rows.append(("total", "", *map(str, sums), _depth(deepest), total))
    depth, force = headed("largest\ndepth", names.length), headed("total\nreaction", names.force)
    columns = ("law", "set", "elements", "in\ncontact", depth, force)
    print_table(printer, _title(evaluation), columns, rows, left=("law", "set"))


def _by_depth(total: Total) -> float:
    return -math.inf if total.deepest is None else total.deepest


def _depth(total: Total) -> str:
    """The largest depth, where anything is in contact."""
    return shown(total.deepest) if total.touching else ""


def _print_states(printer: Console, evaluation: Evaluation, part: Part) -> None:
    """How many elements and nodes are in each state, where a law has states."""
    result = part.result.step(0)
    rows: list[Cells] = []
    if result.state is not None:
        found = counts(result.state[evaluation.elements], STATES)
        rows += [("suction of elements", name, str(count)) for name, count in found]
    if result.friction_state is not None:
        for axis, direction in enumerate(("axial", "lateral")):
            found = counts(result.friction_state[evaluation.nodes, axis], SLIDING)
            rows += [(f"{direction} friction of nodes", name, str(count)) for name, count in found]
    if result.restrained is not None:
        rows.append(("rigid bed", "restrained nodes", str(int(result.restrained.sum()))))
    if rows:
        print_table(printer, "States", ("law", "state", "count"), rows, left=("law", "state"))


def _print_steps(printer: Console, digest: Digest) -> None:
    evaluation, found = digest.evaluation, digest.steps
    names = unit_names(evaluation.scene.units)
    sucked, slipping = (any(getattr(each, name) is not None for each in found) for name in ("sucked", "slipping"))
    rows = [
        (
            shown(each.time),
            str(each.touching),
            *("" if number is None else str(number) for number in (each.first, each.last)),
            shown(each.deepest),
            shown(each.reaction),
            *([str(each.sucked)] if sucked else []),
            *([str(each.slipping)] if slipping else []),
        )
        for each in found
    ]
    depth, force = headed("largest\ndepth", names.length), headed("total\nreaction", names.force)
    columns = (_time(names), "in\ncontact", "first\nelement", "last\nelement", depth, force)
    more = (*(["suction\nor hold"] if sucked else []), *(["nodes\nslipping"] if slipping else []))
    left = evaluation.steps - len(found)
    note = f"{left} more steps: -v shows all, -o writes all" if left else ""
    print_table(printer, f"{_title(evaluation)}, {evaluation.steps} steps", (*columns, *more), rows, note=note)
    _print_peaks(printer, digest)


def _print_peaks(printer: Console, digest: Digest) -> None:
    """The largest of all steps, also of those that are not listed."""
    evaluation, times = digest.evaluation, digest.evaluation.time
    names = unit_names(evaluation.scene.units)
    units = {
        "reaction": ("total reaction", names.force),
        "force": ("force of an element", names.line_force),
        "pull": ("pull on an element", names.line_force),
        "touching": ("elements in contact", ""),
        "deepest": ("depth", names.length),
    }
    rows = []
    for key, (what, unit) in units.items():
        peak = digest.peaks.found.get(key)
        if peak is not None and times is not None and not (key in {"force", "pull"} and peak.value == 0.0):
            element = "" if peak.element is None else str(peak.element)
            rows.append((what, shown(peak.value), unit, shown(float(times[peak.step])), element))
    columns = ("largest", "value", "unit", _time(names), "element")
    print_table(printer, "Over all steps", columns, rows, left=("largest", "unit"))


def _time(names: UnitNames) -> str:
    return "time\n[s]" if names.length else "time"


def _title(evaluation: Evaluation) -> str:
    deck = evaluation.scene.deck
    return f"Contact of {deck.source or deck.file} ({deck.units} units)"
