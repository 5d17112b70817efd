"""Study of a deck for people: sentences and tables for a terminal and a page."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.basics.display import DisplayTable, number, text
from mudline.basics.quantities import shown
from mudline.basics.short_repr import cut
from mudline.basics.units import UNITS
from mudline.model.results.stage_times import StageRow
from mudline.model.results.summary_tables import weight_note
from mudline.model.scene.load_case import in_words
from mudline.tools.touchdown_study.accuracy import StepRow
from mudline.tools.touchdown_study.stability import axial_period
from mudline.tools.touchdown_study.study import Study
from mudline.tools.touchdown_study.zone import Zone

LIMITS = "One plane, small slopes, constant tension; loads are those of this model, only their errors are of use."
_NAME, _WHY = 44, 90
"""Columns of a case, and of the reason of a stage, which is wrapped."""
_DIGITS = 3
_KILO = 1e3
_CONSISTENT = "With the resistance integrated along each element the verdict is"


def description(result: Study) -> str:
    """Return a sentence on the zone, its motion, time integration, weight and mass; "" without a touchdown zone."""
    zone = result.zone
    if zone is None or "accuracy" not in result.parts:
        return ""
    system, length = UNITS[result.units], float(zone.beam.places[-1])
    law = zone.scene.law_names[zone.own].removeprefix("curve:")
    force = {"metric": f"{zone.beam.tension / _KILO:.3g} kN"}.get(result.units)
    force = force or f"{zone.beam.tension:,.0f}{system.behind('F')}"
    scheme, given = zone.scheme, f"line {zone.scheme_line}" if zone.scheme_line else "the program's default"
    own = scheme.alpha if scheme.rho is None else scheme.rho
    values = f"{scheme.alpha_f:.3g}, {scheme.alpha_m:.3g}" if own is None else f"{own:.3g}"
    masses = float(zone.pipe.mass[zone.own]), float(zone.pipe.contents[zone.own]), float(zone.pipe.added_mass[zone.own])
    named = zip(("pipe", "contents", "water"), masses, strict=True)
    parts = ", ".join(f"{name} {_short(mass)}" for name, mass in named)
    reference = "" if result.reference is None else f" Errors against {result.milliseconds(result.reference.step)}."
    assumed = "" if zone.pipe.has_coefficients[zone.own] else " (Cd and Ca 1, assumed)"
    return (
        f"Touchdown zone laid down and lifted: {length:.3g}{system.behind('L')} on {law} at {force}, "
        f"{_motion(zone, system.behind('L'))}, {scheme.name} ({values}, {given}). "
        f"{_weight(zone, system.behind('F/L'))} "
        f"Mass {_short(sum(masses))}{system.behind('M/L')}: {parts}{assumed}.{reference}"
    )


def _weight(zone: Zone, unit: str) -> str:
    """Return the submerged weight with contents, and empty if it differs."""
    filled, empty = (f"{shown(each, 4)}{unit}" for each in zone.weights[:2])
    weights = filled if filled == empty else f"{filled} with contents, {empty} empty"
    note = weight_note(zone.weights.without)
    return f"Submerged weight {weights}{f' ({note})' if note else ''}."


def _motion(zone: Zone, unit: str) -> str:
    motion = zone.motion
    where = f"{motion.source}, line {motion.line}" if motion.line else motion.source
    surge = f" and surging {in_words(motion.surge, unit)}" if motion.surge else ""
    seconds = "" if zone.scene.units == "user" else " s"
    return f"hang-off heaving {in_words(motion.heave, unit)}{surge} ({where}) in {motion.period:.4g}{seconds}"


def _short(value: float) -> str:
    return f"{value:.0f}" if value >= 100.0 or value == 0.0 else f"{value:.3g}"


def steps_table(result: Study) -> DisplayTable | None:
    """Return a row for each step, and one for the mesh; None without any."""
    if not result.steps:
        return None
    seconds = "ms" if result.milliseconds(1.0).endswith("ms") else ""
    length = UNITS[result.units].unit("L")
    columns = (
        text("step", 0, seconds),
        number("touch-\ndown rms", 1, length),
        number("of\ntravel", 2),
        number("range of\nmoment", 3),
        number("largest\nsoil force", 4),
        number("iterations\nmean", 5),
        number("\nmost", 6),
        number("run time", 7, f"{seconds} per s".strip()),
    )
    rows = [_step_cells(result, row) for row in result.steps]
    if result.mesh is not None:
        unit = UNITS[result.units].behind("L")
        own, half = result.mesh.element_length
        even = result.zone is None or bool(np.allclose(result.zone.beam.lengths[result.zone.landing], own, rtol=0.01))
        row = f"{own:.3g}{unit} -> {half:.3g}{unit}" if even else "elements halved"
        shares = result.mesh.changes or (None, None, None)
        rows.append([row, "", *(_share(each) for each in shares), "", "", ""])
    title = "Errors of the time step, and of the elements"
    verdict = None if result.mesh is None else result.mesh.consistent_verdict
    note = "" if verdict in (None, result.advice.verdict) else f"{_CONSISTENT}: {verdict}."
    return DisplayTable(title, columns, rows, note)


def _step_cells(result: Study, row: StepRow) -> list[str]:
    step = result.milliseconds(row.step).removesuffix(" ms") + (" (the deck)" if row.own else "")
    if row.errors is None:
        return [step, row.state, *[""] * 6]
    run_time = 0.0 if row.run_time is None else row.run_time * _KILO
    counts = ["", ""]
    if row.run is not None:
        counts = [f"{row.run.mean_iterations:.1f}", str(row.run.most_iterations)]
    rms = "" if row.rms is None else f"{row.rms:.2g}"
    return [step, rms, *(_share(each) for each in row.errors), *counts, f"{run_time:.2g}"]


def _share(value: float | None) -> str:
    """Return a share in percent with its sign, to two digits above one percent and one below."""
    if value is None:
        return ""
    percent = 100.0 * value
    return f"{shown(float(f'{percent:.1g}' if abs(percent) < 1.0 else f'{percent:.2g}'))} %"


def extremes_table(result: Study) -> DisplayTable | None:
    """Return a row for each stiff or extreme case; None without any."""
    if not result.extremes:
        return None
    columns = (
        text("case", lambda row: cut(row.case, _NAME)),
        text("result", lambda row: "converges" if row.converged else row.message or "does not converge"),
        number("iterations,\nmost", "iterations"),
        number("line\nsearches", "searches"),
        number("range of\nmoment", lambda row: _share(row.range_change)),
        number("largest\nsoil force", lambda row: _share(row.force_change)),
    )
    step = result.milliseconds(result.extremes[0].step)
    if result.own is not None and result.extremes[0].step > result.own.largest:
        step += f", as {result.milliseconds(result.own.largest)} would take long"
    return DisplayTable(f"Stiff and extreme: {step}, and what half of it changes", columns, result.extremes)


def stability_sentences(result: Study) -> Iterator[str]:
    """Yield sentences on friction and on the evaluator itself."""
    own = None if result.own is None else result.own.largest
    stiff = min(result.friction, key=lambda row: row.stick_period, default=None)
    if stiff is not None:
        period = result.milliseconds(float(f"{stiff.stick_period:.4g}"))
        friction = f"Axial friction, not in this model: a node that sticks swings in {period} (line {stiff.deck_line})"
        if own is not None:
            tenth = "within" if own <= 0.1 * stiff.stick_period else "more than"
            friction += f"; the deck's step is {tenth} a tenth of that"
        axial = None if result.zone is None else axial_period(result.zone)
        if axial:
            waves = f"Axial waves pass an element in {result.milliseconds(axial)}"
            friction += f". {waves}: no practical step resolves them, friction is quasi-static"
        yield f"{friction}."
    if result.evaluator is not None:
        yield (
            f"The evaluator itself: error {result.evaluator.error:.1g} of a force, "
            f"{_time(result.evaluator.time)} for a step of the deck."
        )


def stages_table(result: Study) -> DisplayTable | None:
    """Return a row for each stage of the evaluation; None if they were not measured."""
    pruning = result.stages
    if pruning is None:
        return None

    def without(row: StageRow) -> str:
        if row.cost_if_added is not None:
            return f"+ {_time(row.cost_if_added)} a node"
        optional = row.stage not in {"seabed surface", "normal law"} and row.time is not None
        return _time(pruning.step - row.time) if optional and row.time is not None else ""

    columns = (
        text("stage", "stage"),
        text("in", lambda row: "yes" if row.active else "no"),
        number("deck line", "deck_line"),
        number("share", lambda row: "" if row.share is None else f"{100.0 * row.share:.0f} %"),
        number("without it", without),
        text("why", lambda row: cut(row.why.partition(";")[0].partition(" (inferred)")[0], _WHY)),
    )
    title = f"What the deck needs: a step of {pruning.elements} elements takes {_time(pruning.step)}"
    return DisplayTable(title, columns, pruning.rows)


def _time(seconds: float) -> str:
    """Return a time with its unit, to three digits."""
    for scale, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "us")):
        if seconds * scale >= 1.0:
            return f"{shown(seconds * scale, _DIGITS)} {unit}"
    return f"{shown(seconds * 1e9, _DIGITS)} ns"


def sentences(result: Study, part: str) -> list[str]:
    """Return the sentences below the tables of a part."""
    remarks = list(result.notes.get(part, ()))
    if part == "accuracy" and result.zone is not None:
        remarks += [*result.zone.notes, LIMITS]
    return [*remarks, *stability_sentences(result)] if part == "stability" else remarks


TABLES = {"accuracy": steps_table, "stability": extremes_table, "pruning": stages_table}
"""Functions that make the table of a part."""
