"""Study of a deck: error against run time of its touchdown zone, stiff and extreme cases, unnecessary stages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import takewhile
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from mudline.basics.quantities import as_json, finite, shown
from mudline.basics.units import UNITS
from mudline.model.contact import ContactInput
from mudline.model.results.evaluation import require_elements
from mudline.model.results.stage_times import CLOCK, Pruning, Timer, pruned
from mudline.model.scene.load_case import OwnSteps, own_steps
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Mask
from mudline.tools.touchdown_study.accuracy import ADVISED, SHORT, Mesh, StepRow, measured_accuracy, verdict_of
from mudline.tools.touchdown_study.beam import NotConvergedError
from mudline.tools.touchdown_study.stability import (
    EvaluatorCost,
    ExtremeRow,
    FrictionRow,
    curve_notes,
    evaluator_row,
    extreme_rows,
    friction_rows,
    snapping,
)
from mudline.tools.touchdown_study.zone import NotStudiedError, Zone, touchdown_zone

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from mudline.tools.touchdown_study.catenary import Catenary


FORMAT = "mudline-study/2"
NOT_STUDIED = "not studied"
PARTS = ("accuracy", "stability", "pruning")
ERRORS = ("touchdown point", "range of bending moment", "largest soil force")
"""Quantities of the errors of a row, in the order of `Study.errors`."""


class Advice(NamedTuple):
    """The answer: in words, as a verdict, and the line of the deck concerned; None if missing."""

    text: str
    verdict: str = NOT_STUDIED
    own_step: float | None = None
    step: float | None = None
    file: str | None = None
    deck_line: int | None = None


@dataclass
class Study:
    """The study of a deck; None and empty for parts that were not requested or do not exist.

    Attributes:
        deck: name of its file.
        units: its unit system.
        own: its time steps.
        own_line: line of the time steps.
        zone: the touchdown zone.
        reference: the row against which errors are computed.
        notes: sentences, by part.
    """

    deck: str
    units: str
    own: OwnSteps | None
    own_line: int
    advice: Advice = field(default_factory=lambda: Advice(""))
    zone: Zone | None = None
    static: dict[str, float | None] | None = None
    steps: list[StepRow] = field(default_factory=list)
    reference: StepRow | None = None
    mesh: Mesh | None = None
    extremes: list[ExtremeRow] = field(default_factory=list)
    friction: list[FrictionRow] = field(default_factory=list)
    evaluator: EvaluatorCost | None = None
    stages: Pruning | None = None
    parts: tuple[str, ...] = PARTS
    notes: dict[str, list[str]] = field(default_factory=dict)

    def json(self) -> dict[str, Any]:
        """Return the study as in JSON: in the deck's units, unrounded."""
        rows = [*self.steps, *([] if self.reference is None else [self.reference])]
        return {
            "format": FORMAT,
            "deck": self.deck,
            "units": self.units,
            "advice": self.advice._asdict(),
            "model": None if self.zone is None else _model(self.zone),
            "submerged_weight": None if self.zone is None else as_json(self.zone.weights),
            "static": self.static,
            "steps": [row.json() for row in rows],
            "mesh": None if self.mesh is None else self.mesh.json(),
            "extremes": as_json(self.extremes),
            "friction": as_json(self.friction),
            "evaluator": as_json(self.evaluator),
            "stages": None if self.stages is None else as_json(self.stages.rows),
        }

    def milliseconds(self, seconds: float) -> str:
        """Return a step in milliseconds; in user units, whose times have no name, in these units."""
        return (
            f"{shown(1e3 * seconds, 6 if seconds >= 1.0 else 4)} ms" if UNITS[self.units].known else shown(seconds, 4)
        )

    @property
    def time_steps(self) -> Floats:
        """Time steps (k,) of the rows, the largest first."""
        return np.array([row.step for row in self.steps])

    @property
    def errors(self) -> Floats:
        """Absolute errors (k, 3) of touchdown, range and force of the rows; NaN if missing."""
        return np.abs(np.array([row.errors or (np.nan,) * 3 for row in self.steps], np.float64)).reshape(-1, 3)

    @property
    def is_own(self) -> Mask:
        """Mask (k,) of the rows that are steps of the deck."""
        return np.array([row.own for row in self.steps], np.bool_)

    @property
    def run_times(self) -> Floats:
        """Processor time (k,) of the rows for a second of motion."""
        return np.array([np.nan if row.run_time is None else row.run_time for row in self.steps])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the errors over the run time, and return the axes; needs matplotlib."""
        from matplotlib import pyplot as plt  # noqa: PLC0415 - needs the extra `plot`

        from mudline.model.results.plots import draw_run_times  # noqa: PLC0415 - as above

        axes = plt.subplots()[1] if ax is None else ax
        draw_run_times(axes, self.run_times, self.errors, self.is_own, ERRORS)
        return axes

    def figure(self) -> Figure:
        """Return the diagram as a figure of its own; needs matplotlib."""
        from mudline.model.results.plots import run_times_figure  # noqa: PLC0415 - needs the extra `plot`

        return run_times_figure(self.deck, self.run_times, self.errors, self.is_own, ERRORS)

    @property
    def drawable(self) -> bool:
        """True if some step has errors to draw."""
        return bool(np.isfinite(self.errors).any())


def _model(zone: Zone) -> dict[str, Any]:
    """Return the model as in JSON."""
    ids, own, scheme = zone.scene.element_ids, zone.own, zone.scheme
    row = {
        "first_element": int(ids[zone.elements[0]]),
        "last_element": int(ids[zone.elements[-1]]),
        "touchdown_element": int(ids[own]),
        "tension": zone.beam.tension,
        "lying_length": cast("Catenary", zone.line.catenary).lying[-1][1],
        "weight": zone.beam.weight,
        "mass": float(zone.pipe.mass[own] + zone.pipe.contents[own]),
        "added_mass": float(zone.pipe.added_mass[own]),
        "bending_stiffness": zone.beam.bending,
        "travel": zone.travel,
        "end_amplitude": zone.beam.amplitude,
        "heave": abs(zone.motion.heave),
        "surge": abs(zone.motion.surge),
        "period": zone.motion.period,
        "left": zone.start,
        "right": zone.right,
        "drag": float(zone.pipe.drag_coefficient[own]),
    }
    names = ("name", "rho", "alpha", "alpha_f", "alpha_m")
    return {**as_json(row), "scheme": {name: getattr(scheme, name) for name in names}}


def study(
    scene: Scene,
    parts: Sequence[str] = PARTS,
    *,
    heave: float | None = None,
    period: float | None = None,
    timer: Timer = CLOCK,
    tracked: Callable[[Sequence[str]], Iterable[str]] = iter,
) -> Study:
    """Study parts of a scene.

    `heave` and `period` replace the motion of the hang-off in the deck. `timer` measures run times. `tracked` may show
    progress over the parts. Raises DeckError for a deck that cannot be evaluated.
    """
    require_elements(scene)
    given = scene.contact_input("cut" if scene.blocking("keep") else "keep")
    own = own_steps(scene)
    own_line = 0 if own is None else scene.line_of(own.where)
    result = Study(scene.deck.file, scene.units, own, own_line, parts=tuple(part for part in PARTS if part in parts))
    for part in tracked(result.parts):
        notes = result.notes.setdefault(part, [])
        if part != "pruning" and result.zone is None and not result.advice.text:
            _find_zone(result, scene, given, heave, period)
        if part == "accuracy" and result.zone is not None:
            result.steps, result.reference, result.mesh, more = measured_accuracy(result.zone, own, timer)
            notes += more
        elif part == "stability":
            notes += curve_notes(scene, given)
            if result.zone is not None:
                result.extremes, left_out = extreme_rows(result.zone, own)
                notes += left_out
            result.friction = list(friction_rows(scene, given, own))
            result.evaluator = evaluator_row(given, timer)
        elif part == "pruning":
            result.stages = pruned(scene, given, timer)
    if not result.advice.text:
        text, verdict, step = _judged(result)
        largest, file = (None, None) if own is None else (own.largest, result.deck)
        result.advice = Advice(text, verdict, largest, step, file, own_line or None)
    return result


def _find_zone(result: Study, scene: Scene, given: ContactInput, heave: float | None, period: float | None) -> None:
    """Set the zone, or the sentence on why there is none."""
    if refusal := snapping(scene, given):
        result.advice = Advice(f"Not studied: {refusal}.")
        return
    try:
        zone = touchdown_zone(scene, given, heave, period)
        beam, _, rest = zone.rest()
    except (NotStudiedError, NotConvergedError) as error:
        known = isinstance(error, NotStudiedError)
        why = str(error) if known else "the touchdown zone has no state of rest on its soil"
        result.advice = Advice(f"Not studied: {why}.")
        return
    result.zone = zone
    heights, turned = rest.state[np.newaxis, ::2], rest.state[np.newaxis, 1::2]
    static = zone.measures(beam, heights, turned, rest.reaction.per_length[np.newaxis])
    result.static = {
        "largest_force": finite(static.largest_force),
        "largest_moment": finite(static.largest_moment),
        "touchdown": finite(float(static.touchdown[0])),
    }


# --------------------------------------------------------------------------------------------------------------- advice


def _judged(study: Study) -> tuple[str, str, float | None]:
    """Return the answer in words, the verdict, and the advised step."""
    if "accuracy" not in study.parts or not study.steps:
        return "", NOT_STUDIED, None
    if study.reference is None:
        return f"Not studied: {study.notes['accuracy'][-1]}", NOT_STUDIED, None
    row = next((each for each in study.steps if each.own), None)
    within = list(takewhile(lambda each: each.worst <= ADVISED, reversed(study.steps)))  # with all shorter steps
    fine = within[-1].step if within else None
    last = study.steps[-1] if row is None else row
    mesh = _of_mesh(study, last)
    if study.own is None:
        steps = f"{study.milliseconds(fine)} keeps" if fine else "no step that was run keeps"
        text = f"The deck has no time step in *TIME: {steps} the errors of its touchdown zone within 1 %. {mesh}"
        return text.rstrip(), NOT_STUDIED, fine
    place = f"The deck's own step, {study.milliseconds(study.own.largest)} (line {study.own_line}),"
    verdict, step, tried = verdict_of(last.worst), None, study.milliseconds(last.step)
    errors = f"the run {last.state}"
    if last.errors is not None:
        touchdown, moment, force = map(about, last.errors)
        errors = (
            f"about {moment} of the range of the bending moment, {force} of the largest soil force, {touchdown} of the "
            "touchdown point's travel"
        )
    if row is not None:
        text = f"{place} is {verdict} for its touchdown zone: {errors}"
        if verdict == "too long":
            step = fine
            text += f"; use {study.milliseconds(fine)}" if fine else "; no step that was run keeps within 1 %"
    elif last.worst <= SHORT:
        text = f"{place} is short enough for its touchdown zone: {tried} is"
    else:
        text = f"{place} is too short to be judged here in reasonable time, and {tried} is {verdict}: {errors}"
        verdict = NOT_STUDIED
    return f"{text}. {mesh}".rstrip(), verdict, step


def about(share: float) -> str:
    """Return a share in percent, to one digit."""
    return f"{float(f'{100.0 * abs(share):.1g}'):g} %"


def _of_mesh(result: Study, row: StepRow) -> str:
    """Return a sentence on the mesh; "" if halving the elements changes less than the step does."""
    zone, mesh = result.zone, result.mesh
    if zone is None:
        return ""
    longest = float(zone.beam.lengths[zone.landing].max())
    bound, length = min(zone.length, zone.soil_length), UNITS[result.units].behind("L")
    if longest > bound:
        return (
            f"Elements of {longest:.3g}{length} land whole: the line bends within {bound:.2g}{length}. The mesh is the "
            f"finding, and errors of steps look small on it: give elements of {0.5 * bound:.2g}{length} or less."
        )
    worst = max(map(abs, mesh.changes)) if mesh is not None and mesh.changes is not None else 0.0
    if mesh is not None and worst > row.worst:
        return f"Half the element length ({mesh.element_length[0]:.3g}{length}) changes more: {about(worst)}."
    return ""
