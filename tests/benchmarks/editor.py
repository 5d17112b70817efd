"""Typing in an open deck: from a changed line to the message with its findings."""

from __future__ import annotations

import sys
from pathlib import Path

from tests.benchmarks.bench import Bench, Table
from tests.benchmarks.decks import ALIKE
from tests.benchmarks.runner import Job, cpu, figure

LINES = (200, 20_000)
LONG = 10**6

_PROGRAM = """
import json, sys, time
from lsprotocol import types
from pygls.protocol import default_converter
from mudline.lsp import findings
from mudline.lsp.decks import Decks
uri = "file://" + sys.argv[1]
text = open(sys.argv[1], encoding="utf-8").read()
decks, converter = Decks(), default_converter()
document = decks.open(uri, text, 1, "mudline")
at = text.index("STIFFNESS=Clay") + len("STIFFNESS=")
def type_one(version):
    place, end = document.position(at), document.position(at + 4)
    document.change(types.Range(place, end), f"Cl{version % 90 + 10}" if version % 2 else "Clay")
    shown = findings.shown(decks.analysis(uri))
    params = types.PublishDiagnosticsParams(uri, shown, version)
    json.dumps(converter.unstructure(types.PublishDiagnosticsNotification(params)))
for version in range(5):
    type_one(version)
count = int(sys.argv[2])
start = time.process_time()
for version in range(count):
    type_one(version)
print((time.process_time() - start) / count)
"""


def deck(lines: int) -> str:
    """A line of elements on the seabed, with sets and a curve, of about so many lines."""
    count = (lines - len(ALIKE.splitlines()) - 5) // 2
    nodes = "".join(f" {i}, -0.05, {5 * (i - 1)}.0\n" for i in range(1, count + 2))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, count + 1))
    return f"$MODEL\n*OCEAN\n 500.0, 1025.0, 9.81\n*NODE\n{nodes}*ELEMENT\n{elements}{ALIKE}"


def run(bench: Bench) -> None:
    """Measure a keystroke in decks of two lengths, and in a long one; every second one makes a finding."""
    for lines in LINES:
        bench.results.figures[f"typing {lines}"] = figure(_costs(bench, lines, 20, 5), 1000)
    long = figure(_costs(bench, bench.size(LONG), 3, 3))
    rows = [[f"a deck of {bench.size(LONG):,} lines", f"{long.median:.2f}"]]
    bench.results.tables["From a changed line to its findings"] = Table(["what", "s"], rows)


def _costs(bench: Bench, lines: int, changes: int, rounds: int) -> list[float]:
    """Processor seconds of a change, in each round."""
    path: Path = bench.folder / f"typed-{lines}.keyxm"
    path.write_text(deck(lines), encoding="utf-8")
    job = Job([sys.executable, "-c", _PROGRAM, path, str(changes)], own_clock=True)
    return cpu(bench.costs({"typing": job}, rounds)["typing"])
