"""What each stage costs: time, memory and modules of scenes of any size, the ways to call them, and growth.

Times are processor times. What is compared takes turns, in reverse order every other time: a busy machine slows all of
it, and the ratios of one repeat are of the same moment.
"""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import partial
from itertools import pairwise
from statistics import median
from time import process_time
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from mudline.contact.input import ContactInput, LawAssignment
from mudline.contact.model import ContactModel
from mudline.curves import ForceCurve
from mudline.deck.loading import load_bytes
from mudline.scene.model import resolve
from tests.benchmarks.contact import by_hand, stepping, streaming
from tests.benchmarks.drawing import draw, label, panels, style
from tests.benchmarks.studies.scenes import CURVE, SCENES, everything, line, planes, positions, series
from tests.benchmarks.tables import Cell, column, digits, load, save, table

STAGES, CALLS, GROWTH, SIZES = "pruning-stages", "pruning-calls", "pruning-growth", "pruning-sizes"
PLAIN = "plain numpy"
"""A function written by hand for one curve, which gives no other results."""
LADDER = (100, 1000, 10_000, 100_000)
STEPS = 3
_REPEATS = 5
_LEAST = 2e-2
"""Seconds: short calls are repeated within a turn."""
Call = Callable[[], object]


def paired(calls: Sequence[Call]) -> list[list[float]]:
    """Processor seconds of each call in each repeat, after one to warm up."""
    turns = []
    for index, call in enumerate(calls):
        call()
        turns.append((index, call, max(1, round(_LEAST / max(_timed(call, 1), 1e-7)))))
    taken: list[list[float]] = [[] for _ in calls]
    for _ in range(_REPEATS):
        for index, call, inner in turns:
            taken[index].append(_timed(call, inner))
        turns.reverse()
    return taken


def _timed(call: Call, times: int) -> float:
    start = process_time()
    for _ in range(times):
        call()
    return max(process_time() - start, 1e-9) / times


def _ratio(above: Sequence[float], below: Sequence[float]) -> float:
    return median(one / other for one, other in zip(above, below, strict=True))


# -------------------------------------------------------------------------------------------------------------- stages


def _peak(call: Call) -> int:
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


def cost(name: str, nodes: int) -> list[Cell]:
    """A scene of so many nodes, paired with that of a curve and nothing else; or plain numpy on the latter."""
    curve = line(nodes, "curve")
    along = series(positions(curve), STEPS)
    plain = partial(by_hand, along, curve.diameter, 0.5 * curve.length)
    inputs = curve if name == PLAIN else SCENES[name](nodes)
    model, points = ContactModel(inputs), positions(inputs)
    work = plain if name == PLAIN else streaming(inputs, series(points, STEPS), "numpy")
    own, of_curve = paired([work, streaming(curve, along, "numpy")])
    peak = _peak(plain) / STEPS if name == PLAIN else _peak(lambda: model.evaluate(points))
    together = "together" if name == PLAIN or not model.plan.history else "one by one"
    return [name, nodes, together, 1e9 * median(own) / (nodes * STEPS), _ratio(own, of_curve), peak / nodes]


_PROGRAM = """
import json, pickle, sys, time
import numpy
data, before = sys.stdin.buffer.read(), set(sys.modules)
start = time.process_time()
from mudline.contact.input import ContactInput
from mudline.contact.model import ContactModel
model = ContactModel(ContactInput(**pickle.loads(data)), backend="numpy")
model.evaluate()
print(json.dumps([time.process_time() - start, sorted(set(sys.modules) - before)]))
"""


def loaded(name: str) -> tuple[float, set[str]]:
    """Seconds to load, prepare and evaluate 11 nodes in a fresh interpreter that has numpy; and its new modules."""
    inputs = SCENES[name](11)
    kept = [field.name for field in fields(inputs) if field.init and field.name != "names"]
    data = pickle.dumps({key: getattr(inputs, key) for key in kept})
    runs = [
        json.loads(subprocess.run([sys.executable, "-c", _PROGRAM], input=data, capture_output=True, check=True).stdout)
        for _ in range(_REPEATS)
    ]
    return median(run[0] for run in runs), set(runs[0][1])


def _stages(progress: Callable[[str], None]) -> None:
    common = loaded(CURVE)[1]
    rows: list[list[Cell]] = []
    for name in (PLAIN, *SCENES):
        progress(f"cost of {name}")
        seconds, modules = (None, common) if name == PLAIN else loaded(name)
        laws = sorted({one.rpartition(".")[2] for one in modules - common if one.startswith("mudline.contact")})
        time = None if seconds is None else 1e3 * seconds
        rows += [[*cost(name, nodes), time, ", ".join(laws), len(modules)] for nodes in LADDER]
    heads = ("scene", "nodes", "steps", "time [ns/node/step]", "times the curve's", "memory [bytes/node]",
             "to load [ms]", "beyond the curve's modules", "modules")  # fmt: skip
    save(STAGES, heads, rows)


