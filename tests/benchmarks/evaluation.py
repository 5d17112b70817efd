"""The contact evaluator, measured in a process of its own by `contact`."""

from __future__ import annotations

import json
import subprocess
import sys

from tests.benchmarks.bench import Bench
from tests.benchmarks.runner import ROOT, Figure, Job, environment


def run(bench: Bench) -> None:
    """Measure the ratios that have goals."""
    words = [sys.executable, "-m", "tests.benchmarks.contact", "--ratios", "--json", "--rounds", str(bench.rounds(40))]
    done = subprocess.run(words, check=True, cwd=ROOT, env=environment(Job(words)), stdout=subprocess.PIPE)
    for key, taken, peer in json.loads(done.stdout):
        bench.results.figures[key] = Figure([a / b for a, b in zip(taken, peer, strict=True)], min(taken) / min(peer))
