"""What the picture of an evaluation shows, collected as the steps come: memory does not grow with their number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact import ContactResult, LawKind
from mudline.results.evaluation import Evaluation, Part
from mudline.results.totals import traces
from mudline.scene.numbering import Floats, Indices

_BINS = 2000
"""Pieces of time of which the least and the largest value are drawn."""
_POINTS = 4000
"""Evaluated points that are drawn on the curves."""
TRACED = ("reaction", "force", "touching", "deepest")
"""Figures of a step that are drawn over time."""


class Points(NamedTuple):
    """Evaluated points of elements on a curve: its index, ratio and force."""

    curve: Indices
    ratio: Floats
    force: Floats


@dataclass(frozen=True, slots=True)
class Chosen:
    """The step that is drawn, its result, and the positions (n, 3)."""

    step: int
    result: ContactResult
    positions: Floats


class PlotData:
    """The step with the largest total reaction, points on the curves, and traces over time."""

    def __init__(self, evaluation: Evaluation) -> None:
        self.evaluation = evaluation
        self.chosen: Chosen | None = None
        self.points: list[Points] = []
        bins = min(_BINS, evaluation.steps)
        self.traces = {name: (np.full(bins, np.inf), np.full(bins, -np.inf)) for name in TRACED}
        self._largest = -np.inf
        on_curve = evaluation.model.input.law[evaluation.elements] == LawKind.CURVE
        self._on_curve = evaluation.elements[on_curve]
        self._every = max(1, evaluation.steps * len(self._on_curve) // _POINTS)
        self._seen = 0

    @property
    def bin_times(self) -> Floats:
        """The time of the first step of each bin."""
        bins = len(self.traces["reaction"][0])
        first = -(-np.arange(bins) * self.evaluation.steps // bins)
        return np.zeros(0) if self.evaluation.time is None else self.evaluation.time[first]

    def take(self, part: Part) -> None:
        """Look at some steps."""
        of_part = traces(self.evaluation, part)
        steps = np.arange(part.start, part.start + part.count)
        where = steps * len(self.traces["reaction"][0]) // self.evaluation.steps
        for name, (least, most) in self.traces.items():
            values = of_part[name].values
            np.minimum.at(least, where, np.where(np.isnan(values), np.inf, values))
            np.maximum.at(most, where, np.where(np.isnan(values), -np.inf, values))
        self._choose(part, of_part["reaction"].values)
        self._sample(part)

    def _choose(self, part: Part, reaction: Floats) -> None:
        step = int(np.argmax(reaction))
        if self.chosen is None or reaction[step] > self._largest:
            self._largest = float(reaction[step])
            index = part.start + step
            places = np.array(self.evaluation.positions[index], dtype=np.float64)
            whole = part.result.step(step)
            self.chosen = Chosen(index, whole, places)

    def _sample(self, part: Part) -> None:
        """Evaluated points at even distances; those of the chosen step are drawn anyway."""
        size = part.count * len(self._on_curve)
        taken = np.arange(-self._seen % self._every, size, self._every)
        self._seen += size
        if taken.size:
            step, row = np.divmod(taken, len(self._on_curve))
            element = self._on_curve[row]
            self.points.append(self.points_at(part.result, step, element))

    def points_at(self, result: ContactResult, step: Indices | tuple[()], element: Indices) -> Points:
        """Points of elements at steps of a series, or of one step."""
        at = (element,) if isinstance(step, tuple) else (step, element)
        curve = self.evaluation.model.input.curve_index[element]
        return Points(curve.astype(np.intp), result.ratio[at], result.force[at])

    @property
    def on_curve(self) -> Indices:
        """The evaluated elements with a curve."""
        elements: Indices = self._on_curve
        return elements


def along(positions: Floats) -> tuple[Floats, NDArray[np.float64]]:
    """Distances (n,) of nodes along the horizontal direction in which they spread most, and that direction (2,).

    It points from the first node to the last; nodes without a position are NaN.
    """
    known = ~np.isnan(positions).any(axis=1)
    plan = positions[:, 1:]
    scaled = plan[known] / (float(np.abs(plan[known]).max()) or 1.0)  # the squares of large numbers would overflow
    _, axes = np.linalg.eigh(np.cov(scaled.T, bias=True))
    direction = axes[:, -1]
    ends = plan[known][[0, -1]]
    if float((ends[1] - ends[0]) @ direction) < 0.0:
        direction = -direction
    return (plan - ends[0]) @ direction, direction


def thinned(values: Floats, most: int) -> Indices:
    """Rows to draw of many: the least and the largest value of each of `most` / 2 pieces, and both ends."""
    if len(values) <= most:
        return np.arange(len(values))
    edges = np.linspace(0, len(values), most // 2 + 1).astype(np.intp)[:-1]
    known = np.nan_to_num(values)
    low, high = np.minimum.reduceat(known, edges), np.maximum.reduceat(known, edges)
    piece = np.searchsorted(edges, np.arange(len(values)), side="right") - 1
    kept = (known == low[piece]) | (known == high[piece])
    first = np.ones(len(values), dtype=bool)
    first[1:] = (known[1:] != known[:-1]) | (piece[1:] != piece[:-1])
    drawn: NDArray[np.bool_] = kept & first
    drawn[[0, -1]] = True
    return np.flatnonzero(drawn)
