"""Unloading and reloading of `*SEABED UNLOADING`, beside the virgin loading path of a curve or a linear law.

At a new largest penetration the reaction is that of the virgin path. Elsewhere it is that of a straight line through
the deepest point (z_max, F_max) with the stiffness ku', down to 0 at the trench bottom z_p and 0 above it:

    F = max(0, F_max - ku' (z_max - z)),  z_p = z_max - F_max / ku'.

ku' is the largest of the unloading stiffness that was given, the steepest slope that the virgin path reached, and the
secant F_max / z_max. So the line lies nowhere above the virgin path, no closed loop gives work, and the trench bottom
is never above the mudline (the secant counts only where the virgin path jumps at the mudline).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray, IndexArray

if TYPE_CHECKING:  # a linear law does not load the curves
    from mudline.curves import ForceCurve

_LARGEST = np.finfo(np.float64).max


class VirginPath(NamedTuple):
    """The virgin path at the penetrations of a step, arrays (m,), per unit length.

    force: F(z).
    slope: dF/dz.
    steepest: the steepest slope between the mudline and z: the slope itself for a linear law, `steepest_slope` for a
        curve. So a step that passes several segments finds the same path as many small ones.
    """

    force: FloatArray
    slope: FloatArray
    steepest: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class UnloadingHistory:
    """What the elements (m,) remember. A step gives a new one and leaves the old one as it is.

    Attributes:
        stiffness: ku, raised to the steepest slope of the virgin path so far.
        z_max: the largest penetration so far, 0 before the first contact.
        force_max: the virgin force there, F_max; 0 where the path pulls.
        z_p: penetration of the trench bottom, where the reaction vanishes.
    """

    stiffness: FloatArray
    z_max: FloatArray
    force_max: FloatArray
    z_p: FloatArray

    @classmethod
    def initial(cls, stiffness: FloatArray) -> UnloadingHistory:
        """Return the history of elements that never touched the bed, of unloading stiffness `stiffness` > 0."""
        shape = stiffness.shape
        return cls(stiffness.copy(), np.zeros(shape), np.zeros(shape), np.zeros(shape))


class UnloadingReaction(NamedTuple):
    """Reaction of elements, arrays (m,).

    force: per unit length, positive pushing out of the bed.
    stiffness: d force / d penetration, per unit length and length of penetration.
    compressed: the element is below the trench bottom.
    uplift: z_p - z, the way up from the trench bottom, from which suction counts.
    """

    force: FloatArray
    stiffness: FloatArray
    compressed: BoolArray
    uplift: FloatArray


def step(history: UnloadingHistory, z: FloatArray, virgin: VirginPath) -> tuple[UnloadingReaction, UnloadingHistory]:
    """Return the reaction and the next history of elements (m,) at the penetrations `z`.

    At z_max itself, after the step that reached it, the stiffness is that of unloading.
    """
    (deeper,) = (z > history.z_max).nonzero()
    with np.errstate(all="ignore"):
        after = _deepened(history, z, virgin, deeper)
        stiffness = _line_stiffness(after.stiffness, after.z_max, after.force_max)
        compressed = z > after.z_p
        on_line = after.force_max - stiffness * (after.z_max - z)
        force = np.where(compressed, np.maximum(on_line, 0.0, out=on_line), 0.0)
        stiffness = np.where(compressed, stiffness, 0.0)
        force[deeper], stiffness[deeper] = virgin.force[deeper], virgin.slope[deeper]
    return UnloadingReaction(force, stiffness, compressed, after.z_p - z), after


def _deepened(history: UnloadingHistory, z: FloatArray, virgin: VirginPath, deeper: IndexArray) -> UnloadingHistory:
    """The history with the deepest point where it is now, of the elements that are `deeper` than ever."""
    kept = (history.stiffness, history.z_max, history.force_max, history.z_p)
    after = UnloadingHistory(*(values.copy() for values in kept))
    if not deeper.size:
        return after
    z_max, force_max = z[deeper], np.maximum(virgin.force[deeper], 0.0)
    stiffness = np.maximum(history.stiffness[deeper], virgin.steepest[deeper])
    # A bottom that rounds to z_max would leave no place for the reaction there.
    deepest = np.where(force_max > 0.0, np.nextafter(z_max, 0.0), z_max)
    bottom = np.clip(z_max - force_max / _line_stiffness(stiffness, z_max, force_max), 0.0, deepest)
    after.stiffness[deeper], after.z_max[deeper] = stiffness, z_max
    after.force_max[deeper], after.z_p[deeper] = force_max, bottom
    return after


def _line_stiffness(stiffness: FloatArray, z_max: FloatArray, force_max: FloatArray) -> FloatArray:
    """Stiffness ku' of the line through the deepest point."""
    secant = np.minimum(force_max / np.where(z_max > 0.0, z_max, 1.0), _LARGEST)
    return np.maximum(stiffness, secant)


def steepest_slope(curve: ForceCurve, ratio: FloatArray) -> FloatArray:
    """Return the steepest slope (d force / d ratio) of the curve between the mudline and each embedment ratio > 0.

    At a point of the curve the segment to its right does not count yet.
    """
    first, last = curve.segment(np.zeros(1))[0], np.searchsorted(curve.ratios[1:-1], ratio)
    so_far = np.maximum.accumulate(curve.slopes[first:])
    steepest: FloatArray = so_far[np.maximum(last - first, 0)]
    return steepest
