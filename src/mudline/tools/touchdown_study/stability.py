"""Stability of a deck: its touchdown zone on stiffer and softer soils, what its curves do to a solver, its friction."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from mudline.basics.quantities import unit_names
from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.embedment import static_depth
from mudline.model.contact.input import LawKind
from mudline.model.curves import ForceCurve
from mudline.model.results.stage_times import Timer, seconds_per_step
from mudline.model.scene.force_curves import SceneCurve
from mudline.model.scene.load_case import OwnSteps
from mudline.model.scene.model import Scene
from mudline.model.scene.oscillation import line_of, oscillations
from mudline.tools.touchdown_study.beam import NotConvergedError
from mudline.tools.touchdown_study.zone import RAMP, Variant, Zone, jump, ramp, stiffest_factor

PERIODS, MOST_STEPS = 2, 12_000
STEPPED_SHARE = 16
"""Laws with a history take so many times as long: fewer cases are tried with them."""
_GROWN = 3.0
"""Of the moment at half of the step: a run with more is unstable."""
_SNAP = 0.01
"""Diameters within which a falling curve has several rest positions."""
_FALL = 0.01
"""Of the weight of the pipe: smaller falls are none."""
_SAMPLED = 64


class ExtremeRow(NamedTuple):
    """A stiff or extreme case: how it went at the deck's step, and what half of it changes."""

    case: str
    converged: bool
    iterations: int | None = None
    searches: int | None = None
    range_change: float | None = None
    force_change: float | None = None
    message: str | None = None
    deck_line: int | None = None


class FrictionRow(NamedTuple):
    """Friction that sticks: period of a node on its spring, and the deck's steps in it."""

    set: str
    deck_line: int
    stick_period: float
    steps_per_period: float | None


class Evaluator(NamedTuple):
    """The evaluator itself: largest relative error of its curves, and seconds of a step of the deck."""

    error: float
    time: float


# ------------------------------------------------------------------------------------------------------------- extremes


def extreme_rows(zone: Zone, own: OwnSteps | None) -> tuple[list[ExtremeRow], list[str]]:
    """Return the stiff and extreme cases of a zone, and a sentence on those left out."""
    step = zone.motion.period / 100.0 if own is None else own.largest
    each = 3.0 * PERIODS * zone.motion.period / step
    budget = MOST_STEPS // (STEPPED_SHARE if zone.stepped else 1)
    cases = list(_cases(zone))
    tried = cases[: max(int(budget / each), 0)]
    rows = [_extreme(zone, name, variant, step) for name, variant in tried]
    left = ", ".join(name for name, _ in cases[len(tried) :])
    return rows, [f"Left out, as the deck's step is short: {left}."] if left else []


def _cases(zone: Zone) -> Iterator[tuple[str, Variant]]:
    """Names and variants, what stiffens most first."""
    for factor, name in ((1e3, "1e3"), (1e6, "1e6")):
        held = stiffest_factor(zone, factor)
        to = (
            f", to {held * zone.stiffness:.1g}{unit_names(zone.scene.units).behind('stiffness')}"
            if held < factor
            else ""
        )
        yield f"soil x {name}{to}", Variant(factor=held)
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
    """An element of each normal law of the deck that is per unit length."""
    scene = zone.scene
    kinds = np.isin(scene.law, (LawKind.NONE, LawKind.RIGID, LawKind.NODAL))
    rows = np.flatnonzero(~kinds & np.isfinite(scene.diameter))
    stiffness = np.nan_to_num(scene.law_arrays().linear_stiffness)
    keys = {(scene.law_names[at], float(stiffness[at])): at for at in rows.tolist()[::-1]}
    return np.array(sorted(keys.values()), np.intp)


def _extreme(zone: Zone, name: str, variant: Variant, step: float) -> ExtremeRow:
    """One case."""
    steps = max(round(PERIODS * zone.motion.period * variant.period / step), 8)
    try:
        whole = zone.run(steps, variant, PERIODS)
        half = zone.run(2 * steps, variant, PERIODS)
    except NotConvergedError:
        line = jump_line(zone)
        message, where = line or ("no equilibrium was found", None)
        return ExtremeRow(name, converged=False, message=message, deck_line=where)
    low, high = sorted((whole.largest_moment, half.largest_moment))
    stable = high <= _GROWN * low
    return ExtremeRow(
        name,
        stable,
        whole.run.most_iterations,
        whole.run.searches,
        change(whole.moment_range, half.moment_range),
        change(whole.largest_force, half.largest_force),
        None if stable else "unstable: the moments of the two steps differ by over 3 times",
    )


def change(value: float, reference: float) -> float:
    """Return the relative change of a value; 0 against nothing."""
    return value / reference - 1.0 if reference > 0.0 else 0.0


# --------------------------------------------------------------------------------------------------------------- curves


def _curves_in_use(scene: Scene, given: ContactInput) -> Iterator[tuple[SceneCurve, ForceCurve, float, float]]:
    """The curves that elements follow, with the diameter and the submerged weight of the first of these elements."""
    for index, entry in enumerate(scene.laws.curves):
        granted = np.array([grant.curve == index for grant in scene.laws.set_laws] + [False])[scene.laws.of_element]
        rows = np.flatnonzero(granted & (scene.law == LawKind.CURVE))
        if entry.curve is not None and rows.size:
            at = int(rows[0])
            weight = math.nan if given.weight is None else float(given.weight[at])
            yield entry, entry.curve, float(given.diameter[at]), weight


