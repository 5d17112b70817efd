"""Published penetration resistance of a pipe in clay, as the points of a force-embedment curve.

backbone = Backbone(MODELS["f114"], Soil(diameter=0.3, strength=5000.0, gradient=1500.0, weight=6000.0))
points = backbone.points(depth=0.5, tolerance=0.005)

z is the penetration of the pipe's invert, D its diameter, r = z/D, s_u = su0 + gradient z the undrained shear strength
at the invert, w the submerged weight of the soil per volume. Every force is per unit length, in the units of the soil.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mudline.model.curves import FloatArray

__all__ = ["MODELS", "Backbone", "Model", "Soil"]

_SAMPLES = 400
"""Points at which a chord is compared with the model, for every smooth part of the model."""
_MARGIN = 0.995
"""Part of the tolerance used by the chords; the remainder covers rounded points and deviations between samples."""
_DIGITS = 7
"""Least number of digits of the numbers of a point.

Rounding is then a hundredth of the margin left by `_MARGIN`, for a fine tolerance too.
"""


@dataclass(frozen=True, slots=True)
class Soil:
    """A pipe and the clay below it, in one system of units.

    Attributes:
        diameter: of the pipe, > 0.
        strength: su0, undrained shear strength at the mudline, > 0.
        gradient: increase of the strength per depth, >= 0.
        weight: w, submerged weight of the soil per volume, >= 0.
    """

    diameter: float
    strength: float
    gradient: float = 0.0
    weight: float = 0.0

    def shear_strength(self, ratio: FloatArray) -> FloatArray:
        """Return s_u at the invert."""
        return self.strength + self.gradient * self.diameter * ratio


@dataclass(frozen=True, slots=True)
class Model:
    """A published model.

    Attributes:
        title: authors, and year or document.
        formula: force per unit length in one line, for people.
        resistance: the force at ratios >= 0.
        published: the largest ratio for which the model is published or described here.
        range_note: reason for that limit.
        corners: ratios at which the slope jumps.
        weighs: whether the resistance depends on the soil's weight.
    """

    title: str
    formula: str
    resistance: Callable[[Soil, FloatArray], FloatArray]
    published: float
    range_note: str
    corners: tuple[float, ...] = ()
    weighs: bool = True


def contact_width(ratio: FloatArray) -> FloatArray:
    """Return B/D: the chord of the circle at the mudline, 1 for r >= 1/2."""
    low = np.minimum(ratio, 0.5)
    return 2.0 * np.sqrt(low * (1.0 - low))


def displaced_area(ratio: FloatArray) -> FloatArray:
    """Return A_bm/D^2: the segment below the mudline; for r >= 1/2 the half circle and the slot of width D above it."""
    width = contact_width(ratio)
    segment = np.arcsin(width) / 4.0 - width / 4.0 * np.sqrt(1.0 - width * width)
    return np.where(ratio < 0.5, segment, math.pi / 8.0 + (ratio - 0.5))


def _heave(soil: Soil, ratio: FloatArray) -> FloatArray:
    """Return 1.5 w A_bm: the weight of the displaced soil with the heave next to the pipe."""
    return 1.5 * soil.weight * soil.diameter * soil.diameter * displaced_area(ratio)


def _f114(soil: Soil, ratio: FloatArray) -> FloatArray:
    factor = np.minimum(6.0 * ratio**0.25, 3.4 * np.sqrt(10.0 * ratio))
    return factor * soil.shear_strength(ratio) * soil.diameter + _heave(soil, ratio)


def _skempton(soil: Soil, ratio: FloatArray) -> FloatArray:
    width = contact_width(ratio)
    depth = np.divide(ratio, width, out=np.zeros_like(ratio), where=width > 0.0)
    factor = np.minimum(5.14 * (1.0 + 0.23 * np.sqrt(depth)), 7.5)
    pressure = factor * soil.shear_strength(ratio) + soil.weight * soil.diameter * ratio
    return pressure * width * soil.diameter


def _power(a: float, b: float) -> Callable[[Soil, FloatArray], FloatArray]:
    return lambda soil, ratio: a * ratio**b * soil.shear_strength(ratio) * soil.diameter


def _merifield(a: float, b: float) -> Callable[[Soil, FloatArray], FloatArray]:
    bare = _power(a, b)
    return lambda soil, ratio: bare(soil, ratio) + _heave(soil, ratio)


def _randolph_quiggin(soil: Soil, ratio: FloatArray) -> FloatArray:
    factor = np.where(ratio < 0.1, 6.0 * 0.1**0.25 * np.sqrt(10.0 * ratio), 6.0 * ratio**0.25)
    zeta = 200.0 * ratio
    segment = np.where(ratio < 0.5, displaced_area(ratio), math.pi / 4.0 - displaced_area(np.maximum(1.0 - ratio, 0.0)))
    buoyancy = 1.5 * soil.weight * soil.diameter * soil.diameter * segment
    return factor * soil.shear_strength(ratio) * soil.diameter * zeta / (1.0 + zeta) + buoyancy


_HALF = "it is published for penetrations up to half the diameter"
_CAP = (7.5 / 5.14 - 1.0) ** 2 / 0.23**2
"""z/B at which the bearing factor of Skempton reaches 7.5."""

MODELS = {
    "f114": Model(
        "DNV-RP-F114, undrained penetration, model 2",
        "min(6 r^0.25, 3.4 (10 r)^0.5) s_u D + 1.5 w A_bm",
        _f114,
        0.5,
        "beyond half the diameter its users warn of the result",
        corners=((3.4 * math.sqrt(10.0) / 6.0) ** -4.0,),
    ),
    "skempton": Model(
        "Skempton 1951, as used by STRIDE",
        "(min(5.14 (1 + 0.23 (z/B)^0.5), 7.5) s_u + w z) B",
        _skempton,
        _CAP,
        "there the bearing factor reaches 7.5, and stays",
        corners=(0.5, _CAP),
    ),
    "aubeny": Model(
        "Aubeny, Shi and Murff 2005, smooth pipe in a trench of its own width",
        "4.97 r^0.23 s_u D",
        _power(4.97, 0.23),
        0.5,
        _HALF,
        weighs=False,
    ),
    "aubeny-rough": Model(
        "Aubeny, Shi and Murff 2005, rough pipe in a trench of its own width",
        "6.73 r^0.29 s_u D",
        _power(6.73, 0.29),
        0.5,
        _HALF,
        weighs=False,
    ),
    "merifield": Model(
        "Merifield, White and Randolph 2009, smooth pipe",
        "5.66 r^0.32 s_u D + 1.5 w A_bm",
        _merifield(5.66, 0.32),
        0.5,
        _HALF,
    ),
    "merifield-rough": Model(
        "Merifield, White and Randolph 2009, rough pipe",
        "7.4 r^0.4 s_u D + 1.5 w A_bm",
        _merifield(7.4, 0.4),
        0.5,
        _HALF,
    ),
    "randolph-quiggin": Model(
        "Randolph and Quiggin 2009, initial penetration, K_max 200",
        "N_c s_u D 200 r/(1 + 200 r) + 1.5 w A, N_c = 6 r^0.25, below r = 0.1: N_c(0.1) (10 r)^0.5",
        _randolph_quiggin,
        1.0,
        "it has no published end that we know of: one diameter",
        corners=(0.1,),
    ),
}
"""The models by their names on the command line."""


@dataclass(frozen=True, slots=True)
class Backbone:
    """A model in one soil."""

    model: Model
    soil: Soil

    def force(self, ratio: FloatArray) -> FloatArray:
        """Return force per unit length at ratios z/D >= 0."""
        return self.model.resistance(self.soil, ratio)

    def points(self, depth: float, tolerance: float, first: float = 0.0) -> FloatArray:
        """Return points (ratio, force) of the model from (0, 0) to `depth`, (n, 2), few enough for the tolerance.

        Linear interpolation between the points differs from the model by at most `tolerance` times its largest force,
        from the ratio `first` on. No point but (0, 0) lies nearer to 0, where most models are too steep for an
        analysis. The next point is always the farthest that keeps the tolerance; for a curve that bends to one side
        only, no fewer points on it would do.

        Raises OverflowError if the slope of the first chord that keeps the tolerance overflows.
        """
        allowed = _MARGIN * tolerance * self.largest(depth)
        digits = max(_DIGITS, 4 - math.floor(math.log10(tolerance)))
        ratios = [0.0, first] if first and self._chord(0.0, first) > allowed else [0.0]
        while ratios[-1] < depth:
            ratios.append(self._next(ratios[-1], depth, allowed))
        chosen = np.array([*(_rounded(ratio, digits) for ratio in ratios[:-1]), depth])
        return np.column_stack((chosen, [_rounded(force, digits) for force in self.force(chosen).tolist()]))

    def largest(self, depth: float) -> float:
        """Return the largest force down to `depth`."""
        return float(self.force(self._samples(0.0, depth)).max())

    def deviation(self, points: FloatArray) -> float:
        """Return the largest distance between the model and linear interpolation of `points`, over their range."""
        ratios, forces = points.T
        pieces = zip(ratios[:-1].tolist(), ratios[1:].tolist(), strict=True)
        samples = np.concatenate([self._samples(start, end) for start, end in pieces])
        return float(np.abs(np.interp(samples, ratios, forces) - self.force(samples)).max())

    def _next(self, start: float, depth: float, allowed: float) -> float:
        """Return the farthest end of a chord from `start` that stays within `allowed`, by bisection."""
        if self._chord(start, depth) <= allowed:
            return depth
        low, high = start, depth
        while high - low > 1e-9 * high and low < (middle := 0.5 * (low + high)) < high:
            low, high = (middle, high) if self._chord(start, middle) <= allowed else (low, middle)
        if not np.isfinite(np.diff(self.force(np.array([start, low]))) / (low - start)).all():
            raise OverflowError(f"the curve is too steep for a float64 from z/D = {start:g} on")
        return low

    def _chord(self, start: float, end: float) -> float:
        return self.deviation(np.column_stack(((start, end), self.force(np.array([start, end])))))

    def _samples(self, start: float, end: float) -> FloatArray:
        """Return ratios from `start` to `end`, including corners, denser at either end, where roots are steep."""
        inner = [corner for corner in self.model.corners if start < corner < end]
        ends = np.array([start, *inner, end])
        share = np.linspace(0.0, 1.0, _SAMPLES)
        share = share**3 * (10.0 - 15.0 * share + 6.0 * share * share)
        return np.unique(ends[:-1, None] + np.diff(ends)[:, None] * share)


def _rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")
