"""Values, names, files and sections at fault: ranges, undefined names, missing diameters, pipes without a wall."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.references import REF002, REF015, REF019
from mudline.language.deck.parameters import folded
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.catalogue import may_have_no_length
from mudline.language.keywords.contents import is_read, range_faults
from mudline.language.keywords.text import advice_on, shown
from mudline.language.keywords.values import Names, number_meant
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.contact.laws import law_named
from mudline.model.scene.deck_values import missing_files, not_found
from mudline.model.scene.laws import NOTHING
from mudline.model.scene.references import CURVES, THINGS, undefined
from mudline.model.scene.sections import format_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.seabed_properties import ElasticSurface
    from mudline.language.keywords.model import Part
    from mudline.model.scene.resolved import ResolvedDeck


SBD004 = Code("SBD004", "missing-embedment", Severity.ERROR)
SBD009 = Code("SBD009", "missing-diameter", Severity.ERROR)
SBD010 = Code("SBD010", "negative-property", Severity.ERROR)

_GEOMETRY = "geometry"
"""Setting of `*SEABED TRENCH`, the third step of a path to its values; EXT003 reports their faults."""


@rule(SBD010, blocks=True)
def negative_property(scene: ResolvedDeck) -> Iterator[Problem]:
    """A value is out of its range: a stiffness, a length or a diameter is negative, or zero where it divides.

    Such a value has no physical meaning: a sign was typed by mistake, or the value is in the wrong field. The same
    holds for a share above 1, such as the floor of CYCLIC= in *SEABED SUCTION. Correct it. Values of equations and
    of tables are checked too. A deck in JSON or YAML with such a value is refused when it is read, and `convert`
    writes none. The geometry of a trench and the stiffness of unloading have their own rules, EXT003 and EXT009.

    Example on seabed:
          STIFFNESS=50000.0
        - FRICTION=-0.3, 0.6
        + FRICTION=0.3, 0.6

    Finds: 6:11
    """
    for where, _, block in scene.deck.every_block():
        for path, message in range_faults(block):
            if _GEOMETRY not in path[2:3] or block.keyword != "SEABED TRENCH":
                yield Problem(SBD010, message, where=where._replace(path=path))


@rule(REF015, blocks=True)
def missing_file(scene: ResolvedDeck) -> Iterator[Problem]:
    """A file that the deck names was not found.

    Settings such as FILE= of *SEABED PROFILE and LAST= of *RESTART name files next to the deck. If the deck named by
    *RESTART is missing, mudline does not know the model of this deck, and missing definitions are only warnings. The
    finding is also given for a deck that is there and cannot be read, and for decks that continue each other in a
    cycle.

    A file that nothing is computed from is an info if its folder has no other file with its suffix: the deck came
    without its companions. A deck from standard input has no folder, so files are not searched.

    Example on storm:
         $LOAD CASE
        -*RESTART
        - LAST=static

    Finds: 6:7
    """
    for where, folder, name in missing_files(scene.context.written, scene.context.names(Names.FILE).used):
        message, severity = not_found(folder, name)
        # Without the file of its profile the seabed is not known.
        profile = bool(scene.seabed.missing) and where == scene.seabed.where.inside("file")
        blocks = Blocks.ALWAYS if profile or severity is Severity.ERROR else Blocks.NEVER
        severity = max(severity, Severity.WARNING, key=lambda level: level.rank) if profile else severity
        yield Problem(REF015, message, None, severity, where, blocks=blocks)


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
        lacking = getattr(cast("ElasticSurface", block).properties, "stiffness", None) is None
        if lacking and not embedment:
            message = "no stiffness here and no *EMBEDMENT in the model: nothing carries the elements; give a stiffness"
            yield reading.missing(SBD004, message, where, "EMBEDMENT")


GEO001 = Code("GEO001", "inner-exceeds-outer", Severity.ERROR)
GEO004 = Code("GEO004", "zero-length-element", Severity.ERROR)


@rule(GEO001, blocks=True)
def inner_exceeds_outer(scene: ResolvedDeck) -> Iterator[Problem]:
    """The internal diameter of a section is not smaller than its external diameter.

    The pipe has no wall: its mass and stiffness would be zero or negative. The two fields are exchanged, or the wall
    thickness was subtracted from the wrong diameter. Correct Do or Di. Both ends of a *TAPER are compared.

    Example on pipe:
        - 207.0E9, 79.6E9, 0.2889, 0.3239, 7850.0
        + 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 12:27
    """
    walls: list[tuple[Where, Part | None, tuple[tuple[str, str, str], ...]]] = [
        (where.inside(format_of(entry)), entry.section, (("Di", "do", "di"),))
        for where, entry in scene.context.records("GEOMETRIC SETS")
    ]
    for where, joint in scene.context.records("TAPER"):
        bore = ("Doe", "do_end", "di") if joint.section.di_end is None else ("Die", "do_end", "di_end")
        walls.append((where.inside("section"), joint.section, (("Dis", "do", "di"), bore)))
    for where, row, ends in walls:
        for key, outside, inside in ends:
            outer, inner = getattr(row, outside, None), getattr(row, inside, None)
            if isinstance(outer, int | float) and isinstance(inner, int | float) and inner >= outer > 0:
                words = f"internal diameter {inner!r} is not smaller than the external diameter {outer!r}"
                yield Problem(GEO001, f"{words}: correct one", where=where.inside(key))
                break


@rule(GEO004, blocks=True)
def zero_length_element(scene: ResolvedDeck) -> Iterator[Problem]:
    """The two nodes of an element lie at the same place.

    The element has no length and no direction, so it has neither a stiffness nor a share of the seabed. A node was
    copied without changing its coordinates, or two parts that meet have one node each. Correct the node, or join the
    parts at one node. In a model with flex joints, hinges, springs or dampers, which may have no length, this is a
    warning.

    Example on sets:
          GEN=1, 5
        - 6, 12.0, 40.0
        + 6, 12.0, 50.0

          GEN=1, 4
        | 5, 5, 6

    Finds: 10:2
    """
    suspects = (~(scene.length > 0.0)).nonzero()[0]
    if not suspects.size:
        return
    known = suspects[(scene.element_nodes[suspects] >= 0).all(axis=1)]
    first, second = scene.element_nodes[known].T
    same = known[(scene.coordinates[first] == scene.coordinates[second]).all(axis=1)]
    joints = [keyword for keyword in scene.deck.keywords() if may_have_no_length(keyword)]
    hint = f", or keep it if *{min(joints)} makes it one without length" if joints else ""
    reported: set[Where] = set()
    for index in same[: MOST_REPORTED + 1].tolist():
        where = scene.table.numbered.where(index)
        if where in reported:
            continue  # another element of the same GEN=
        reported.add(where)
        start, end = scene.node_ids[scene.element_nodes[index]].tolist()
        nodes = f"both its ends are node {start}" if start == end else f"nodes {start} and {end} lie at one place"
        message = f"element {scene.element_ids[index]} has no length, {nodes}: correct it{hint}"
        yield Problem(GEO004, message, None, Severity.WARNING if joints else None, where)


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
                message = f"{scene.describe(bare)} a {name} and no external diameter"
                yield lacks_diameter(scene, SBD009, message, where.inside("set"))
    missing = np.flatnonzero((scene.law == LawKind.CURVE) & lacking)
    if not missing.size:
        return
    missing = missing[np.argsort(scene.laws.of_element[missing], kind="stable")]
    begins = np.flatnonzero(np.diff(scene.laws.of_element[missing])) + 1
    for elements in np.split(missing, begins):
        index = int(scene.laws.of_element[elements[0]])
        message = f"{scene.describe(elements)} a curve and no external diameter"
        yield lacks_diameter(scene, SBD009, message, scene.laws.set_laws[index].where)


def lacks_diameter(scene: ResolvedDeck, code: Code, message: str, where: Where) -> Problem:
    """Return the problem of an unknown external diameter that a law needs, wherever it may be given."""
    message += ": give Do (or Dd) in *GEOMETRIC SETS"
    if scene.section_table.open:
        message += "; a section belongs to a set whose elements this deck does not show"
        return Problem(code, message, None, Severity.WARNING, where, blocks=Blocks.ALWAYS)
    return replace(scene.context.missing(code, message, where, "GEOMETRIC SETS"), blocks=Blocks.ALWAYS)


@rule(REF019, blocks=True)
def undefined_name(scene: ResolvedDeck) -> Iterator[Problem]:
    """A name is used that the deck does not define: of a vessel, a line, a vector or another object.

    Mostly the name is spelt differently in two places: case is ignored in names, spaces are not. Correct the name, or
    define the object. It is a warning if an unread line, or the deck that *RESTART continues, may define the name.
    Sets, curves, nodes and elements have their own rules. The contact with the seabed does not depend on the name.

    Example:
         $MODEL
         *VESSEL
          VESSEL=FPSO
          INITIAL POSITION=1005.0, 0.0, 0.0
         $LOAD CASE
         *OFFSET
        - VESSEL=FSPO
        + VESSEL=FPSO
          OFFSET=0.0, -8.0, 0.0

    Finds: 7:9
    """
    yield from undefined(scene.context, THINGS, REF019)
    yield from _cables(scene)


def _cables(scene: ResolvedDeck) -> Iterator[Problem]:
    """Yield undefined cables, which have numbers, that nodes lie on."""
    blocks = scene.context.blocks("CABLE")
    cables = {cable.cable for _, cable in scene.context.records("CABLE", "cables")}
    doubt = any(not is_read(block) or scene.deck.lost(where) for where, block in blocks) or scene.context.restart
    for place, entry in scene.context.records("NODE,CURVILINEAR", "entries"):
        if hasattr(entry, "nodes"):
            rows = enumerate(entry.nodes.column(1).tolist())
            used = [(cable, place.inside("nodes", row, 1)) for row, cable in rows]
        else:
            used = [(entry.cable, place.inside("cable"))]
        for cable, at in used:
            if isinstance(cable, int | float) and math.isfinite(cable) and cable not in cables:
                message = f"cable {cable:g} is not defined: define it in *CABLE, or correct the number"
                severity = Severity.WARNING if doubt else None
                yield Problem(REF019, message, None, severity, at, blocks=Blocks.NEVER, lacks=f"{cable:g}")


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
    uses = [use for use in scene.context.names(Names.CURVE).used if folded(use.name) not in names]
    if not uses:
        return
    laws = scene.laws.set_laws
    lost = [index for index, law in enumerate(laws) if law.kind is LawKind.CURVE and law.curve == NOTHING]
    followed = {laws[index].where for index in lost if (scene.laws.of_element == index).any()}
    unused = [name for key, name in names.items() if key not in scene.referenced]
    elsewhere = scene.context.possible_definition("SEABED STIFFNESS")
    unused_hint = f" (did you mean {unused[0]}, which nothing uses?)" if len(unused) == 1 and not elsewhere else ""
    for name, where in ((use.name, use.where) for use in uses):
        hint = scene.context.hint(name, names) or ("" if name[:1].isdigit() else unused_hint)
        number = number_meant(name)
        number = f"if it is a number, write {number}" if number else ""
        advice = advice_on(name) or number or "*SEABED STIFFNESS has no such curve"
        message = f"curve {shown(name)} is not defined{hint}: {advice}"
        problem = scene.context.missing(REF002, message, where, "SEABED STIFFNESS", name)
        yield replace(problem, blocks=Blocks.ALWAYS) if where in followed else problem
