"""Stability of a deck: its touchdown zone on stiffer and softer soils, curves that hinder a solver, friction."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mudline.basics.units import UNITS
from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.input import LawKind
from mudline.model.contact.stretch import static_depth
from mudline.model.curves import ForceCurve
from mudline.model.results.stage_times import Timer, seconds_per_step
from mudline.model.scene.curves import SceneCurve
from mudline.model.scene.load_case import OwnSteps
from mudline.model.scene.model import Scene
from mudline.model.scene.oscillation import oscillations
from mudline.tools.touchdown_study.beam import NotConvergedError
from mudline.tools.touchdown_study.zone import RAMP, Measures, Variant, Zone, jump, ramp

PERIODS, MOST_STEPS = 2, 12_000
_LEAST = 100.0
"""Steps of a period up to which a deck's step may be lengthened, so that its cases can be run."""
_LARGE = 1e9
"""Stiffness in N/m2 up to which a soil is made stiffer."""
_GROWN = 3.0
"""Ratio of moment, range or force to those of another run above which a run is unstable."""
_SNAP = 0.01
"""Diameters within which a falling curve has several rest positions."""
_FALL = 0.01
"""Share of the pipe's weight below which a fall is ignored."""


class ExtremeRow(NamedTuple):
    """A stiff or extreme case: the course of the run at a step, and the changes with half of it."""

    case: str
    step: float
    converged: bool
    iterations: int | None = None
    searches: int | None = None
    range_change: float | None = None
    force_change: float | None = None
    message: str | None = None
    deck_line: int | None = None


class FrictionRow(NamedTuple):
    """Friction that sticks: period of a node on its spring, and the deck's steps per period."""

    set: str
    deck_line: int
    stick_period: float
    steps_per_period: float | None


class EvaluatorCost(NamedTuple):
    """Accuracy and cost of the evaluator: bound of the relative error of a force, and seconds of a step of the deck."""

    error: float
    time: float


# ------------------------------------------------------------------------------------------------------------- extremes


def extreme_rows(zone: Zone, own: OwnSteps | None) -> tuple[list[ExtremeRow], list[str]]:
    """Return the stiff and extreme cases of a zone, and a sentence on those left out.

    They are run at the deck's step, or at longer steps if that takes too long.
    """
    period, cases = zone.motion.period, list(_cases(zone))
    step = period / _LEAST if own is None else own.largest
    budget = MOST_STEPS / (3.0 * PERIODS * period * zone.cost)
    while step <= period / _LEAST and len(cases) > budget * step:
        step *= 2.0
    tried = cases[: max(int(budget * step), 1)]
    left = ", ".join(name for name, _ in cases[len(tried) :])
    notes = [f"Left out, as the deck's step is short: {left}."] if left else []
    return [_extreme(zone, name, variant, step) for name, variant in tried], notes


def _cases(zone: Zone) -> Iterator[tuple[str, Variant]]:
    """Yield names and variants, the stiffest first."""
    most = (_LARGE / 47.88 if zone.scene.units == "imperial" else _LARGE) / zone.stiffness
    unit, last = UNITS[zone.scene.units].behind("F/L2"), 1.0
    for factor, name in ((1e3, "1e3"), (1e6, "1e6")):
        held = min(factor, most)
        if held > last:
            to = f", to {held * zone.stiffness:.1g}{unit}".replace("e+0", "e") if held < factor else ""
            yield f"soil x {name}{to}", Variant(factor=held)
            last = held
    yield "period x 0.5", Variant(period=0.5)
    yield "soil x 0.01", Variant(factor=0.01)
    laws = _law_elements(zone)
    if len(laws) > 1:
        depths = static_depth(zone.given, laws, np.full(len(laws), zone.beam.weight))
        usable = np.isfinite(depths) & (depths > 0.0)
        names = zone.scene.law_names
        for word, at in (("steepest", np.nanargmin), ("softest", np.nanargmax)):
            if usable.any():
                element = int(laws[at(np.where(usable, depths, np.nan))])
                yield f"{word} law everywhere, {names[element].removeprefix('curve:')}", Variant(law_of=element)


def _law_elements(zone: Zone) -> np.ndarray:
    """Return an element of each normal law per unit length of the deck."""
    scene = zone.scene
    kinds = np.isin(scene.law, (LawKind.NONE, LawKind.RIGID, LawKind.NODAL))
    rows = np.flatnonzero(~kinds & np.isfinite(scene.diameter))
    stiffness = np.nan_to_num(scene.law_arrays().linear_stiffness)
    keys = {(scene.law_names[at], float(stiffness[at])): at for at in rows.tolist()[::-1]}
    return np.array(sorted(keys.values()), np.intp)


def _extreme(zone: Zone, name: str, variant: Variant, step: float) -> ExtremeRow:
    """Return the result of one case."""
    steps = max(round(PERIODS * zone.motion.period * variant.period / step), 8)
    try:
        whole, run = zone.run(steps, PERIODS, variant)
        half, _ = zone.run(2 * steps, PERIODS, variant)
    except NotConvergedError as error:
        where = next((line for line, _ in _jumps(zone.scene, zone.given)), None)
        message = str(error) if where is None else f"{error}: see the jump at line {where}"
        return ExtremeRow(name, step, converged=False, message=message, deck_line=where)
    stable = not (unstable(whole, half) or unstable(half, whole))
    changes = change(whole.moment_range, half.moment_range), change(whole.largest_force, half.largest_force)
    why = None if stable else "unstable: the two steps differ by over 3 times"
    return ExtremeRow(name, step, stable, run.most_iterations, run.searches, *changes, why)


