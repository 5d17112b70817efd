"""The bed that extension keywords need, and the one that planes make."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING, cast

from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.text import shown
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.context import MOST_TOLD
from mudline.scene.surfaces import surfaces

if TYPE_CHECKING:
    from mudline.keywords.library.seabed_planes import PlaneBounds, SeabedPlanes

EXT001 = Code("EXT001", "extension-needs-elastic", Severity.ERROR)
EXT002 = Code("EXT002", "floor-conflict", Severity.ERROR)
EXT007 = Code("EXT007", "bad-plane", Severity.ERROR)

_VERTICAL = 90.0


@rule(EXT001)
def extension_needs_elastic(context: LintContext) -> Iterator[Problem]:
    """An extension keyword stands in a model without an elastic seabed.

    The laws of the extensions act on penetration, and nothing penetrates a rigid seabed or none at all. Write
    *SEABED PROPERTIES with TYPE=ELASTIC, or remove the keyword.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=RIGID
         SET=ALL
         FRICTION=0.3, 0.6
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
         FRICTION=0.3, 0.6
        *SEABED SUCTION
         SET=ALL
         COHESION=5000.0

    Finds: 6:1
    """
    scene = context.scene
    reading, types = scene.context, scene.laws.types
    unclear = "SEABED PROPERTIES" in scene.deck.keywords() or reading.astray("SEABED PROPERTIES")
    if "ELASTIC" in types or (unclear and "RIGID" not in types):
        return
    supplier = "" if "RIGID" in types else reading.supplier("ELASTIC SURFACE")
    what = "the seabed is rigid" if "RIGID" in types else "the model has none"
    for where, block in scene.deck.blocks_that(lambda declared: declared.facts.extension):
        message = f"*{block.keyword} needs an elastic seabed, and {what}: write *SEABED PROPERTIES with TYPE=ELASTIC"
        if supplier:
            yield Problem(EXT001, f"{message}; {supplier}", None, Severity.WARNING, where)
        else:
            yield Problem(EXT001, message, where=where)


@rule(EXT002)
def floor_conflict(context: LintContext) -> Iterator[Problem]:
    """The bed is given twice: by planes and by a profile or a slope.

    *SEABED PLANES describes the whole sea floor, and so does *SEABED PROFILE or the slope of a legacy surface. Which of
    them the pipe lies on would be a guess. Keep one of them.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PROFILE
         TYPE=SLOPING
         SLOPE=2.0
        *SEABED PLANES
         PLANE=shelf
         POINT=0.0, 0.0, 0.0
         SLOPE=2.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PLANES
         PLANE=shelf
         POINT=0.0, 0.0, 0.0
         SLOPE=2.0

    Finds: 9:1
    """
    deck = context.scene.deck
    planes = [where for where, _ in deck.blocks("SEABED PLANES")]
    others = [where for where, _ in deck.blocks("SEABED PROFILE")]
    for where, surface in surfaces(deck):
        if surface.slope is not None or surface.profile is not None:
            others.append(where)
    if planes and others:
        places = [place for place in (planes[0], min(others)) if place.section < len(deck.own_sections)]
        message = "the bed is given by *SEABED PLANES and by a profile or slope too: remove one of them"
        yield Problem(EXT002, message, where=max(places, default=planes[0]))


@rule(EXT007)
def bad_plane(context: LintContext) -> Iterator[Problem]:
    """A plane of the sea floor is incomplete, vertical or empty.

    A plane is a point and a slope, in degrees between -90 and 90; its bounds must hold some ground, the smaller value
    first. Give what is missing. Two planes of one name are a warning: names are for readers, and case does not count in
    them.

    Bad:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PLANES
         PLANE=shelf
         POINT=0.0, 0.0, 0.0
         SLOPE=2.0
         BOUNDS=900.0, 200.0, -500.0, 500.0

    Good:
        $MODEL
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=ALL
         STIFFNESS=50000.0
        *SEABED PLANES
         PLANE=shelf
         POINT=0.0, 0.0, 0.0
         SLOPE=2.0
         BOUNDS=200.0, 900.0, -500.0, 500.0

    Finds: 10:2
    """
    yield from islice(_bad(context), MOST_TOLD)
    yield from islice(_repeated(context), MOST_TOLD)


def _bad(context: LintContext) -> Iterator[Problem]:
    """Planes that are no ground."""
    for where, block in context.scene.deck.blocks("SEABED PLANES"):
        for index, plane in enumerate(block.planes):
            place = where._replace(path=("planes", index))
            lacking = [key for key in ("POINT", "SLOPE") if getattr(plane, key.lower(), None) is None]
            if lacking and not context.scene.context.disturbed(place):
                names = " and ".join(f"{key}=" for key in lacking)
                yield Problem(EXT007, f"this plane lacks {names}: give it", where=place)
            slope = getattr(plane, "slope", None)
            if isinstance(slope, float | int) and abs(slope) >= _VERTICAL:
                message = f"slope {slope!r}: it must be between -90 and 90 degrees"
                yield Problem(EXT007, message, where=place._replace(path=(*place.path, "slope")))
            if _is_empty(getattr(plane, "bounds", None)):
                message = "the bounds hold no ground: the smaller value must come first, and the two must differ"
                yield Problem(EXT007, message, where=place._replace(path=(*place.path, "bounds")))


def _repeated(context: LintContext) -> Iterator[Problem]:
    """Planes of the deck itself with the name of an earlier one."""
    known: set[str] = set()
    for where, block in context.deck.blocks("SEABED PLANES"):
        for index, plane in enumerate(cast("SeabedPlanes", block).planes):
            name = folded(cast("str | None", plane.name) or "")
            if name and name in known:
                message = f"there is a plane {shown(plane.name)} already: choose another name, or remove one of the two"
                place = where._replace(path=("planes", index, "name"))
                yield Problem(EXT007, message, None, Severity.WARNING, place)
            known.add(name)


def _is_empty(bounds: PlaneBounds | None) -> bool:
    pairs = [(getattr(bounds, f"{axis}_min", None), getattr(bounds, f"{axis}_max", None)) for axis in "yz"]
    return any(
        isinstance(low, float | int) and isinstance(high, float | int) and cast("float", low) >= cast("float", high)
        for low, high in pairs
    )
