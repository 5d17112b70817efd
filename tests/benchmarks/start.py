"""One deck: what a command costs from its start to its end, as processor time of the whole process.

Cold starts stand beside the bare imports of the same rounds.
"""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path

from tests.benchmarks.bench import Bench
from tests.benchmarks.decks import alike
from tests.benchmarks.runner import ROOT, Job, cpu, ratio

IMPORTS = Job([sys.executable, "-c", "import numpy, pydantic, lark"])
_SAMPLE, _BROKEN = (ROOT / "samples" / f"{name}.keyxm" for name in ("scr-touchdown", "broken"))


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
        "second `mudline lint`, with findings": bench.mudline("lint", _BROKEN, cache="again", codes=(1,)),
        "cold `mudline lint`, SCR sample": _cold(bench, "lint", _SAMPLE),
        "cold `mudline evaluate`, SCR sample": _cold(bench, "evaluate", _SAMPLE),
    }
    if bench.quick:  # a full run has a round that does not count
        bench.costs({name: job for name, job in jobs.items() if name.startswith("second")}, 1)
    found = bench.costs(jobs, 11)
    nothing, version, imports, first, second, told, lint, evaluate = (cpu(found[name]) for name in jobs)
    bench.results.figures |= {
        "version": ratio(version, nothing),
        "cold": ratio(first, imports),
        "again": ratio(second, imports),
        "remembered": ratio(told, second),
        "evaluate": ratio(evaluate, lint),
    }
