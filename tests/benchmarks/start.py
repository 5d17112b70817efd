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

IMPORTS = Job([sys.executable, "-c", "import numpy, pydantic, lark"])
_SAMPLE = ROOT / "samples" / "scr-touchdown.keyxm"


def _cold(bench: Bench, *words: str | Path) -> Job:
    """A command whose cache is emptied before each run."""
    cache = bench.folder / "cold"
    return replace(bench.mudline(*words, cache="cold"), before=lambda: shutil.rmtree(cache, ignore_errors=True))


def lints(bench: Bench) -> dict[str, Job]:
    """The bare imports, and the first and the second check of a deck."""
    deck = bench.folder / "one.keyxm"
    deck.write_text(alike(1), encoding="utf-8")
    return {
        "`import numpy, pydantic, lark`": IMPORTS,
        "cold `mudline lint`": _cold(bench, "lint", deck),
        "second `mudline lint`": bench.mudline("lint", deck, cache="again"),
    }


def run(bench: Bench) -> None:
    """Measure all of it."""
    jobs = {
        "`python -c pass`": Job([sys.executable, "-c", "pass"]),
        "`mudline --version`": bench.mudline("--version"),
        **lints(bench),
        "cold `mudline lint`, SCR sample": _cold(bench, "lint", _SAMPLE),
        "cold `mudline evaluate`, SCR sample": _cold(bench, "evaluate", _SAMPLE),
    }
    if bench.quick:
        bench.costs({"": jobs["second `mudline lint`"]}, 1)  # a full run has a round that does not count
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