def _calls(progress: Callable[[str], None]) -> None:
    progress("ways to call")
    rows = []
    for name, make in ((CURVE, SCENES[CURVE]), ("everything", everything)):
        for nodes in LADDER[:3]:
            inputs = make(nodes)
            moved, model = series(positions(inputs), 30), ContactModel(inputs, backend="numpy")
            calls: list[Call] = [
                partial(model.evaluate, moved),
                streaming(inputs, moved, "numpy"),
                stepping(inputs, moved, "numpy"),
                partial(by_hand, moved, inputs.diameter, 0.5 * inputs.length),
            ]
            steps = (30, 30, 1, 30)
            taken = [1e9 * median(found) / nodes / one for found, one in zip(paired(calls), steps, strict=True)]
            rows.append([name, nodes, *taken])
    save(CALLS, ("scene", "nodes", "evaluate [ns]", "stream [ns]", "step [ns]", "plain numpy [ns]"), rows)


# -------------------------------------------------------------------------------------------------------------- growth

_NODES, _FEW_NODES, _ELEMENTS = 10_001, 1001, 2048


class Growing(NamedTuple):
    """Sizes of one thing, and the call that is timed for each size."""

    sizes: Sequence[int]
    prepared: Callable[[int], Call]


def _spread(points: int, scale: float) -> ForceCurve:
    """A curve of this many points, graded towards the mudline."""
    ratios = 0.5 * np.linspace(0.0, 1.0, points) ** 2
    return ForceCurve(np.column_stack([ratios, scale * np.sqrt(ratios)]))


def _pressed(inputs: ContactInput) -> Call:
    return partial(ContactModel(inputs, backend="numpy").evaluate, positions(inputs))