def unstable(tried: Measures, reference: Measures) -> bool:
    """Return True if forces or moments of a run exceed those of another so far that it must be unstable."""
    names = ("largest_moment", "moment_range", "largest_force")
    return any(getattr(tried, name) > _GROWN * getattr(reference, name) for name in names)


def change(value: float, reference: float) -> float:
    """Return the relative change of a value; 0 if the reference is 0."""
    return value / reference - 1.0 if reference > 0.0 else 0.0


# --------------------------------------------------------------------------------------------------------------- curves


def _curves_in_use(scene: Scene, given: ContactInput) -> Iterator[tuple[SceneCurve, ForceCurve, float, float]]:
    """Yield the curves that elements follow, with diameter and submerged weight of the first of these elements."""
    for index, entry in enumerate(scene.laws.curves):
        rows = scene.followers(index)
        if entry.curve is not None and rows.size:
            at = int(rows[0])
            weight = math.nan if given.weight is None else float(given.weight[at])
            yield entry, entry.curve, float(given.diameter[at]), weight


def _jumps(scene: Scene, given: ContactInput) -> Iterator[tuple[int, float]]:
    """Yield the lines of curves in use whose force jumps at the mudline, and that force."""
    for entry, curve, _, weight in _curves_in_use(scene, given):
        if force := jump(curve, weight):
            yield scene.line_of(entry.where), force


def snapping(scene: Scene, given: ContactInput) -> str:
    """Return a sentence on a curve that falls so fast that the rest position is not unique, or ""."""
    system = UNITS[scene.units]
    for entry, curve, diameter, weight in _curves_in_use(scene, given):
        used = ramp(curve) if jump(curve, weight) else curve
        widths, drops = np.diff(used.ratios), -np.diff(used.forces)
        snaps = np.flatnonzero((widths <= _SNAP) & (drops > _FALL * abs(weight)) & (used.ratios[:-1] >= 0.0))
        if snaps.size:
            at = int(snaps[0])
            high, low = used.forces[at : at + 2].tolist()
            where = _line_of_point(scene, entry, float(used.ratios[at]))
            return (
                f"line {where}: curve {entry.name} falls from {high:.4g} to {low:.4g}{system.behind('F/L')} "
                f"within {widths[at] * diameter:.3g}{system.behind('L')}: the rest position is not unique"
            )
    return ""


def _line_of_point(scene: Scene, entry: SceneCurve, ratio: float) -> int:
    """Return the line of the point of a curve at a ratio, else of the curve."""
    at = np.flatnonzero(entry.points[:, 0] == ratio)
    return scene.line_of(entry.point(int(at[0])) if at.size else entry.where)


def curve_notes(scene: Scene, given: ContactInput) -> list[str]:
    """Return sentences on curves that jump at the mudline, and on falling curves with the stiffness of the fall."""
    system = UNITS[scene.units]
    remarks = [
        f"Line {line}: the force jumps to {force:.4g}{system.behind('F/L')} at the mudline: a ramp over {RAMP} D "
        "replaces it."
        for line, force in _jumps(scene, given)
    ]
    for entry, curve, diameter, _ in _curves_in_use(scene, given):
        inside = (curve.slopes < 0.0) & (curve.ratios[1:] > 0.0)
        if inside.any():
            at = int(np.argmin(np.where(inside, curve.slopes, 0.0)))
            line = _line_of_point(scene, entry, float(curve.ratios[at]))
            stiffness = float(f"{float(curve.slopes[at]) / diameter:.4g}")
            falls = f"{curve.forces[at]:.4g} to {curve.forces[at + 1]:.4g}{system.behind('F/L')}"
            carried = f"a stiffness of {stiffness:,.15g}{system.behind('F/L2')} that the line has to carry"
            remarks.append(f"Line {line}: curve {entry.name} falls from {falls}: {carried}.")
    return remarks


# ------------------------------------------------------------------------------------------------------------- friction


def friction_rows(scene: Scene, given: ContactInput, own: OwnSteps | None) -> Iterator[FrictionRow]:
    """Yield the period 2 pi sqrt(m l/Kt) of a sticking node, for each block that gives friction."""
    for oscillation in oscillations(scene, given).found:
        if oscillation.kind == "friction" and oscillation.omega > 0.0:
            period = 2.0 * math.pi / oscillation.omega
            steps = None if own is None else period / own.largest
            name, line = oscillation.name.removeprefix("friction on "), scene.line_of(oscillation.where)
            yield FrictionRow(name, line, period, steps)


def axial_period(zone: Zone) -> float | None:
    """Return the time l sqrt(m/EA) of an axial wave through the element at the touchdown; None without EA."""
    axial, mass = float(zone.pipe.axial[zone.own]), float(zone.pipe.mass[zone.own] + zone.pipe.contents[zone.own])
    if not (axial > 0.0 and mass > 0.0):
        return None
    return float(zone.given.length[zone.own]) * math.sqrt(mass / axial)


# ------------------------------------------------------------------------------------------------------------ evaluator


def evaluator_row(given: ContactInput, timer: Timer) -> EvaluatorCost | None:
    """Return the error bound of a curve's force, and the seconds of a step; None if a step overflows."""
    taken = seconds_per_step({"": ContactModel(given, backend="numpy")}, timer)
    return EvaluatorCost(4.0 * float(np.finfo(np.float64).eps), taken[""]) if taken else None
