"""What the subjects measure with: the inputs, the sizes of a full and of a quick run, and where the results go."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import NamedTuple

from tests.benchmarks.peers import Environment
from tests.benchmarks.runner import ROOT, Cost, Figure, Job, alternate, cpu, elapsed, environment

Maker = Callable[[int], Job]
"""The job for a size."""
Series = dict[str, list[tuple[int, float]]]
"""Sizes and seconds by the name of a program."""

_SMALL = 200
_BRIEF = 3.0
"""Seconds by the clock of a run; at the size behind a longer one, a series has a single run."""
_LONG = 15.0
"""Seconds by the clock of the last run of a series: the next would take minutes."""

_TIMED = """
import sys, time
{0.setup}
def prepare(path):
    {0.prepare}
    def work():
        {0.work}
    return work
prepare(sys.argv[2])()
work = prepare(sys.argv[1])
start = time.process_time()
kept = work()
print(time.process_time() - start)
"""


class Work(NamedTuple):
    """Lines of Python that are timed, and what comes before them once and for each file; the file is `path`."""

    setup: str
    work: str
    prepare: str = "pass"


@dataclass
class Results:
    """All that was found.

    `runs` says how each subject was last measured, `failed` has the peers that ended in an error.
    """

    figures: dict[str, Figure] = field(default_factory=dict)
    series: dict[str, Series] = field(default_factory=dict)
    runs: dict[str, str] = field(default_factory=dict)
    failed: list[str] = field(default_factory=list)

    def save(self, path: Path) -> None:
        """Write them."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1), encoding="utf-8")

    @classmethod
    def load(cls, path: Path) -> Results:
        """The results that `save` wrote; none if there is no such file."""
        if not path.exists():
            return cls()
        kept = json.loads(path.read_text(encoding="utf-8"))
        return cls(
            {key: Figure(*value) for key, value in kept["figures"].items()},
            {
                key: {name: [(n, s) for n, s in points] for name, points in of.items()}
                for key, of in kept["series"].items()
            },
            kept["runs"],
            kept["failed"],
        )


@dataclass
class Bench:
    """A run of the benchmarks."""

    folder: Path
    quick: bool
    environments: Mapping[str, Environment]
    results: Results = field(default_factory=Results)
    most_rounds: int = 100

    def size(self, full: int) -> int:
        """A size, or a five hundredth of it in a quick run."""
        return max(10, full // 500) if self.quick else full

    def rounds(self, full: int) -> int:
        """How many rounds to run: one in a quick run, and no more than the user wants."""
        return 1 if self.quick else min(full, self.most_rounds)

    def costs(self, jobs: Mapping[str, Job], rounds: int, *, warm: bool = True) -> dict[str, list[Cost]]:
        """The costs of jobs in turn; a run of a single round, such as a quick one, has none to warm up."""
        rounds = self.rounds(rounds)
        taken = alternate(jobs, rounds, warm=warm and rounds > 1)
        lost = {jobs[name].peer for name in jobs.keys() - taken.keys()}
        self.results.failed += sorted(lost - set(self.results.failed))
        return taken

    def table(self, kind: str, count: int) -> Path:
        """A file with a table of so many rows; see `inputs`."""
        path = self.folder / f"{re.sub('[^A-Za-z0-9.]', '-', kind)}-{count}{_SUFFIXES.get(kind, '.keyxm')}"
        if not path.exists():
            words = [sys.executable, "-m", "tests.benchmarks.inputs", kind, str(count), str(path)]
            subprocess.run(words, check=True, cwd=ROOT, env=environment(Job(words)))
        return path

    def has(self, peer: str) -> bool:
        """Whether a peer is installed and has not failed."""
        return not self.environments[peer].reason and peer not in self.results.failed

    def timed(self, work: Work, kind: str, count: int, peer: str = "") -> Job:
        """Processor time of work on a table, in a process that has done it once for a table of a few rows."""
        python: str | Path = self.environments[peer].program("python") if peer else sys.executable
        files = (self.table(kind, size) for size in (count, _SMALL))
        return Job([python, "-c", _TIMED.format(work), *files], own_clock=True, peer=peer)

    def mudline(self, *words: str | Path, cache: str = "cache", codes: Sequence[int] = (0,)) -> Job:
        """A command of mudline, with a folder for its cache."""
        place = {"MUDLINE_CACHE_DIR": str(self.folder / cache)}
        return Job([sys.executable, "-m", "mudline", *words], codes=frozenset(codes), environment=place)

    def grow(self, panel: str, sizes: Sequence[int], makers: Mapping[str, Maker]) -> None:
        """Measure jobs of growing sizes: least processor time of two runs.

        What takes long is run once, and left out at the sizes where it would take minutes.
        """
        series: Series = {}
        last = dict.fromkeys(makers, 0.0)
        for size in sizes:
            for rounds, names in (
                (2, [name for name, took in last.items() if took < _BRIEF]),
                (1, [name for name, took in last.items() if _BRIEF <= took < _LONG]),
            ):
                taken = self.costs({name: makers[name](size) for name in names}, rounds, warm=False)
                for name in names:
                    last[name] = min(elapsed(taken[name])) if name in taken else _LONG
                for name, costs in taken.items():
                    series.setdefault(name, []).append((size, min(cpu(costs))))
        self.results.series[panel] = series


_SUFFIXES = {"abaqus": ".inp", "opm-curve": ".data", "opm-nodes": ".data"}
