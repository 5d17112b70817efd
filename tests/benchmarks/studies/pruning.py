"""What each stage costs, time and memory of scenes of any size, and how time grows with what a deck has.

Times are processor times. What is compared takes turns, in reverse order every other time: a busy machine slows all of
it, and the ratios of one repeat are of the same moment.
"""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise
from statistics import median
from time import process_time

import numpy as np
from matplotlib.figure import Figure

from mudline.language.deck.loading import load_bytes
from mudline.model.contact.input import ContactInput, LawAssignment
from mudline.model.contact.model import ContactModel
from mudline.model.contact.seabed import PlanesSeabed, Seabed, SlopingSeabed
from mudline.model.curves import ForceCurve
from mudline.model.results.plots.style import COLORS
from mudline.model.scene.model import resolve
from tests.benchmarks.contact import all_laws, by_hand, of_line, series, streaming
from tests.benchmarks.drawing import draw, label
from tests.benchmarks.tables import Cell, column, digits, load, save, table
from tests.helpers.builders.contact import bridge_law, friction, line, on, suction, trench

STAGES, GROWTH = "pruning-stages", "pruning-growth"
PLAIN, CURVE = "plain numpy", "curve"
"""A function written by hand for one curve, which gives no other results; and the scene that all are compared with."""
LADDER = (100, 1000, 10_000, 100_000)
STEPS = 3
_REPEATS = 5
_LEAST = 2e-2
"""Seconds: short calls are repeated within a turn."""
_RISE = 0.001
"""Of a seabed over the length: that of a gentle slope."""
Call = Callable[[], object]

# -------------------------------------------------------------------------------------------------------------- scenes

LAWS: dict[str, Callable[[int], LawAssignment]] = {
    "curve": lambda count: on("curve", count, curve=0),
    "linear": lambda count: on("linear", count, stiffness=2e4),
    "smoothed": lambda count: on("smoothed", count, stiffness=2e4, half_width=0.003),
    "nodal": lambda count: on("nodal", count + 1, stiffness=3e4, half_width=0.003),
    "unloading": lambda count: on("unloading", count, stiffness=4e5),
    "suction springs": lambda count: on("suction spring", count, stiffness=800.0, extent=0.06),
    "suction": lambda count: suction(bridge_law(count)),
    "friction": lambda count: friction(count + 1, stiffness=np.nan, mobilisation=0.01),
    "lateral springs": lambda count: on("lateral", count, stiffness=900.0),
    "trench": lambda count: trench(count, 0.02, 0.4, 350.0),
}
"""On this many elements, or on their nodes."""


def scene(nodes: int, *laws: str, seabed: Seabed | None = None) -> ContactInput:
    """A line in contact all along, with these laws everywhere and nothing else."""
    count = nodes - 1
    return replace(
        of_line(line(count, 1), np.full(count, 0.3), *(LAWS[law](count) for law in laws)),
        curves=of_line(line(count, 1), np.full(count, 0.3)).curves if "curve" in laws else (),
        seabed=seabed,
    )


def planes(number: int, nodes: int) -> PlanesSeabed:
    """A valley of this many planes along a line; one more plane is steeper than the one before."""
    points = np.column_stack([np.zeros(number), np.linspace(0.0, 2.0 * nodes, number), np.zeros(number)])
    return PlanesSeabed(points, np.linspace(0.0, _RISE, number))


SCENES: dict[str, Callable[[int], ContactInput]] = {
    CURVE: lambda nodes: scene(nodes, "curve"),
    **{
        ", ".join(laws): (lambda nodes, laws=laws: scene(nodes, *laws))  # type: ignore[misc]
        for laws in (
            ("linear",),
            ("smoothed",),
            *(("curve", law) for law in LAWS if law not in {"curve", "linear", "smoothed", "trench"}),
            ("curve", "friction", "trench"),
        )
    },
    "curve, sloping bed": lambda nodes: scene(nodes, "curve", seabed=SlopingSeabed(_RISE, 30.0)),
    "curve, 2 planes": lambda nodes: scene(nodes, "curve", seabed=planes(2, nodes)),
    "everything": lambda nodes: replace(all_laws(nodes), seabed=planes(2, nodes)),
}
"""By name, of a number of nodes; "everything" has each law on a part of the line, drawn at random."""


# ------------------------------------------------------------------------------------------------------------- measure


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
    curve = scene(nodes, "curve")
    along = series(curve, STEPS)
    plain = partial(by_hand, along, curve.diameter, 0.5 * curve.length)
    inputs = curve if name == PLAIN else SCENES[name](nodes)
    model = ContactModel(inputs, backend="numpy")
    work = plain if name == PLAIN else streaming(inputs, series(inputs, STEPS), "numpy")
    own, of_curve = paired([work, streaming(curve, along, "numpy")])
    peak = _peak(plain) / STEPS if name == PLAIN else _peak(model.evaluate)
    together = "together" if name == PLAIN or not model.plan.history else "one by one"
    return [name, nodes, together, 1e9 * median(own) / (nodes * STEPS), _ratio(own, of_curve), peak / nodes]


