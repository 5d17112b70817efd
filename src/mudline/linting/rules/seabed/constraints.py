"""Nodes that a boundary condition holds on a sloping rigid bed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

import numpy as np

from mudline.diagnostics import Code, Problem, Severity, Where
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.seabed.elevation import depths, steepness
from mudline.scene.context import MOST_REPORTED
from mudline.scene.model import Scene
from mudline.scene.numbering import LARGEST, Indices, Mask

if TYPE_CHECKING:
    from mudline.keywords.library.boundary import Boundary, FixedNode, FixedRange

SBD021 = Code("SBD021", "one-constrained-dof", Severity.WARNING)

_IN_PLANE = (1, 2)


@rule(SBD021)
def one_constrained_dof(context: LintContext) -> Iterator[Problem]:
    """Only one of the degrees of freedom 1 and 2 is constrained at a node on a sloping rigid bed.

    Such a bed holds its nodes along its own normal, which lies between the directions 1 and 2. A node with a constraint
    in one of the two only is held in both by the program: it can no longer slide down the slope, and the reaction there
    is larger than the deck seems to say. Constrain both, or none. Told are nodes that lie on the bed or below it, or
    less than a diameter above it.

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
    alone = (given[0] != given[1]) & _on_slope(scene)
    told = 0
    for where, dof, nodes in held:
        found = nodes[alone[nodes]]
        if found.size and told < MOST_REPORTED:
            told += 1
            which = f"node {scene.node_ids[found[0]]}"
            if found.size > 1:
                which = f"{found.size} nodes (first: {scene.node_ids[found[0]]})"
            message = (
                f"of degrees of freedom 1 and 2 only {dof} is constrained at {which} on a sloping rigid bed, and both "
                "are held there: give both, or remove this one"
            )
            yield Problem(SBD021, message, where=where)


def _on_slope(scene: Scene) -> Mask:
    """Nodes at a bed that is not level, as far as the diameter of their elements says."""
    reach = np.zeros(len(scene.node_ids))
    ends = scene.element_nodes
    known = (ends >= 0).all(axis=1) & (scene.diameter > 0.0)
    for side in (0, 1):
        np.maximum.at(reach, ends[known, side], scene.diameter[known])
    near = 1e-6 * np.abs(scene.coordinates).max(axis=1, initial=0.0)  # coordinates are rounded when they are written
    sloping: Mask = (steepness(scene) > 0.0) & (depths(scene) >= -np.maximum(reach, near))
    return sloping


def _held(scene: Scene) -> Iterator[tuple[Where, int, Indices]]:
    """Each constraint of degree of freedom 1 or 2: its place, the degree, the indices of its nodes."""
    for where, block in scene.deck.blocks("BOUNDARY", "LOAD CASE"):
        for i, type_ in enumerate(cast("Boundary", block).types):
            for j, entry in enumerate(type_.entries):
                place = where._replace(path=("types", i, "entries", j))
                generated = getattr(entry, "generate", None)
                if generated is None:
                    yield from _single(scene, cast("FixedNode", entry), place)
                else:
                    yield from _range(scene, cast("FixedRange", entry), place)


def _single(scene: Scene, entry: FixedNode, where: Where) -> Iterator[tuple[Where, int, Indices]]:
    node, dof = entry.node, entry.dof
    if isinstance(node, int) and abs(node) <= LARGEST and dof in _IN_PLANE:
        found = np.flatnonzero(scene.node_ids == node)
        yield where._replace(path=(*where.path, "dof")), int(dof), found


def _range(scene: Scene, entry: FixedRange, where: Where) -> Iterator[tuple[Where, int, Indices]]:
    """Nodes of a GEN=: of three values the last one is the degree of freedom, of five the fourth.

    Four values are told two ways; they are taken as increment and degree of freedom.
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
        yield where._replace(path=(*where.path, "generate")), int(dof), found
