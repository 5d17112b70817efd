"""An evaluation in few figures: by law and set, and by time step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mudline.results.evaluation import Evaluation


class Total(NamedTuple):
    """Elements that share a law and the set that gave it to them, at one step.

    `deepest` is the largest depth, negative above the bed; `reaction` the total normal force.
    """

    law: str
    set_name: str
    elements: int
    touching: int
    deepest: float
    reaction: float


class StepTotal(NamedTuple):
    """All evaluated elements at one step; `first` and `last` are the elements in contact, in the deck's order."""

    time: float
    touching: int
    first: int | None
    last: int | None
    deepest: float | None
    reaction: float


def totals(evaluation: Evaluation) -> list[Total]:
    """By law and set, in the order of the elements, at the first step."""
    scene, result = evaluation.scene, evaluation.result.step(0)
    groups: dict[tuple[str, str], list[int]] = {}
    for index in evaluation.elements.tolist():
        groups.setdefault((scene.law_names[index], scene.law_sets[index] or ""), []).append(index)
    return [
        Total(
            law,
            name,
            len(members),
            int(result.contact[members].sum()),
            float(result.depth[members].max()),
            _sum(result.force[members], evaluation.length[members]),
        )
        for (law, name), members in groups.items()
    ]


def step_totals(evaluation: Evaluation, most: int | None) -> list[StepTotal]:
    """The first `most` steps; None for all of them."""
    if evaluation.time is None:
        return []
    scene, chosen = evaluation.scene, evaluation.elements
    ids, length = scene.element_ids[chosen], evaluation.length[chosen]
    rows = []
    for step, time in enumerate(evaluation.time[:most].tolist()):
        result = evaluation.result.step(step)
        touching = np.flatnonzero(result.contact[chosen])
        first, last = (int(ids[touching[end]]) if touching.size else None for end in (0, -1))
        depth = result.depth[chosen]
        deepest = float(depth.max()) if chosen.size else None
        rows.append(StepTotal(time, len(touching), first, last, deepest, _sum(result.force[chosen], length)))
    return rows


def _sum(
    force: np.ndarray[tuple[int], np.dtype[np.float64]], length: np.ndarray[tuple[int], np.dtype[np.float64]]
) -> float:
    with np.errstate(over="ignore", invalid="ignore"):
        return float((force * length).sum())
