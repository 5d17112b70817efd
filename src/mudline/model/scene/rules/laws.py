"""Seabed types of a model, and the needs of its laws: curves, an elastic seabed, a stiffness, diameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.text import advice_on, shown
from mudline.language.keywords.values import Names, number_meant
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.contact.laws import law_named
from mudline.model.scene.laws import NOTHING, typed_blocks
from mudline.model.scene.references import CURVES, undefined

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_curves import Embedment
    from mudline.language.keywords.library.seabed_properties import ElasticSurface
    from mudline.model.scene.curves import SceneCurve
    from mudline.model.scene.resolved import ResolvedDeck


SBD001 = Code("SBD001", "rigid-with-curve", Severity.ERROR)
SBD002 = Code("SBD002", "two-seabed-types", Severity.ERROR)
SBD003 = Code("SBD003", "missing-type", Severity.ERROR)
SBD004 = Code("SBD004", "missing-embedment", Severity.ERROR)
SBD005 = Code("SBD005", "embedment-needs-elastic", Severity.ERROR)
SBD009 = Code("SBD009", "missing-diameter", Severity.ERROR)


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
        for index, entry in enumerate(properties.sets if type_ == "RIGID" else ()):
            place = where.inside("sets", index)
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
    if len(scene.laws.types) < 2:
        return
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
        for index, entry in enumerate(properties.sets[:1]):
            yield from _without_set(entry.set_name, where.inside("sets", index), "lines")
    for where, block in scene.context.blocks("EMBEDMENT"):
        for index, curve in enumerate(cast("Embedment", block).curves[:1]):
            yield from _without_set(curve.set_name, where.inside("curves", index), "points")


def _without_set(name: str | None, where: Where, what: str) -> Iterator[Problem]:
    if name is None:
        message = f"{what} before any SET= are read as those of SET=ALL (inferred): write SET= before them"
        yield Problem(SBD003, message, None, Severity.WARNING, where)


@rule(SBD004, blocks=True)
def missing_embedment(scene: ResolvedDeck) -> Iterator[Problem]:
    """*ELASTIC SURFACE gives no stiffness, and there is no *EMBEDMENT.

    The first field of *ELASTIC SURFACE may be empty only if curves of *EMBEDMENT carry the elements. Otherwise nothing
    holds them vertically, and a static run has no solution. Give a stiffness, here or with the newer keywords.

    Example:
         $MODEL
        -*ELASTIC SURFACE
        - , 0.3, 0.6
        +*SEABED PROPERTIES
        + TYPE=ELASTIC
        + SET=ALL
        + STIFFNESS=50000.0
        + FRICTION=0.3, 0.6

    Finds: 2:1
    """
    reading = scene.context
    embedment = any(curve.embedment for curve in scene.laws.curves) or "EMBEDMENT" in reading.unread
    for where, block in scene.context.blocks("ELASTIC SURFACE"):
        properties = cast("ElasticSurface", block).properties
        lacking = getattr(properties, "stiffness", None) is None
        if lacking and not embedment:
            message = "no stiffness here and no *EMBEDMENT in the model: nothing carries the elements; give a stiffness"
            yield reading.missing(SBD004, message, where, "EMBEDMENT")


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
    if not first:
        return
    reading, types = scene.context, scene.laws.types
    unread = "SEABED PROPERTIES" in scene.deck.keywords() or "SEABED PROPERTIES" in reading.misplaced
    if "RIGID" not in types and ("ELASTIC" in types or unread):
        return  # a type that could not be read is reported elsewhere
    for curve in first.values():
        if "RIGID" in types and "ELASTIC" in types:
            continue  # SBD002 reports both, and which of them is meant is open
        if "RIGID" in types:
            message = "*EMBEDMENT needs an elastic seabed: the seabed is rigid"
            yield Problem(SBD005, message, where=curve.where)
        else:
            message = "*EMBEDMENT needs an elastic seabed: the model has no *ELASTIC SURFACE and no TYPE=ELASTIC"
            yield reading.missing(SBD005, message, curve.where, "ELASTIC SURFACE")


@rule(SBD009, blocks=True)
def missing_diameter(scene: ResolvedDeck) -> Iterator[Problem]:
    """Elements follow a force-embedment curve and have no external diameter.

    The embedment ratio is a depth divided by the external diameter: without a diameter there is no ratio, and no force.
    The diameter is Do of *GEOMETRIC SETS, or for OPTION=FLEXIBLE without Do the drag diameter Dd, and it must not be 0.
    Give the elements a section, or put them into a set that has one.

    Example on clay:
         $MODEL
        |*NODE
        | 1, -0.05, 0.0
        | 5, -0.05, 40.0
        | GEN=1, 5
        |*ELEMENT
        | 1, 1, 2
        | GEN=1, 4
        |*ELEMENT SETS
        | SET=Flowline
        - GEN=1, 3
        + GEN=1, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=Flowline
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 24:12
    """
    if not scene.replaced and all(set_law.kind is not LawKind.CURVE for set_law in scene.laws.set_laws):
        return
    sections = scene.section_table
    lacking = np.isnan(sections.diameter) & ~sections.faulty
    holders = (scene.set_table.find(section.name) for section in sections.sections)
    if not np.count_nonzero(lacking) or any(holder.faulty for holder in holders if holder):
        return
    for kind, _, extension, _ in scene.replaced:
        name = kind.name.lower()
        for index, where in enumerate(extension.places) if law_named(name).needs_diameter else ():
            bare = np.flatnonzero((scene.law == kind) & lacking & (extension.of_element == index))
            if bare.size:
                what = f"a {name} and no external diameter: give Do (or Dd) in *GEOMETRIC SETS"
                yield lacks_diameter(scene, SBD009, f"{scene.describe(bare)} {what}", where.inside("set"))
    missing = np.flatnonzero((scene.law == LawKind.CURVE) & lacking)
    if not missing.size:
        return
    missing = missing[np.argsort(scene.laws.of_element[missing], kind="stable")]
    begins = np.flatnonzero(np.diff(scene.laws.of_element[missing])) + 1
    for elements in np.split(missing, begins):
        index = int(scene.laws.of_element[elements[0]])
        message = f"{scene.describe(elements)} a curve and no external diameter: give Do (or Dd) in *GEOMETRIC SETS"
        yield lacks_diameter(scene, SBD009, message, scene.laws.set_laws[index].where)


def lacks_diameter(scene: ResolvedDeck, code: Code, message: str, where: Where) -> Problem:
    """Return the problem of an unknown external diameter that a law needs, wherever it may be given."""
    if scene.section_table.open:
        message += "; a section belongs to a set whose elements this deck does not show"
        return Problem(code, message, None, Severity.WARNING, where, blocks=Blocks.ALWAYS)
    return replace(scene.context.missing(code, message, where, "GEOMETRIC SETS"), blocks=Blocks.ALWAYS)


REF002 = Code("REF002", "undefined-curve", Severity.ERROR)


@rule(REF002, blocks=True)
def undefined_curve(scene: ResolvedDeck) -> Iterator[Problem]:
    """STIFFNESS=, or another setting that takes a curve, names a curve that the deck does not define.

    The elements of the set then have no seabed. A STIFFNESS= that is not a number is taken for the name of a curve, so
    a slip in a number is reported here too. Define the curve in *SEABED STIFFNESS, or correct the name. It is a warning
    if an unread line may define the curve. The curves of *MOMENT-CURVATURE, *FORCE-STRAIN and the like are looked up in
    the same way; the contact with the seabed does not depend on them.

    Example on clay:
        - STIFFNESS=Caly
        + STIFFNESS=Clay

    Finds: 10:12
    """
    yield from undefined(scene.context, CURVES, REF002)
    names = {folded(curve.name): curve.name for curve in scene.laws.curves if curve.name and not curve.embedment}
    if names.keys() >= scene.referenced:
        return
    laws = scene.laws.set_laws
    lost = [index for index, law in enumerate(laws) if law.kind is LawKind.CURVE and law.curve == NOTHING]
    followed = {laws[index].where for index in lost if (scene.laws.of_element == index).any()}
    unused = [name for key, name in names.items() if key not in scene.referenced]
    elsewhere = scene.context.possible_definition("SEABED STIFFNESS")
    unused_hint = f" (did you mean {unused[0]}, which nothing uses?)" if len(unused) == 1 and not elsewhere else ""
    for name, where in ((use.name, use.where) for use in scene.context.names[Names.CURVE].used):
        if folded(name) in names:
            continue
        hint = scene.context.hint(name, names) or ("" if name[:1].isdigit() else unused_hint)
        number = number_meant(name)
        number = f"if it is a number, write {number}" if number else ""
        advice = advice_on(name) or number or "*SEABED STIFFNESS has no such curve"
        message = f"curve {shown(name)} is not defined{hint}: {advice}"
        problem = scene.context.missing(REF002, message, where, "SEABED STIFFNESS", name)
        yield replace(problem, blocks=Blocks.ALWAYS) if where in followed else problem
