"""Run time of the stages of a deck's plan, and of stages that could be added.

The time of a stage is the difference of a step with and without it, on the same elements. A stage that the deck lacks
is added with usual values to all elements with a normal law; its cost is the increase of a step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from time import get_clock_info, perf_counter, thread_time
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mudline.language.diagnostics import Where
from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.arrays import IndexArray
from mudline.model.contact.laws import law_named
from mudline.model.contact.laws.suction import from_cohesion
from mudline.model.scene.model import Scene

Timer = Callable[[], float]
CLOCK: Timer = thread_time if get_clock_info("thread_time").resolution < 1e-5 else perf_counter
"""Processor time of this thread if its clock is fine enough: other programs do not count in it."""

_ROUNDS = 9
_LEAST = 1e-3
"""Least duration of a round of each model in seconds."""
_SURFACE = "seabed surface"
_COHESION = 5000.0
_DIAMETER = 0.3

_STAGES = ("smoothing", "unloading", "suction", "friction", "lateral", "trench")
"""The stages that a deck may lack; the law of smoothing replaces other laws."""
_EXTENSIONS = {
    "smoothing": "SEABED CONTACT",
    "unloading": "SEABED UNLOADING",
    "suction": "SEABED SUCTION",
    "friction": "SEABED FRICTION",
    "trench": "SEABED TRENCH",
}
_RESISTANCES = ("suction", "friction", "lateral")


class StageRow(NamedTuple):
    """A stage of the plan; None for values that are not measured, or not in the deck.

    Attributes:
        time: seconds per step of all elements.
        share: share of the time of a whole step.
        cost_if_added: seconds per step and node if the deck had the stage.
    """

    stage: str
    active: bool
    why: str
    file: str | None
    deck_line: int | None
    share: float | None
    time: float | None
    cost_if_added: float | None


class Pruning(NamedTuple):
    """The stages, seconds of a step and its number of elements."""

    rows: list[StageRow]
    step: float
    elements: int


def pruned(scene: Scene, given: ContactInput, timer: Timer) -> Pruning:
    """Return the stages of a scene with their times, measured in turns on the deck's own elements."""
    model = ContactModel(given, backend="numpy")
    models = {"": model, _SURFACE: ContactModel(replace(given, laws=()), backend="numpy")}
    for stage in model.plan:
        if stage.stage in _STAGES:
            changed = without(given, stage.stage) if stage.active else with_added(given, stage.stage)
            with suppress(ValueError):  # an added law may exclude those of the deck
                models |= {} if changed is None else {stage.stage: ContactModel(changed, backend="numpy")}
    removable = any(stage.active for stage in model.plan if stage.stage in _STAGES)
    if removable:
        models["normal law"] = ContactModel(without(given, *_STAGES), backend="numpy")
    taken = seconds_per_step(models, timer)
    if "" not in taken:
        taken = {}
    whole, surface = taken.get("", 0.0), taken.get(_SURFACE, 0.0)
    if taken and not removable:
        taken["normal law"] = whole
    rows = []
    for stage in model.plan:
        where = _place(scene, stage.stage) if stage.active else None
        base = scene.deck.base_of(where)
        file = None if where is None else Path(base[0].file if base else scene.deck.file).name
        share = time = added = None
        if stage.active and stage.stage in taken:
            less = taken[stage.stage]
            time = max({_SURFACE: surface, "normal law": less - surface}.get(stage.stage, whole - less), 0.0)
            share = min(time / whole, 1.0)
        elif stage.stage in taken and stage.stage in _STAGES:
            added = max(taken[stage.stage] - whole, 0.0) / len(given.node_ids)
        line = scene.line_of(where) or None
        rows.append(StageRow(stage.stage, stage.active, stage.why, file, line, share, time, added))
    return Pruning(rows, whole, len(given.element_ids))


def seconds_per_step(models: Mapping[str, ContactModel], timer: Timer) -> dict[str, float]:
    """Return the time of a step of each model at its own coordinates: the least of several rounds in turns."""
    calls: dict[str, Callable[[], object]] = {}
    for name, model in models.items():
        points = model.input.coordinates
        try:
            _, state = model.step(points, np.zeros_like(points), model.initial_state())
        except ValueError:  # an added law may exclude a curve that pulls, and forces may overflow
            continue
        rates = np.full_like(points, 1e-3)
        calls[name] = partial(model.step, points, rates, state)
    repeats = max(1, round(_LEAST / max(_seconds(calls.values(), 1, timer)[0], 1e-7)))
    rounds = [_seconds(calls.values(), repeats, timer) for _ in range(_ROUNDS)]
    return dict(zip(calls, np.min(rounds, axis=0).tolist(), strict=True))