def _stages(progress: Callable[[str], None]) -> None:
    rows = []
    for name in (PLAIN, *SCENES):
        progress(f"cost of {name}")
        rows += [cost(name, nodes) for nodes in LADDER]
    heads = ("scene", "nodes", "steps", "time [ns/node/step]", "times the curve's", "memory [bytes/node]")
    save(STAGES, heads, rows)


# -------------------------------------------------------------------------------------------------------------- growth

_NODES, _FEW_NODES, _ELEMENTS = 10_001, 1001, 2048


def _spread(points: int, scale: float) -> ForceCurve:
    """A curve of this many points, graded towards the mudline."""
    ratios = 0.5 * np.linspace(0.0, 1.0, points) ** 2
    return ForceCurve(np.column_stack([ratios, scale * np.sqrt(ratios)]))


def _pressed(inputs: ContactInput) -> Call:
    return ContactModel(inputs, backend="numpy").evaluate


def _curves(size: int) -> Call:
    """Curves on consecutive parts of the line, as sets have them."""
    elements = np.arange(_NODES - 1)
    law = on("curve", elements, curve=elements * size // (_NODES - 1))
    made = tuple(_spread(10, 1000.0 + number) for number in range(size))
    return _pressed(replace(scene(_NODES, "curve"), laws=(law,), curves=made))


def _sets(size: int) -> Call:
    """From reading the deck to its evaluator."""
    text = deck_with_sets(size, _ELEMENTS).encode()
    return lambda: resolve(load_bytes(text, "sets.keyxm")).require().contact()


def _stepped(inputs: ContactInput, steps: int) -> Call:
    return streaming(inputs, series(inputs, steps), "numpy")


GROWING: dict[str, tuple[int, Callable[[int], Call]]] = {
    "points on the curve": (4096, lambda size: _pressed(replace(scene(_NODES, "curve"), curves=(_spread(size, 1e3),)))),
    "curves": (512, _curves),
    "sets": (512, _sets),
    "planes": (256, lambda size: _pressed(scene(_NODES, "curve", seabed=planes(size, _NODES)))),
    "steps, curve": (256, lambda size: _stepped(scene(_FEW_NODES, "curve"), size)),
    "steps, everything": (64, lambda size: _stepped(SCENES["everything"](_FEW_NODES), size)),
}
"""The largest size, and the call that is timed for each."""


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


def _growth(progress: Callable[[str], None]) -> None:
    fits: list[list[Cell]] = []
    for what, (most, prepared) in GROWING.items():
        progress(f"growth with the number of {what}")
        sizes = [2**power for power in range("points" in what, most.bit_length())]
        seconds = [median(found) for found in paired([prepared(size) for size in sizes])]
        half = len(sizes) // 2
        one_more = (seconds[-1] - seconds[-2]) / (sizes[-1] - sizes[-2])
        power = float(np.polyfit(np.log(sizes[half:]), np.log(seconds[half:]), 1)[0])
        fits.append([what, sizes[0], most, power, 1e3 * seconds[0], 1e3 * seconds[-1], max(0.0, 1e6 * one_more)])
    heads = ("number of", "from", "to", "exponent", "time of the first [ms]", "of the last [ms]", "one more [us]")
    save(GROWTH, heads, fits)


def run(progress: Callable[[str], None]) -> None:
    """Write tables and picture."""
    _stages(progress)
    _growth(progress)
    draw(STAGES, _draw_stages, (11.0, 6.5))


def _draw_stages(figure: Figure) -> None:
    rows = [row for row in load(STAGES) if row["nodes"] == str(LADDER[-1])]
    ordered = sorted(rows, key=lambda row: float(row["times the curve's"]))
    names = [row["scene"] for row in ordered]
    colors = [COLORS[0] if row["steps"] == "together" else COLORS[1] for row in ordered]
    memory = float(next(row for row in rows if row["scene"] == CURVE)["memory [bytes/node]"])
    time, space = figure.subplots(1, 2, sharey=True)
    shares = (column(ordered, "times the curve's"), [one / memory for one in column(ordered, "memory [bytes/node]")])
    titles = (f"Time of a step, {LADDER[-1]:,} nodes", "Most memory during one step")
    for axes, values, title in zip((time, space), shares, titles, strict=True):
        axes.bar_label(axes.barh(names, values, color=colors), fmt="%.2g", padding=6)
        axes.axvline(1.0, color="0.4", linestyle=":")
        axes.set_xlim(0.0, 1.2 * max(values))
        label(axes, title, "times that of the scene with a curve [-]", "")
    for words, color in (("all steps together", COLORS[0]), ("one step after the other", COLORS[1])):
        space.barh(names[:1], [0.0], color=color, label=words)
    space.legend(loc="upper right")
    time.invert_yaxis()


def _stage_table() -> str:
    rows = load(STAGES)
    own = {name: [row for row in rows if row["scene"] == name] for name in dict.fromkeys(row["scene"] for row in rows)}
    head = ["scene", *(f"{digits(nodes, 6)} nodes" for nodes in (LADDER[0], LADDER[-1])), "times the curve's", "steps"]
    return table(
        head,
        [
            [
                name,
                *(f"{digits(row['time [ns/node/step]'], 2)} ns" for row in (part[0], part[-1])),
                digits(part[-1]["times the curve's"], 2),
                part[-1]["steps"],
            ]
            for name, part in own.items()
        ],
    )


TABLES = {"stages": _stage_table}
