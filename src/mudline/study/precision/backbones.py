"""Two published curves of undrained penetration in closed form, to see what sampling them at points costs.

D = 0.3 m, strength 5 kPa at the mudline; SI units. The ratio is z / D.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray

DIAMETER = 0.3
_STRENGTH = 5000.0
_GRADIENT = 1500.0
_SOIL_WEIGHT = 6000.0
_STIFFNESS = 200.0
DEEPEST = 0.5
"""Ratio up to which the curves are sampled."""


class Backbone(NamedTuple):
    """A curve in closed form: force per unit length over the ratio."""

    name: str
    force: Callable[[FloatArray], FloatArray]


def f114(ratio: FloatArray) -> FloatArray:
    """DNV-RP-F114, undrained penetration, model 2: bearing of the pipe and buoyancy in the soil, constant strength."""
    bearing = np.minimum(6.0 * ratio**0.25, 3.4 * np.sqrt(10.0 * ratio))
    width = 2.0 * np.sqrt(np.maximum(ratio - ratio**2, 0.0))
    angle = np.arcsin(np.minimum(width, 1.0))
    shallow = 0.25 * (angle - width * np.cos(angle))
    area = np.where(ratio < 0.5, shallow, np.pi / 8.0 + ratio - 0.5) * DIAMETER**2
    return bearing * DIAMETER * _STRENGTH + 1.5 * _SOIL_WEIGHT * area


def randolph_quiggin(ratio: FloatArray) -> FloatArray:
    """Randolph and Quiggin (OMAE2009-79259), first penetration: H Nc su D, H = zeta / (1 + zeta), zeta = 200 z / D."""
    bearing = 6.0 * np.where(ratio < 0.1, 0.1**0.25 * np.sqrt(10.0 * ratio), ratio**0.25)
    zeta = _STIFFNESS * ratio
    return zeta / (1.0 + zeta) * bearing * (_STRENGTH + _GRADIENT * ratio * DIAMETER) * DIAMETER


BACKBONES = (Backbone("DNV-RP-F114, model 2", f114), Backbone("Randolph and Quiggin 2009", randolph_quiggin))


def even(points: int) -> FloatArray:
    """Ratios at even distances."""
    return np.linspace(0.0, DEEPEST, points)


def graded(points: int) -> FloatArray:
    """Ratios that crowd towards the mudline, with the fourth power: where the curve bends most."""
    return DEEPEST * np.linspace(0.0, 1.0, points) ** 4


SPACINGS = {"even": even, "graded": graded}
