"""Time and memory of each scene at each number of nodes, and the overhead of a scene with one curve alone."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import BoolArray, FloatArray
from mudline.contact.input import ContactInput
from mudline.contact.model import ContactModel
from mudline.study.pictures import Picture, label, line_style
from mudline.study.pruning.plain import Plain
from mudline.study.pruning.scenes import (
    AS_IT_IS,
    CURVE,
    EVERYTHING,
    PLAIN,
    STEPS,
    Pipe,
    Variant,
    line,
    positions,
    series,
)
from mudline.study.report import Layout, Section, StudyOptions, columns_of, grouped
from mudline.study.timing import Spread, paired, ratios

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LADDER = (100, 1000, 10_000, 100_000)
MOST = 1_000_000


class CostRow(NamedTuple):
    """A scene with a number of nodes; CPU times of a series.

    touching: at the first step.
    peak: largest memory of one evaluation of one step beyond what was there before, bytes per node; its result counts.
    prepare: nanoseconds per node to check the input and make the evaluator.
    history: whether steps are taken one after the other.
    ratio: how many times the time of the scene with nothing but a curve, in the same repeat.
    """

    scene: Annotated[str, "scene"]
    nodes: Annotated[int, "nodes"]
    nanoseconds: Annotated[float, "best time [ns/node/step]"]
    median: Annotated[float, "median time [ns/node/step]"]
    touching: Annotated[float, "share in contact"]
    peak: Annotated[float, "memory [bytes/node]"]
    prepare: Annotated[float, "to prepare [ns/node]"]
    history: Annotated[bool, "history"]
    lower: Annotated[float, "lower quartile [ns/node/step]"]
    upper: Annotated[float, "upper quartile [ns/node/step]"]
    ratio: Annotated[float, "times the curve's"]
    ratio_lower: Annotated[float, "times the curve's, lower quartile"]
    ratio_upper: Annotated[float, "times the curve's, upper quartile"]


class CurveRow(NamedTuple):
    """A scene with nothing but a curve, all elements touching, and what it is compared with: medians, ns per node.

    The ratios are medians of those of each repeat.
    """

    nodes: Annotated[int, "nodes"]
    curve: Annotated[float, "curve alone [ns/node]"]
    bare: Annotated[float, "plain numpy [ns/node]"]
    scene: Annotated[float, "scene [ns/node]"]
    over_curve: Annotated[float, "scene / curve alone"]
    over_bare: Annotated[float, "scene / plain numpy"]
    lower: Annotated[float, "scene / plain numpy, lower quartile"]
    upper: Annotated[float, "scene / plain numpy, upper quartile"]
    bare_over_curve: Annotated[float, "plain numpy / curve alone"]
    equal: Annotated[bool, "same results"]


ALONE = Layout("curve", "A scene with nothing but a curve, one step, every element in contact", columns_of(CurveRow))
STAGES = Layout[CostRow](
    "stages",
    "Scenes of about {nodes} nodes",
    {
        "scene": lambda row: row.scene,
        "steps": lambda row: "one by one" if row.history else "together",
        "in contact [%]": lambda row: 100.0 * row.touching,
        "time [ns/node/step]": lambda row: row.median,
        "times the curve's": lambda row: row.ratio,
        "memory [bytes/node]": lambda row: row.peak,
        "to prepare [ns/node]": lambda row: row.prepare,
        "lower quartile [ns/node/step]": lambda row: row.lower,
        "upper quartile [ns/node/step]": lambda row: row.upper,
        "nodes": lambda row: row.nodes,
    },
)
NODES = Layout("nodes", "Time and memory against the number of nodes", columns_of(CostRow), brief=False)


def study_curve(pipe: Pipe, options: StudyOptions) -> list[CurveRow]:
    """The curve alone at every number of nodes."""
    return [curve_alone(pipe, nodes) for nodes in options.each((*LADDER, MOST), "{} nodes: the curve alone".format)]


def study_cost(variants: Sequence[Variant], pipe: Pipe, alone: Sequence[CurveRow], options: StudyOptions) -> Section:
    """Every scene at every number of nodes, beside the rows of the curve alone."""
    sizes = (*LADDER, MOST) if options.full else LADDER
    wanted = [(nodes, variant) for nodes in sizes for variant in variants]
    found: dict[tuple[str, int], CostRow] = {}
    for nodes, variant in options.each(wanted, lambda both: f"{both[0]} nodes: {both[1].name}"):
        inputs = variant.make(nodes)  # a long deck has one copy at several sizes
        if (variant.name, len(inputs.node_ids)) not in found:
            found[variant.name, len(inputs.node_ids)] = cost(variant, inputs, pipe)
        if variant.name == CURVE:
            found[PLAIN, nodes] = plain_cost(inputs, pipe)
    rows = list(found.values())
    largest = [scene[-1] for scene in grouped(rows, lambda row: row.scene).values()]
    tables = ALONE.table(alone), STAGES.table(largest, nodes=sizes[-1]), NODES.table(rows)
    caption = "Time per node and step, and memory per node, against the number of nodes; bars are quartiles."
    stages = "Time and memory of each scene in times those of the scene with a curve; bars are quartiles."
    pictures = (
        Picture("nodes", caption, partial(_draw_nodes, rows), (12.0, 5.6)),
        Picture("stages", stages, partial(_draw_stages, largest), (11, 6.5)),
    )
    return Section(tables, pictures)


# ------------------------------------------------------------------------------------------------------------- pictures

_SHOWN = {
    PLAIN: ("#6a6a6a", "P", ":"),
    CURVE: ("#0072b2", "o"),
    "curve, suction": ("#009e73", "^"),
    "curve, friction": ("#cc79a7", "D"),
    AS_IT_IS: ("#000000", "s"),
    EVERYTHING: ("#d55e00", "v"),
}
"""Colours and markers of the scenes in the picture."""
_APART = 0.045
"""Least distance of two names, over the height of a picture."""


def _draw_nodes(rows: Sequence[CostRow], figure: Figure) -> None:
    time, memory = figure.subplots(1, 2)
    scenes = {name: [row for row in rows if row.scene == name] for name in _SHOWN}
    scenes = {name: part for name, part in scenes.items() if part}
    for scene, part in scenes.items():
        nodes, median = [row.nodes for row in part], [row.median for row in part]
        off = [[row.median - row.lower for row in part], [row.upper - row.median for row in part]]
        time.errorbar(nodes, median, off, capsize=2, **line_style(*_SHOWN[scene]))
        memory.plot(nodes, [row.peak for row in part], **line_style(*_SHOWN[scene]))
    label(time, "Time", "nodes [-]", "time per node and step [ns]")
    label(memory, "Most memory during one step, its result included", "nodes [-]", "memory per node [bytes]")
    ends = {name: part[-1] for name, part in scenes.items()}
    for axes, heights in (
        (time, {name: row.median for name, row in ends.items()}),
        (memory, {name: row.peak for name, row in ends.items()}),
    ):
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlim(0.7 * min(row.nodes for row in rows), 12.0 * max(row.nodes for row in rows))
        axes.set_ylim(0.7 * min(heights.values()), None)
        _name(axes, heights, max(row.nodes for row in rows))


def _name(axes: Axes, heights: Mapping[str, float], x: float) -> None:
    """Write the names of lines at their ends, from below, far enough from each other to be readable."""
    low, high = axes.get_ylim()
    below, apart = 0.0, (high / low) ** _APART
    for name, height in sorted(heights.items(), key=lambda pair: pair[1]):
        below = max(height, apart * below)
        color = _SHOWN[name][0]
        axes.annotate(name, (x, below), (8, 0), textcoords="offset points", color=color, va="center", fontsize="small")


def _draw_stages(largest: Sequence[CostRow], figure: Figure) -> None:
    time, memory = figure.subplots(1, 2, sharey=True)
    ordered = sorted(largest, key=lambda row: row.ratio)
    plain = next(row for row in largest if row.scene == CURVE)
    names = [row.scene for row in ordered]
    quartiles = [[row.ratio - row.ratio_lower for row in ordered], [row.ratio_upper - row.ratio for row in ordered]]
    colors = [_HISTORY[row.history][1] for row in ordered]
    _bars(time, names, [row.ratio for row in ordered], colors, quartiles)
    _bars(memory, names, [row.peak / plain.peak for row in ordered], colors)
    for words, color in _HISTORY.values():
        memory.barh(names[:1], [0.0], color=color, label=words)
    memory.legend(loc="upper right")
    label(time, f"Time of one step, {plain.nodes} nodes", "times that of the scene with a curve [-]", "")
    label(memory, "Most memory during one step", "times that of the scene with a curve [-]", "")
    time.invert_yaxis()


_HISTORY = {False: ("all steps together", "#0072b2"), True: ("one step after the other", "#d55e00")}


def _bars(
    axes: Axes,
    names: Sequence[str],
    values: Sequence[float],
    colors: Sequence[str],
    off: Sequence[Sequence[float]] = (),
) -> None:
    bars = axes.barh(names, values, xerr=off or None, color=colors, ecolor="0.3", capsize=2)
    axes.set_axisbelow(True)
    axes.bar_label(bars, fmt="%.2g", padding=6)
    axes.set_xlim(0.0, 1.2 * max(values))
    axes.axvline(1.0, color="0.4", linestyle=":")


# ------------------------------------------------------------------------------------------------------------ measuring


def cost(variant: Variant, inputs: ContactInput, pipe: Pipe) -> CostRow:
    """One scene, paired with that of a curve and nothing else that has as many nodes."""
    nodes, model = len(inputs.node_ids), ContactModel(inputs)
    plain = line(pipe, nodes)
    points, along = positions(variant, inputs, pipe), positions(Variant("", lambda _: plain), plain, pipe)
    return _row(
        variant.name,
        paired([streamed(model, series(points, pipe)), streamed(ContactModel(plain), series(along, pipe))]),
        lambda: ContactModel(replace(inputs)),
        model.evaluate(points).contact,
        peak_of(lambda: model.evaluate(points)),
        nodes,
        history=model.plan.history,
    )


def plain_cost(inputs: ContactInput, pipe: Pipe) -> CostRow:
    """Plain numpy on elements with one curve and nothing else, paired with the scene."""
    model, plain = ContactModel(inputs), Plain.of(inputs)
    points = positions(Variant("", lambda _: inputs), inputs, pipe)
    moved = series(points, pipe)
    parts = [slice(part.start, part.start + len(part.result.depth)) for part in model.stream(moved)]

    def run() -> None:
        for part in parts:
            plain.evaluate(moved[part])

    return _row(
        PLAIN,
        paired([run, streamed(model, moved)]),
        lambda: Plain.of(inputs),
        plain.evaluate(points).contact,
        peak_of(lambda: plain.evaluate(points)),
        len(inputs.node_ids),
        history=False,
    )


def _row(  # noqa: PLR0913 - what the two ways to measure differ in
    name: str,
    seconds: list[list[float]],
    prepare: Callable[[], object],
    contact: BoolArray,
    peak: int,
    nodes: int,
    *,
    history: bool,
) -> CostRow:
    """The row of what was paired with the scene of a curve."""
    taken, over = Spread.of(seconds[0]).times(1e9 / (nodes * STEPS)), ratios(*seconds)
    (prepared,) = paired([prepare])
    touching = float(contact.mean()) if contact.size else 0.0
    prepared_in = Spread.of(prepared).median * 1e9 / nodes
    return CostRow(
        name,
        nodes,
        taken.least,
        taken.median,
        touching,
        peak / nodes,
        prepared_in,
        history,
        taken.lower,
        taken.upper,
        over.median,
        over.lower,
        over.upper,
    )


def streamed(model: ContactModel, moved: FloatArray) -> Callable[[], None]:
    """A run through a series (steps, n, 3), results discarded."""
    times = 0.1 * np.arange(float(len(moved)))

    def run() -> None:
        for _ in model.stream(moved, times=times):
            pass

    return run


def curve_alone(pipe: Pipe, nodes: int) -> CurveRow:
    """The scene with a curve against the curve on the same ratios and against plain numpy; one step, turn by turn."""
    inputs = line(pipe, nodes)
    model, plain = ContactModel(inputs), Plain.of(inputs)
    points = positions(Variant("", lambda _: inputs), inputs, pipe)
    result = model.evaluate(points)
    ratio = result.ratio.copy()
    calls = (lambda: pipe.curve.evaluate(ratio), lambda: plain.evaluate(points), lambda: model.evaluate(points))
    curve, bare, scene = paired(calls)
    over = ratios(scene, bare)
    return CurveRow(
        nodes,
        1e9 * Spread.of(curve).median / nodes,
        1e9 * Spread.of(bare).median / nodes,
        1e9 * Spread.of(scene).median / nodes,
        ratios(scene, curve).median,
        over.median,
        over.lower,
        over.upper,
        ratios(bare, curve).median,
        plain.evaluate(points).equals(result),
    )


def peak_of(call: Callable[[], object]) -> int:
    """Peak memory of a call in bytes, beyond what was there before; what it returns counts."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        tracemalloc.reset_peak()
        kept = call()
        peak = tracemalloc.get_traced_memory()[1] - before
        del kept
    finally:
        tracemalloc.stop()
    return peak
