"""The law of a curve in exact rational arithmetic: points and ratios as the doubles they are, no rounding at all."""

from __future__ import annotations

from bisect import bisect_right
from fractions import Fraction

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve


def exact_forces(curve: ForceCurve, ratios: FloatArray) -> list[Fraction]:
    """The forces at `ratios` (n,): linear between the points, the end segments continued."""
    inner = curve.ratios[1:-1].tolist()
    found = []
    for ratio in ratios.tolist():
        left = bisect_right(inner, ratio)
        r0, r1 = (Fraction(float(value)) for value in curve.ratios[left : left + 2])
        f0, f1 = (Fraction(float(value)) for value in curve.forces[left : left + 2])
        found.append(f0 + (f1 - f0) / (r1 - r0) * (Fraction(ratio) - r0))
    return found


def largest_error(forces: FloatArray, exact: list[Fraction], scale: float) -> float:
    """Largest |force - exact| over `scale`, rounded once at the end; inf where a force is not finite."""
    if not np.isfinite(forces).all():
        return float("inf")
    errors = (abs(Fraction(force) - true) for force, true in zip(forces.tolist(), exact, strict=True))
    return float(max(errors) / Fraction(scale))
