"""Where nodes and elements lie relative to the seabed, and what holds them vertically."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from mudline.codes.lines import SYN014
from mudline.contact.input import LawKind
from mudline.deck.model import Opaque
from mudline.diagnostics import Code, Problem, Repair, Severity, Span, Where
from mudline.keywords.catalogue import is_superseded, sections_of
from mudline.linting.rule import LintContext, limited, rule
from mudline.scene.checks.laws import SBD004
from mudline.scene.model import Scene
from mudline.scene.numbering import LARGEST, Floats, Indices, Mask, blocks_of
from mudline.scene.seabed import SeabedKind, SeabedShape

if TYPE_CHECKING:
    from mudline.keywords.library.boundary import Boundary, FixedNode, FixedRange

_SAME_PLACE = 3
"""Decimals in which the coordinates of the pipes of a pipe in a pipe agree."""

SBD006 = Code("SBD006", "no-vertical-restraint", Severity.WARNING)
SBD021 = Code("SBD021", "one-constrained-dof", Severity.WARNING)
SBD022 = Code("SBD022", "deep-node", Severity.WARNING)

_VERTICAL = 90.0

DEEPEST = 5.0
"""Diameters below the seabed."""

_IN_PLANE = (1, 2)


def depths(context: LintContext) -> Floats:
    """Depths (n,) of the deck's coordinates normal to the seabed, negative above it; NaN where they are not known.

    Of a polyline and of a surface it is a lower bound: no point of the seabed is nearer. A surface is triangulated
    between its points, so it lies nowhere below the lowest of them. A cubic profile may lie anywhere between its
    points. Several rules need them, and ask `context.once`.
    """
    scene = context.scene
    floor = scene.seabed
    x, y, z = scene.coordinates.T
    if not _is_bed(scene):
        return np.full(len(x), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        if floor.kind is SeabedKind.PLANES:
            return _below_planes(floor, x, y, z)
        if floor.kind in (SeabedKind.FLAT, SeabedKind.SLOPING):
            slope = np.radians(floor.slope)
            level = floor.slope == 0.0 and floor.direction == 0.0
            found = np.empty(len(x))
            for block in blocks_of(len(x)):
                if level:
                    found[block] = 0.0 * y[block] + 0.0 * z[block] - x[block]
                else:
                    along = _along(floor.direction, y[block], z[block])
                    found[block] = along * np.sin(slope) - x[block] * np.cos(slope)
            return found
        if floor.missing or floor.points.size == 0 or floor.interpolation != "LINEAR":
            return np.full(len(x), np.nan)
        if floor.kind is SeabedKind.SURFACE:
            return np.asarray(floor.points[:, 0].min() - x)
        return _below_profile(floor, x, _along(floor.direction, y, z))


def _is_bed(scene: Scene) -> bool:
    """Whether slopes are below 90 degrees, and the deck describes one seabed; other rules report where it does not."""
    floor = scene.seabed
    if floor.kind is SeabedKind.PLANES and "SEABED PROFILE" in scene.deck.keywords():
        return False
    return all(abs(slope) < _VERTICAL for slope in (floor.slope, *(plane.slope for plane in floor.planes)))


class Bounds(NamedTuple):
    """The highest and the deepest node, normal to the seabed, the lowest X, the first and the last Z: NaN with a NaN.

    Of the known diameters the smallest and the largest, inf and 0 without any. With no nodes all is infinite.
    """

    highest: float
    deepest: float
    lowest: float
    first: float
    last: float
    thinnest: float
    thickest: float


def bounds_of(context: LintContext) -> Bounds:
    """What is computed once for the rules that most decks pass by such bounds alone; they ask `context.once`."""
    scene, depth = context.scene, context.once(depths)
    x, _, z = scene.coordinates.T
    least, most = np.minimum.reduce, np.maximum.reduce
    return Bounds(
        -float(least(depth, initial=np.inf)),
        float(most(depth, initial=-np.inf)),
        float(least(x, initial=np.inf)),
        float(least(z, initial=np.inf)),
        float(most(z, initial=-np.inf)),
        float(np.fmin.reduce(scene.diameter, initial=np.inf)),
        float(np.fmax.reduce(scene.diameter, initial=0.0)),
    )


def steepness(scene: Scene) -> Floats:
    """Slopes (n,) of the seabed under the nodes as a tangent, without sign: of a profile, or of a uniform slope.

    NaN where they are not known.
    """
    floor = scene.seabed
    _, y, z = scene.coordinates.T
    if floor.kind in (SeabedKind.FLAT, SeabedKind.SLOPING):
        return np.full(len(y), abs(np.tan(np.radians(floor.slope))))
    if floor.kind is not SeabedKind.PROFILE or floor.missing or floor.points.size == 0:
        return np.full(len(y), np.nan)
    points = floor.points[np.argsort(floor.points[:, 0], kind="stable")]
    slopes = np.concatenate([[0.0], _slopes(points), [0.0]])
    place = _along(floor.direction, y, z)
    sides = (np.searchsorted(points[:, 0], place, side) for side in ("left", "right"))
    found: Floats = np.maximum(*(slopes[side] for side in sides))
    return found


def _along(direction: float, y: Floats, z: Floats) -> Floats:
    """The horizontal coordinate in which a seabed that is the same across it rises or falls."""
    turned = np.radians(direction)
    along: Floats = y * np.cos(turned) + z * np.sin(turned)
    return along


def _slopes(points: Floats) -> Floats:
    widths, rises = np.diff(points, axis=0).T
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slopes: Floats = np.abs(np.where(rises == 0.0, 0.0, rises / widths))
    return slopes


def _below_profile(floor: SeabedShape, x: Floats, along: Floats) -> Floats:
    points = floor.points[np.argsort(floor.points[:, 0], kind="stable")]
    steepest = float(_slopes(points).max(initial=0.0))
    below: Floats = (np.interp(along, points[:, 0], points[:, 1]) - x) / np.hypot(1.0, steepest)
    return below


def _below_planes(floor: SeabedShape, x: Floats, y: Floats, z: Floats) -> Floats:
    """Depth below the highest plane whose bounds hold the node; of two as high the later one counts."""
    highest = np.full(len(x), -np.inf)
    depth = np.full(len(x), np.nan)
    for plane in floor.planes:
        x0, y0, z0 = plane.point
        slope = np.radians(plane.slope)
        height = x0 + _along(plane.direction, y - y0, z - z0) * np.tan(slope)
        y_min, y_max, z_min, z_max = plane.bounds
        held = (y >= y_min) & (y <= y_max) & (z >= z_min) & (z <= z_max) & (height >= highest)
        highest[held] = height[held]
        depth[held] = ((height - x) * np.cos(slope))[held]
    return depth


@rule(SBD006)
def no_vertical_restraint(context: LintContext) -> Iterator[Problem]:
    """Nothing supports elements of the model vertically.

    Either the block of *SEABED PROPERTIES that applies to the elements gives no stiffness: a block overrides an earlier
    one as a whole, and does not inherit its STIFFNESS=. Or the elements lie at or below the seabed (X = 0) in the
    deck's coordinates, and no law, or a stiffness of 0, applies to them; inner pipes of *PIP SECTION need none. A
    static run may then have no unique solution. Give STIFFNESS=, or put the elements into a set that has it.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0
          5, -0.05, 40.0
          GEN=1, 5
         *ELEMENT
          1, 1, 2
          GEN=1, 4
         *ELEMENT SETS
          SET=Crossing
          2, 3
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0
          SET=Crossing
        + STIFFNESS=50000.0
          FRICTION=0.8, 0.9

    Finds: 16:2
    """
    scene = context.scene
    reading = scene.context
    if stray := list(_stray_laws(context)):
        yield from stray
        return
    if reading.restart or any(map(is_superseded, reading.misplaced_keywords)) or reading.misplaced("SEABED PROPERTIES"):
        return
    if any(map(is_superseded, reading.unread)) or "SEABED CONTACT" in context.keywords:
        return  # a law that was not read may hold
    if context.problems_of(SYN014):
        return  # the law may be in the part that was cut off
    if context.problems_of(SBD004):
        return  # that there is no stiffness is reported there
    yield from _zeros(scene)
    free = scene.law == LawKind.NONE
    if np.count_nonzero(free) and "PIP SECTION" in context.keywords:
        free &= ~_inside_pipes(scene)
    if np.count_nonzero(free):
        yield from _blocks(scene, np.flatnonzero(free & (scene.laws.covered >= 0)))
        yield from _lying(context, np.flatnonzero(free & (scene.laws.covered < 0)))


_LAW = re.compile(r"^[ \t]*TYPE[ \t]*=[ \t]*(?:ELASTIC|RIGID)[ \t]*$", re.IGNORECASE | re.MULTILINE)


def _stray_laws(context: LintContext) -> Iterator[Problem]:
    """Lines of *SEABED PROPERTIES in blocks that are passed through: their keyword line is missing."""
    for number, section in enumerate(context.deck.sections):
        for index, block in enumerate(section.blocks):
            if type(block) is not Opaque or section.name not in (sections_of(block.keyword) or ()):
                continue
            if not any(map(_LAW.match, block.lines)) or not context.text:
                continue
            where = Where(number, index)
            head = context.text.heads[where]
            found = _LAW.search(context.text.source.text, head.end)
            message = (
                f"*{block.keyword} has no such line: begin *SEABED PROPERTIES above it, else no seabed law applies"
            )
            place = Span(*found.span()) if found else head
            line = (Span(place.start, place.start), "*SEABED PROPERTIES\n")
            repair = Repair("unsafe", "begin *SEABED PROPERTIES above this line", (line,)) if found else None
            yield Problem(SBD006, message, place, repair=repair)


def _zeros(scene: Scene) -> Iterator[Problem]:
    """Stiffnesses of 0 of elements that lie at or below a flat seabed."""
    grants = scene.laws.set_laws
    zero = [
        i
        for i, grant in enumerate(grants)
        if grant.kind is LawKind.LINEAR and grant.stiffness == 0.0 and not grant.unknown
    ]
    for index in zero if scene.seabed.kind is SeabedKind.FLAT else ():
        elements = np.flatnonzero(scene.laws.of_element == index)
        lying = elements[_depths(scene, elements) >= 0.0]
        if lying.size and "SEABED CONTACT" not in scene.extensions:
            which = f"{first_of('element', scene.element_ids[lying[0]], lying.size)} lie{'s' * (lying.size == 1)}"
            message = f"{which} at or below the seabed (X = 0) and this stiffness is 0: give another one"
            yield Problem(SBD006, message, where=grants[index].where)


_KEYWORD = "PIP SECTION"
_INNER = re.compile(r"\bINNER\s*=\s*([^,]+)", re.IGNORECASE)


def _inside_pipes(scene: Scene) -> Mask:
    """Elements (m,) of the inner pipes of *PIP SECTION, which the seabed does not touch."""
    inside = np.zeros(len(scene.element_ids), dtype=np.bool_)
    blocks = (block for section in scene.deck.sections for block in section.blocks if type(block) is Opaque)
    lines = (line for block in blocks if block.keyword == _KEYWORD for line in block.lines)
    for name in (match[1] for line in lines if (match := _INNER.search(line))):
        if set_ := scene.set_table.find(name.strip()):
            inside[set_.elements] = True
    return inside


def _blocks(scene: Scene, elements: Indices) -> Iterator[Problem]:
    """Blocks without stiffness that hold for elements, unless a later one whose elements are not known may hold."""
    if not elements.size:
        return
    grants = scene.laws.set_laws
    last_open = max((index for index, grant in enumerate(grants) if grant.set_.open), default=-1)
    legacy_open = any(grant.set_.open for grant in grants if grant.family == "legacy")
    found = np.unique(scene.laws.covered[elements], return_index=True, return_counts=True)
    for index, first, count in zip(*(part.tolist() for part in found), strict=True):
        where = grants[index].where
        hidden = grants[index].unknown or scene.context.has_unread_line_after(where, "SEABED PROPERTIES")
        if legacy_open or last_open > index or hidden:
            continue
        which = f"{first_of('element', scene.element_ids[elements[first]], count)} get{'s' * (count == 1)}"
        message = (
            f"{which} no stiffness from this block, which overrides earlier ones as a whole: give STIFFNESS= here too"
        )
        yield Problem(SBD006, message, where=where)


def _lying(context: LintContext, elements: Indices) -> Iterator[Problem]:
    """Elements at or below a flat seabed without any law; without any seabed in the deck only those below count."""
    if not elements.size:
        return
    scene = context.scene
    uncertain = scene.laws.uncertain or "SEABED PROPERTIES" in scene.context.unread
    if uncertain or scene.seabed.kind is not SeabedKind.FLAT or context.in_soil:
        return
    seabed = bool(scene.laws.types or scene.laws.set_laws)
    lies = np.greater_equal if seabed else np.greater
    parts = (elements[block] for block in blocks_of(len(elements)))
    lying = np.concatenate([part[lies(_depths(scene, part), 0.0)] for part in parts])
    if lying.size and ("PIP SECTION" in context.keywords or "PIP CONNECTION" in context.keywords):
        lying = lying[~_inside_others(scene, lying)]
    if lying.size:
        where = "at or below" if seabed else "below"
        which = f"{first_of('element', scene.element_ids[lying[0]], lying.size)} lie{'s' * (lying.size == 1)}"
        message = f"{which} {where} the seabed (X = 0) and no seabed law applies: give STIFFNESS= to a set of them"
        yield Problem(SBD006, message, where=scene.table.numbered.where(int(lying[0])))


def _inside_others(scene: Scene, elements: Indices) -> Mask:
    """Elements whose middle is that of an element with a law: the inner pipes of pipes in pipes."""
    middles = scene.coordinates[scene.element_nodes].mean(axis=1).round(_SAME_PLACE)
    outer = set(map(tuple, middles[scene.law != LawKind.NONE].tolist()))
    return np.array([tuple(middle) in outer for middle in middles[elements].tolist()], dtype=np.bool_)


def _depths(scene: Scene, elements: Indices) -> Floats:
    """Mean depths of the two nodes; NaN where one is not known."""
    depths = np.full(len(elements), np.nan)
    ends = scene.element_nodes[elements]
    known = (ends >= 0).all(axis=1)
    heights = scene.coordinates[ends[known], 0]
    depths[known] = 0.0 - (0.5 * heights[:, 0] + 0.5 * heights[:, 1])
    return depths


def first_of(thing: str, first: int, count: int) -> str:
    """Some elements or nodes in words, by the number of the first and how many they are."""
    return f"{thing} {first}" if count == 1 else f"{count} {thing}s (first: {first})"


@rule(SBD022)
def deep_node(context: LintContext) -> Iterator[Problem]:
    """Nodes lie more than five diameters below the seabed.

    Pipes on the seabed sink by a fraction of their diameter. So deep a node usually has the wrong datum: elevations are
    measured upwards from the mudline at X = 0, and not from the sea surface. Correct the coordinates. Of a
    three-dimensional seabed only its lowest point is used; cubic and compiled profiles, and models with soil curves,
    are left out.

    Example:
         $MODEL
         *NODE
        - 1, -500.0, 0.0
        - 2, -500.0, 10.0
        + 1, -0.02, 0.0
        + 2, -0.02, 10.0
         *ELEMENT
          1, 1, 2
         *GEOMETRIC SETS
          OPTION=RIGID
          SET=ALL
          207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0

    Finds: 3:2
    """
    scene = context.scene
    if not (scene.laws.types or scene.laws.set_laws) or context.in_soil:
        return
    depth, bounds = context.once(depths), context.once(bounds_of)
    if bounds.thinnest > 0.0 and bounds.deepest <= DEEPEST * bounds.thinnest:
        return
    with np.errstate(over="ignore", invalid="ignore"):
        limit = DEEPEST * _widest(scene)
        deep = np.flatnonzero((limit > 0.0) & (depth > limit))
    if deep.size:
        which = f"{first_of('node', scene.node_ids[deep[0]], deep.size)} lie{'s' * (deep.size == 1)}"
        message = f"{which} more than 5 diameters below the seabed: correct the datum of X"
        yield Problem(SBD022, message, where=scene.nodes.where(int(deep[0])))


@rule(SBD021)
@limited
def one_constrained_dof(context: LintContext) -> Iterator[Problem]:
    """Only one of the degrees of freedom 1 and 2 is constrained at a node on a sloping rigid seabed.

    Such a seabed holds its nodes along its normal, which lies between the directions 1 and 2. A node with a constraint
    in one of the two only is held in both by the program: it can no longer slide down the slope, and the reaction there
    is larger than the deck suggests. Constrain both, or none. Reported are nodes on the seabed or below it, or less
    than a diameter above it.

    Example:
         $MODEL
         *NODE
          1, 0.0, 0.0
          2, 0.3, 10.0
         *ELEMENT
          1, 1, 2
         *SEABED PROPERTIES
          TYPE=RIGID
          SET=ALL
          FRICTION=0.3, 0.6
         *SEABED PROFILE
          TYPE=SLOPING
          SLOPE=2.0
         $LOAD CASE
         *BOUNDARY
          TYPE=CONSTANT
        + 1, 1
          1, 2

    Finds: 17:5
    """
    scene = context.scene
    if "RIGID" not in scene.laws.types or "ELASTIC" in scene.laws.types:
        return
    held = list(_held(scene))
    if not held or scene.context.restart:  # the deck that is continued may constrain the other one
        return
    given = np.zeros((2, len(scene.node_ids)), dtype=np.bool_)
    for _, dof, nodes in held:
        given[dof - 1, nodes] = True
    alone = (given[0] != given[1]) & _on_slope(context)
    for where, dof, nodes in held:
        found = nodes[alone[nodes]]
        if found.size:
            which = first_of("node", scene.node_ids[found[0]], found.size)
            message = (
                f"of degrees of freedom 1 and 2 only {dof} is constrained at {which} on a sloping rigid seabed, and "
                "both are held there: give both, or remove this one"
            )
            yield Problem(SBD021, message, where=where)


def _widest(scene: Scene) -> Floats:
    """The largest diameter (n,) of the elements at each node; 0 where none is known."""
    widest = np.zeros(len(scene.node_ids))
    ends = scene.element_nodes
    known = (ends >= 0).all(axis=1) & (scene.diameter > 0.0)
    for side in (0, 1):
        np.maximum.at(widest, ends[known, side], scene.diameter[known])
    return widest


def _on_slope(context: LintContext) -> Mask:
    """Nodes within a diameter of a seabed that is not level."""
    scene = context.scene
    near = 1e-6 * np.abs(scene.coordinates).max(axis=1, initial=0.0)  # coordinates are rounded when they are written
    sloping: Mask = (steepness(scene) > 0.0) & (context.once(depths) >= -np.maximum(_widest(scene), near))
    return sloping


def _held(scene: Scene) -> Iterator[tuple[Where, int, Indices]]:
    """Each constraint of degree of freedom 1 or 2: its place, the degree, the indices of its nodes."""
    for where, block in scene.deck.blocks("BOUNDARY", "LOAD CASE"):
        for i, type_ in enumerate(cast("Boundary", block).types):
            for j, entry in enumerate(type_.entries):
                place = where.inside("types", i, "entries", j)
                generated = getattr(entry, "generate", None)
                if generated is None:
                    yield from _single(scene, cast("FixedNode", entry), place)
                else:
                    yield from _range(scene, cast("FixedRange", entry), place)


def _single(scene: Scene, entry: FixedNode, where: Where) -> Iterator[tuple[Where, int, Indices]]:
    node, dof = entry.node, entry.dof
    if isinstance(node, int) and abs(node) <= LARGEST and dof in _IN_PLANE:
        found = np.flatnonzero(scene.node_ids == node)
        yield where.inside("dof"), int(dof), found


def _range(scene: Scene, entry: FixedRange, where: Where) -> Iterator[tuple[Where, int, Indices]]:
    """Nodes of a GEN=: of three values the last one is the degree of freedom, of five the fourth.

    Four values can be read in two ways; they are read as increment and degree of freedom.
    """
    values = entry.generate
    if values.third is None:
        return
    step, dof = (1, values.third) if values.fourth is None else (values.third, values.fourth)
    numbers = (values.start, values.end, step)
    if dof not in _IN_PLANE or not all(isinstance(value, int) and abs(value) <= LARGEST for value in numbers):
        return
    start, end, step = (int(value) for value in numbers)
    if step > 0:
        ids = scene.node_ids
        found = np.flatnonzero((ids >= start) & (ids <= end) & ((ids - start) % step == 0))
        yield where.inside("generate"), int(dof), found
