"""Figures of each step: what a time trace shows, and where over all steps they are largest."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from mudline.results.evaluation import Evaluation, Part
from mudline.scene.numbering import Floats, Indices


class Traces(NamedTuple):
    """Figures of some steps (steps,): NaN where there is none.

    Attributes:
        reaction: total normal force on all nodes.
        force: largest magnitude of an element's force per unit length, with its sign.
        force_element: the index of that element, -1 for none.
        pull: largest magnitude of an element's force per unit length that holds it down, 0 where none is.
        pull_element: the index of that element, -1 for none.
        touching: number of elements in contact.
        deepest: largest depth of an element.
        deepest_element: the index of that element, -1 for none.
    """

    reaction: Floats
    force: Floats
    force_element: Indices
    pull: Floats
    pull_element: Indices
    touching: Floats
    deepest: Floats
    deepest_element: Indices


def traces(evaluation: Evaluation, part: Part) -> Traces:
    """The figures of the steps of a part."""
    result, chosen = part.result, evaluation.elements
    with np.errstate(over="ignore", invalid="ignore"):
        reaction = result.normal_force[:, evaluation.nodes].sum(axis=1)
    force, force_at = _largest(result.force[:, chosen], chosen, by_size=True)
    pull, pull_at = _largest(np.maximum(0.0 - result.force[:, chosen], 0.0), chosen, by_size=False)
    deepest, deepest_at = _largest(result.depth[:, chosen], chosen, by_size=False)
    touching = np.count_nonzero(result.contact[:, chosen], axis=1).astype(np.float64)
    return Traces(reaction, force, force_at, pull, pull_at, touching, deepest, deepest_at)


def _largest(values: Floats, chosen: Indices, *, by_size: bool) -> tuple[Floats, Indices]:
    steps = np.arange(len(values))
    if not values.shape[1]:
        return np.full(len(values), np.nan), np.full(len(values), -1)
    ranked = np.where(np.isnan(values), -np.inf, np.abs(values) if by_size else values)
    column = ranked.argmax(axis=1)
    found = values[steps, column]
    return found, np.where(np.isnan(found), -1, chosen[column])


class Peak(NamedTuple):
    """A largest value over all steps, when it first was, and at which element; None for all elements."""

    value: float
    step: int
    element: int | None


@dataclass(slots=True)
class Peaks:
    """Gathers the largest figures as the steps come, by the names of `Traces`."""

    evaluation: Evaluation
    found: dict[str, Peak] = field(default_factory=dict)

    def take(self, part: Part) -> None:
        """Look at some steps."""
        of_part = traces(self.evaluation, part)
        elements = {
            "force": of_part.force_element,
            "pull": of_part.pull_element,
            "deepest": of_part.deepest_element,
        }
        for name in ("reaction", "force", "pull", "touching", "deepest"):
            values: Floats = getattr(of_part, name)
            sizes = np.abs(values) if name == "force" else values
            if np.isnan(sizes).all():
                continue
            step = int(np.nanargmax(sizes))
            before = self.found.get(name)
            if before is None or sizes[step] > (abs(before.value) if name == "force" else before.value):
                element = int(self.evaluation.scene.element_ids[elements[name][step]]) if name in elements else None
                self.found[name] = Peak(float(values[step]), part.start + step, element)
