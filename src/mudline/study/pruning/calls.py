"""The ways to call the evaluator, few steps and many, on a line and in the order of the deck, beside plain numpy.

Nodes of a deck have the order in which it gives them: GEN= puts the nodes that it generates after the two that it is
between, so that neighbours on the line are not neighbours in memory.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.contact.input import ContactInput
from mudline.contact.model import ContactModel
from mudline.contact.result import ContactResult
from mudline.study.pictures import LineStyle, Picture, label, legend_below, line_style
from mudline.study.pruning.cost import LADDER, peak_of
from mudline.study.pruning.plain import Plain
from mudline.study.pruning.scenes import (
    AS_IT_IS,
    Pipe,
    Variant,
    copies_for,
    line,
    positions,
    repeated,
    series,
    with_curve,
)
from mudline.study.report import Layout, Section, StudyOptions, columns_of
from mudline.study.timing import Spread, paired, ratios

if TYPE_CHECKING:  # only drawing needs matplotlib
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ALONG, IN_ORDER = "curve, along the line", "curve, in the order of the deck"
EVALUATE, STREAM, STEP = "evaluate", "stream", "step"
SERIES = (1, 10, 100)
"""Steps of a series."""
_MOST = 1_000_000
"""Nodes times steps of a series."""
_DT = 0.1


class CallRow(NamedTuple):
    """A call on a scene, and plain numpy for the same results; NaN where no plain function gives them.

    peak: largest memory of the whole call beyond its input, its results included where it returns them.
    equal: whether all results were those of plain numpy, bit by bit.
    """

    scene: Annotated[str, "scene"]
    call: Annotated[str, "call"]
    nodes: Annotated[int, "nodes"]
    steps: Annotated[int, "steps"]
    time: Annotated[float, "median time [ns/node/step]"]
    lower: Annotated[float, "lower quartile [ns/node/step]"]
    upper: Annotated[float, "upper quartile [ns/node/step]"]
    plain: Annotated[float, "plain numpy [ns/node/step]"]
    ratio: Annotated[float, "times plain numpy"]
    ratio_lower: Annotated[float, "times plain numpy, lower quartile"]
    ratio_upper: Annotated[float, "times plain numpy, upper quartile"]
    peak: Annotated[float, "memory [bytes/node]"]
    plain_peak: Annotated[float, "memory of plain numpy [bytes/node]"]
    equal: Annotated[bool | None, "same results"]


CALLS = Layout("calls", "Ways to call the evaluator", columns_of(CallRow), brief=False)


class Measured(NamedTuple):
    """A scene of some nodes whose calls are timed; `plain` gives the same results."""

    scene: str
    inputs: ContactInput
    lies: bool
    plain: Plain | None


def study_calls(inputs: ContactInput, pipe: Pipe, options: StudyOptions) -> Section:
    """All calls at every number of nodes, with few steps and with many."""
    rows = []
    for nodes in options.each(LADDER, "{} nodes: evaluate, stream and step".format):
        copies = repeated(inputs, copies_for(inputs, nodes))
        along, in_order = line(pipe, nodes), with_curve(copies, pipe)
        scenes = (
            Measured(ALONG, along, lies=False, plain=Plain.of(along)),
            Measured(IN_ORDER, in_order, lies=False, plain=Plain.of(in_order)),
            Measured(AS_IT_IS, copies, lies=True, plain=None),
        )
        for scene in scenes:
            rows += [
                call_row(scene, pipe, call, steps)
                for steps in SERIES
                if steps * nodes <= _MOST
                for call in (EVALUATE, STREAM, STEP)
            ]
    caption = "Time of a scene with a curve in times that of plain numpy for the same results; bars are quartiles."
    return Section([CALLS.table(rows)], [Picture("plain", caption, partial(_draw, rows), (11.0, 5.4))])


def call_row(scene: Measured, pipe: Pipe, call: str, steps: int) -> CallRow:
    """One call."""
    nodes, model = len(scene.inputs.node_ids), ContactModel(scene.inputs)
    points = positions(Variant("", lambda _: scene.inputs, scene.lies), scene.inputs, pipe)
    moved = series(points, pipe, steps)
    run = partial(_run, call, model, moved)
    per = 1e9 / (nodes * steps)
    taken = paired([run])
    plain, over, plain_peak, equal = math.nan, Spread(*[math.nan] * 4), math.nan, None
    if scene.plain is not None:
        bare = partial(_bare, scene.plain, moved, [at for at, _ in _results(call, model, moved)])
        taken = paired([run, bare])
        plain, over = Spread.of(taken[1]).median * per, ratios(*taken)
        plain_peak = peak_of(bare) / nodes
        equal = all(scene.plain.evaluate(moved[at]).equals(result) for at, result in _results(call, model, moved))
    time = Spread.of(taken[0]).times(per)
    return CallRow(
        scene.scene,
        call,
        nodes,
        steps,
        time.median,
        time.lower,
        time.upper,
        plain,
        over.median,
        over.lower,
        over.upper,
        peak_of(run) / nodes,
        plain_peak,
        equal,
    )


def _results(call: str, model: ContactModel, moved: FloatArray) -> Iterator[tuple[slice | int, ContactResult]]:
    """The steps and the results of a call, as they come."""
    times = _DT * np.arange(float(len(moved)))
    if call == EVALUATE:
        yield slice(None), model.evaluate(moved, times=times)
    elif call == STREAM:
        for part in model.stream(moved, times=times):
            yield slice(part.start, part.start + len(part.result.depth)), part.result
    else:
        state = model.initial_state()
        for step, points in enumerate(moved):
            result, state = model.step(points, None, state, _DT)
            yield step, result


def _run(call: str, model: ContactModel, moved: FloatArray) -> object:
    """Make a call, and return its last result, which is the whole series for `evaluate`."""
    kept: object = None
    for _, kept in _results(call, model, moved):  # noqa: B007 - the last one
        pass
    return kept


def _bare(plain: Plain, moved: FloatArray, parts: Sequence[slice | int]) -> object:
    """The same in plain numpy, as many steps at a time as the call takes; return the last result."""
    kept: object = None
    for at in parts:
        kept = plain.evaluate(moved[at])
    return kept


# -------------------------------------------------------------------------------------------------------------- picture

_LOOKS = {EVALUATE: ("#0072b2", "o"), STREAM: ("#009e73", "^"), STEP: ("#d55e00", "D")}
_DASHES = {ALONG: "-", IN_ORDER: "--"}


def _draw(rows: Sequence[CallRow], figure: Figure) -> None:
    """The shortest series on the left, the longest of each size on the right; three calls, two orders."""
    one, many = figure.subplots(1, 2, sharey=True)
    most = {row.nodes: max(other.steps for other in rows if other.nodes == row.nodes) for row in rows}
    longest = [row for row in rows if row.steps == most[row.nodes]]
    shortest = [row for row in rows if row.steps == SERIES[0]]
    words = f"{max(most.values())} steps, {most[max(most)]} of the longest line"
    for axes, shown, what in ((one, shortest, "one step"), (many, longest, words)):
        for scene, dash in _DASHES.items():
            for call, look in _LOOKS.items():
                found = [row for row in shown if (row.scene, row.call) == (scene, call)]
                _line(axes, found, f"{call}, {scene.removeprefix('curve, ')}", line_style(*look, dash))
        axes.axhline(1.0, color="0.3", linewidth=1.0)
        axes.set_xscale("log")
        label(axes, what, "nodes [-]", "times plain numpy [-]" if axes is one else "")
    one.set_ylim(0.0, None)
    legend_below(figure, one, 3)


def _line(axes: Axes, rows: Sequence[CallRow], name: str, look: LineStyle) -> None:
    """The ratios over the number of nodes, with their quartiles."""
    if rows:
        ratio = [row.ratio for row in rows]
        off = [[row.ratio - row.ratio_lower for row in rows], [row.ratio_upper - row.ratio for row in rows]]
        axes.errorbar([row.nodes for row in rows], ratio, off, capsize=2, label=name, **look)