def _curves(size: int) -> Call:
    """Curves on consecutive parts of the line, as sets have them."""
    elements = np.arange(_NODES - 1)
    law = LawAssignment("curve", elements, {"curve": elements * size // (_NODES - 1)})
    made = tuple(_spread(10, 1000.0 + number) for number in range(size))
    return _pressed(replace(line(_NODES, "curve"), laws=(law,), curves=made))


def _sets(size: int) -> Call:
    """From reading the deck to its evaluator."""
    text = deck_with_sets(size, _ELEMENTS).encode()
    return lambda: resolve(load_bytes(text, "sets.keyxm")).require().contact()


def _stepped(inputs: ContactInput, steps: int) -> Call:
    return streaming(inputs, series(positions(inputs), steps), "numpy")


def _doubling(most: int, first: int = 1) -> list[int]:
    return [size for size in (2**power for power in range(20)) if first <= size <= most]


GROWING = {
    "points on the curve": Growing(
        _doubling(4096, 2), lambda size: _pressed(replace(line(_NODES, "curve"), curves=(_spread(size, 1000.0),)))
    ),
    "curves": Growing(_doubling(512), _curves),
    "sets": Growing(_doubling(512), _sets),
    "planes": Growing(_doubling(256), lambda size: _pressed(line(_NODES, "curve", seabed=planes(size, 2.0 * _NODES)))),
    "steps, curve": Growing(_doubling(256), lambda size: _stepped(line(_FEW_NODES, "curve"), size)),
    "steps, everything": Growing(_doubling(64), lambda size: _stepped(everything(_FEW_NODES), size)),
}


def deck_with_sets(sets: int, elements: int) -> str:
    """The text of a straight line on linear seabeds; the elements are divided among the sets."""
    edges = [number * elements // sets for number in range(sets + 1)]
    ranges = [(f"Part {number + 1}", first + 1, last) for number, (first, last) in enumerate(pairwise(edges))]
    lines = ["$MODEL", "*NODE", " 1, -0.01, 0.0, 0.0", f" {elements + 1}, -0.01, {2.0 * elements}, 0.0"]
    lines += [f" GEN=1, {elements + 1}", "*ELEMENT", " 1, 1, 2", f" GEN=1, {elements}", "*ELEMENT SETS"]
    lines += [line for name, first, last in ranges for line in (f" SET={name}", f" GEN={first}, {last}")]
    lines += ["*GEOMETRIC SETS", " OPTION=RIGID", " SET=ALL", " 207.0E9, 79.6E9, 0.3, 0.25, 7850.0"]
    lines += ["*SEABED PROPERTIES", " TYPE=ELASTIC"]
    lines += [line for name, first, _ in ranges for line in (f" SET={name}", f" STIFFNESS={50_000 + first}")]
    return "\n".join([*lines, ""])


def exponent(sizes: Sequence[float], seconds: Sequence[float]) -> float:
    """Slope of the straight line through log(size), log(seconds), by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(seconds), 1)[0])


def _growth(progress: Callable[[str], None]) -> None:
    rows: list[list[Cell]] = []
    fits: list[list[Cell]] = []
    for what, (sizes, prepared) in GROWING.items():
        progress(f"growth with the number of {what}")
        seconds = [median(found) for found in paired([prepared(size) for size in sizes])]
        rows += [[what, size, found] for size, found in zip(sizes, seconds, strict=True)]
        half = len(sizes) // 2
        one_more = (seconds[-1] - seconds[-2]) / (sizes[-1] - sizes[-2])
        powers = [exponent(sizes, seconds), exponent(sizes[half:], seconds[half:])]
        fits.append([what, sizes[0], sizes[-1], *powers, 1e3 * seconds[-1], max(0.0, 1e6 * one_more)])
    save(SIZES, ("number of", "size", "time [s]"), rows)
    heads = ("number of", "from", "to", "exponent", "of the larger half", "time of the largest [ms]", "one more [us]")
    save(GROWTH, heads, fits)


def run(progress: Callable[[str], None]) -> None:
    """Write tables and pictures."""
    _stages(progress)
    _calls(progress)
    _growth(progress)
    draw(STAGES, _draw_stages, (11.0, 6.5))
    draw(GROWTH, _draw_growth, (12.0, 7.5))


def _draw_stages(figure: Figure) -> None:
    rows = [row for row in load(STAGES) if row["nodes"] == str(LADDER[-1])]
    ordered = sorted(rows, key=lambda row: float(row["times the curve's"]))
    names = [row["scene"] for row in ordered]
    colors = ["#0072b2" if row["steps"] == "together" else "#d55e00" for row in ordered]
    memory = float(next(row for row in rows if row["scene"] == CURVE)["memory [bytes/node]"])
    time, space = figure.subplots(1, 2, sharey=True)
    shares = (column(ordered, "times the curve's"), [one / memory for one in column(ordered, "memory [bytes/node]")])
    titles = (f"Time of a step, {LADDER[-1]:,} nodes", "Most memory during one step")
    for axes, values, title in zip((time, space), shares, titles, strict=True):
        axes.bar_label(axes.barh(names, values, color=colors), fmt="%.2g", padding=6)
        axes.axvline(1.0, color="0.4", linestyle=":")
        axes.set_xlim(0.0, 1.2 * max(values))
        label(axes, title, "times that of the scene with a curve [-]", "")
    for words, color in (("all steps together", "#0072b2"), ("one step after the other", "#d55e00")):
        space.barh(names[:1], [0.0], color=color, label=words)
    space.legend(loc="upper right")
    time.invert_yaxis()


def _draw_growth(figure: Figure) -> None:
    for axes, (what, fit) in zip(
        panels(figure, len(GROWING), 3), ((row["number of"], row) for row in load(GROWTH)), strict=True
    ):
        own = [row for row in load(SIZES) if row["number of"] == what]
        sizes, times = np.array(column(own, "size")), 1e3 * np.array(column(own, "time [s]"))
        axes.loglog(sizes, times, **style("", 0) | {"linestyle": "none"})
        half, power = len(sizes) // 2, float(fit["of the larger half"])
        middle = np.exp(np.log(times[half:]).mean() + power * (np.log(sizes[half:]) - np.log(sizes[half:]).mean()))
        axes.loglog(sizes[half:], middle, color="#cc6677", label=f"exponent {power:.2f}")
        axes.set_ylim(0.25 * times.min(), max(4.0 * times.max(), 50.0 * times.min()))
        label(axes, f"Number of {what}", "number [-]", "time [ms]")
        axes.legend(fontsize="small", loc="upper left")


def _stage_table() -> str:
    rows = load(STAGES)
    own = {name: [row for row in rows if row["scene"] == name] for name in dict.fromkeys(row["scene"] for row in rows)}
    head = ["scene", *(f"{nodes:,} nodes".replace(",", " ") for nodes in LADDER), "times the curve's", "steps",
            "bytes a node", "to load", "its own modules"]  # fmt: skip
    return table(
        head,
        [
            [
                name,
                *(f"{digits(row['time [ns/node/step]'], 2)} ns" for row in part),
                digits(part[-1]["times the curve's"], 2),
                part[-1]["steps"],
                digits(part[-1]["memory [bytes/node]"]),
                f"{digits(part[-1]['to load [ms]'], 2)} ms" if part[-1]["to load [ms]"] else "",
                part[-1]["beyond the curve's modules"],
            ]
            for name, part in own.items()
        ],
    )


def _all(name: str, most: int) -> str:
    rows = load(name)
    text = rows[0].keys() & {"scene", "number of"}
    return table(
        list(rows[0]), [[cell if key in text else digits(cell, most) for key, cell in row.items()] for row in rows]
    )


TABLES = {"stages": _stage_table, "calls": lambda: _all(CALLS, 2), "growth": lambda: _all(GROWTH, 2)}
