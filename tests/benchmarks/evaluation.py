"""The contact evaluator and force curves, each measured in a process of its own by `contact` and `curves`."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Any

from tests.benchmarks.bench import Bench, Table
from tests.benchmarks.runner import ROOT, Job, environment

NODES = (100, 1000, 10_000, 100_000, 1_000_000)
POINTS = (4, 16, 10_000)
RATIOS = 10**6


def run(bench: Bench) -> None:
    """Measure both."""
    _contact(bench)
    _curves(bench)


def _printed(module: str, *arguments: object) -> Any:  # noqa: ANN401 JSON
    words = [sys.executable, "-m", f"tests.benchmarks.{module}", *map(str, arguments)]
    done = subprocess.run(words, check=True, cwd=ROOT, env=environment(Job(words)), stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def _contact(bench: Bench) -> None:
    nodes = NODES[:2] if bench.quick else NODES
    found = _printed("contact", "--json", "--rounds", bench.rounds(5), "--nodes", *nodes)
    kinds = {"numpy": "numpy", "fast": "compiled", "2 threads": "compiled, 2 threads"}
    rows = [
        [scene, f"{int(size):,}", *(f"{cells[kind]:.1f}" if kind in cells else "" for kind in kinds)]
        for size, scenes in found["sizes"].items()
        for scene, cells in scenes.items()
    ]
    head = ["scene", "nodes", *(f"{name}, ns a node and step" for name in kinds.values())]
    bench.results.tables["Contact evaluation"] = Table(head, sorted(rows, key=lambda row: row[0]))
    single = [[name, f"{1e3 * seconds:.3g}"] for name, seconds in found["single"].items()]
    bench.results.tables["Single contact evaluations"] = Table(["what", "ms"], single)
    bench.results.series["nodes of a contact step"] = {
        f"{scene}, {kinds[kind]}": [(int(n), 1e-9 * int(n) * of[scene][kind]) for n, of in found["sizes"].items()]
        for scene in ("all", "curves")
        for kind in ("numpy", "fast")
    }


def _curves(bench: Bench) -> None:
    found = _printed("curves", "--ratios", bench.size(RATIOS), "--rounds", bench.rounds(3), "--points", *POINTS)
    rows = [[f"{count:,}", spacing, *(f"{cell:.2f}" for cell in cells)] for count, spacing, cells in found["rows"]]
    bench.results.tables["Force curves, ns a ratio"] = Table(["points", "spacing", *found["heads"]], rows)
