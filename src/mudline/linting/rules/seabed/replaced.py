"""Friction that `*SEABED FRICTION` takes the place of."""

from __future__ import annotations

import numpy as np

from mudline.deck.parameters import folded
from mudline.linting.context import LintContext
from mudline.linting.rules.seabed.given import Given
from mudline.scene.extensions import Extension
from mudline.scene.sets import ALL


def friction_replaced(context: LintContext, entry: Given) -> bool:
    """Whether every element that follows this place has its friction from `*SEABED FRICTION` instead.

    Of sets whose elements the deck does not show only the names are compared.
    """
    friction = context.scene.extensions.get("SEABED FRICTION")
    if friction is None:
        return False
    names = _names(friction)
    if ALL in names:
        return True
    bed = context.scene.resistance
    followers = np.zeros(0, dtype=np.intp)
    if entry.where in bed.places:
        followers = np.flatnonzero(bed.of_element == bed.places.index(entry.where))
    if followers.size:
        return bool((friction.of_element[followers] >= 0).all())
    return not entry.legacy and folded(str(entry.part.set_name)) in names


def _names(friction: Extension) -> set[str]:
    return {folded(held.name) for held in friction.sets if held is not None}
