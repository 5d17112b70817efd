"""One deck: what a command costs from its start to its end, as processor time of the whole process."""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path
from statistics import median

from tests.benchmarks.bench import Bench, Table
from tests.benchmarks.decks import alike
from tests.benchmarks.runner import ROOT, Job, cpu, ratio

_SAMPLE = ROOT / "samples" / "scr-touchdown.keyxm"


def run(bench: Bench) -> None:
    """Measure all of it."""
    deck = bench.folder / "one.keyxm"
    deck.write_text(alike(1), encoding="utf-8")

    def empty() -> None:
        shutil.rmtree(bench.folder / "cold", ignore_errors=True)

    def cold(*words: str | Path) -> Job:
        return replace(bench.mudline(*words, cache="cold"), before=empty)

    again = bench.mudline("lint", deck, cache="again")
    jobs = {
        "`python -c pass`": Job([sys.executable, "-c", "pass"]),
        "`mudline --version`": bench.mudline("--version"),
        "`import numpy, pydantic, lark`": Job([sys.executable, "-c", "import numpy, pydantic, lark"]),
        "cold `mudline lint`": cold("lint", deck),
        "second `mudline lint`": again,
        "cold `mudline lint`, SCR sample": cold("lint", _SAMPLE),
        "cold `mudline evaluate`, SCR sample": cold("evaluate", _SAMPLE),
    }
    if bench.quick:
        bench.costs({"": again}, 1)  # a full run has a round that does not count
    found = bench.costs(jobs, 11)
    nothing, version, imports, first, second, lint, evaluate = (cpu(found[name]) for name in jobs)
    bench.results.figures |= {
        "version": ratio(version, nothing),
        "cold": ratio(first, imports),
        "again": ratio(second, imports),
        "evaluate": ratio(evaluate, lint),
    }
    rows = [
        [name, f"{1e3 * median(cpu(costs)):.0f}", f"{1e3 * min(cpu(costs)):.0f}", f"{max(c.memory for c in costs):.0f}"]
        for name, costs in found.items()
    ]
    bench.results.tables["Processor time of a start"] = Table(["command", "median ms", "least ms", "peak MB"], rows)