def jump_line(zone: Zone) -> tuple[str, int] | None:
    """Return the sentence on a curve of a deck whose force jumps at the mudline, and its line; None without one."""
    for entry, curve, _, _ in _curves_in_use(zone.scene, zone.given):
        if force := jump(curve, zone.beam.weight):
            line = line_of(zone.scene, entry.where)
            unit = unit_names(zone.scene.units).behind("line_force")
            return f"line {line}: the force jumps to {force:.4g}{unit} at the mudline", line
    return None


def snapping(scene: Scene, given: ContactInput) -> str:
    """Return the sentence that refuses a curve which falls so fast that the rest position is not unique, or ""."""
    units = unit_names(scene.units)
    for entry, curve, diameter, weight in _curves_in_use(scene, given):
        used = ramp(curve) if jump(curve, weight) else curve
        widths, drops = np.diff(used.ratios), -np.diff(used.forces)
        snaps = np.flatnonzero((widths <= _SNAP) & (drops > _FALL * abs(weight)) & (used.ratios[:-1] >= 0.0))
        if snaps.size:
            at = int(snaps[0])
            high, low = used.forces[at : at + 2].tolist()
            where = _line_of_point(scene, entry, float(used.ratios[at]))
            return (
                f"line {where}: curve {entry.name} falls from {high:.4g} to {low:.4g}{units.behind('line_force')} "
                f"within {widths[at] * diameter:.3g}{units.behind('length')}: the rest position is not unique"
            )
    return ""


def _line_of_point(scene: Scene, entry: SceneCurve, ratio: float) -> int:
    """Line of the point of a curve at a ratio, else of the curve."""
    at = np.flatnonzero(entry.points[:, 0] == ratio)
    return line_of(scene, entry.point(int(at[0])) if at.size else entry.where)


def curve_notes(scene: Scene, given: ContactInput) -> list[str]:
    """Return sentences on curves that jump at the mudline, and on those that fall, with the stiffness a line needs."""
    found, units = [], unit_names(scene.units)
    for entry, curve, diameter, weight in _curves_in_use(scene, given):
        if force := jump(curve, weight):
            line = line_of(scene, entry.where)
            text = f"the force jumps to {force:.4g}{units.behind('line_force')} at the mudline"
            found.append(f"Line {line}: {text}: a ramp over {RAMP} D takes its place.")
        inside = (curve.slopes < 0.0) & (curve.ratios[1:] > 0.0)
        if inside.any():
            at = int(np.argmin(np.where(inside, curve.slopes, 0.0)))
            line = _line_of_point(scene, entry, float(curve.ratios[at]))
            stiffness = float(curve.slopes[at]) / diameter
            found.append(
                f"Line {line}: curve {entry.name} falls from {curve.forces[at]:.4g} to {curve.forces[at + 1]:.4g}"
                f"{units.behind('line_force')}: a stiffness of {stiffness:.4g}{units.behind('stiffness')} that "
                "the line has to carry."
            )
    return found


# ------------------------------------------------------------------------------------------------------------- friction


def friction_rows(scene: Scene, given: ContactInput, own: OwnSteps | None) -> list[FrictionRow]:
    """Return the period 2 pi sqrt(m l/Kt) of a node that sticks, for each block that gives friction."""
    rows = []
    for one in oscillations(scene, given).found:
        if one.kind == "friction" and one.omega > 0.0:
            period = 2.0 * math.pi / one.omega
            name = one.name.removeprefix("friction on ")
            steps = None if own is None else period / own.largest
            rows.append(FrictionRow(name, line_of(scene, one.where), period, steps))
    return rows


def axial_period(zone: Zone) -> float | None:
    """Return the time l sqrt(m/EA) in which an axial wave passes the element at the touchdown; None without EA."""
    axial, mass = float(zone.pipe.axial[zone.own]), float(zone.pipe.mass[zone.own] + zone.pipe.contents[zone.own])
    if not (axial > 0.0 and mass > 0.0):
        return None
    return float(zone.given.length[zone.own]) * math.sqrt(mass / axial)


# ------------------------------------------------------------------------------------------------------------ evaluator


def evaluator_row(given: ContactInput, timer: Timer) -> Evaluator | None:
    """Return the largest error of the curves against rationals, and the seconds of a step; None if it overflows."""
    taken = seconds_per_step({"": ContactModel(given, backend="numpy")}, timer)
    if not taken:
        return None
    errors = [_error(curve) for curve in given.curves]
    return Evaluator(max(errors, default=float(np.finfo(np.float64).eps)), taken[""])


def _error(curve: ForceCurve) -> float:
    """The largest relative error of a curve between its points."""
    last = float(curve.ratios[-1])
    ratios = np.linspace(0.0, last if last > 0.0 else 1.0, _SAMPLED)
    forces, worst = curve.evaluate(ratios)[0], 0.0
    points = [(Fraction(float(r)), Fraction(float(f))) for r, f in zip(curve.ratios, curve.forces, strict=True)]
    for ratio, force in zip(ratios.tolist(), forces.tolist(), strict=True):
        at = min(max(int(np.searchsorted(curve.ratios, ratio, side="right")) - 1, 0), len(points) - 2)
        (r0, f0), (r1, f1) = points[at : at + 2]
        exact = f0 + (f1 - f0) / (r1 - r0) * (Fraction(ratio) - r0)
        if exact:
            worst = max(worst, abs(float((Fraction(force) - exact) / exact)))
    return worst
