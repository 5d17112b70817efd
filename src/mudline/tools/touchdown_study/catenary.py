"""Catenary of a line between its two ends: its tension, and its length on the seabed.

The line is inextensible and has no bending stiffness; its elements have lengths and weights per length. It leaves the
seabed where V = 0. From there an element of weight q and length l increases V to V1 = V + q l. It adds T/q (asinh(V1/T)
- asinh(V/T)) to the distance and (sqrt(T^2 + V1^2) - sqrt(T^2 + V^2))/q to the height. The horizontal tension T is
constant. On a seabed that rises by `slope` the line leaves with V = T slope. Buoyant elements have q < 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mudline.model.scene.numbering import Floats

_STEPS = 80
"""Halvings of an interval, after which its ends are adjacent floats."""
_CLOSE = 1e-13
_LEAST = 1e-6
"""Share of the weight of a line: the least tension tried; the largest is the weight divided by it."""
_MET, _DIP = 1e-6, 1e-9
"""Shares of the length: accuracy of the ends, and depth below the seabed that rounding may cause."""
_STRAIGHT = 1e-9
"""Change of V/T along an element below which it is straight to rounding."""


_Part = tuple[float, float]
"""First and last arc length of a part of a line."""


class NoRestShapeError(Exception):
    """Reason, in a sentence, why a line has no resting shape."""


class Catenary(NamedTuple):
    """A line at rest.

    Attributes:
        tension: horizontal tension.
        lying: (first, last) arc lengths of the parts on the seabed, along the line.
        distance: distances (n,) of the nodes from the first end.
        height: heights (n,) of the nodes above the seabed below them.
        vertical: vertical force (n,) of the line at each node on the next element; 0 on the seabed.
    """

    tension: float
    lying: tuple[_Part, ...]
    distance: Floats
    height: Floats
    vertical: Floats


class HangingLine:
    """The elements between two held ends, from the lower to the upper end.

    Args:
        lengths, weights: (m,) of the elements.
        slope: tangent of the angle by which the seabed rises from the first end to the last.
    """

    def __init__(self, lengths: Floats, weights: Floats, slope: float = 0.0) -> None:
        self.lengths, self.weights, self.slope = lengths, weights, slope
        self.arcs = np.append(0.0, np.cumsum(lengths))
        self.carried = np.append(0.0, np.cumsum(lengths * weights))
        self.length = float(self.arcs[-1])

    def reversed(self) -> HangingLine:
        """Return the line from its other end."""
        return HangingLine(self.lengths[::-1], self.weights[::-1], -self.slope)

    def weight_to(self, arc: float) -> float:
        """Return the weight from the first end to an arc length."""
        return float(np.interp(arc, self.arcs, self.carried))

    def lifted(self, tension: float, start: float, stop: float) -> tuple[Floats, Floats, Floats, Floats]:
        """Return arc lengths, distances, heights and vertical forces (k,) of the hanging part between two arc lengths.

        Distances and heights are relative to `start`, where V = T slope; heights are above the seabed.
        """
        inner = (self.arcs > start) & (self.arcs < stop)
        arcs = np.concatenate([[start], self.arcs[inner], [stop]])
        at = np.clip(np.searchsorted(self.arcs, 0.5 * (arcs[:-1] + arcs[1:])) - 1, 0, len(self.weights) - 1)
        weights, steps = self.weights[at], np.diff(arcs)
        force = tension * self.slope + np.append(0.0, np.cumsum(weights * steps))
        before, behind = force[:-1] / tension, force[1:] / tension
        root, next_root = np.hypot(1.0, before), np.hypot(1.0, behind)
        rise = weights * steps / tension
        curved = np.abs(rise) > _STRAIGHT
        # a difference of two asinh by one asinh, which keeps the digits of a small difference
        along = np.arcsinh(behind * root - before * next_root) / np.where(curved, rise, 1.0)
        distance = np.append(0.0, np.cumsum(steps * np.where(curved, along, 1.0 / root)))
        height = np.append(0.0, np.cumsum(steps * (before + behind) / (root + next_root)))
        return arcs, distance, height - self.slope * distance, force

    def carrying_parts(self) -> list[_Part]:
        """Return the stretches (first, last arc length) of elements that sink, between buoyant stretches."""
        sinks = np.concatenate([[False], self.weights > 0.0, [False]])
        first, last = np.flatnonzero(~sinks[:-1] & sinks[1:]), np.flatnonzero(sinks[:-1] & ~sinks[1:])
        return [(float(self.arcs[a]), float(self.arcs[b])) for a, b in zip(first, last, strict=True)]


def rest(line: HangingLine, distance: float, heights: tuple[float, float]) -> Catenary:
    """Return the shape of a line whose ends are `distance` apart, at `heights` above the seabed.

    A first height of 0 or less belongs to an end on the seabed; the last height is above 0. Raises NoRestShapeError for
    a line without a shape.
    """
    parts = line.carrying_parts()
    if not parts or (heights[0] <= 0.0 and parts[0][0] > 0.0):
        raise NoRestShapeError(f"the pipe floats: {line.weights[0]:.4g} per unit length where the line would lie")
    rise = heights[1] - max(heights[0], 0.0) + line.slope * distance
    if math.hypot(distance, rise) >= line.length:
        apart = f"its ends are {math.hypot(distance, rise):.6g} apart, and it is {line.length:.6g} long"
        raise NoRestShapeError(f"the line is taut: {apart}")
    used = parts[:1]
    shape = _tensioned(line, distance, heights, used)
    for part in parts[1:]:
        inside = (line.arcs >= part[0]) & (line.arcs <= part[1])
        if (shape.height[inside] < -_DIP * line.length).any():
            used = [*used, part]
            shape = _tensioned(line, distance, heights, used)
    if (shape.height < -_DIP * line.length).any():
        raise NoRestShapeError("the line would sink below the seabed where it hangs")
    return shape


def _tensioned(line: HangingLine, distance: float, heights: tuple[float, float], used: list[_Part]) -> Catenary:
    """Return the shape with the required distance of the ends and lying parts in `used`, by varying the tension."""
    low, high = (float(np.abs(line.carried).max()) * share for share in (_LEAST, 1.0 / _LEAST))
    shape = _hanging(line, low, heights, used)
    if shape is None or _extent(line, low, shape) > distance:
        least = line.length if shape is None else _extent(line, low, shape)
        raise NoRestShapeError(
            f"the line is slack: laid straight and hung steeply it reaches {least:.6g}, its ends are {distance:.6g} "
            "apart"
        )
    while high > low * (1.0 + _CLOSE):
        middle = math.sqrt(low) * math.sqrt(high)
        if not low < middle < high:
            break
        trial = _hanging(line, middle, heights, used)
        if trial is None or _extent(line, middle, trial) > distance:
            high = middle
        else:
            low, shape = middle, trial
    if abs(_extent(line, low, shape) - distance) > _MET * line.length:
        raise NoRestShapeError("the line hangs free of the seabed")
    return _assembled(line, low, shape)


def _hanging(line: HangingLine, tension: float, heights: tuple[float, float], used: list[_Part]) -> list[_Part] | None:
    """Return the hanging parts under a tension: at the ends above the seabed, and between lying parts.

    None if the tension is too large for a part to leave the seabed.
    """
    spans: list[_Part] = []
    if heights[0] > 0.0:
        back = line.reversed()
        start = _leaves(back, tension, (line.length - used[0][1], line.length - used[0][0]), heights[0])
        if start is None:
            return None
        spans.append((0.0, line.length - start))
    for before, behind in pairwise(used):
        arch = _arch(line, tension, before, behind)
        if arch is None:
            return None
        spans.append(arch)
    start = _leaves(line, tension, used[-1], heights[1])
    if start is None or any(a[1] > b[0] for a, b in pairwise([*spans, (start, line.length)])):
        return None
    return [*spans, (start, line.length)]


def _leaves(line: HangingLine, tension: float, part: _Part, height: float) -> float | None:
    """Return the arc length at which a line leaves the seabed within a part to end at a height, or None."""

    def missing(start: float) -> float:
        return height - float(line.lifted(tension, start, line.length)[2][-1])

    if missing(part[0]) > 0.0:
        return None
    return part[1] if missing(part[1]) < 0.0 else _root(missing, *part)


def _arch(line: HangingLine, tension: float, before: _Part, behind: _Part) -> _Part | None:
    """Return the arc lengths at which a buoyant arch leaves the seabed and comes down in the next part, or None."""

    def lands(start: float) -> float:
        inner = (line.arcs >= behind[0]) & (line.arcs <= behind[1])
        return float(np.interp(line.weight_to(start), line.carried[inner], line.arcs[inner]))

    def missing(start: float) -> float:
        return -float(line.lifted(tension, start, lands(start))[2][-1])

    if missing(before[0]) > 0.0 or missing(before[1]) < 0.0:
        return None
    start = _root(missing, *before)
    return start, lands(start)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return the root of an ascending function, not above 0 at `low` and not below 0 at `high`."""
    at_low, at_high, last = function(low), function(high), 0
    for step in range(_STEPS):
        if not at_high > at_low or high - low <= _CLOSE * max(abs(low), abs(high)):
            break
        middle = 0.5 * (low + high) if step % 3 == 2 else low - at_low * (high - low) / (at_high - at_low)
        value = function(min(max(middle, low), high))
        if value > 0.0:
            high, at_high, at_low, last = middle, value, at_low * (0.5 if last > 0 else 1.0), 1
        else:
            low, at_low, at_high, last = middle, value, at_high * (0.5 if last < 0 else 1.0), -1
    return 0.5 * (low + high)


