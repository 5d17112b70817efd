"""What keeps a scene from being evaluated and is no fault of the deck: something that it needs is not known."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mudline.codes import RUN001
from mudline.contact.input import LawKind
from mudline.diagnostics import Problem
from mudline.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.scene.model import Scene


def refusals(scene: Scene) -> Iterator[Problem]:
    """What no check covers: a problem for each kind, at the first element concerned."""
    springs = np.isin(scene.law, (LawKind.CURVE, LawKind.LINEAR))
    lost = scene.element_nodes.min(axis=1, initial=0) < 0
    yield from _elements(scene, lost, "ends at a node that is not known", "end at nodes that are not known")
    endless = springs & ~np.isfinite(scene.length) & ~lost
    yield from _elements(scene, endless, "has no known finite length", "have no known finite length")


def _elements(scene: Scene, found: Mask, one: str, many: str) -> Iterator[Problem]:
    at = np.flatnonzero(found)
    if at.size:
        number = scene.element_ids[at[0]]
        what = f"element {number} {one}" if at.size == 1 else f"{at.size} elements (first: {number}) {many}"
        where = scene.table.numbered.where(int(at[0]))
        yield Problem(RUN001, f"{what}; this cannot be evaluated", where=where)
