"""Time and memory of each scene at each number of nodes, and what a scene with nothing but a curve pays beyond it."""

from __future__ import annotations

import tracemalloc
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput
from mudline.contact.model import ContactModel
from mudline.study.pictures import Picture, draw_lines, label, legend_below, style
from mudline.study.pruning.scenes import CURVE, STEPS, Pipe, Variant, line, positions, series
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.timing import Timing, processor_time

if TYPE_CHECKING:  # only who draws loads matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LADDER = (100, 1000, 10_000, 100_000)
MOST = 1_000_000


class CostRow(NamedTuple):
    """A scene of so many nodes.

    nanoseconds, median: best and middle time of the processor, of a series.
    touching: at the first step.
    peak: largest memory of one evaluation of one step beyond what was there before, bytes per node; its result counts.
    prepare: nanoseconds per node to make the evaluator.
    history: whether steps are taken one after the other.
    """

    scene: Annotated[str, "scene"]
    nodes: Annotated[int, "nodes"]
    nanoseconds: Annotated[float, "best time [ns/node/step]"]
    median: Annotated[float, "median time [ns/node/step]"]
    touching: Annotated[float, "share in contact"]
    peak: Annotated[float, "memory [bytes/node]"]
    prepare: Annotated[float, "to prepare [ns/node]"]
    history: Annotated[bool, "history"]


class CurveRow(NamedTuple):
    """A scene with nothing but a curve, all elements touching, and what it is compared with; ns per node."""

    nodes: Annotated[int, "nodes"]
    curve: Annotated[float, "curve alone [ns/node]"]
    bare: Annotated[float, "plain numpy [ns/node]"]
    scene: Annotated[float, "scene [ns/node]"]

    @property
    def over_curve(self) -> float:
        """How many times the time of the curve alone."""
        return self.scene / self.curve

    @property
    def over_bare(self) -> float:
        """How many times the time of plain numpy."""
        return self.scene / self.bare


ALONE = Layout[CurveRow](
    "curve",
    "A scene with nothing but a curve, one step, every element in contact",
    {
        **columns_of(CurveRow),
        "scene / curve alone": lambda row: row.over_curve,
        "scene / plain numpy": lambda row: row.over_bare,
    },
)
STAGES = Layout[tuple[CostRow, CostRow]](
    "stages",
    "Scenes of {nodes} nodes",
    {
        "scene": lambda both: both[0].scene,
        "steps": lambda both: "one by one" if both[0].history else "together",
        "in contact [%]": lambda both: 100.0 * both[0].touching,
        "time [ns/node/step]": lambda both: both[0].nanoseconds,
        "times the curve's": lambda both: both[0].nanoseconds / both[1].nanoseconds,
        "memory [bytes/node]": lambda both: both[0].peak,
        "to prepare [ns/node]": lambda both: both[0].prepare,
    },
)
"""A scene, and that with nothing but a curve."""
NODES = Layout("nodes", "Time and memory against the number of nodes", columns_of(CostRow), brief=False)


def study_curve(pipe: Pipe, options: StudyOptions) -> list[CurveRow]:
    """The curve alone at every number of nodes."""
    rows = []
    for nodes in (*LADDER, MOST):
        options.progress(f"{nodes} nodes: the curve alone, and the scene that has nothing else")
        rows.append(curve_alone(pipe, nodes))
    return rows


def study_cost(variants: Sequence[Variant], pipe: Pipe, alone: Sequence[CurveRow], options: StudyOptions) -> Section:
    """Every scene at every number of nodes, beside the rows of the curve alone."""
    rows = []
    for nodes in (*LADDER, MOST) if options.full else LADDER:
        for variant in variants:
            options.progress(f"{nodes} nodes: {variant.name}")
            rows.append(cost(variant, pipe, nodes))
    most = max(row.nodes for row in rows)
    largest = [row for row in rows if row.nodes == most]
    plain = next(row for row in largest if row.scene == CURVE)
    tables = (
        ALONE.table(alone),
        STAGES.table([(row, plain) for row in largest], nodes=most),
        NODES.table(rows),
    )
    caption = "Time per node and step, and memory per node, against the number of nodes: one line a scene."
    stages = "Cost of each scene in times that of the curve alone."
    pictures = (
        Picture("nodes", caption, partial(_draw_nodes, rows, alone), (12.0, 8.0)),
        Picture("stages", stages, partial(_draw_stages, largest, plain), (11, 6.5)),
    )
    return Section(tables, pictures)


