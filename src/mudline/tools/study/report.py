"""The study of a deck as a whole: what it found, the advice that follows, and its JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from time import get_clock_info, perf_counter, thread_time
from typing import Any, NamedTuple

import numpy as np

from mudline.basics.quantities import finite, shown, time_unit
from mudline.model.contact.input import LawKind
from mudline.model.contact.stiffest import rounded_down
from mudline.model.results.evaluation import require_elements
from mudline.model.scene.model import Scene
from mudline.tools.study.extremes import Extremes, extremes
from mudline.tools.study.precision import GOALS, Precision, Timer, measured
from mudline.tools.study.pruning import Pruning, pruned
from mudline.tools.study.schemes import CRITICAL, HHT, SCHEMES
from mudline.tools.study.stability import Contact, Judged, OwnStep, StabilityRow, contacts_of, judged, own_step

FORMAT = "mudline-study/1"
PARTS = ("precision", "stability", "pruning")

CLOCK: Timer = thread_time if get_clock_info("thread_time").resolution < 1e-5 else perf_counter
"""Processor time of this thread where that clock is fine enough: other programs do not count in it."""


class Advice(NamedTuple):
    """What to do, and which line of the deck asks for it; None where there is none."""

    text: str
    scheme: str | None = None
    step: float | None = None
    file: str | None = None
    deck_line: int | None = None
    own_step: float | None = None


@dataclass
class Study:
    """What the study of a deck found; None for a part that was not asked for.

    Attributes:
        deck: name of its file.
        own: its fixed time step; None without one.
        notes: by part, what is missing or not known, in sentences.
        drawn: the work-precision curves, whether or not the part is shown.
    """

    deck: str
    units: str
    own: OwnStep | None
    advice: Advice = field(default_factory=lambda: Advice(""))
    precision: Precision | None = None
    stability: list[Judged] | None = None
    extremes: Extremes | None = None
    stages: Pruning | None = None
    notes: dict[str, list[str]] = field(default_factory=dict)
    drawn: Precision | None = None

    def json(self) -> dict[str, Any]:
        """Return the study as JSON has it: in the deck's units, unrounded."""
        return {
            "format": FORMAT,
            "deck": self.deck,
            "units": self.units,
            "advice": self.advice._asdict(),
            "precision": None if self.precision is None else [_plain(row) for row in self.precision.rows],
            "stability": None if self.stability is None else [_plain(one.row) for one in self.stability],
            "extremes": None
            if self.extremes is None
            else {
                "tried": self.extremes.tried,
                "held": self.extremes.held,
                "failed": [_plain(failure) for failure in self.extremes.failed],
            },
            "stages": None if self.stages is None else [_plain(row) for row in self.stages.rows],
        }

    def milliseconds(self, seconds: float | None) -> str:
        """Return a step as people read it, rounded down; in user units, whose times have no name, as it is."""
        if seconds is None:
            return "-"
        return shown(rounded_down(seconds * (1e3 if time_unit(self.units) else 1.0)))

    @property
    def step_unit(self) -> str:
        """The unit of `milliseconds`."""
        return "ms" if time_unit(self.units) else ""


def _plain(row: Any) -> dict[str, Any]:  # noqa: ANN401 - rows are named tuples of several kinds
    """A row by its names, rows inside it too; numbers that JSON cannot hold are None."""
    found = {}
    for name, value in row._asdict().items():
        nested = hasattr(value, "_asdict")
        found[name] = _plain(value) if nested else finite(value) if isinstance(value, float) else value
    return found


def study(
    scene: Scene,
    parts: Sequence[str] = PARTS,
    *,
    draw: bool = False,
    timer: Timer = CLOCK,
    tracked: Callable[[Sequence[str]], Iterable[str]] = iter,
) -> Study:
    """Study a scene: these parts, and the work-precision curves too if they are to be drawn.

    `timer` measures run times; `tracked` may show which part comes next. Raises DeckError for a deck that cannot be
    evaluated.
    """
    require_elements(scene)
    given = scene.contact_input("cut" if scene.blocking("keep") else "keep")
    found = Study(scene.deck.file, scene.units, own_step(scene))
    contacts, unknown, softening = contacts_of(scene, given)
    measure = [part for part in PARTS if part in parts or (draw and part == "precision")]
    for part in tracked(measure):
        notes = found.notes.setdefault(part, [])
        if part == "precision":
            found.drawn = measured(scene, given, contacts, found.own, timer)
            found.precision = found.drawn if part in parts else None
            notes += found.drawn.left_out
        elif part == "stability":
            found.stability, found.extremes = judged(scene, contacts, found.own), extremes(given, contacts)
            notes += unknown
        else:
            found.stages = pruned(scene, given, timer)
    compared = [part for part in measure if part != "pruning" and part in parts]
    none = "" if contacts else f"No contact of this deck has a frequency: {_without_springs(scene)}."
    if none and compared:
        found.notes[compared[0]].append(none)
    if found.own is None and compared:
        found.notes[compared[0]].append("The deck has no *TIME with a fixed step to compare with.")
    found.advice = _advice(found, contacts, [*softening, none])
    return found


def _without_springs(scene: Scene) -> str:
    """Why no contact of a scene has a spring and a mass."""
    if not np.isin(scene.law, (LawKind.NONE, LawKind.RIGID)).all():
        return "no law has a stiffness" if (scene.mass_per_length > 0.0).any() else "no section has a mass"
    return "the seabed is rigid" if (scene.law == LawKind.RIGID).any() else "no element has a seabed law"


