"""Why a scene without errors can still not be evaluated: something it needs stands where it is not read."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mudline.codes import RUN001
from mudline.contact.input import LawKind
from mudline.diagnostics import Problem, Where
from mudline.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.scene.model import Scene


def refusals(scene: Scene) -> Iterator[Problem]:
    """What keeps the evaluator from being made: a problem for each kind, at the first element or law concerned."""
    springs = np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR))
    lost = scene.element_nodes.min(axis=1, initial=0) < 0
    yield from _elements(scene, lost, "ends at a node that is not known", "end at nodes that are not known")
    unknown: Mask = np.array([*(grant.unknown for grant in scene.laws.grants), False])[scene.laws.of_element]
    yield from _laws(scene, unknown, "the law given here is not known")
    bare = (scene.law == LawKind.CURVE) & np.isnan(scene.diameter)
    yield from _laws(scene, bare & ~unknown, "a curve is given here, and the external diameter is not known")
    endless = springs & ~np.isfinite(scene.length) & ~lost
    yield from _elements(scene, endless, "has no known finite length", "have no known finite length")


def _elements(scene: Scene, found: Mask, one: str, many: str) -> Iterator[Problem]:
    at = np.flatnonzero(found)
    if at.size:
        number = scene.element_ids[at[0]]
        what = f"element {number} {one}" if at.size == 1 else f"{at.size} elements (first: {number}) {many}"
        yield _problem(what, scene.table.numbered.where(int(at[0])))


def _laws(scene: Scene, found: Mask, what: str) -> Iterator[Problem]:
    at = np.flatnonzero(found)
    if at.size:
        number = scene.element_ids[at[0]]
        which = f"element {number}" if at.size == 1 else f"{at.size} elements (first: {number})"
        yield _problem(f"{what}: {which}", scene.laws.grants[int(scene.laws.of_element[at[0]])].where)


def _problem(message: str, where: Where) -> Problem:
    return Problem(RUN001, f"{message}; this cannot be evaluated", where=where)
