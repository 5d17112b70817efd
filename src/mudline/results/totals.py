"""An evaluation in few figures: by law and set, and by time step."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact import ContactResult
from mudline.results.columns import SLIDING, STATES, Names
from mudline.results.evaluation import Evaluation, Part
from mudline.results.numbers import finite
from mudline.scene.numbering import Floats


class Total(NamedTuple):
    """Elements that share a law and the set that gave it to them, at one step.

    `deepest` is the largest depth, negative above the bed, None where there is no bed; `reaction` the total normal
    force of a law per unit length; None for springs of nodes.
    """

    law: str
    set_name: str
    elements: int
    touching: int
    deepest: float | None
    reaction: float | None


class StepTotal(NamedTuple):
    """All evaluated elements at one step; `first` and `last` are the elements in contact, in the deck's order.

    `sucked` counts the elements in the states suction and hold, `slipping` the nodes that slip in a direction; None
    without such laws.
    """

    time: float
    touching: int
    first: int | None
    last: int | None
    deepest: float | None
    reaction: float
    sucked: int | None = None
    slipping: int | None = None


def totals(evaluation: Evaluation, part: Part) -> list[Total]:
    """By law and set, in the order of the elements, at the first step of a part."""
    scene, result = evaluation.scene, part.result.step(0)
    groups: dict[tuple[str, str], list[int]] = {}
    with np.errstate(over="ignore"):
        line_forces = result.force * evaluation.length
    for index in evaluation.elements.tolist():
        groups.setdefault((scene.law_names[index], scene.law_sets[index] or ""), []).append(index)
    return [
        Total(
            law,
            name,
            len(members),
            int(result.contact[members].sum()),
            _largest(result.depth[members]),
            None if law in _AT_NODES else _sum(line_forces[members]),
        )
        for (law, name), members in groups.items()
    ]


def step_totals(evaluation: Evaluation, part: Part) -> list[StepTotal]:
    """The steps of a part; none for a single state without a time."""
    if evaluation.time is None:
        return []
    return [_step(evaluation, part, step) for step in range(part.count)]


def reaction(evaluation: Evaluation, result: ContactResult) -> float:
    """Total normal force of a step on all nodes."""
    return _sum(result.normal_force[evaluation.nodes])


def _step(evaluation: Evaluation, part: Part, step: int) -> StepTotal:
    chosen, result = evaluation.elements, part.result.step(step)
    ids = evaluation.scene.element_ids[chosen]
    touching = np.flatnonzero(result.contact[chosen])
    first, last = (int(ids[touching[end]]) if touching.size else None for end in (0, -1))
    times = evaluation.time
    slips = result.friction_state
    return StepTotal(
        0.0 if times is None else float(times[part.start + step]),
        len(touching),
        first,
        last,
        _largest(result.depth[chosen]),
        reaction(evaluation, result),
        None if result.state is None else int(np.isin(result.state, _HELD).sum()),
        None if slips is None else int((slips == SLIDING.index("slip")).any(axis=-1).sum()),
    )


_AT_NODES = ("nodal", "rigid")
"""Laws without a force per unit length."""
_HELD = (STATES.index("suction"), STATES.index("hold"))


def counts(states: NDArray[np.int8], names: Names) -> list[tuple[str, int]]:
    """How many there are in each state that occurs."""
    found = np.bincount(states.astype(np.intp) + 1, minlength=len(names))[1:]
    return [(name, int(count)) for name, count in zip(names, found, strict=False) if name is not None and count]


def _largest(depth: Floats) -> float | None:
    known = depth[~np.isnan(depth)]
    return finite(float(known.max())) if known.size else None


def _sum(forces: Floats) -> float:
    with np.errstate(over="ignore", invalid="ignore"):
        return float(forces.sum())
