"""Values that elements need, and values out of range."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.codes import SBD009, SBD010
from mudline.diagnostics import Problem, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule

_OF_EXTENSIONS = {"SEABED TRENCH": "geometry", "SEABED UNLOADING": "stiffness"}
_IN_SET = 3
"""Steps of a path to a value of a set: `sets`, its index, the setting."""


@rule(SBD009)
def missing_diameter(context: LintContext) -> Iterator[Problem]:
    """Elements follow a force-embedment curve and have no external diameter.

    The embedment ratio is a depth divided by the external diameter: without one there is no ratio, and no force. The
    diameter is Do of *GEOMETRIC SETS, or for OPTION=FLEXIBLE without Do the drag diameter Dd, and it must not be 0.
    Give the elements a section, or put them into a set that has one.

    Bad:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Flowline
         GEN=1, 3
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=Flowline
         207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Good:
        $MODEL
        *NODE
         1, -0.05, 0.0
         5, -0.05, 40.0
         GEN=1, 5
        *ELEMENT
         1, 1, 2
         GEN=1, 4
        *ELEMENT SETS
         SET=Flowline
         GEN=1, 4
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=Flowline
         207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        *SEABED STIFFNESS
         CURVE=Clay
         0.0, 0.0
         0.5, 4200.0
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=Clay

    Finds: 23:12
    """
    yield from context.told(SBD009)


@rule(SBD010)
def negative_property(context: LintContext) -> Iterator[Problem]:
    """A stiffness, a friction coefficient, a length or a diameter is negative, or zero where it divides.

    Such a value has no physical meaning: a sign was typed by mistake, or the value stands in the wrong field. The same
    holds for a share above 1, as the floor of CYCLIC= in *SEABED SUCTION. Correct it. Values of equations and of tables
    are looked at too. The geometry of a trench and the stiffness of unloading have rules of their own, EXT003 and
    EXT009.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=-0.3, 0.6

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6

    Finds: 6:11
    """
    for problem in context.told(SBD010):
        if not _told_by_extension(context, problem.where):
            yield problem


def _told_by_extension(context: LintContext, where: Where | None) -> bool:
    """Whether EXT003 or EXT009 tells of the value: the geometry of a trench, the stiffness of unloading."""
    if where is None or len(where.path) < _IN_SET:
        return False
    keyword = context.scene.deck.sections[where.section].blocks[where.block].keyword
    return _OF_EXTENSIONS.get(keyword) == where.path[2]