# --------------------------------------------------------------------------------------------------------------- advice


class _Limit(NamedTuple):
    """The largest step that something of the deck allows a scheme, and what that is; None for none that was tried."""

    step: float | None
    name: str
    file: str
    line: int


def _advice(found: Study, contacts: Sequence[Contact], softening: Sequence[str]) -> Advice:
    own = None if found.own is None else found.own.step
    if found.precision is None and found.stability is None:
        return Advice(_of_stages(found), own_step=own)
    limits = {scheme: _limits(found, contacts, scheme) for scheme in SCHEMES}
    best = {scheme: one for scheme in (_least_work(limits), HHT) if (one := _smallest(limits[scheme])) is not None}
    if found.precision is None and HHT in best:
        best = {HHT: best[HHT]}
    texts = [_of_steps(found, best)] if best else []
    lost = dict.fromkeys(one.name for every in limits.values() for one in every if one.step is None)
    if lost:
        texts.append(f"No step that was tried keeps errors within 1 % on {', '.join(lost)}.")
    scheme, first = next(iter(best.items()), (None, None))
    if first is not None and first.step is not None:
        texts.append(_of_own_step(found, first.step))
    texts += [jump_note(found, one.row) for one in found.stability or () if one.row.jump] + [*softening]
    if found.extremes is not None and found.extremes.failed:
        texts.append(f"{len(found.extremes.failed)} of {found.extremes.tried} extreme cases do not hold.")
    text = " ".join(filter(None, texts))
    if first is None:
        return Advice(text, own_step=own)
    return Advice(text, scheme, first.step, first.file, first.line, own)


def _limits(found: Study, contacts: Sequence[Contact], scheme: str) -> list[_Limit]:
    """What the parts that were measured allow a scheme."""
    limits = []
    if found.precision is not None:
        rows = [row for row in found.precision.rows if row.scheme == scheme and row.goal == GOALS[0]]
        limits += [_Limit(row.step, row.contact, row.file, row.deck_line) for row in rows]
    if scheme in CRITICAL:
        limits += [_Limit(one.oscillation.critical_step(CRITICAL[scheme]), *_named(one.row)) for one in contacts]
    elif found.stability is not None:
        rows_too = [one.row for one in found.stability if one.row.landing_step is not None or one.row.jump]
        limits += [_Limit(row.landing_step, *_named(row)) for row in rows_too]
    return limits


def _named(row: StabilityRow) -> tuple[str, str, int]:
    return row.contact, row.file, row.deck_line


def _smallest(limits: Sequence[_Limit]) -> _Limit | None:
    return min((one for one in limits if one.step is not None), key=lambda one: one.step or 0.0, default=None)


def _least_work(limits: dict[str, list[_Limit]]) -> str:
    """The explicit scheme with the fewest force evaluations per second of motion."""

    def work(scheme: str) -> float:
        smallest = _smallest(limits[scheme])
        step = None if smallest is None else smallest.step
        return _EVALUATIONS[scheme] / step if step else math.inf

    return min(CRITICAL, key=work)


_EVALUATIONS = {"velocity Verlet": 1.0, "RK4": 4.0}
"""Force evaluations of a step."""


def _of_steps(found: Study, best: dict[str, _Limit]) -> str:
    """Which scheme with which step, because of what."""
    uses = [f"{scheme} with {found.milliseconds(one.step)} {found.step_unit}".strip() for scheme, one in best.items()]
    why = "errors" if found.precision is not None else "landings" if HHT in best else "stable motions"
    within = "" if why == "stable motions" else " within 1 %"
    places = list(dict.fromkeys(_place(found, one) for one in best.values()))
    sets = f"{places[0]} sets {'both' if len(best) > 1 else 'it'}"
    if len(places) > 1:
        sets = f"{places[0]} sets the first, {places[1]} the second"
    return f"Use {', or '.join(uses)}, for {why}{within}: {sets}."


def _place(found: Study, one: _Limit) -> str:
    file = "" if found.deck.endswith(one.file) else f" of {one.file}"
    return f"line {one.line}{file} ({one.name})" if one.line else one.name


def _of_own_step(found: Study, step: float) -> str:
    if found.own is None:
        return ""
    times = found.own.step / step
    judgement = f"is {float(f'{times:.2g}'):g} times too long for it" if times > 1.0 else "is short enough"
    own = f"{shown(found.own.step * (1e3 if found.step_unit else 1.0))} {found.step_unit}".strip()
    return f"The deck's own step, {own} (line {found.own.deck_line}), {judgement}."


def jump_note(found: Study, row: StabilityRow) -> str:
    """That the force jumps at the mudline, where, and the step without it."""
    if row.without_jump is None:
        return ""
    without = row.without_jump
    step = (
        f"landings keep their speed within 1 % up to {found.milliseconds(without.step)} {found.step_unit}".strip()
        if without.step is not None
        else "no step that was tried lands within 1 % either"
    )
    place = _place(found, _Limit(None, row.contact, row.file, without.deck_line))
    return f"The force jumps at the mudline, {place}; without the jump {step}."


def _of_stages(found: Study) -> str:
    """What takes most of a step."""
    rows = [row for row in found.stages.rows if row.share] if found.stages is not None else []
    if not rows:
        return ""
    most = max(rows, key=lambda row: row.share or 0.0)
    line = f" (line {most.deck_line})" if most.deck_line else ""
    return f"Most of a step goes to the stage {most.stage}{line}: {100.0 * (most.share or 0.0):.0f} %."