def _draw_nodes(rows: Sequence[CostRow], alone: Sequence[CurveRow], figure: Figure) -> None:
    time, memory = figure.subplots(1, 2)
    scenes = grouped(rows, lambda row: row.scene)
    times = {scene: [(row.nodes, row.nanoseconds) for row in part] for scene, part in scenes.items()}
    peaks = {scene: [(row.nodes, row.peak) for row in part] for scene, part in scenes.items()}
    draw_lines(time, times, "Time of one step", "nodes [-]", "time per node and step [ns]")
    draw_lines(memory, peaks, "Most memory during one step", "nodes [-]", "memory per node [bytes]")
    nodes, curve = [row.nodes for row in alone], [row.curve for row in alone]
    time.loglog(nodes, curve, "k:", linewidth=2.5, label="ForceCurve.evaluate alone")
    memory.set_ylim(100.0, 2.0 * max(row.peak for row in rows))
    memory.yaxis.set_minor_formatter("")
    legend_below(figure, time, 4)


def _draw_stages(largest: Sequence[CostRow], plain: CostRow, figure: Figure) -> None:
    time, memory = figure.subplots(1, 2, sharey=True)
    names = [row.scene for row in largest]
    _bars(time, names, [row.nanoseconds / plain.nanoseconds for row in largest])
    _bars(memory, names, [row.peak / plain.peak for row in largest])
    label(time, f"Time of one step, {plain.nodes} nodes", "times that of the scene with a curve [-]", "")
    label(memory, "Most memory during one step", "times that of the scene with a curve [-]", "")
    time.invert_yaxis()


def _bars(axes: Axes, names: Sequence[str], values: Sequence[float]) -> None:
    bars = axes.barh(names, values, color=style(0)["color"])
    axes.bar_label(bars, fmt="%.2g", padding=3)
    axes.set_xlim(0.0, 1.15 * max(values))
    axes.axvline(1.0, color="0.4", linestyle=":")


def cost(variant: Variant, pipe: Pipe, nodes: int) -> CostRow:
    """One scene."""
    inputs = variant.make(nodes)
    model = ContactModel(inputs)
    points = positions(variant, inputs, pipe)
    taken = stepping(model, series(points, pipe))
    prepared = processor_time(lambda: ContactModel(inputs), few=True)
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

    return processor_time(run)


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
            least[index] = min(least[index], processor_time(call).best)
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


def bare_evaluation(inputs: ContactInput, points: FloatArray) -> tuple[NDArray[np.float64 | np.bool_], ...]:
    """Depth, ratio, contact, force, slope, stiffness, and reactions, of a chain of elements on one curve, flat seabed.

    What nobody who wants the same results can do without, in plain numpy: a line of code for each. All elements are
    taken to touch the seabed; nothing is checked, no history, no other law or seabed.
    """
    gap = points[:, 0] + 0.0
    depth = -0.5 * (gap[:-1] + gap[1:])
    ratio = depth / inputs.diameter
    contact = depth > 0.0
    force, slope = inputs.curves[0].evaluate(ratio)
    stiffness = slope / inputs.diameter
    share = 0.5 * inputs.length * force
    normal_force = np.zeros(len(points))
    normal_force[:-1] += share
    normal_force[1:] += share
    reaction = np.zeros(points.shape)
    reaction[:, 0] = normal_force
    return gap, depth, ratio, contact, force, slope, stiffness, normal_force, reaction
