"""Positions of nodes relative to the seabed and to the sea surface."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress

import numpy as np

from mudline.basics.units import UNITS
from mudline.checks.context import LintContext
from mudline.checks.rules.curve_points import is_upside_down
from mudline.language.diagnostics import Code, Problem, Severity
from mudline.language.keywords.text import shown
from mudline.language.rules import rule
from mudline.model.contact.seabed import heading
from mudline.model.scene.deck_values import number
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, first_of
from mudline.model.scene.seabed import FLAT, SeabedKind, SeabedShape, made_seabed

SBD021 = Code("SBD021", "one-constrained-dof", Severity.WARNING)
SBD022 = Code("SBD022", "deep-node", Severity.WARNING)
CRV014 = Code("CRV014", "beyond-curve", Severity.INFO)
UNT006 = Code("UNT006", "suspicious-length", Severity.WARNING)

DEEPEST = 5.0
"""Depth below the seabed in diameters."""
HIGHEST, HIGHEST_IN_USER_UNITS = 3.0, 10.0
"""Largest height of a model, in water depths."""
TALLEST = 500.0
"""Largest height of a model above the sea in m: no wind turbine is taller."""


def depths(context: LintContext) -> Floats:
    """Return depths (n,) of the nodes normal to the seabed, negative above it; NaN where they are not known.

    * For a polyline and a surface the depth is a lower bound: no point of the seabed is nearer.
    * A surface is triangulated between its points, so it lies nowhere below the lowest of them.
    * A cubic profile may lie anywhere between its points, so its depths are not known.
    * In a trench that lowers the seabed, depths count from its bottom.

    Several rules need the depths: they call `context.once`.
    """
    lowering = _lowering(context.scene)
    return _depths(context.scene) if lowering is None else _depths(context.scene) - lowering


def mean_depths(context: LintContext, elements: Indices | slice) -> Floats:
    """Return the mean depth (k,) of the two nodes of some elements, see `depths`; NaN where one is not known."""
    ends = context.scene.element_nodes[elements]
    below = np.append(context.once(depths), np.nan)[ends]  # -1, an unknown node, is the last one
    middle: Floats = 0.5 * below[:, 0] + 0.5 * below[:, 1]
    return middle


def _lowering(scene: Scene) -> Floats | None:
    """Return the depth (n,) by which trenches lower the seabed at nodes; None without any."""
    trenches = scene.extensions.get("SEABED TRENCH")
    if trenches is None or not len(scene.node_ids):
        return None
    from mudline.model.contact.laws.trench import lowered  # noqa: PLC0415 - most decks do without

    elements = np.flatnonzero(trenches.says(trenches.of_element, "level", "LOWERED"))
    block = trenches.of_element[elements]
    deep, bottom, top = (trenches.values(block, "geometry", name) for name in ("depth", "bottom_width", "upper_width"))
    y0, z0, y1, z1 = (trenches.values(block, "centreline", name) for name in ("y0", "z0", "y1", "z1"))
    lowering = np.zeros(len(scene.node_ids))
    for nodes in scene.element_nodes[elements].T:
        _, y, z = scene.coordinates[nodes].T
        with np.errstate(all="ignore"):
            away = np.abs((y1 - y0) * (z - z0) - (z1 - z0) * (y - y0)) / np.hypot(y1 - y0, z1 - z0)
            share = lowered(away, 0.5 * bottom, 0.5 * top)[0]
        known = nodes >= 0
        lower = deep * np.where(np.isnan(away), 1.0, share)  # without a line of its own it lies below the pipe
        np.fmax.at(lowering, nodes[known], lower[known])
    return lowering


def _depths(scene: Scene) -> Floats:
    floor, places = scene.seabed, scene.coordinates
    unknown = np.full(len(places), np.nan)
    with np.errstate(over="ignore", invalid="ignore"):
        if floor.kind in (SeabedKind.PROFILE, SeabedKind.SURFACE):
            if floor.missing or floor.points.size == 0 or floor.interpolation != "LINEAR":
                return unknown
            if floor.kind is SeabedKind.SURFACE:
                return np.asarray(floor.points[:, 0].min() - places[:, 0])
            return _below_profile(floor, places)
        if floor.kind is SeabedKind.PLANES and "SEABED PROFILE" in scene.deck.keywords():
            return unknown  # two seabeds, which is reported
        with suppress(ValueError):  # illegal numbers are reported too
            made_seabed(floor).gaps(places, unknown)
    return 0.0 - unknown


def _below_profile(floor: SeabedShape, places: Floats) -> Floats:
    """Return lower bounds of the distances below the profile; beyond its ends, where it is level, they are exact."""
    points = floor.points[np.argsort(floor.points[:, 0], kind="stable")]
    widths, rises = np.diff(points, axis=0).T
    with np.errstate(divide="ignore"):
        steepest = float(np.abs(rises[rises != 0.0] / widths[rises != 0.0]).max(initial=0.0))
    cosine, sine = heading(floor.direction)
    x, y, z = places.T
    along = y * cosine + z * sine
    below: Floats = np.interp(along, points[:, 0], points[:, 1]) - x
    below[(along >= points[0, 0]) & (along <= points[-1, 0])] /= np.hypot(1.0, steepest)
    return below


@rule(SBD022)
def deep_node(context: LintContext) -> Iterator[Problem]:
    """Nodes lie more than five diameters below the seabed.

    Pipes on the seabed sink by a fraction of their diameter. A node this deep usually has the wrong datum: elevations
    are measured upwards from the mudline at X = 0, and not from the sea surface. Correct the coordinates. For a
    three-dimensional seabed only its lowest point is used. Cubic and compiled profiles, and models with soil curves,
    are left out.

    Example on pipe:
        - 1, -500.0, 0.0
        - 5, -500.0, 40.0
        + 1, -0.05, 0.0
        + 5, -0.05, 40.0

    Finds: 3:2
    """
    scene = context.scene
    if not (scene.laws.types or scene.laws.set_laws) or context.in_soil:
        return
    depth = context.once(depths)
    with np.errstate(over="ignore", invalid="ignore"):
        limit = DEEPEST * _widest(scene)
        deep = np.flatnonzero((limit > 0.0) & (depth > limit))
    if deep.size:
        which = first_of("node", scene.node_ids[deep], "lies", "lie")
        message = f"{which} more than 5 diameters below the seabed: correct the datum of X{_surface(scene)}"
        yield Problem(SBD022, message, where=scene.nodes.where(int(deep[0])))


def _surface(scene: Scene) -> str:
    """Return the likely datum in words, if the lowest node lies at minus the water depth; else ""."""
    depth = scene.surroundings.depth
    with np.errstate(invalid="ignore"):
        lowest = float(np.fmin.reduce(scene.coordinates[:, 0], initial=np.inf))
    if not (depth > 0.0 and abs(lowest + depth) <= FLAT * depth):
        return ""
    return f", which is 0 at the mudline and not at the sea surface: add {depth:.5g}"


@rule(SBD021)
def one_constrained_dof(context: LintContext) -> Iterator[Problem]:
    """Only one of the degrees of freedom 1 and 2 is constrained at a node on a sloping rigid seabed.

    The seabed holds its nodes along its normal, which lies between the directions 1 and 2. The program holds a node
    with a constraint in one of them in both: it can no longer slide down the slope, and the reaction there is larger
    than the deck suggests. Constrain both, or none. Reported are nodes on the seabed or below it, or less than a
    diameter above it.

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
          2, 1
          2, 2

    Finds: 17:5
    """
    scene = context.scene
    if "RIGID" not in scene.laws.types or "ELASTIC" in scene.laws.types:
        return
    held = [line for line in scene.held if line.dof in (1, 2)]
    if not held or scene.context.restart:  # the deck that is continued may constrain the other one
        return
    constrained = np.zeros((2, len(scene.node_ids)), dtype=np.bool_)
    for _, dof, nodes, _ in held:
        constrained[dof - 1, nodes] = True
    alone = (constrained[0] != constrained[1]) & _on_slope(context)
    for where, dof, nodes, _ in held:
        single = nodes[alone[nodes]]
        if single.size:
            which = first_of("node", scene.node_ids[single])
            message = (
                f"of degrees of freedom 1 and 2 only {dof} is constrained at {which} on a sloping rigid seabed, and "
                "both are held there: give both, or remove this one"
            )
            yield Problem(SBD021, message, where=where)


def _widest(scene: Scene) -> Floats:
    """Return the largest diameter (n,) of the elements at each node; 0 where none is known."""
    widest = np.zeros(len(scene.node_ids))
    ends = scene.element_nodes
    known = (ends >= 0).all(axis=1) & (scene.diameter > 0.0)
    for side in (0, 1):
        np.maximum.at(widest, ends[known, side], scene.diameter[known])
    return widest


def _on_slope(context: LintContext) -> Mask:
    """Return a mask (n,) of the nodes within a diameter of a profile or a uniform slope that is not level."""
    scene, floor = context.scene, context.scene.seabed
    places, sloping = scene.coordinates, np.zeros(len(scene.node_ids), dtype=np.bool_)
    if floor.kind not in (SeabedKind.SLOPING, SeabedKind.PROFILE) or math.isnan(floor.direction):
        return sloping
    near = 1e-6 * np.abs(places).max(axis=1, initial=1e-3)  # coordinates are rounded when they are written
    aside = near[:, np.newaxis] * (0.0, *heading(floor.direction))
    normal = np.empty_like(places)
    with suppress(ValueError):
        for beside in (places - aside, places + aside):
            made_seabed(floor).locate(beside, np.empty(len(places)), normal)
            sloping |= normal[:, 1:].any(axis=1)
    sloping &= context.once(depths) >= -np.maximum(_widest(scene), near)
    return sloping


@rule(CRV014)
def beyond_curve(context: LintContext) -> Iterator[Problem]:
    """Elements lie deeper, in the deck's coordinates, than their curve reaches.

    The force there is extrapolated with the last slope, and nothing was measured or calculated for it. Perhaps the
    coordinates have another datum than the seabed, X = 0; otherwise add points down to the depth of the elements.
    Nothing is reported in models whose seabed is not flat.

    Example on clay:
         $MODEL
        |*NODE
        - 1, -0.25, 0.0
        - 5, -0.25, 40.0
        + 1, -0.05, 0.0
        + 5, -0.05, 40.0
        | GEN=1, 5
        |*ELEMENT
        | 1, 1, 2
        | GEN=1, 4
        |*GEOMETRIC SETS
        | OPTION=RIGID
        | SET=ALL
        | 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0

    Finds: 14:2
    """
    scene = context.scene
    if scene.seabed.kind is not SeabedKind.FLAT or not scene.laws.curves:
        return
    with np.errstate(over="ignore"):
        ratios = mean_depths(context, slice(None)) / scene.diameter
    deepest_of_all = np.fmax.reduce(ratios, initial=-np.inf)
    if deepest_of_all > DEEPEST and not context.in_soil:
        return  # SBD022 reports the datum
    for index, entry in enumerate(scene.laws.curves):
        if entry.curve is None or not entry.whole or is_upside_down(entry) or deepest_of_all <= entry.curve.ratios[-1]:
            continue
        elements = scene.followers(index)
        last = float(entry.curve.ratios[-1])
        beyond = elements[ratios[elements] > last]
        if beyond.size:
            deepest = int(beyond[np.argmax(ratios[beyond])])
            which = "an element lies" if beyond.size == 1 else f"{beyond.size} elements lie"
            message = (
                f"{which} beyond the last ratio {last!r} of curve {shown(entry.name)}, element "
                f"{scene.element_ids[deepest]} at {ratios[deepest]:.4g}: add points down to there"
            )
            yield Problem(CRV014, message, where=entry.where)


def height_over_depth(context: LintContext) -> Iterator[Problem]:
    """Yield the problem of UNT006 in the water depth, compared with the heights of nodes.

    Nothing is reported if all nodes lie above the sea, which GEO005 reports.
    """
    scene, oceans = context.scene, context.blocks("OCEAN")
    if not oceans or not len(scene.node_ids):
        return
    where, depth = oceans[-1][0], number(oceans[-1][1], "depth")
    units = UNITS[scene.units]
    deepest, height = context.once(depths).max(), -context.once(depths).min()
    above_sea = (height - depth) * (units.length if units.known else math.inf)
    if not 0.0 < depth < math.inf or -deepest > depth or not height < math.inf:
        return
    if height > (HIGHEST if units.known else HIGHEST_IN_USER_UNITS) * depth and above_sea > TALLEST:
        highest = scene.node_ids[context.once(depths).argmin()]
        message = (
            f"node {highest} lies {height:.5g} high in water {depth!r} deep, expected "
            "little more than the depth: write both in one unit (km, feet or mm?), and heights as X"
        )
        yield Problem(UNT006, message, where=where.inside("depth"))
