"""Totals of an evaluation: by law and set, by state, by step, and by line at each step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mudline.basics.quantities import SLIDING, STATES, Names, finite, shown
from mudline.model.contact import ContactResult, LawKind
from mudline.model.contact.lines import LineSummary
from mudline.model.contact.result import ResultPart, total_normal_force
from mudline.model.results.evaluation import Evaluation
from mudline.model.results.extremes import StepValues, largest_of_steps
from mudline.model.scene.numbering import Floats, Indices, Mask

NOT_KNOWN = "not known"
"""Text for the reaction of a rigid seabed, and for one that overflows."""
_SLACK = 1e-9
"""Tolerance of the length in contact, as a part of the length of a line."""


def touchdown_words(places: Sequence[float], contact: float | None, length: float | None, most: int) -> str:
    """Return the arc lengths of the touchdown points of a line as text, or where all of it is; "" if unknown.

    A line only part of which has a gap may lie on the seabed there without a touchdown point.
    """
    if places:
        more = f", {len(places) - most} more" if len(places) > most else ""
        return ", ".join(shown(place) for place in places[:most]) + more
    if not contact:
        return "none"
    return "all on the seabed" if length is not None and contact > (1.0 - _SLACK) * length else ""


def carried(result: ContactResult) -> Mask:
    """Return the elements (..., m) of a result that are in contact with a law of the seabed, or lie on a rigid one."""
    given = result.known
    in_contact: Mask = result.contact & (given.law != LawKind.NONE)
    if result.restrained is not None:
        in_contact |= result.restrained[..., given.element_nodes].all(axis=-1) & (given.law == LawKind.RIGID)
    return in_contact


def totals(evaluation: Evaluation, result: ContactResult) -> list[dict[str, Any]]:
    """Return the totals of the elements that share a law and its set, in the order of the elements, at one step.

    `touching` is the number of elements in contact, `deepest` their largest depth, negative above the seabed, None
    without a seabed; `reaction` is the total normal force of a law per unit length, None for springs of nodes.
    """
    scene, in_contact = evaluation.scene, carried(result)
    groups: dict[tuple[str, str], list[int]] = {}
    for index in evaluation.elements.tolist():
        groups.setdefault((scene.law_names[index], scene.law_sets[index] or ""), []).append(index)
    rows = []
    with np.errstate(over="ignore", invalid="ignore"):
        for (law, name), members in groups.items():
            force = float((result.force[members] * evaluation.model.input.length[members]).sum())
            rows.append(
                {
                    "law": law,
                    "set_name": name,
                    "elements": len(members),
                    "touching": int(in_contact[members].sum()),
                    "deepest": _deepest(result.depth[members]),
                    "reaction": None if law in _AT_NODES else force,
                }
            )
    return rows


def reaction(evaluation: Evaluation, result: ContactResult) -> float:
    """Return the total normal force of a step on all nodes; NaN on a rigid seabed, whose force is not known."""
    with np.errstate(over="ignore", invalid="ignore"):
        return float(total_normal_force(result, evaluation.nodes))


def step_totals(evaluation: Evaluation, part: ResultPart, *, of_nodes: bool = False) -> Iterator[dict[str, Any]]:
    """Yield the figures of all evaluated elements, or nodes, at each step of a part with times.

    Keys of a row; a value that does not exist is None:

    * `time`, and `reaction`, the total normal force;
    * `touching`: number of elements in contact, or of nodes that the seabed acts on;
    * `first`, `last`: numbers of the first and the last of these, in the order of the deck;
    * `slipping`: number of nodes that slip in a direction;
    * of elements `deepest`, the largest depth, and `sucked`, the number in the states suction and hold;
    * of nodes `gap`, the smallest distance from the seabed, and `largest`, the largest normal force.
    """
    elements, nodes, scene = evaluation.elements, evaluation.nodes, evaluation.scene
    for step, time in enumerate([] if part.result.times is None else part.result.times.tolist()):
        result = part.result.step(step)
        slips = result.friction_state
        slipping = None if slips is None else int((slips == SLIDING.index("slip")).any(axis=-1).sum())
        total = reaction(evaluation, result)
        if of_nodes:
            acts = scene.node_ids[acted_on(evaluation, result)]
            deepest = _deepest(-result.gap[nodes])
            own = {
                "gap": None if deepest is None else 0.0 - deepest,
                "largest": _deepest(result.normal_force[nodes]),
            }
        else:
            acts = scene.element_ids[elements[carried(result)[elements]]]
            own = {
                "deepest": _deepest(result.depth[elements]),
                "sucked": None if result.state is None else int(np.isin(result.state, HELD).sum()),
            }
        first, last = (int(acts[0]), int(acts[-1])) if acts.size else (None, None)
        counts = {"touching": len(acts), "first": first, "last": last, "slipping": slipping}
        yield {"time": time, "reaction": total, **counts, **own}


def line_steps(evaluation: Evaluation, part: ResultPart) -> Iterator[LineSummary]:
    """Yield every line at each step of a part."""
    yield from evaluation.touchdown.summaries(part, evaluation.touchdown.series(part))


def acted_on(evaluation: Evaluation, result: ContactResult) -> Indices:
    """Return the indices of the evaluated nodes that the seabed acts on, or restrains, at a step."""
    acts: Mask = (result.reaction != 0.0).any(axis=1)
    if result.restrained is not None:
        acts |= result.restrained
    return evaluation.nodes[acts[evaluation.nodes]]


_AT_NODES = ("nodal", "rigid")
"""Laws without a force per unit length."""
HELD = (STATES.index("suction"), STATES.index("hold"))
"""States of an element above the seabed in which suction may act again."""


def states(evaluation: Evaluation, result: ContactResult) -> list[dict[str, Any]]:
    """Return the counts of states that occur at a step, of suction by element, of friction by node and direction."""
    rows = []
    if result.state is not None:
        rows += _counts("suction of elements", result.state[evaluation.elements], STATES)
    if result.friction_state is not None:
        for axis, direction in enumerate(("axial", "lateral")):
            sliding = result.friction_state[evaluation.nodes, axis]
            rows += _counts(f"{direction} friction of nodes", sliding, SLIDING)
    if result.restrained is not None:
        rows.append({"law": "rigid seabed", "state": "restrained nodes", "count": int(result.restrained.sum())})
    return rows


def _counts(law: str, states: NDArray[np.int8], names: Names) -> list[dict[str, Any]]:
    numbers = np.bincount(states.astype(np.intp) + 1, minlength=len(names))[1:].tolist()
    return [{"law": law, "state": name, "count": count} for name, count in zip(names, numbers, strict=False) if count]


def _deepest(depth: Floats) -> float | None:
    known = depth[~np.isnan(depth)]
    return finite(float(known.max())) if known.size else None


def step_figures(part: ResultPart) -> dict[str, StepValues]:
    """Return the figures of `STEPS` for the steps of a part, each as one column."""
    result, chosen = part.result, np.flatnonzero(part.result.evaluated)
    with np.errstate(over="ignore", invalid="ignore"):
        reaction = total_normal_force(result, result.present)
    force = result.force[:, chosen]
    return {
        "reaction": StepValues(reaction[:, np.newaxis]),
        "force": largest_of_steps(force, chosen, by_size=True),
        "pull": largest_of_steps(np.maximum(0.0 - force, 0.0), chosen),
        "touching": StepValues(carried(result)[:, chosen].sum(axis=1, keepdims=True, dtype=np.float64)),
        "deepest": largest_of_steps(result.depth[:, chosen], chosen),
    }
