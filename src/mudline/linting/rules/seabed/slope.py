"""Slopes and profiles that a bed cannot have, or rarely has."""

from __future__ import annotations

from collections.abc import Iterator

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.surfaces import surfaces

SBD011 = Code("SBD011", "profile-needs-elastic", Severity.ERROR)
SBD012 = Code("SBD012", "steep-slope", Severity.ERROR)

_STEEP = 45.0
_VERTICAL = 90.0


@rule(SBD011)
def profile_needs_elastic(context: LintContext) -> Iterator[Problem]:
    """A rigid seabed has a profile that only an elastic one takes.

    A rigid bed is flat, sloping or a polyline in one plane: nodes are moved back to it along its normal. A surface in
    three dimensions needs TYPE=ELASTIC. Cubic interpolation and DIRECTION= are described for elastic beds only, which
    is a warning (inferred).

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=RIGID
         SET=ALL
         FRICTION=0.3, 0.6
        *SEABED PROFILE
         TYPE=SLOPING
         DIRECTION=30.0
         SLOPE=2.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6
        *SEABED PROFILE
         TYPE=SLOPING
         DIRECTION=30.0
         SLOPE=2.0

    Finds: 8:12
    """
    types = context.scene.laws.types
    if "RIGID" not in types or "ELASTIC" in types:
        return
    for where, profile in context.scene.deck.blocks("SEABED PROFILE"):
        if getattr(profile, "type_", None) == "3D":
            message = "a profile in three dimensions needs an elastic seabed: the seabed is rigid"
            yield Problem(SBD011, message, where=where._replace(path=("type",)))
        if (getattr(profile, "interpolation", None) or "LINEAR") != "LINEAR":
            message = "cubic interpolation needs an elastic seabed (inferred), and the seabed is rigid"
            yield Problem(SBD011, message, None, Severity.WARNING, where._replace(path=("interpolation",)))
        direction = getattr(profile, "direction", None)
        if isinstance(direction, float | int) and abs(direction) > 0.0:
            message = "DIRECTION= needs an elastic seabed (inferred), and the seabed is rigid"
            yield Problem(SBD011, message, None, Severity.WARNING, where._replace(path=("direction",)))


@rule(SBD012)
def steep_slope(context: LintContext) -> Iterator[Problem]:
    """The slope of the bed is steep.

    A slope is an angle in degrees: one of 90 or more is no bed at all, and one above 45 is steeper than soil stands. A
    gradient in percent, typed as degrees, is a common cause. Correct it.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PROFILE
         TYPE=SLOPING
         SLOPE=95.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PROFILE
         TYPE=SLOPING
         SLOPE=2.5

    Finds: 8:8
    """
    for where, slope in _slopes(context):
        if abs(slope) >= _VERTICAL:
            yield Problem(SBD012, f"slope {slope!r}: it must be between -90 and 90 degrees", where=where)
        elif abs(slope) > _STEEP:
            message = f"slope {slope!r} is over 45 degrees, steeper than soil stands: correct it"
            yield Problem(SBD012, message, None, Severity.WARNING, where)


def _slopes(context: LintContext) -> Iterator[tuple[Where, float]]:
    deck = context.scene.deck
    for where, block in (*surfaces(deck), *deck.blocks("SEABED PROFILE")):
        slope = getattr(block, "slope", None)
        if isinstance(slope, float | int):
            yield where._replace(path=("slope",)), float(slope)
