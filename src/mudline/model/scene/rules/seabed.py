"""The shape of the seabed: slopes, profiles, planes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Blocks, Code, Problem, Severity
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.language.syntax.source import BINARY
from mudline.model.scene.deck_values import file_name, missing_files, number
from mudline.model.scene.seabed import COMPILED, SeabedKind, SeabedShape, made_seabed

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_surface import SeabedPlanes, SeabedProfile
    from mudline.model.scene.resolved import ResolvedDeck


SBD011 = Code("SBD011", "profile-needs-elastic", Severity.ERROR)
SBD012 = Code("SBD012", "steep-slope", Severity.ERROR)
SBD023 = Code("SBD023", "unreadable-profile", Severity.INFO)
EXT002 = Code("EXT002", "floor-conflict", Severity.ERROR)
EXT007 = Code("EXT007", "bad-plane", Severity.ERROR)

_STEEP = 45.0
_VERTICAL = 90.0


@rule(SBD011, blocks=True)
def profile_needs_elastic(scene: ResolvedDeck) -> Iterator[Problem]:
    """A rigid seabed has a profile that only an elastic seabed may have.

    A rigid seabed is flat, sloping or a polyline in one plane: nodes are moved back to it along its normal. A surface
    in three dimensions needs TYPE=ELASTIC. Cubic interpolation and DIRECTION= are described for elastic seabeds
    only; on a rigid one they are a warning (inferred).

    Example on seabed:
        - TYPE=RIGID
        + TYPE=ELASTIC
          SET=ALL
        + STIFFNESS=50000.0
        | FRICTION=0.3, 0.6
        |*SEABED PROFILE
        | TYPE=SLOPING
        | DIRECTION=30.0
        | SLOPE=2.0

    Finds: 8:12
    """
    types = scene.laws.types
    if "RIGID" not in types or "ELASTIC" in types:
        return
    for where, profile in scene.context.blocks("SEABED PROFILE"):
        if getattr(profile, "type_", None) == "3D":
            message = "a profile in three dimensions needs an elastic seabed: the seabed is rigid"
            yield Problem(SBD011, message, where=where.inside("type"))
        if (getattr(profile, "interpolation", None) or "LINEAR") != "LINEAR":
            message = "cubic interpolation needs an elastic seabed (inferred), and the seabed is rigid"
            yield Problem(SBD011, message, None, Severity.WARNING, where.inside("interpolation"))
        if abs(number(profile, "direction")) > 0.0:
            message = "DIRECTION= needs an elastic seabed (inferred), and the seabed is rigid"
            yield Problem(SBD011, message, None, Severity.WARNING, where.inside("direction"))


@rule(SBD012, blocks=True)
def steep_slope(scene: ResolvedDeck) -> Iterator[Problem]:
    """The slope of the seabed is steep.

    A slope is an angle in degrees: 90 or more is not a seabed, and more than 45 is steeper than soil can stand. Often a
    gradient in percent was typed as degrees. Correct it. A profile that rises by more than its whole width most
    likely has its columns exchanged: 2D has Y and elevation, 3D has elevation, Y and Z.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED PROFILE
        | TYPE=SLOPING
        - SLOPE=95.0
        + SLOPE=2.5

    Finds: 8:8
    """
    for where, block in (*scene.context.surfaces, *scene.context.blocks("SEABED PROFILE")):
        slope, place = number(block, "slope"), where.inside("slope")
        if abs(slope) >= _VERTICAL:
            message = f"slope {slope!r}: it must be between -90 and 90 degrees"
            yield Problem(SBD012, message, where=place)
        elif abs(slope) > _STEEP:
            message = f"slope {slope!r} is over 45 degrees, steeper than soil can stand: correct it"
            yield Problem(SBD012, message, None, Severity.WARNING, place)
    if scene.seabed.points.size:
        yield from _exchanged_columns(scene.seabed)


def _exchanged_columns(floor: SeabedShape) -> Iterator[Problem]:
    """Yield a problem of a profile or surface that is higher than it is wide."""
    extents = np.ptp(floor.points, axis=0)
    surface = floor.kind is SeabedKind.SURFACE
    rise, *sides = extents if surface else extents[::-1]
    if rise > math.hypot(*sides):
        form, wide = ("elevation, Y, Z", "wide") if surface else ("Y, elevation", "wide in Y")
        message = (
            f"the profile rises by {rise:.5g} and is {math.hypot(*sides):.5g} {wide}, steeper than soil can stand: "
            f"are its columns exchanged? expected `{form}` for each point"
        )
        yield Problem(SBD012, message, None, Severity.WARNING, floor.where)


@rule(SBD023, blocks=True)
def unreadable_profile(scene: ResolvedDeck) -> Iterator[Problem]:
    """The profile of the seabed cannot be read, or its points do not form a seabed.

    A compiled file (.fcsbd) of *SEABED PROFILE is binary, and its format is not public: the seabed is not known, and
    the deck cannot be evaluated. A linear profile may be a text file instead, with a line `Y, elevation` for each
    point. If its lines cannot be read, the finding is a warning and names the first faulty line. Any binary file is an
    info. Points that do not form a seabed, such as a single point or two elevations at one Y, are an error. A missing
    file is only reported as REF015.

    Example:
         $MODEL
        -*ELASTIC SURFACE
        - 50000.0, 0.3, 0.6
        - 0.0, 0.0
        - 0.0, 1.0
        +*SEABED PROFILE
        + TYPE=SLOPING
        + SLOPE=1.5

    Finds: 4:2
    """
    seabed = scene.seabed
    missing = {where for where, _, _ in missing_files(scene.context.written)} if seabed.unreadable else set()
    for where, message in seabed.unreadable:
        if where in missing:
            continue
        used = bool(seabed.missing) and (where.section, where.block) == (seabed.where.section, seabed.where.block)
        profile = cast("SeabedProfile", scene.deck.sections[where.section].blocks[where.block])
        compiled = file_name(profile.file or "").lower().endswith(COMPILED)
        severity = Severity.INFO if compiled or BINARY in message else Severity.WARNING
        yield Problem(SBD023, message, None, severity, where, blocks=Blocks.ALWAYS if used else Blocks.NEVER)
    known = seabed.kind is SeabedKind.PROFILE and not seabed.missing and not np.isnan(seabed.points).any()
    if known and (fault := _fault(scene)):
        where = seabed.where.inside("file") if seabed.file else seabed.where
        yield Problem(SBD023, f"{fault}: correct the points", None, Severity.ERROR, where)


@rule(EXT002, blocks=True)
def floor_conflict(scene: ResolvedDeck) -> Iterator[Problem]:
    """The seabed is given twice: by planes and by a profile or a slope.

    *SEABED PLANES describes the whole seabed, and so does *SEABED PROFILE or the slope of a legacy surface. It is not
    defined which of them the pipe lies on. Keep one of them.

    Example on seabed:
          STIFFNESS=50000.0
        -*SEABED PROFILE
        - TYPE=SLOPING
        - SLOPE=2.0
        |*SEABED PLANES
        | PLANE=shelf
        | POINT=0.0, 0.0, 0.0
        | SLOPE=2.0

    Finds: 9:1
    """
    deck = scene.deck
    planes = [where for where, _ in scene.context.blocks("SEABED PLANES")]
    if not planes:
        return
    others = [where for where, _ in scene.context.blocks("SEABED PROFILE")]
    for where, surface in scene.context.surfaces:
        if surface.slope is not None or surface.profile is not None:
            others.append(where)
    if others:
        places = [place for place in (planes[0], min(others)) if place.section < len(deck.own_sections)]
        message = "the seabed is given by *SEABED PLANES and by a profile or slope too: remove one of them"
        yield Problem(EXT002, message, where=max(places, default=planes[0]))


@rule(EXT007, blocks=True)
def bad_plane(scene: ResolvedDeck) -> Iterator[Problem]:
    """A plane of the seabed is incomplete, vertical or empty.

    A plane is a point and a slope, in degrees between -90 and 90. The smaller value of its bounds comes first. Give the
    missing values, or correct them. Two planes with the same name are a warning: names only help readers, and are
    case-insensitive.

    Example on seabed:
          STIFFNESS=50000.0
        |*SEABED PLANES
        | PLANE=shelf
        | POINT=0.0, 0.0, 0.0
        | SLOPE=2.0
        - BOUNDS=900.0, 200.0, -500.0, 500.0
        + BOUNDS=200.0, 900.0, -500.0, 500.0

    Finds: 10:2
    """
    faults = list(_faulty_planes(scene))
    yield from faults
    if scene.seabed.kind is SeabedKind.PLANES and not faults and _known_planes(scene) and (fault := _fault(scene)):
        yield Problem(EXT007, f"{fault}: correct it", where=scene.seabed.where)
    yield from _repeated(scene)


def _faulty_planes(scene: ResolvedDeck) -> Iterator[Problem]:
    for where, block in scene.context.blocks("SEABED PLANES"):
        for index, plane in enumerate(cast("SeabedPlanes", block).planes):
            place = where.inside("planes", index)
            lacking = [key for key in ("POINT", "SLOPE") if getattr(plane, key.lower()) is None]
            if lacking:
                names = " and ".join(f"{key}=" for key in lacking)
                yield Problem(EXT007, f"this plane lacks {names}: write it", where=place)
            slope = number(plane, "slope")
            if abs(slope) >= _VERTICAL:
                message = f"slope {slope!r}: it must be between -90 and 90 degrees"
                yield Problem(EXT007, message, where=place.inside("slope"))
            if any(number(plane.bounds, f"{axis}_min") >= number(plane.bounds, f"{axis}_max") for axis in "yz"):
                message = (
                    "invalid bounds: the second value must be larger than the first, the fourth larger than the third"
                )
                yield Problem(EXT007, message, where=place.inside("bounds"))


def _known_planes(scene: ResolvedDeck) -> bool:
    """Return True if all numbers of planes could be read; other faults are reported already."""
    numbers = (
        value for plane in scene.seabed.planes for value in (*plane.point, plane.slope, plane.direction, *plane.bounds)
    )
    return not any(map(math.isnan, numbers))


def _repeated(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield planes of the deck itself with the name of an earlier plane."""
    known: set[str] = set()
    for where, block in scene.context.blocks("SEABED PLANES"):
        if where.section >= len(scene.deck.own_sections):
            continue
        for index, plane in enumerate(cast("SeabedPlanes", block).planes):
            name = folded(cast("str | None", plane.name) or "")
            if name and name in known:
                message = f"plane {shown(plane.name)} is already defined: choose another name, or remove one of the two"
                place = where.inside("planes", index, "name")
                yield Problem(EXT007, message, None, Severity.WARNING, place)
            known.add(name)


def _fault(scene: ResolvedDeck) -> str:
    """Return the reason why the seabed cannot be made from its numbers, or ""."""
    try:
        made_seabed(scene.seabed)
    except ValueError as error:
        return str(error)
    return ""
