"""Time and memory of each scene at each number of nodes."""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.model import ContactModel
from mudline.study.pruning.bare import bare_evaluation
from mudline.study.pruning.motion import STEPS, positions, series
from mudline.study.pruning.pipe import Pipe
from mudline.study.pruning.variants import Variant, line
from mudline.study.report import StudyOptions
from mudline.study.timing import Timing, spent


class CostRow(NamedTuple):
    """A scene of so many nodes.

    nanoseconds: best time of the processor per node and step, of a series.
    median: the middle one.
    touching: share of elements in contact at the first step.
    peak: largest memory of one evaluation of one step beyond what was there before, bytes per node; its result counts.
    prepare: nanoseconds per node to make the evaluator.
    history: whether steps are taken one after the other.
    """

    scene: str
    nodes: int
    nanoseconds: float
    median: float
    touching: float
    peak: float
    prepare: float
    history: bool


class CurveRow(NamedTuple):
    """A scene with nothing but a curve, all elements touching, and what it is compared with; ns per node."""

    nodes: int
    curve: float
    bare: float
    scene: float

    @property
    def over_curve(self) -> float:
        """How many times the time of the curve alone."""
        return self.scene / self.curve

    @property
    def over_bare(self) -> float:
        """How many times the time of plain numpy."""
        return self.scene / self.bare


def costs(found: Sequence[Variant], pipe: Pipe, ladder: Sequence[int], options: StudyOptions) -> Iterator[CostRow]:
    """Every scene at every number of nodes."""
    for nodes in ladder:
        for variant in found:
            options.progress(f"{nodes} nodes: {variant.name}")
            yield cost(variant, pipe, nodes)


def cost(variant: Variant, pipe: Pipe, nodes: int) -> CostRow:
    """One scene."""
    inputs = variant.make(nodes)
    model = ContactModel(inputs)
    points = positions(variant, inputs, pipe)
    taken = stepping(model, series(points, pipe))
    prepared = spent(lambda: ContactModel(inputs), few=True)
    per = 1e9 / (nodes * STEPS)
    touching, peak = _evaluated(model, points)
    return CostRow(
        variant.name,
        nodes,
        taken.best * per,
        taken.median * per,
        touching,
        peak / nodes,
        prepared.best * 1e9 / nodes,
        model.plan.history,
    )


def stepping(model: ContactModel, moved: FloatArray) -> Timing:
    """Time of a run through a series (steps, n, 3), results thrown away."""
    times = 0.1 * np.arange(float(len(moved)))

    def run() -> None:
        for _ in model.stream(moved, times=times):
            pass

    return spent(run)


def curve_alone(pipe: Pipe, nodes: int) -> CurveRow:
    """The scene with a curve against the curve on the same ratios and against plain numpy; one step, turn by turn."""
    inputs = line(pipe, nodes)
    model = ContactModel(inputs)
    points = positions(Variant("", lambda _: inputs), inputs, pipe)
    ratios = model.evaluate(points).ratio.copy()
    calls = (
        lambda: pipe.curve.evaluate(ratios),
        lambda: bare_evaluation(inputs, points),
        lambda: model.evaluate(points),
    )
    least = [np.inf] * len(calls)
    for _ in range(3):  # turn by turn: a machine that gets busy slows all of them
        for index, call in enumerate(calls):
            least[index] = min(least[index], spent(call).best)
    curve, bare, scene = (1e9 * seconds / nodes for seconds in least)
    return CurveRow(nodes, curve, bare, scene)


def _evaluated(model: ContactModel, points: FloatArray) -> tuple[float, int]:
    """Share of elements that touch, and bytes at the peak of an evaluation."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        result = model.evaluate(points)
        peak = tracemalloc.get_traced_memory()[1] - before
    finally:
        tracemalloc.stop()
    return float(result.contact.mean()), peak
