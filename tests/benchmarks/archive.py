"""An archive of many decks: its first index beside `validate`, a second one, and the ready questions."""

from __future__ import annotations

import shutil
from dataclasses import replace

from mudline.archive.tables import QUESTIONS
from tests.benchmarks.bench import Bench
from tests.benchmarks.decks import MANY, folder_of
from tests.benchmarks.runner import cpu, figure, ratio


def run(bench: Bench) -> None:
    """Measure all of it, in a single process: processor time does not depend on what else the machine does."""
    folder = folder_of(bench, bench.size(MANY))
    archive = bench.folder / "archive"
    again = bench.mudline("index", folder, "-o", archive, "--isolated", "--jobs", "1")
    jobs = {
        "validate": bench.mudline("validate", "-q", folder),
        "first": replace(again, before=lambda: shutil.rmtree(archive, ignore_errors=True)),
        "second": again,
    }
    found = bench.costs(jobs, 3, warm=False)
    figures = bench.results.figures
    figures["index first"] = ratio(cpu(found["first"]), cpu(found["validate"]))
    figures["index second"] = ratio(cpu(found["first"]), cpu(found["second"]))
    asked = bench.costs({name: bench.mudline("query", archive, "--ask", name) for name in QUESTIONS}, 3)
    slowest = [max(costs) for costs in zip(*(cpu(costs) for costs in asked.values()), strict=True)]
    figures["questions"] = figure(slowest)
