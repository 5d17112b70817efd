"""Trenches."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.diagnostics import Code, Problem, Severity
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.model import Scene
from mudline.scene.numbering import Mask

EXT003 = Code("EXT003", "bad-trench", Severity.ERROR)


@rule(EXT003)
def bad_trench(context: LintContext) -> Iterator[Problem]:
    """The geometry of a trench is not one, or its elements have no friction spring.

    The walls of a trench rise from its bottom width to a larger upper width, and its depth is above 0. Their resistance
    raises the limit of the lateral friction spring: without *SEABED FRICTION, or a transverse friction coefficient,
    there is no spring to be limited. Correct the geometry, or give the friction.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6
        *SEABED TRENCH
         SET=ALL
         GEOMETRY=0.5, 3.0, 1.0
         PEAK=2000.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6
        *SEABED TRENCH
         SET=ALL
         GEOMETRY=0.5, 1.0, 3.0
         PEAK=2000.0

    Finds: 9:2
    """
    scene = context.scene
    extension = scene.extensions.get("SEABED TRENCH")
    if extension is None:
        return
    for index, (entry, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
        geometry = getattr(entry, "geometry", None)
        values = [getattr(geometry, name, None) for name in ("depth", "bottom_width", "upper_width")]
        numbers = [float(value) if isinstance(value, float | int) else float("nan") for value in values]
        _, bottom, upper = numbers
        if any(number <= 0.0 for number in numbers) or upper <= bottom:
            message = "not a trench: it must have a depth above 0, a bottom width above 0, and a larger upper width"
            yield Problem(EXT003, message, where=where._replace(path=(*where.path, "geometry")))
        bare = np.flatnonzero((extension.of_element == index) & ~_sprung(scene))
        if bare.size and not scene.context.restart:
            message = (
                f"{bare.size} elements (first: {scene.element_ids[bare[0]]}) have a trench and no friction spring: "
                "give *SEABED FRICTION for them"
            )
            yield Problem(EXT003, message, where=where._replace(path=(*where.path, "set")))


def _sprung(scene: Scene) -> Mask:
    """Elements that have, or may have, a lateral friction spring."""
    friction = scene.extensions.get("SEABED FRICTION")
    count = len(scene.element_ids)
    if friction is None:
        sprung: Mask = np.zeros(count, dtype=np.bool_)
    elif any(held is None or held.open for held in friction.sets):
        return np.ones(count, dtype=np.bool_)
    else:
        sprung = friction.of_element >= 0
    if scene.laws.uncertain or any(scene.context.disturbed(place) for place in scene.bed.places):
        return np.ones(count, dtype=np.bool_)
    return sprung | (scene.bed.column("friction")[:, 1] > 0.0)