def _extent(line: HangingLine, tension: float, shape: list[_Part]) -> float:
    """Return the distance between the ends of a line with hanging parts."""
    lying = line.length - sum(last - first for first, last in shape)
    cosine = 1.0 / math.hypot(1.0, line.slope)
    return lying * cosine + sum(float(_span(line, tension, each)[1][-1]) for each in shape)


def _span(line: HangingLine, tension: float, span: _Part) -> tuple[Floats, Floats, Floats, Floats]:
    """Return arc lengths, distances, heights and forces of a hanging part, from its end on the seabed."""
    first, last = span
    if first > 0.0 or last >= line.length:
        return line.lifted(tension, first, last)
    back = line.reversed().lifted(tension, line.length - last, line.length)
    arcs, distance, height, force = (each[::-1] for each in back)
    return line.length - arcs, distance[0] - distance, height, -force


def _assembled(line: HangingLine, tension: float, shape: list[_Part]) -> Catenary:
    """Return the catenary of all nodes from its hanging parts."""
    cosine = 1.0 / math.hypot(1.0, line.slope)
    steps, height, vertical = np.diff(line.arcs) * cosine, np.zeros(len(line.arcs)), np.zeros(len(line.arcs))
    distance = np.append(0.0, np.cumsum(steps))
    for first, last in shape:
        arcs, along, above, force = _span(line, tension, (first, last))
        inside = (line.arcs > first) & (line.arcs <= last) if first > 0.0 else line.arcs <= last
        at = line.arcs[inside]
        start = float(np.interp(first, line.arcs, distance))
        moved = start + np.interp(at, arcs, along)
        distance[line.arcs > last] += start + along[-1] - float(np.interp(last, line.arcs, distance))
        distance[inside] = moved
        height[inside], vertical[inside] = (np.interp(at, arcs, each) for each in (above, force))
    ends = [0.0, *(arc for span in shape for arc in span), line.length]
    lying = tuple((ends[i], ends[i + 1]) for i in range(0, len(ends), 2) if ends[i + 1] > ends[i])
    return Catenary(tension, lying, distance, height, vertical)
