"""Curves that a rule may have something to say about; most curves of most decks are not among them."""

from __future__ import annotations

from itertools import pairwise

from mudline.scene.force_curves import SceneCurve
from mudline.scene.laws import LawTable

MOST_POINTS = 64
"""Points of a curve that are looked at one by one; longer curves are left to the rules."""

LARGEST_RATIO = 5.0
STEEPEST = 100.0


def odd_curves(laws: LawTable) -> list[tuple[int, SceneCurve]]:
    """The curves that are not as they should be, with their index in the table of laws.

    As they should be are curves whose points were all read, begin at (0, 0) and rise in order, with slopes that differ
    by a factor of 100 at most, to a ratio of 5 at most.
    """
    return [(number, entry) for number, entry in enumerate(laws.curves) if not _ordinary(entry)]


def _ordinary(entry: SceneCurve) -> bool:
    if not entry.usable or len(entry.points) > MOST_POINTS:
        return False
    points = entry.points.tolist()
    if points[0] != [0.0, 0.0] or points[-1][0] > LARGEST_RATIO:
        return False
    steps = [(after[0] - before[0], after[1] - before[1]) for before, after in pairwise(points)]
    if any(width <= 0.0 or rise <= 0.0 for width, rise in steps):
        return False
    slopes = [rise / width for width, rise in steps]
    return bool(max(slopes) <= STEEPEST * min(slopes))
