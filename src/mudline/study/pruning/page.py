"""The page of the pruning study, all numbers from its tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from mudline.study import timing
from mudline.study.pages import (
    Record,
    Tables,
    bullets,
    command_of,
    filled,
    grouped_digits,
    listed,
    markdown_table,
    percent,
    rounded,
    span,
    table_of,
    time,
)
from mudline.study.pruning.calls import ALONG, EVALUATE, IN_ORDER, STEP, STREAM
from mudline.study.pruning.features import advice
from mudline.study.pruning.growth import ONE_MORE, UPPER_EXPONENT
from mudline.study.pruning.imports import NODES as IMPORT_NODES
from mudline.study.pruning.scenes import AS_IT_IS, CURVE, EVERYTHING, PLAIN
from mudline.study.report import grouped
from mudline.study.running import RUN_TIME

_SHORT = (PLAIN, CURVE, "curve, unloading", "curve, suction", "curve, friction", AS_IT_IS, EVERYTHING)
_SCATTERED = "curve, scattered points"
_STEP_TIME, _RATIO, _PLAIN = "time [ns/node/step]", "times the curve's", "times plain numpy"
_MEMORY, _BARE_MEMORY = "memory [bytes/node]", "memory of plain numpy [bytes/node]"
_MEDIAN = "median time [ns/node/step]"
_LEVEL = 1.15
"""The largest exponent that is called proportional: the fit of a few noisy times."""


def page(tables: Tables) -> str:
    """The page in Markdown; raises MissingTableError where a part was not run."""
    machine = {row.text("what"): row.text("value") for row in tables.rows("machine")}
    own = _at_most(tables.rows("nodes", scene=CURVE))
    fields = {
        "advice": advice(tables),
        "command": command_of("pruning", machine["deck"]),
        "deck": f"`{machine['deck']}`",
        "run_time": time(float(machine[RUN_TIME])),
        "machine": ", ".join([machine["processor"], f"{machine['cores']} cores", *_versions(machine)]),
        "repeats": str(timing.REPEATS),
        "summary": bullets(_summary(tables)),
        "level": _level(tables),
        "touching": _touching(tables),
        "short_table": _short_table(tables),
        "order": _order(tables),
        "stages_table": _stages_table(tables),
        "noise": rounded(own.number(_RATIO), 3),
        "noise_low": rounded(own.number(f"{_RATIO}, lower quartile"), 3),
        "noise_high": rounded(own.number(f"{_RATIO}, upper quartile"), 3),
        "equal": _equal(tables),
        "calls_table": _calls_table(tables),
        "calls_text": _calls_text(tables),
        "curve_table": _curve_table(tables),
        "curve_text": _curve_text(tables),
        "imports_table": _imports_table(tables),
        "import_nodes": str(IMPORT_NODES),
        "growth_table": _growth_table(tables),
        "growth_text": _growth_text(tables),
        "conclusions": bullets(_conclusions(tables)),
    }
    return filled(Path(__file__).with_name("page.md"), fields)


def _versions(machine: dict[str, str]) -> list[str]:
    return [f"{name} {machine[name]}" for name in ("Python", "numpy", "mudline") if name in machine]


def _ns(row: Record, heading: str) -> str:
    return time(1e-9 * row.number(heading))


def _at_most(rows: Sequence[Record]) -> Record:
    """The row of the most nodes."""
    return max(rows, key=lambda row: row.number("nodes"))


def _nodes(row: Record) -> str:
    return grouped_digits(row.number("nodes"))


def _whole(row: Record, heading: str) -> str:
    """Seconds of a step in all, from those of a node."""
    return time(1e-9 * row.number(heading) * row.number("nodes"))


# -------------------------------------------------------------------------------------------------------------- stages


def _summary(tables: Tables) -> Iterator[str]:
    curve, whole = (tables.row("stages", scene=name) for name in (CURVE, EVERYTHING))
    yield (
        f"A scene pays for what it has. With {_nodes(curve)} nodes a curve costs {_ns(curve, _STEP_TIME)} a node and "
        f"step, everything at once {_ns(whole, _STEP_TIME)}: {rounded(whole.number(_RATIO))} times as much."
    )
    together, alone = (
        [row.number(_RATIO) for row in tables.rows("stages", steps=steps) if row.text("scene") not in {AS_IT_IS, PLAIN}]
        for steps in ("together", "one by one")
    )
    yield (
        "History costs. Scenes whose steps are taken together cost "
        f"{span(together)} times what a curve costs, those whose steps depend on the one before {span(alone)} times."
    )
    yield (
        f"The evaluator takes {_over(tables)} times as long as plain numpy that is written by hand for a curve and "
        "nothing else, and gives the same bits; the tables below say where."
    )
    points = tables.row("growth", **{"number of": "points on the curve"})
    yield (
        f"A curve of {points.text('to')} points takes {rounded(points.number('time, largest / smallest'))} times as "
        f"long as one of {points.text('from')}."
    )
    loads, loads_scipy = (tables.row("imports", scene=name).number("median [ms]") for name in (CURVE, _SCATTERED))
    yield (
        f"A seabed of scattered points loads scipy: {time(1e-3 * loads_scipy)} before the first step, "
        f"{time(1e-3 * loads)} without."
    )


def _short_table(tables: Tables) -> str:
    """Seconds of a whole step of some scenes at every number of nodes of the scene with a curve."""
    sizes = tables.rows("nodes", scene=CURVE)
    lines = []
    for name in _SHORT:
        by_size = {_decade(row): row for row in tables.rows("nodes", scene=name)}
        near = [by_size.get(_decade(size)) for size in sizes]
        lines.append([name, *("" if row is None else _whole(row, _MEDIAN) for row in near)])
    return markdown_table(["scene", *(f"{_nodes(row)} nodes" for row in sizes)], lines)


def _level(tables: Tables) -> str:
    """How much the time of a node changes from each number of nodes to the next, over the scenes."""
    by_scene = [tables.rows("nodes", scene=name) for name in _SHORT]
    first, before, last = by_scene[0][0], *by_scene[0][-2:]
    steps = [rows[-1].number(_MEDIAN) / rows[-2].number(_MEDIAN) for rows in by_scene if len(rows) > 1]
    fall = [rows[0].number(_MEDIAN) / rows[-1].number(_MEDIAN) for rows in by_scene if len(rows) > 1]
    return (
        f"With {_nodes(first)} nodes, each of them costs {span(fall)} times what it costs with {_nodes(last)}; from "
        f"{_nodes(before)} to {_nodes(last)} nodes its cost changes by a factor of {span(steps)}."
    )


def _touching(tables: Tables) -> str:
    """How many elements are in contact in the scenes that are made for the study."""
    made = [row.number("in contact [%]") for row in tables.rows("stages") if row.text("scene") != AS_IT_IS]
    if min(made) == 100.0:
        return "all elements touch the seabed at the first step, which is the worst case"
    return f"at least {percent(0.01 * min(made), 3)} of the elements touch the seabed at the first step"


def _order(tables: Tables) -> str:
    """How much more the order of the deck costs."""
    along = {_call(row): row.number(_MEDIAN) for row in tables.rows("calls", scene=ALONG)}
    rows = [row for row in tables.rows("calls", scene=IN_ORDER) if _call(row) in along]
    over = span(row.number(_MEDIAN) / along[_call(row)] for row in rows)
    return f"A curve in that order costs {over} times what it costs along the line, over all calls below."


def _call(row: Record) -> tuple[str, str, int]:
    return row.text("call"), row.text("steps"), _decade(row)


def _decade(row: Record) -> int:
    """The power of ten of the number of nodes: whole copies of a deck seldom have exactly one."""
    return round(math.log10(row.number("nodes")))


def _stages_table(tables: Tables) -> str:
    return table_of(
        sorted(tables.rows("stages"), key=lambda row: row.number(_RATIO)),
        {
            "scene": lambda row: _marked(row, CURVE, AS_IT_IS),
            "nodes": _nodes,
            "steps": "steps",
            "time per node and step": lambda row: _ns(row, _STEP_TIME),
            "times the curve's": lambda row: rounded(row.number(_RATIO)),
            "memory per node": lambda row: _bytes(row, _MEMORY),
            "to prepare": lambda row: _ns(row, "to prepare [ns/node]"),
        },
    )


def _marked(row: Record, *scenes: str) -> str:
    """The name of a scene, in bold letters where it is one of these."""
    return f"**{row.text('scene')}**" if row.text("scene") in scenes else row.text("scene")


def _bytes(row: Record, heading: str) -> str:
    return f"{rounded(row.number(heading), 3)} B"


# --------------------------------------------------------------------------------------------------------------- calls


def _compared(tables: Tables, **cells: str) -> list[Record]:
    """The calls that plain numpy was compared with."""
    return [row for row in tables.rows("calls", **cells) if row.text("same results")]


def _over(tables: Tables, **cells: str) -> str:
    return span(row.number(_PLAIN) for row in _compared(tables, **cells))


def _equal(tables: Tables) -> str:
    rows = _compared(tables)
    same = sum(row.flag("same results") for row in rows)
    return f"{same} of {len(rows)} calls gave the same bits in every result"


def _calls_table(tables: Tables) -> str:
    """One step and the most steps, of the line that is nearest to a thousand nodes."""
    shown: list[Record] = []
    for own in grouped(tables.rows("calls"), lambda row: row.text("scene")).values():
        nodes = min((row.number("nodes") for row in own), key=lambda count: abs(count - 1000.0))
        near = [row for row in own if row.number("nodes") == nodes]
        steps = [row.number("steps") for row in near]
        shown += [row for row in near if row.number("steps") in {min(steps), max(steps)}]
    return table_of(
        shown,
        {
            "scene": "scene",
            "call": lambda row: f"`{row.text('call')}`",
            "nodes": _nodes,
            "steps": "steps",
            "per node and step": lambda row: _ns(row, _MEDIAN),
            _PLAIN: lambda row: rounded(row.number(_PLAIN)) if row.text("same results") else "",
            "memory per node": lambda row: _bytes(row, _MEMORY),
            "of plain numpy": lambda row: _bytes(row, _BARE_MEMORY) if row.text("same results") else "",
        },
    )


def _calls_text(tables: Tables) -> str:
    spans = [
        f"`{call}` {_over(tables, scene=ALONG, call=call)} along the line and "
        f"{_over(tables, scene=IN_ORDER, call=call)} in the order of the deck"
        for call in (EVALUATE, STREAM, STEP)
    ]
    few = min(tables.rows("calls", scene=ALONG, call=STEP), key=lambda row: (row.number("nodes"), -row.number("steps")))
    kept, passed = (
        max(tables.rows("calls", scene=ALONG, call=call), key=lambda row: row.number("steps") * row.number("nodes"))
        for call in (EVALUATE, STREAM)
    )
    return (
        f"In times of plain numpy, over all sizes and series: {'; '.join(spans)}. A call of `step` on {_nodes(few)} "
        f"nodes costs {_whole(few, _MEDIAN)}: use `stream` where the whole series is known. On {_nodes(kept)} "
        f"nodes and {kept.text('steps')} steps `evaluate` holds {rounded(kept.number(_MEMORY), 3)} bytes a node, "
        f"`stream` {rounded(passed.number(_MEMORY), 3)}. All sizes "
        "and numbers of steps are in [`pruning-calls.csv`](pruning-calls.csv)."
    )


# --------------------------------------------------------------------------------------------------------------- curve


def _curve_table(tables: Tables) -> str:
    ratio = "scene / plain numpy"
    return table_of(
        tables.rows("curve"),
        {
            "nodes": _nodes,
            "curve alone": lambda row: _ns(row, "curve alone [ns/node]"),
            "plain numpy": lambda row: _ns(row, "plain numpy [ns/node]"),
            "scene": lambda row: _ns(row, "scene [ns/node]"),
            "scene / curve": lambda row: rounded(row.number("scene / curve alone")),
            ratio: lambda row: rounded(row.number(ratio)),
            "quartiles": lambda row: span(row.number(f"{ratio}, {which} quartile") for which in ("lower", "upper")),
        },
    )


def _curve_text(tables: Tables) -> str:
    rows = tables.rows("curve")
    share = [row.number("curve alone [ns/node]") / row.number("scene [ns/node]") for row in rows]
    bare = [row.number("plain numpy / curve alone") for row in rows]
    return (
        f"The formula of the curve is {percent(min(share))} to {percent(max(share))} of the time of the scene. Plain "
        "numpy, which reads positions and writes gaps, depths, ratios, forces, slopes and reactions, takes "
        f"{span(bare)} times as long as the curve alone. The scene takes "
        f"{span(row.number('scene / plain numpy') for row in rows)} times as long as plain numpy: the rest goes into "
        "finding the elements in contact, into checks that name the element at fault, and into blocks small enough for "
        f"the cache. {_not_loaded(tables).capitalize()}, see [imports](#imports)."
    )


# -------------------------------------------------------------------------------------------------- growth and loading


def _imports_table(tables: Tables) -> str:
    return table_of(
        tables.rows("imports"),
        {
            "scene": lambda row: _marked(row, CURVE),
            "time to load": lambda row: time(1e-3 * row.number("median [ms]")),
            "quartiles": lambda row: span((row.number(f"{end} quartile [ms]") for end in ("lower", "upper")), 3, "ms"),
            "modules of mudline": "modules of mudline",
            "other modules": "other modules",
            "beyond those of the curve": "beyond those of the curve",
        },
    )


def _not_loaded(tables: Tables) -> str:
    """What everything loads and a scene with a curve does not."""
    modules = tables.row("imports", scene=EVERYTHING).text("beyond those of the curve")
    return f"a scene with a curve loads no module of {listed(modules.split(', '), 'or')}"


def _growth_table(tables: Tables) -> str:
    return table_of(
        tables.rows("growth"),
        {
            "number of": "number of",
            "from": "from",
            "to": "to",
            "exponent": lambda row: f"{row.number('exponent'):.2f}",
            "of the larger half": lambda row: f"{row.number(UPPER_EXPONENT):.2f}",
            "the largest": lambda row: time(row.number("time of the largest [s]")),
            "one more costs": lambda row: time(1e-6 * row.number(ONE_MORE)) if _grows(row) else "not measurable",
        },
    )


def _grows(row: Record) -> bool:
    return row.number(UPPER_EXPONENT) > 1.0 - 1.0 / _LEVEL


def _growth_text(tables: Tables) -> str:
    faster = [row.text("number of") for row in tables.rows("growth") if row.number(UPPER_EXPONENT) > _LEVEL]
    level = [
        f"{row.text('number of')} ({rounded(row.number('time, largest / smallest'))} times from {row.text('from')} to "
        f"{row.text('to')})"
        for row in tables.rows("growth")
        if not _grows(row)
    ]
    words = ["**Nothing grows faster than in proportion.**"]
    if faster:
        words = [f"The time grows faster than in proportion with the number of {listed(faster)}."]
    if level:
        words.append(f"The number of {listed(level)} hardly counts.")
    return " ".join(words)


def _conclusions(tables: Tables) -> Iterator[str]:
    yield (f"Do not leave out a feature because of its cost for other decks: {_not_loaded(tables)}.")
    costliest = sorted(tables.rows("stages", steps="one by one"), key=lambda row: -row.number(_RATIO))
    named = [f"{row.text('scene')} ({rounded(row.number(_RATIO))} times the curve)" for row in costliest[:3]]
    yield (
        f"What makes a run long is history and the number of steps: {', '.join(named)}. If only the embedment is asked "
        "for, evaluate a copy of the deck without friction."
    )
    curves = tables.row("growth", **{"number of": "curves"})
    yield (
        f"Merge equal curves: {curves.text('to')} curves cost {time(curves.number('time of the largest [s]'))} a step, "
        f"{rounded(curves.number('time, largest / smallest'))} times what {curves.text('from')} costs."
    )