def _seconds(calls: Iterable[Callable[[], object]], repeats: int, timer: Timer) -> list[float]:
    times = []
    for call in calls:
        began = timer()
        for _ in range(repeats):
            call()
        times.append(max(timer() - began, 1e-9) / repeats)
    return times


# ----------------------------------------------------------------------------------------------- with less, with more


def without(given: ContactInput, *stages: str) -> ContactInput:
    """Return the input without the laws of some stages; smoothed laws become linear laws."""
    laws = [law for law in given.laws if law_named(law.law).stage not in stages]
    if "smoothing" in stages:
        laws = [_sharp(law) for law in laws]
    return replace(given, laws=tuple(laws))


def _sharp(law: LawAssignment) -> LawAssignment:
    """Return a law without its zone around the mudline."""
    if law.law == "smoothed":
        return LawAssignment("linear", law.rows, {"stiffness": law.parameters["stiffness"]})
    if law.law == "nodal":
        return replace(law, parameters={**law.parameters, "half_width": 0.0})
    return law


def with_added(given: ContactInput, stage: str) -> ContactInput | None:
    """Return the input with the law of a stage on elements with a normal law; None if no element can have it."""
    # a normal law with a history has unloading and suction of its own
    fit = [law.rows for law in given.normal_laws if not (law.law.history and stage in {"unloading", "suction"})]
    rows = np.sort(np.concatenate([np.zeros(0, np.intp), *fit]))
    if not rows.size:
        return None
    known = given.diameter[np.isfinite(given.diameter)]
    size = float(np.median(known)) if known.size else _DIAMETER
    if stage == "smoothing":  # zones of a hundredth of the diameter on linear laws
        laws = [
            replace(law, law="smoothed", parameters={**law.parameters, "half_width": 0.01 * size})
            if law.law == "linear"
            else law
            for law in given.laws
        ]
        return replace(given, laws=tuple(laws)) if given.has("linear") else None
    needed = ("friction", "trench peak") if stage == "trench" else (stage,)
    names = [name for name in needed if not given.has(name)]
    nodes = np.unique(given.element_nodes[rows])
    usual = _usual(given, rows, size)
    added = [LawAssignment(name, nodes if law_named(name).acts_on == "nodes" else rows, usual[name]) for name in names]
    return replace(given, laws=(*given.laws, *added))


def _usual(given: ContactInput, rows: IndexArray, size: float) -> dict[str, Mapping[str, ArrayLike]]:
    """Return usual values of laws by name, for elements (k,) like those of the deck, with a diameter."""
    steepest = ContactModel(given, backend="numpy").stiffest().per_length(np.maximum(given.length, 1e-300))[rows]
    stiffness = float(np.max(steepest[np.isfinite(steepest)], initial=1.0))
    return {
        "unloading": {"stiffness": 2.0 * stiffness},
        "suction": from_cohesion(np.array(_COHESION), np.array(size))._asdict(),
        "lateral": {"stiffness": 0.1 * stiffness},
        "friction": {
            "axial_coefficient": 0.35,
            "lateral_coefficient": 0.6,
            "axial_mobilisation": 0.01 * size,
            "lateral_mobilisation": 0.1 * size,
        },
        "trench peak": {"bottom": 2.0 * size, "upper": 4.0 * size, "peak": 0.1 * stiffness * size},
    }


# ---------------------------------------------------------------------------------------------------------------- place


def _place(scene: Scene, stage: str) -> Where | None:
    """Return the first place in the deck that assigns a stage to an element."""
    if stage == "normal law":
        return next((law.where for law in scene.laws.set_laws), None)
    extension = scene.extensions.get(_EXTENSIONS.get(stage, ""))
    if extension is not None and (extension.of_element >= 0).any():
        return extension.places[int(extension.of_element[extension.of_element >= 0].min())]
    if stage not in _RESISTANCES:
        return None
    resistance = scene.resistance
    values = resistance.column(stage)
    having = np.greater(values, 0.0) if values.ndim == 1 else np.greater(values, 0.0).any(axis=1)
    at = resistance.of_element[having & (resistance.of_element >= 0)]
    return resistance.places[int(at.min())].inside(stage) if at.size else None
