"""Unloading and reloading of `*SEABED UNLOADING`, next to the virgin loading path of a normal law.

At a new largest penetration z_max the reaction is that of the virgin path. Elsewhere it is that of a straight line
through the deepest point (z_max, F_max) with the stiffness ku', down to 0 at the trench bottom z_p and 0 above it:

    F = max(0, F_max - ku' (z_max - z)),  z_p = z_max - F_max / ku'.

ku' is the largest of the given unloading stiffness, the steepest slope that the virgin path reached, and the secant
F_max / z_max. So the line lies nowhere above the virgin path, no closed loop gives work, and the trench bottom is never
above the mudline. The secant matters only where the virgin path has a force F(0) > 0 at the mudline: the line is then
steeper than the given stiffness, as a softer line would end above the mudline.

All values depend on z_max alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mudline.basics.short_repr import short_repr
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import Law, Parameter, Reached, Value, where


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class UnloadingHistory:
    """History of elements (k,) with an unloading law. It is never changed: a step returns a new history.

    Attributes:
        z_max: the largest penetration so far, 0 before the first contact.
        force_max: the virgin force there, F_max; 0 where the path pulls.
        line: stiffness ku' of the line.
        bottom: penetration z_p of the trench bottom, where the reaction vanishes.
    """

    z_max: FloatArray
    force_max: FloatArray
    line: FloatArray
    bottom: FloatArray

    __repr__ = short_repr

    @classmethod
    def initial(cls, stiffness: FloatArray) -> UnloadingHistory:
        """Return the history of elements that never touched the seabed, of unloading stiffness `stiffness` > 0."""
        z_max, force_max, bottom = np.zeros((3, len(stiffness)))
        return cls(z_max, force_max, stiffness.copy(), bottom)


_ROUNDING = 2.0**-50
_FINITE = float(np.finfo(np.float64).max)


def line_stiffness(stiffness: Value, z_max: Value, force_max: Value) -> Value:
    """Return ku' of the line through the deepest point; `stiffness` is already as steep as the virgin path."""
    secant = np.minimum(force_max / where(z_max > 0.0, z_max, 1.0), _FINITE)
    return np.maximum(stiffness, secant)


def trench_bottom(line: Value, z_max: Value, force_max: Value) -> Value:
    """Return z_p, between 0 and z_max; strictly below z_max where there is a force."""
    # a bottom that rounds to z_max would leave no depth over which the reaction falls
    deepest = where(force_max > 0.0, np.nextafter(z_max, 0.0), z_max)
    bottom = np.minimum(z_max - force_max / line, deepest)
    # a line to the mudline ends at 0, whatever its quotient rounds to
    return where(bottom > _ROUNDING * z_max, bottom, 0.0)


def on_line(z: Value, z_max: Value, force_max: Value, line: Value, bottom: Value) -> tuple[Value, Value]:
    """Return force and stiffness at a penetration that is not the largest so far."""
    below = z > bottom
    return where(below, np.maximum(force_max - line * (z_max - z), 0.0), 0.0), where(below, line, 0.0)


def _largest(reached: Reached, parameters: dict[str, FloatArray]) -> tuple[FloatArray, None]:
    """Return ku, or the steepest slope of the virgin path if larger."""
    return np.maximum(parameters["stiffness"], reached.virgin), None


UNLOADING = Law(
    name="unloading",
    summary="unloading line from the deepest point so far",
    stage="unloading",
    acts_on="elements",
    parameters=(Parameter("stiffness", "F/L2", "unloading stiffness ku", above=True),),
    history=True,
    state="unloading",
    initial=lambda _rows, _count, parameters: UnloadingHistory.initial(parameters["stiffness"]),
    plan="on unloading lines, from the deepest point so far",
    largest=_largest,
    equation="F = max(0, F_max - ku' (z_max - z)) below z_max",
    source="linear unloading and reloading as in the full cycle of pipe-soil interaction models",
)
