"""Trenches."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.contact_parts.build import friction_of
from mudline.scene.contact_parts.trench import KEYWORD, LOCKED, resistance_faults, self_locking
from mudline.scene.model import Scene
from mudline.scene.numbering import Mask

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_trench import TrenchSet

EXT003 = Code("EXT003", "bad-trench", Severity.ERROR)


@rule(EXT003)
def bad_trench(context: LintContext) -> Iterator[Problem]:
    """A trench has no possible geometry, no resistance, no friction spring, or a wall that locks itself.

    The walls of a trench rise from its bottom width to a larger upper width, and its depth is above 0. Their resistance
    raises the limit of the lateral friction spring: without *SEABED FRICTION, or a transverse friction coefficient,
    there is no spring to be limited. MODEL=PEAK, the default, needs PEAK=; the rows of PEAK=TABLE are two or more, and
    their offsets begin at 0 or more and ascend. MODEL=WALL has the resistance of its slope: where the transverse
    coefficient times that slope is 1 or more, the wall would hold any force. PEAK= beside MODEL=WALL counts for nothing
    and is a warning. Correct the value, or give what is missing.

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
    extension = scene.extensions.get(KEYWORD)
    if extension is None:
        return
    locked = _locked(scene)
    for index, (entry, where) in enumerate(zip(extension.entries, extension.places, strict=True)):
        yield from _resistance(context, cast("TrenchSet", entry), where)
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
        held = np.flatnonzero((extension.of_element == index) & locked)
        if held.size:
            message = f"{LOCKED}: {held.size} elements (first: {scene.element_ids[held[0]]})"
            yield Problem(EXT003, message, where=where._replace(path=(*where.path, "geometry")))


def _resistance(context: LintContext, entry: TrenchSet, where: Where) -> Iterator[Problem]:
    """What PEAK= lacks, or says in vain."""
    if entry.model == "WALL" and entry.peak is not None:
        message = "PEAK= counts for nothing under MODEL=WALL: remove it, or write MODEL=PEAK"
        yield Problem(EXT003, message, None, Severity.WARNING, where._replace(path=(*where.path, "peak")))
    if not context.scene.context.disturbed(where):
        for path, message in resistance_faults(entry):
            yield Problem(EXT003, message, where=where._replace(path=(*where.path, *path)))


def _locked(scene: Scene) -> Mask:
    """Elements with a wall that locks itself, where the friction of all nodes is known."""
    if scene.element_nodes.min(initial=0) < 0 or _uncertain(scene):
        return np.zeros(len(scene.element_ids), dtype=np.bool_)
    return self_locking(scene, friction_of(scene))


def _uncertain(scene: Scene) -> bool:
    """Whether some friction may come from lines or sets that this deck does not show."""
    friction = scene.extensions.get("SEABED FRICTION")
    if friction is not None and any(held is None or held.open for held in friction.sets):
        return True
    return scene.laws.uncertain or any(scene.context.disturbed(place) for place in scene.bed.places)


def _sprung(scene: Scene) -> Mask:
    """Elements that have, or may have, a lateral friction spring."""
    friction = scene.extensions.get("SEABED FRICTION")
    if _uncertain(scene):
        return np.ones(len(scene.element_ids), dtype=np.bool_)
    by_coefficient: Mask = scene.bed.column("friction")[:, 1] > 0.0
    return by_coefficient if friction is None else by_coefficient | (friction.of_element >= 0)
