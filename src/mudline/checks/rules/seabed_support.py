"""Lines without the support of the seabed: none of them reaches it, or no law with a stiffness applies."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mudline.checks.context import LintContext
from mudline.checks.rules.seabed_position import depths, mean_depths
from mudline.language.codes.contact import GEO005, GEO017, SBD006
from mudline.language.codes.lines import SYN014
from mudline.language.diagnostics import Problem, Where
from mudline.language.keywords.catalogue import is_superseded
from mudline.language.rules import rule
from mudline.model.contact.input import LawKind
from mudline.model.scene.laws import present
from mudline.model.scene.laws_in_use import block_without_stiffness, without_law
from mudline.model.scene.model import Scene
from mudline.model.scene.numbering import Floats, Indices, Mask, blocks_of, first_of
from mudline.model.scene.rules.fields import SBD004
from mudline.model.scene.seabed import FLAT, NEAR, LineExtent, SeabedKind, survey_of

HIGHEST = 100.0
"""Height above the seabed, in diameters, at which a level line does not hang."""
LEVEL = 0.1
"""Ratio of rise to horizontal length of a level line."""


@rule(GEO005)
def not_on_the_seabed(context: LintContext) -> Iterator[Problem]:
    """The line cannot reach the seabed, or lies as if Z were vertical.

    X is vertical in a deck, and 0 at the mudline. Nodes with another datum, or with the height as their last
    coordinate, never touch the seabed, or all of them do. Correct the coordinates. The static solution of a deck may
    start above the seabed, and a riser or a jumper may hang there for good. Therefore only these cases are reported,
    each for the elements with a seabed law:

    * every node lies above the sea surface (*OCEAN gives the depth);
    * the line lies level over 100 diameters above the seabed: it rises by less than a tenth of its length, or its
      lowest four nodes or more have one height;
    * Z goes from 0 to the depth, or from the depth below 0 to 0, within 5 % of the depth, and every node has the same X
      within 1 % of the depth; or, from 0, three nodes or more lie within a diameter of Z = 0, and only one of X = 0;
    * the three lowest nodes in Z or more lie at minus the depth within 1 % of it, on one level within a diameter, and
      only one lies within a diameter of X = 0: Z is the height, and 0 at the sea surface.

    Nothing is reported where elements come from lines or from another deck, where the shape of the seabed is not known,
    or in models with soil curves.

    Example on pipe:
         $MODEL
        |*OCEAN
        | 420.0, 1025.0, 9.81
         *NODE
        - 1, 420.0, 0.0
        - 5, 420.0, 40.0
        + 1, -0.05, 0.0
        + 5, -0.05, 40.0

    Finds: 5:2
    """
    scene = context.scene
    if scene.context.external_definers or scene.context.restart or context.in_soil:
        return
    below = context.once(depths)
    if (line := _line(scene, below)) is not None and (message := _above(line) or _along_z(line)):
        lowest = int(np.where(line.used, below, -np.inf).argmax())
        message = message.format(node=f"node {scene.node_ids[lowest]}")
        yield Problem(GEO005, message, where=scene.nodes.where(lowest))


@rule(GEO017)
def beyond_the_survey(context: LintContext) -> Iterator[Problem]:
    """The line goes beyond the end of the seabed that the deck gives.

    Outside the hull of scattered points, and outside the bounds of all planes, there is no seabed: a pipe gets no force
    there, and a run gives no warning. A profile is taken as level beyond its ends, whatever the real ground does. Give
    the seabed as far as the line goes, or correct the coordinates.

    Reported are nodes of elements with a seabed law that lie beyond the end, up to 100 diameters above the level there.
    That level is the end of a profile, the nearest place of a plane, or the highest point of a surface. `mudline
    evaluate` reports the same for the positions of every step. Compiled profiles are left out.

    Example:
         $MODEL
         *NODE
          1, -0.05, 0.0, 0.0
          2, -0.05, 0.0, 50.0
        - 3, -0.05, 0.0, 150.0
        + 3, -0.05, 0.0, 100.0
         *ELEMENT
          1, 1, 2
          2, 2, 3
         *SEABED PLANES
          PLANE=Shelf
          POINT=0.0, 0.0, 0.0
          SLOPE=0.0
          DIRECTION=0.0
          BOUNDS=-50.0, 50.0, 0.0, 120.0
         *SEABED PROPERTIES
          TYPE=ELASTIC
          SET=ALL
          STIFFNESS=50000.0

    Finds: 5:2
    """
    scene = context.scene
    survey = survey_of(scene.seabed)
    if survey is None:
        return
    held = scene.element_nodes[scene.law != LawKind.NONE]
    used = np.unique(held[held >= 0])
    diameter = float(np.fmax.reduce(scene.diameter, initial=0.0, where=scene.law != LawKind.NONE))
    left = used[survey.left(scene.coordinates[used], diameter)]
    if left.size:
        which = first_of("node", scene.node_ids[left], "lies", "lie")
        yield Problem(GEO017, f"{which} {survey.end}: {survey.consequence}", where=scene.nodes.where(int(left[0])))


class _Line(NamedTuple):
    """Nodes (n,) that belong to elements with a seabed law, and where they lie; NaN where a value is not known.

    used: the nodes.
    extent: smallest and largest coordinates.
    heights: smallest and largest heights above the seabed.
    diameter: the largest one.
    """

    used: Mask
    extent: LineExtent
    heights: tuple[float, float]
    diameter: float
    flat: tuple[int, ...]
    """Number of nodes within a diameter of X = 0, of Z = 0, and of the smallest Z."""
    level: int
    """Number of nodes as low as the lowest one."""


LAID = 3
"""Number of nodes of a line that lie on the seabed, at least."""
ROUNDED = 1e-3
"""Height difference in diameters up to which nodes are on one level."""


def _line(scene: Scene, below: Floats) -> _Line | None:
    """Return where the line lies, of whose nodes the depths (n,) are `below`; None if nothing is known of it."""
    used = np.zeros(len(scene.node_ids), dtype=np.bool_)
    for block in blocks_of(len(scene.element_ids)):
        ends = scene.element_nodes[block][scene.law[block] != LawKind.NONE]
        if (ends < 0).any():
            return None
        used[ends] = True
    if not used.any():
        return None
    x, y, z = (_extent(axis, used) for axis in scene.coordinates.T)
    highest, deepest = _extent(below, used)
    diameter = float(np.fmax.reduce(scene.diameter, initial=np.nan, where=scene.law != LawKind.NONE))
    with np.errstate(invalid="ignore", over="ignore"):
        distances = (scene.coordinates[used, axis] - level for axis, level in ((0, 0.0), (2, 0.0), (2, z[0])))
        flat = tuple(int(np.count_nonzero(np.abs(each) <= diameter)) for each in distances)
    level = int((below[used] >= deepest - ROUNDED * diameter).sum())
    extent = LineExtent(x, y, z, scene.surroundings.depth)
    return _Line(used, extent, (-deepest, -highest), diameter, flat, level)


def _extent(values: Floats, used: Mask) -> tuple[float, float]:
    """Return the smallest and the largest of the values in use; NaN if one of them is NaN."""
    return float(values.min(where=used, initial=np.inf)), float(values.max(where=used, initial=-np.inf))


def _above(line: _Line) -> str:
    """Return the fault of a line that hangs above the seabed in words, or ""."""
    (lowest, highest), (_, y, z, depth) = line.heights, line.extent
    if lowest > depth > 0.0:
        return (
            f"the lowest {{node}} lies {lowest:.5g} above the seabed, in water {depth:.5g} deep: correct the "
            "datum of X, which is 0 at the mudline"
        )
    length = math.hypot(y[1] - y[0], z[1] - z[0])
    level = highest - lowest < LEVEL * length
    if (level or line.level > LAID) and lowest > HIGHEST * line.diameter:
        what = "the line lies level, its lowest {node}" if level else "the lowest nodes lie level, {node}"
        what = f"{what} {lowest:.5g} above the seabed (over 100 diameters)"
        return f"{what}: correct the datum of X, which is 0 at the mudline"
    return ""


def _along_z(line: _Line) -> str:
    """Return the fault of a line whose last coordinate is its height in words, or ""."""
    x, _, (first, last), depth = line.extent
    near = NEAR * depth
    if not depth > 0.0:
        return ""
    turned = abs(first) <= near and line.flat[0] <= 1 and line.flat[1] >= LAID
    if turned and x[1] - x[0] > FLAT * depth and line.extent.spans_depth_in_z():
        return (
            f"Z goes from {first:.5g} to {last:.5g}, and {line.flat[1]} nodes lie within a diameter of 0 in Z and "
            f"{line.flat[0]} in X, as if Z were the height: write the height as X, the first coordinate"
        )
    sunk = abs(first + depth) <= FLAT * depth and last > first + near
    if sunk and line.flat[0] <= 1 and line.flat[2] >= LAID:
        return (
            f"{line.flat[2]} nodes lie at Z = {first:.5g}, minus the water depth, and {line.flat[0]} near X = 0, as if "
            "Z were the height above the sea surface: write the height above the mudline as X, the first coordinate"
        )
    sign = line.extent.height_along_z()
    return f"{sign}, as if it were the height: write the height as X, the first coordinate" if sign else ""


# ----------------------------------------------------------------------------------------------------------------- laws


@rule(SBD006)
def no_vertical_restraint(context: LintContext) -> Iterator[Problem]:
    """Nothing supports elements of the model vertically.

    Either the block of *SEABED PROPERTIES that applies to the elements gives no stiffness: a block overrides an earlier
    one as a whole, and does not inherit its STIFFNESS=. Or the elements lie at or below the seabed in the deck's
    coordinates, and no law, or a stiffness of 0, applies to them. Inner pipes of *PIP SECTION need no law. A static run
    may then have no unique solution. Give STIFFNESS=, or put the elements into a set that has it.

    Example on sets:
          GEN=3, 4
        |*SEABED PROPERTIES
        | TYPE=ELASTIC
        | SET=ALL
        | STIFFNESS=50000.0
        | SET=Flowline
        + STIFFNESS=50000.0
        | FRICTION=0.8, 0.9

    Finds: 18:2
    """
    scene = context.scene
    reading = scene.context
    if reading.restart or any(map(is_superseded, reading.misplaced)) or "SEABED PROPERTIES" in reading.misplaced:
        return
    # *SEABED CONTACT may hold the pipe, and SBD004 reports that there is no stiffness.
    if "SEABED CONTACT" in context.keywords or context.problems_of(SBD004):
        return
    yield from _zeros(context)
    free = scene.law == LawKind.NONE
    if "PIP SECTION" in context.keywords or "PIP CONNECTION" in context.keywords:
        free &= ~_inner_pipes(scene, free)
    yield from _blocks(scene, np.flatnonzero(free & (scene.laws.covered >= 0)))
    if not context.problems_of(SYN014):  # else the law may be in the part that was cut off
        yield from _lying(context, np.flatnonzero(free & (scene.laws.covered < 0)))


def _zeros(context: LintContext) -> Iterator[Problem]:
    """Yield stiffnesses of 0 of elements that lie at or below the seabed."""
    scene = context.scene
    for index, grant in enumerate(scene.laws.set_laws):
        if grant.kind is not LawKind.LINEAR or grant.stiffness != 0.0 or grant.unknown:
            continue
        elements = np.flatnonzero(scene.laws.of_element == index)
        lying = elements[mean_depths(context, elements) >= 0.0]
        if lying.size and "SEABED CONTACT" not in scene.extensions:
            which = scene.describe(lying, "lies", "lie")
            message = f"{which} at or below the seabed{_level(scene)} and this stiffness is 0: give another one"
            yield Problem(SBD006, message, where=grant.where)


_SAME_PLACE = 3
"""Number of decimals to which the coordinates of the pipes of a pipe in a pipe agree."""


def _inner_pipes(scene: Scene, free: Mask) -> Mask:
    """Return a mask (m,) of the elements without a law that lie in another pipe, out of reach of the seabed.

    They are named by *PIP SECTION, or their middles coincide with those of elements with a law.
    """
    inside = in_another_pipe(scene)
    placed = (scene.element_nodes >= 0).all(axis=1)
    outer = set(_middles(scene, np.flatnonzero(placed & (scene.law != LawKind.NONE))))
    alone = np.flatnonzero(placed & free & ~inside)
    inside[alone] = [middle in outer for middle in _middles(scene, alone)]
    return inside & free


def in_another_pipe(scene: Scene) -> Mask:
    """Return a mask (m,) of the elements of the inner pipes that `*PIP SECTION` names."""
    inside = np.zeros(len(scene.element_ids), dtype=np.bool_)
    for _, pipe in scene.context.records("PIP SECTION", "pipes"):
        if set_ := scene.set_table.find(pipe.inner or ""):
            inside[set_.elements] = True
    return inside


def _middles(scene: Scene, elements: Indices) -> list[tuple[float, ...]]:
    """Return the rounded middles of some elements whose nodes are known."""
    return list(map(tuple, scene.coordinates[scene.element_nodes[elements]].mean(axis=1).round(_SAME_PLACE).tolist()))


def _blocks(scene: Scene, elements: Indices) -> Iterator[Problem]:
    """Yield blocks without stiffness that apply to elements, unless a later block of unknown elements may apply."""
    grants = scene.laws.set_laws
    last_open = max((index for index, grant in enumerate(grants) if grant.set_.open), default=-1)
    legacy_open = any(grant.set_.open for grant in grants if grant.family == "legacy")
    covered = scene.laws.covered[elements]
    for index in present(covered):
        where = grants[index].where
        if legacy_open or last_open > index or grants[index].unknown or max(scene.laws.gaps, default=Where()) >= where:
            continue
        yield block_without_stiffness(scene, index, elements[covered == index], "gets", "get")


def _lying(context: LintContext, elements: Indices) -> Iterator[Problem]:
    """Yield elements at or below the seabed without any law; if the deck has no seabed, only those below it."""
    if not elements.size:
        return
    scene = context.scene
    if scene.laws.uncertain or scene.may_have_more_laws or context.in_soil:
        return
    seabed = bool(scene.laws.types or scene.laws.set_laws)
    lies = np.greater_equal if seabed else np.greater
    parts = (elements[block] for block in blocks_of(len(elements)))
    lying = np.concatenate([part[lies(mean_depths(context, part), 0.0)] for part in parts])
    if lying.size:
        where = f"{'at or below' if seabed else 'below'} the seabed{_level(scene)}"
        yield without_law(scene, lying, f"lies {where}", f"lie {where}")


def _level(scene: Scene) -> str:
    """Return the level of a flat seabed for a message, or ""."""
    return " (X = 0)" if scene.seabed.kind is SeabedKind.FLAT else ""
