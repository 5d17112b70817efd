"""The contact evaluator, measured in a process of its own by `contact`, and force curves beside numpy's own ways."""

from __future__ import annotations

import json
import subprocess
import sys
from time import process_time
from typing import Any

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from tests.benchmarks.bench import Bench, Table
from tests.benchmarks.runner import ROOT, Job, environment
from tests.benchmarks.studies.curves import METHODS, Evaluation

NODES = (100, 1000, 10_000, 100_000, 1_000_000)
POINTS = (4, 16, 10_000)
RATIOS = 10**6
SHOWN = ("mudline, numpy", "mudline, fast", "np.interp", "scipy PPoly")


def run(bench: Bench) -> None:
    """Measure both."""
    _contact(bench)
    _curves(bench)


def _printed(module: str, *arguments: object) -> Any:  # noqa: ANN401 JSON
    words = [sys.executable, "-m", f"tests.benchmarks.{module}", "--json", *map(str, arguments)]
    done = subprocess.run(words, check=True, cwd=ROOT, env=environment(Job(words)), stdout=subprocess.PIPE)
    return json.loads(done.stdout)


def _contact(bench: Bench) -> None:
    nodes = NODES[:2] if bench.quick else NODES
    found = _printed("contact", "--rounds", bench.rounds(5), "--nodes", *nodes)
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
    """Nanoseconds a ratio, those of the methods of the study of curves; the least of several rounds in turns."""
    rng, count = np.random.default_rng(1), bench.size(RATIOS)
    rows = []
    for points in POINTS:
        for spacing, knots in (("even", np.linspace(0.0, 1.0, points)), ("geometric", np.geomspace(1e-6, 1.0, points))):
            curve = ForceCurve(np.column_stack((knots, rng.random(points))))
            ratios = rng.uniform(-0.1, 1.1, count)
            ways = [METHODS[name](curve) for name in SHOWN]
            rounds = [[_seconds(way, ratios) for way in ways] for _ in range(1 + bench.rounds(3))]
            least = [1e9 * min(taken) / count for taken in zip(*rounds, strict=True)]
            rows.append([f"{points:,}", spacing, *(f"{cell:.2f}" for cell in least)])
    bench.results.tables["Force curves, ns a ratio"] = Table(["points", "spacing", *SHOWN], rows)


def _seconds(way: Evaluation, ratios: FloatArray) -> float:
    start = process_time()
    way(ratios)
    return process_time() - start
