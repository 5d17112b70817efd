"""Where the nodes of a timed scene are, step by step."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput
from mudline.study.pruning.pipe import Pipe
from mudline.study.pruning.variants import Variant

STEPS = 3
"""Of a series: laid, then lifted in waves, then dragged."""
_WAVE = 200
_DEEPEST = 0.25


def positions(variant: Variant, inputs: ContactInput, pipe: Pipe) -> FloatArray:
    """Positions (n, 3): those of the deck, or from the seabed down to a quarter of the diameter, at random."""
    points = inputs.coordinates.copy()
    if not variant.lies:
        y, z = points[:, 1].copy(), points[:, 2].copy()
        level = np.zeros(len(points)) if inputs.seabed is None else inputs.seabed.elevation(y, z)
        points[:, 0] = level - np.random.default_rng(3).uniform(0.01, _DEEPEST, len(points)) * pipe.diameter
    return points


def series(points: FloatArray, pipe: Pipe, steps: int = STEPS) -> FloatArray:
    """Positions (steps, n, 3) of nodes that are moved up by a part of the diameter, along and across the line."""
    waves = np.sin(2.0 * np.pi / _WAVE * np.arange(len(points)))
    lift = pipe.diameter * np.maximum(0.4 * waves, -0.02)
    drag = 0.02 * pipe.diameter
    moved = np.empty((steps, *points.shape))
    for step in range(steps):
        moved[step] = points
        if step % STEPS:
            moved[step, :, 0] += lift
        if step % STEPS == STEPS - 1:
            moved[step, :, 1:] += drag
    return moved
