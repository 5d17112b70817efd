"""What holds the elements vertically."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.contact.input import LawKind
from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.catalogue import holds_in_soil, is_superseded
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.scene.checks.laws import SBD004
from mudline.scene.model import Scene
from mudline.scene.numbering import Floats, Indices, blocks_of
from mudline.scene.seabed import SeabedKind

SBD006 = Code("SBD006", "no-vertical-restraint", Severity.WARNING)


@rule(SBD006)
def no_vertical_restraint(context: LintContext) -> Iterator[Problem]:
    """Nothing carries elements of the model vertically.

    Either the block of *SEABED PROPERTIES that holds for the elements gives no stiffness: a block is taken whole, and
    does not inherit the STIFFNESS= of an earlier one. Or the elements lie at or below the bed (X = 0) in the deck's
    coordinates, and no law holds for them. A static run may then have no unique solution. Give STIFFNESS=, or put the
    elements into a set that has it.

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
    if reading.restart or any(map(is_superseded, reading.misplaced_keywords)) or reading.misplaced("SEABED PROPERTIES"):
        return
    if any(map(is_superseded, reading.unread)) or "SEABED CONTACT" in scene.deck.keywords():
        return  # a law that was not read may hold
    if any(context.told(SBD004)):
        return  # that there is no stiffness has been told
    free = scene.law == LawKind.NONE
    yield from _blocks(scene, np.flatnonzero(free & (scene.laws.covered >= 0)))
    yield from _lying(scene, np.flatnonzero(free & (scene.laws.covered < 0)))


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
        which = _which(scene, elements[first], count, "gets", "get")
        message = f"{which} no stiffness from this block, which is taken whole: give STIFFNESS= here too"
        yield Problem(SBD006, message, where=where)


def _lying(scene: Scene, elements: Indices) -> Iterator[Problem]:
    """Elements at or below a flat bed without any law; without any seabed in the deck only those below count."""
    if not elements.size:
        return
    uncertain = scene.laws.uncertain or "SEABED PROPERTIES" in scene.context.unread
    if uncertain or scene.seabed.kind is not SeabedKind.FLAT or any(map(holds_in_soil, scene.deck.keywords())):
        return
    seabed = bool(scene.laws.types or scene.laws.set_laws)
    lies = np.greater_equal if seabed else np.greater
    parts = (elements[block] for block in blocks_of(len(elements)))
    lying = np.concatenate([part[lies(_depths(scene, part), 0.0)] for part in parts])
    if lying.size:
        where = "at or below" if seabed else "below"
        which = _which(scene, lying[0], lying.size, "lies", "lie")
        message = f"{which} {where} the bed (X = 0) and no seabed law holds: give STIFFNESS= to a set of them"
        yield Problem(SBD006, message, where=scene.table.numbered.where(int(lying[0])))


def _depths(scene: Scene, elements: Indices) -> Floats:
    """Mean depths of the two nodes; NaN where one is not known."""
    depths = np.full(len(elements), np.nan)
    ends = scene.element_nodes[elements]
    known = (ends >= 0).all(axis=1)
    heights = scene.coordinates[ends[known], 0]
    depths[known] = 0.0 - (0.5 * heights[:, 0] + 0.5 * heights[:, 1])
    return depths


def _which(scene: Scene, first: int, count: int, one: str, many: str) -> str:
    number = scene.element_ids[first]
    return f"element {number} {one}" if count == 1 else f"{count} elements (first: {number}) {many}"
