"""The seabed of a model: its type, which laws and keywords need to be elastic, and its shape."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.text import shown
from mudline.language.keywords.values import Names
from mudline.language.rules import rule
from mudline.language.syntax.source import BINARY
from mudline.model.scene.context import records_of
from mudline.model.scene.deck_values import file_name, missing_files, number
from mudline.model.scene.laws import typed_blocks
from mudline.model.scene.seabed import COMPILED, SeabedKind, SeabedShape, made_seabed

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_surface import Plane, SeabedProfile
    from mudline.model.scene.curves import SceneCurve
    from mudline.model.scene.resolved import ResolvedDeck


SBD001 = Code("SBD001", "rigid-with-curve", Severity.ERROR)
SBD002 = Code("SBD002", "two-seabed-types", Severity.ERROR)
SBD003 = Code("SBD003", "missing-type", Severity.ERROR)
SBD005 = Code("SBD005", "embedment-needs-elastic", Severity.ERROR)
EXT001 = Code("EXT001", "extension-needs-elastic", Severity.ERROR)


def extends_rigid(scene: ResolvedDeck) -> bool:
    """Return True if EXT001 reports a rigid seabed: faults of laws that then have no effect are not reported."""
    extension = bool(scene.deck.blocks_with("extension"))
    return extension and "RIGID" in scene.laws.types and "ELASTIC" not in scene.laws.types


@rule(SBD001, blocks=True)
def rigid_with_curve(scene: ResolvedDeck) -> Iterator[Problem]:
    """A rigid seabed has a force-embedment curve, or a value of an elastic seabed.

    Nothing penetrates a rigid seabed, so a curve has no meaning there. It is an error, as either the curve or the type
    is wrong. STIFFNESS= with a number, LATERAL= and SUCTION= have no effect and are a warning. Choose TYPE=ELASTIC, or
    remove the line.

    Example on clay:
        - TYPE=RIGID
        + TYPE=ELASTIC

    Finds: 10:12
    """
    blocks = typed_blocks(scene.context) if "RIGID" in scene.laws.types and not extends_rigid(scene) else ()
    for where, properties, type_ in blocks:
        for place, entry in records_of([(where, properties)]) if type_ == "RIGID" else ():
            suction = entry.suction and entry.suction.stiffness
            for name, value in (("stiffness", entry.stiffness), ("lateral", entry.lateral), ("suction", suction)):
                inner = place.inside(name)
                if isinstance(value, str):
                    message = f"curve {shown(value)} on a rigid seabed: a force-embedment curve needs TYPE=ELASTIC"
                    yield Problem(SBD001, message, where=inner)
                elif value:
                    message = f"{name.upper()}= has no effect on a rigid seabed: it needs TYPE=ELASTIC"
                    yield Problem(SBD001, message, None, Severity.WARNING, inner)


@rule(SBD002, blocks=True)
def two_seabed_types(scene: ResolvedDeck) -> Iterator[Problem]:
    """The model has a rigid and an elastic seabed.

    A model has one of them for all its elements, given by TYPE= or by *RIGID SURFACE and *ELASTIC SURFACE. Usually a
    block was pasted from another deck. Remove one of them; a hard part of an elastic seabed takes a high stiffness.

    Example on seabed:
          STIFFNESS=50000.0
        -*SEABED PROPERTIES
        - TYPE=RIGID
        - SET=ALL

    Finds: 7:7
    """
    places = sorted((where, name) for name, type_places in scene.laws.types.items() for where in type_places)
    where, name = next(((where, name) for where, name in places if name != places[0][1]), (Where(), ""))
    if not name:
        return
    present, earlier = ("a rigid", "an elastic") if name == "RIGID" else ("an elastic", "a rigid")
    message = f"{present} seabed after {earlier} one: a model has one of them; remove the other"
    if where.section == places[0][0].section:
        yield Problem(SBD002, message, where=where)
    else:
        message += " (inferred: the $MODEL sections of a file make one model)"
        yield Problem(SBD002, message, None, Severity.WARNING, where)


@rule(SBD003, blocks=True)
def missing_type(scene: ResolvedDeck) -> Iterator[Problem]:
    """*SEABED PROPERTIES lacks the type of the seabed, rigid or elastic.

    The type has no default: write TYPE=RIGID or TYPE=ELASTIC on the first line. A later block without TYPE= keeps the
    type of the block before it. A SET= that is missing at the beginning is a warning: lines before the first SET=
    are read as SET=ALL (inferred), and so are points of *EMBEDMENT before its first SET=.

    Example on seabed:
        + TYPE=ELASTIC

    Finds: 2:1
    """
    reading, reported = scene.context, False
    for where, properties, type_ in typed_blocks(reading):
        if type_ is None and not reported:
            reported = True
            message = "the type is missing: write TYPE=RIGID or TYPE=ELASTIC as the first line"
            yield Problem(SBD003, message, where=where)
        yield from _without_set(records_of([(where, properties)]), "lines")
    for block in scene.context.blocks("EMBEDMENT"):
        yield from _without_set(records_of([block], "curves"), "points")


def _without_set(records: list[tuple[Where, Any]], what: str) -> Iterator[Problem]:
    for where, record in records[:1]:
        if record.set_name is None:
            message = f"{what} before any SET= are read as those of SET=ALL (inferred): write SET= before them"
            yield Problem(SBD003, message, None, Severity.WARNING, where)


@rule(SBD005, blocks=True)
def embedment_needs_elastic(scene: ResolvedDeck) -> Iterator[Problem]:
    """*EMBEDMENT is used with a rigid seabed, or without a seabed.

    A force-embedment curve gives the penetration of a pipe, so it needs an elastic seabed: *ELASTIC SURFACE, or
    *SEABED PROPERTIES with TYPE=ELASTIC. Choose the elastic seabed, or remove the curves.

    Example:
         $MODEL
        -*RIGID SURFACE
        - 0.3, 0.6
        -*EMBEDMENT
        - SET=ALL
        +*SEABED STIFFNESS
        + CURVE=Clay
          0.0, 0.0
          0.5, 4200.0
        +*SEABED PROPERTIES
        + TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=Clay
        + FRICTION=0.3, 0.6

    Finds: 5:2
    """
    first: dict[tuple[int, int], SceneCurve] = {}
    for curve in scene.laws.curves:
        if curve.embedment:
            first.setdefault((curve.where.section, curve.where.block), curve)
    for curve in first.values() if _lacks_elastic(scene) else ():
        if "RIGID" in scene.laws.types:
            message = "*EMBEDMENT needs an elastic seabed: the seabed is rigid"
            yield Problem(SBD005, message, where=curve.where)
        else:
            message = "*EMBEDMENT needs an elastic seabed: the model has no *ELASTIC SURFACE and no TYPE=ELASTIC"
            yield scene.context.missing(SBD005, message, curve.where, "ELASTIC SURFACE")


def _lacks_elastic(scene: ResolvedDeck) -> bool:
    """Return True if the seabed is rigid, or there is none; False if its type could not be read, or if it is both."""
    types = scene.laws.types
    return "ELASTIC" not in types and (
        "RIGID" in types
        or not ("SEABED PROPERTIES" in scene.deck.keywords() or "SEABED PROPERTIES" in scene.context.misplaced)
    )


@rule(EXT001, blocks=True)
def extension_needs_elastic(scene: ResolvedDeck) -> Iterator[Problem]:
    """An extension keyword is in a model without an elastic seabed.

    The laws of the extensions act on penetration, and nothing penetrates a rigid seabed or a missing one. Write
    *SEABED PROPERTIES with TYPE=ELASTIC, or remove the keyword.

    Example on seabed:
        - TYPE=RIGID
        + TYPE=ELASTIC
          SET=ALL
        + STIFFNESS=50000.0
        | FRICTION=0.3, 0.6
        |*SEABED SUCTION
        | SET=ALL
        | COHESION=5000.0

    Finds: 3:7
    """
    if not _lacks_elastic(scene):
        return
    types = scene.laws.types
    supplier = "" if "RIGID" in types else scene.context.possible_definition("ELASTIC SURFACE")
    what = "the seabed is rigid" if "RIGID" in types else "the model has none"
    blocks = scene.deck.blocks_with("extension")
    names = " and ".join(dict.fromkeys(f"*{block.keyword}" for _, block in blocks))
    for where, _ in blocks[:1]:
        needs = "needs" if len(names.split(" and ")) == 1 else "need"
        message = f"{names} {needs} an elastic seabed, and {what}: write *SEABED PROPERTIES with TYPE=ELASTIC"
        if supplier:
            yield Problem(EXT001, f"{message}; {supplier}", None, Severity.WARNING, where)
        else:
            rigid = (place for place in types.get("RIGID", ()) if place.section < len(scene.deck.own_sections))
            yield Problem(EXT001, message, where=next(rigid, where))


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
        yield from _vertical(SBD012, block, where)
        slope = number(block, "slope")
        if _STEEP < abs(slope) < _VERTICAL:
            message = f"slope {slope!r} is over 45 degrees, steeper than soil can stand: correct it"
            yield Problem(SBD012, message, None, Severity.WARNING, where.inside("slope"))
    if scene.seabed.points.size:
        yield from _exchanged_columns(scene.seabed)


def _vertical(code: Code, part: object, where: Where) -> Iterator[Problem]:
    """Yield a problem of a part whose slope is vertical or overhangs."""
    slope = number(part, "slope")
    if abs(slope) >= _VERTICAL:
        yield Problem(code, f"slope {slope!r}: it must be between -90 and 90 degrees", where=where.inside("slope"))


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
    files = scene.context.names(Names.FILE).used if seabed.unreadable else ()
    missing = {where for where, _, _ in missing_files(scene.context.written, files)}
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
    others = [where for where, _ in scene.context.blocks("SEABED PROFILE")]
    for where, surface in scene.context.surfaces:
        if surface.slope is not None or surface.profile is not None:
            others.append(where)
    if planes and others:
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
    written = scene.context.records("SEABED PLANES", "planes")
    faults = [fault for place, plane in written for fault in _faults_of_plane(plane, place)]
    yield from faults
    planes = scene.seabed.planes
    numbers = (value for plane in planes for value in (*plane.point, plane.slope, plane.direction, *plane.bounds))
    readable = not any(map(math.isnan, numbers))  # other faults of numbers are reported already
    if scene.seabed.kind is SeabedKind.PLANES and not faults and readable and (fault := _fault(scene)):
        yield Problem(EXT007, f"{fault}: correct it", where=scene.seabed.where)
    known: set[str] = set()
    for where, plane in written:
        name = folded(plane.name or "") if where.section < len(scene.deck.own_sections) else ""
        if name and name in known:
            message = f"plane {shown(plane.name)} is already defined: choose another name, or remove one of the two"
            yield Problem(EXT007, message, None, Severity.WARNING, where.inside("name"))
        known.add(name)


def _faults_of_plane(plane: Plane, where: Where) -> Iterator[Problem]:
    lacking = [key for key in ("POINT", "SLOPE") if getattr(plane, key.lower()) is None]
    if lacking:
        names = " and ".join(f"{key}=" for key in lacking)
        yield Problem(EXT007, f"this plane lacks {names}: write it", where=where)
    yield from _vertical(EXT007, plane, where)
    if any(number(plane.bounds, f"{axis}_min") >= number(plane.bounds, f"{axis}_max") for axis in "yz"):
        message = "invalid bounds: the second value must be larger than the first, the fourth larger than the third"
        yield Problem(EXT007, message, where=where.inside("bounds"))


def _fault(scene: ResolvedDeck) -> str:
    """Return the reason why the seabed cannot be made from its numbers, or ""."""
    try:
        made_seabed(scene.seabed)
    except ValueError as error:
        return str(error)
    return ""
