"""Nodal normal law: a spring at the node's own penetration."""

from __future__ import annotations

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.extras import NodalSprings
from mudline.contact.laws.smoothing import force_and_slope
from mudline.contact.result import ContactResult


class NodalLaw:
    """The springs of the nodes that have one."""

    def __init__(self, springs: NodalSprings) -> None:
        self._nodes = np.flatnonzero(~np.isnan(springs.stiffness))
        self._stiffness = springs.stiffness[self._nodes]
        self._half_width = springs.half_width[self._nodes]
        self._one_sided = springs.one_sided[self._nodes]

    def apply(self, part: ContactResult) -> FloatArray:
        """Add to `normal_force` (steps, n) of `part`; return d force / d penetration (steps, n)."""
        penetration = 0.0 - part.gap[:, self._nodes]
        force, slope = force_and_slope(penetration, self._stiffness, self._half_width, self._one_sided)
        part.normal_force[:, self._nodes] += force
        stiffness = np.zeros(part.normal_force.shape)
        stiffness[:, self._nodes] = slope
        return stiffness
