"""Values, names and files at fault: ranges of fields, undefined names, pipes without a wall."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.basics.limits import MOST_REPORTED
from mudline.language.codes.references import REF015
from mudline.language.diagnostics import Blocks, Code, Problem, Severity, Where
from mudline.language.keywords.catalogue import may_have_no_length
from mudline.language.keywords.contents import is_read, range_faults
from mudline.language.rules import rule
from mudline.model.scene.deck_values import missing_files, not_found
from mudline.model.scene.references import THINGS, undefined
from mudline.model.scene.sections import format_of

if TYPE_CHECKING:
    from mudline.language.keywords.library.curvilinear import CurvilinearNodes
    from mudline.language.keywords.library.geometric_sets import GeometricSets
    from mudline.language.keywords.library.tapered_joints import TaperedJoints
    from mudline.language.keywords.model import Part
    from mudline.model.scene.resolved import ResolvedDeck


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
    for where, folder, name in missing_files(scene.context.written):
        message, severity = not_found(folder, name)
        # Without the file of its profile the seabed is not known.
        profile = bool(scene.seabed.missing) and where == scene.seabed.where.inside("file")
        blocks = Blocks.ALWAYS if profile or severity is Severity.ERROR else Blocks.NEVER
        severity = max(severity, Severity.WARNING, key=lambda level: level.rank) if profile else severity
        yield Problem(REF015, message, None, severity, where, blocks=blocks)


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
        (where.inside("sets", index, format_of(entry)), entry.section, (("Di", "do", "di"),))
        for where, block in scene.context.blocks("GEOMETRIC SETS")
        for index, entry in enumerate(cast("GeometricSets", block).sets)
    ]
    for where, block in scene.context.blocks("TAPER"):
        for index, joint in enumerate(cast("TaperedJoints", block).sets):
            bore = ("Doe", "do_end", "di") if joint.section.di_end is None else ("Die", "do_end", "di_end")
            walls.append((where.inside("sets", index, "section"), joint.section, (("Dis", "do", "di"), bore)))
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
    suspects = ~(scene.length > 0.0)
    if not np.count_nonzero(suspects):
        return
    known = np.flatnonzero((scene.element_nodes >= 0).all(axis=1) & suspects)
    first, second = scene.element_nodes[known].T
    same = known[(scene.coordinates[first] == scene.coordinates[second]).all(axis=1)]
    if not same.size:
        return
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


REF019 = Code("REF019", "undefined-name", Severity.ERROR)


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
    cables = {cable.cable for _, block in blocks for cable in block.cables}
    doubt = any(not is_read(block) or scene.deck.lost(where) for where, block in blocks) or scene.context.restart
    for where, block in scene.context.blocks("NODE,CURVILINEAR"):
        for index, entry in enumerate(cast("CurvilinearNodes", block).entries):
            place = where.inside("entries", index)
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
