"""Sections of pipes, and where the line lies."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.codes.contact import GEO005
from mudline.contact.input import LawKind
from mudline.deck.model import Opaque
from mudline.deck.parameters import folded
from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.keywords.text import shown
from mudline.linting.rule import LintContext, limited, rule
from mudline.linting.rules.seabed_position import bounds_of, depths
from mudline.scene.deck_values import number
from mudline.scene.numbering import Floats, Mask, blocks_of
from mudline.scene.sections import Section, format_of
from mudline.scene.sets import set_key
from mudline.scene.vertical_axis import FLAT, NEAR

if TYPE_CHECKING:
    from mudline.keywords.library.geometric_sets import GeometricSet, GeometricSets
    from mudline.scene.model import Scene

GEO002 = Code("GEO002", "number-and-curve", Severity.WARNING)
GEO003 = Code("GEO003", "drag-diameter-assumed", Severity.INFO)
GEO006 = Code("GEO006", "repeated-section", Severity.WARNING)

HIGHEST = 100.0
"""Diameters above the seabed: a line that lies level does not hang there."""
LEVEL = 0.1
"""Rise to length, along the ground, of a line that lies level."""

_BENDING = ("eiyy", "eizz")
_CURVES = {
    "eiyy_curve": ("EIYY", ("eiyy",)),
    "eizz_curve": ("EIZZ", ("eizz",)),
    "gj_curve": ("GJ", ("gj",)),
    "ea_curve": ("EA", ("ea",)),
    "ei_curve": ("EI", _BENDING),
    "hysteresis_curve": ("EI_HYSTERESIS", _BENDING),
    "e_curve": ("E", ("e",)),
}
"""Which numbers of the property line a curve replaces, and the setting that names the curve."""
_NAMES = {"eiyy": "EIyy", "eizz": "EIzz", "gj": "GJ", "ea": "EA", "e": "E"}


@rule(GEO005)
def not_on_the_seabed(context: LintContext) -> Iterator[Problem]:
    """The line cannot reach the seabed, or lies as if Z were vertical.

    X is vertical in a deck, and 0 at the mudline. Nodes with another datum, or with the height as their last
    coordinate, never touch the seabed, or all of them do. Correct the coordinates. As the static solution of a deck may
    start above the seabed, and a riser or a jumper may hang there for good, only these are reported, all of them for
    the elements with a seabed law:

    * every node lies above the sea surface (*OCEAN gives the depth);
    * the line lies level over 100 diameters above the seabed: it rises by less than a tenth of its length, or its
      lowest four nodes or more have one height;
    * Z goes from 0 to the depth, or from the depth below 0 to 0, within 5 % of the depth, and every node has the same X
      within 1 % of the depth; or, from 0, three nodes or more lie within a diameter of Z = 0, and only one of X = 0.

    Nothing is reported where elements come from lines or from another deck, where the shape of the seabed is not known,
    or in models with soil curves.

    Example:
         $MODEL
         *OCEAN
          420.0, 1025.0, 9.81
         *NODE
        - 1, 420.0, 0.0
        - 5, 420.0, 40.0
        + 1, -0.01, 0.0
        + 5, -0.01, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *GEOMETRIC SETS
          OPTION=RIGID
          SET=ALL
          207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0

    Finds: 5:2
    """
    scene = context.scene
    if scene.context.external_definers or scene.context.restart or context.in_soil or _is_low(context):
        return
    if (line := _line(context)) is not None and (message := _above(line) or _along_z(line)):
        lowest = int(np.where(line.used, context.once(depths), -np.inf).argmax())
        message = message.format(node=f"node {scene.node_ids[lowest]}")
        yield Problem(GEO005, message, where=scene.nodes.where(lowest))


_WITH_SECTIONS = {"HYDRODYNAMIC SETS", "PIP SECTION"}
"""Keywords that name sets whose sections are given elsewhere."""


class _Line(NamedTuple):
    """What is known of the nodes (n,) that belong to elements with a seabed law.

    Smallest and largest coordinates and heights above the seabed, the largest diameter, the water depth; NaN where a
    value is not known.
    """

    used: Mask
    x: tuple[float, float]
    y: tuple[float, float]
    z: tuple[float, float]
    heights: tuple[float, float]
    diameter: float
    depth: float
    flat: tuple[int, int]
    """Nodes within a diameter of X = 0, and of Z = 0."""
    level: int
    """Nodes as low as the lowest one."""


LAID = 3
"""Nodes of a line that lie on the seabed."""
ROUNDED = 1e-3
"""Diameters by which nodes on one level may differ."""


def _is_low(context: LintContext) -> bool:
    """Whether no line can be reported, as every node lies near the seabed and Z does not span the depth."""
    bounds, depth = context.once(bounds_of), _water_depth(context)
    if not bounds.highest <= HIGHEST * bounds.thinnest:
        return False
    return not depth > 0.0 or (bounds.highest <= depth and bounds.last - bounds.first < (1.0 - 2.0 * NEAR) * depth)


def _water_depth(context: LintContext) -> float:
    """The depth that the last *OCEAN gives, NaN without any."""
    oceans = context.blocks("OCEAN")
    return number(oceans[-1][1], "depth") if oceans else math.nan


def _line(context: LintContext) -> _Line | None:
    """The line, None where nothing is known of it."""
    scene = context.scene
    used = np.zeros(len(scene.node_ids), dtype=np.bool_)
    for block in blocks_of(len(scene.element_ids)):
        ends = scene.element_nodes[block][scene.law[block] != LawKind.NONE]
        if (ends < 0).any():
            return None
        used[ends] = True
    if not used.any():
        return None
    deepest, highest = _extent(context.once(depths), used)[::-1]
    x, y, z = (_extent(axis, used) for axis in scene.coordinates.T)
    diameter = float(np.fmax.reduce(scene.diameter, initial=np.nan, where=scene.law != LawKind.NONE))
    with np.errstate(invalid="ignore"):
        near = np.abs(scene.coordinates[used]) <= diameter
    flat = int(near[:, 0].sum()), int(near[:, 2].sum())
    level = int((context.once(depths)[used] >= deepest - ROUNDED * diameter).sum())
    return _Line(used, x, y, z, (-deepest, -highest), diameter, _water_depth(context), flat, level)


def _extent(values: Floats, used: Mask) -> tuple[float, float]:
    """The smallest and the largest of the values in use, NaN with a NaN among them."""
    return float(values.min(where=used, initial=np.inf)), float(values.max(where=used, initial=-np.inf))


def _above(line: _Line) -> str:
    """What is wrong with a line that hangs above the seabed, or ""."""
    lowest, highest = line.heights
    if lowest > line.depth > 0.0:
        return (
            f"the lowest {{node}} lies {lowest:.5g} above the seabed, in water {line.depth:.5g} deep: correct the "
            "datum of X, which is 0 at the mudline"
        )
    length = math.hypot(line.y[1] - line.y[0], line.z[1] - line.z[0])
    level = highest - lowest < LEVEL * length
    if (level or line.level > LAID) and lowest > HIGHEST * line.diameter:
        what = "the line lies level, its lowest {node}" if level else "the lowest nodes lie level, {node}"
        what = f"{what} {lowest:.5g} above the seabed (over 100 diameters)"
        return f"{what}: correct the datum of X, which is 0 at the mudline"
    return ""


def _along_z(line: _Line) -> str:
    """What is wrong with a line whose last coordinate is its height, or ""."""
    near = NEAR * line.depth
    first, last = line.z
    upright = abs(last - first - line.depth) <= near and (abs(first) <= near or abs(last) <= near)
    turned = abs(first) <= near and line.flat[0] <= 1 and line.flat[1] >= LAID
    if line.depth > 0.0 and upright and turned and line.x[1] - line.x[0] > FLAT * line.depth:
        return (
            f"Z goes from {first:.5g} to {last:.5g}, and {line.flat[1]} nodes lie within a diameter of 0 in Z and "
            f"{line.flat[0]} in X, as if Z were the height: write the height as X, the first coordinate"
        )
    if line.depth > 0.0 and line.x[1] - line.x[0] <= FLAT * line.depth and upright:
        return (
            f"X is the same at all nodes and Z goes from {first:.5g} to {last:.5g}, as if it were the height: write "
            "the height as X, the first coordinate"
        )
    return ""


def section_entries(blocks: Iterable[tuple[Where, GeometricSets]]) -> Iterator[tuple[Where, GeometricSet]]:
    """Every entry of some blocks of *GEOMETRIC SETS with its place."""
    for where, block in blocks:
        for index, entry in enumerate(block.sets):
            yield where.inside("sets", index), entry


@rule(GEO002)
@limited
def number_and_curve(context: LintContext) -> Iterator[Problem]:
    """A stiffness is given twice: as a number, and by a curve.

    Where SET= names a curve of the non-linear stiffness, its number on the property line is to be left empty. With both
    it is not clear which one a run uses. Leave the field empty, or remove the curve.

    Example:
         $MODEL
         *GEOMETRIC SETS
          OPTION=FLEXIBLE
          SET=ALL, EI=Bend Stiffener
        - 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429
        + , , 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3429, 0.3429, 0.3429

    Finds: 5:2
    """
    for where, entry in section_entries(context.written("GEOMETRIC SETS")):
        if entry.mooring is not None:
            continue  # its format has no field for a curve, and EA must be given
        for curve, (key, numbers) in _CURVES.items():
            if getattr(entry, curve) is None:
                continue
            if given := [name for name in numbers if getattr(entry.section, name, None) is not None]:
                names = " and ".join(_NAMES[name] for name in given)
                message = f"{names} is given as a number, and {key}= names a curve for it: remove one of them"
                place = where.inside(format_of(entry), _NAMES[given[0]])
                yield Problem(GEO002, message, where=place)


@rule(GEO003)
def drag_diameter_assumed(context: LintContext) -> Iterator[Problem]:
    """A flexible section under a force-embedment curve has no Do: the drag diameter Dd is used.

    The embedment ratio is a depth divided by the external diameter, so the stiffness of the seabed depends on it. The
    drag diameter is often larger, as it takes in marine growth, fairings or strakes. Give Do, the last field but one of
    the property line.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0
          5, -0.05, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *GEOMETRIC SETS
          OPTION=FLEXIBLE
          SET=ALL
        - 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429
        + 23.5E3, 23.5E3, 1.2E6, 480.0E6, 92.0, 0.9, 0.2032, 0.3910, 0.3429, 0.3429
         *SEABED STIFFNESS
          CURVE=Clay
          0.0, 0.0
          0.5, 4200.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=Clay

    Finds: 12:53
    """
    scene = context.scene
    table = scene.section_table
    if all(section.source != "Dd" for section in table.sections):
        return
    on_curve = table.of_element[(scene.law == LawKind.CURVE) & (table.of_element >= 0)]
    for index, count in zip(*(part.tolist() for part in np.unique(on_curve, return_counts=True)), strict=True):
        section = table.sections[index]
        if section.source == "Dd" and not np.isnan(section.diameter) and not section.faulty:
            elements = "an element" if count == 1 else f"{count} elements"
            message = (
                f"the embedment ratio of {elements} on a curve is computed with Dd = {section.diameter:g}, as the "
                "section has no Do: give Do"
            )
            yield Problem(GEO003, message, where=section.where.inside("flexible", "Dd"))


@rule(GEO006)
def repeated_section(context: LintContext) -> Iterator[Problem]:
    """A set has two sections, and another set has none; or a set has none at all.

    The later section of a set overrides the earlier one. That is legal, but beside a set without a section it suggests
    an entry that was copied and kept the name of the first: the elements of that set have neither stiffness nor mass.
    Correct the name in one of the two entries. A set without a section is also reported where no set has two, but not
    if a keyword that is passed through names it, as that may describe its elements. Nothing is reported where elements
    come from lines or from another deck, where a section names a set that is not defined (REF001), where every element
    has a section, or where a curve lacks a diameter (SBD009).

    Example:
         $MODEL
         *NODE
          1, 0.0, 0.0
          5, 0.0, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *ELEMENT SETS
          SET=West
          GEN=1, 2
          SET=East
          GEN=3, 4
         *GEOMETRIC SETS
          OPTION=RIGID
          SET=West
          207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
        - SET=West
        + SET=East
          207.0E9, 79.6E9, 0.3239, 0.2731, 7850.0

    Finds: 18:6
    """
    scene = context.scene
    sections, reading = scene.section_table.sections, scene.context
    repeated = _repeated(sections)
    hidden = (
        scene.section_table.open or reading.external_definers or reading.restart or "GEOMETRIC SETS" in reading.unread
    )
    if not sections or hidden or any(scene.set_table.find(section.name) is None for section in sections):
        return
    lacking = scene.section_table.of_element < 0
    sets = scene.set_table.named.values() if lacking.any() else ()
    bare_sets = [one for one in sets if one.elements.size and not one.open and lacking[one.elements].all()]
    for section in repeated if bare_sets else ():
        message = (
            f"SET={shown(section.name)} already has a section, and SET={shown(bare_sets[0].name)} has none: correct "
            "one of the two names"
        )
        yield Problem(GEO006, message, where=section.where.inside("set"))
    for one in () if repeated else bare_sets:
        on_curve = (scene.law[one.elements] == LawKind.CURVE).any()  # SBD009 says so
        if one.where is not None and not on_curve and folded(one.name) not in _passed_through(scene):
            message = f"the elements of SET={shown(one.name)} have no section: give one in *GEOMETRIC SETS"
            yield Problem(GEO006, message, where=one.where)


def _passed_through(scene: Scene) -> set[str]:
    """Names after SET= and the like in blocks that are passed through, but for those that need sections."""
    blocks = (block for section in scene.deck.sections for block in section.blocks)
    lines = (
        line
        for block in blocks
        if isinstance(block, Opaque) and block.keyword not in _WITH_SECTIONS
        for line in block.lines
    )
    return {folded(field.partition("=")[2]) for line in lines for field in line.split(",") if "=" in field}


def _repeated(sections: Iterable[Section]) -> list[Section]:
    """Sections of a set that already has one."""
    known: set[str] = set()
    found: list[Section] = []
    for section in sections:
        name = set_key(section.name)
        if name in known:
            found.append(section)
        known.add(name)
    return found
