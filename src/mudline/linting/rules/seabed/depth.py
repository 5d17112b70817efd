"""Nodes far below the bed."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mudline.diagnostics import Code, Problem, Severity
from mudline.keywords.catalogue import holds_in_soil
from mudline.linting.context import LintContext
from mudline.linting.registry import rule
from mudline.linting.rules.seabed.elevation import depths

SBD022 = Code("SBD022", "deep-node", Severity.WARNING)

_DEEPEST = 5.0


@rule(SBD022)
def deep_node(context: LintContext) -> Iterator[Problem]:
    """Nodes lie more than five diameters below the bed.

    Pipes on the seabed sink by a fraction of their diameter. So deep a node usually has the wrong datum: elevations
    count from the mudline at X = 0, upwards, and not from the sea surface. Correct the coordinates. Of a bed in three
    dimensions only its lowest point is taken; cubic and compiled profiles, and models with soil curves, are left out.

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
    if not (scene.laws.types or scene.laws.set_laws) or any(map(holds_in_soil, scene.deck.keywords())):
        return
    depth = depths(scene)
    thinnest = float(np.fmin.reduce(scene.diameter, initial=np.inf))  # of Python: a product may overflow
    if thinnest > 0.0 and np.fmax.reduce(depth, initial=-np.inf) <= _DEEPEST * thinnest:
        return
    with np.errstate(over="ignore", invalid="ignore"):
        ends = scene.element_nodes
        known = (ends >= 0).all(axis=1) & (scene.diameter > 0.0)
        limit = np.zeros(len(depth))
        for side in (0, 1):
            np.maximum.at(limit, ends[known, side], _DEEPEST * scene.diameter[known])
        deep = np.flatnonzero((limit > 0.0) & (depth > limit))
    if deep.size:
        what = f"{deep.size} nodes (first: {scene.node_ids[deep[0]]})"
        message = f"{what} lie more than 5 diameters below the bed: correct the datum of X"
        yield Problem(SBD022, message, where=scene.nodes.where(int(deep[0])))
