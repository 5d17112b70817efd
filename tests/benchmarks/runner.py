"""Commands run in turn, each a process of its own, and what each cost: processor time, elapsed time, peak memory.

The runner itself imports nothing large and holds no data: on Linux a process that is started counts the memory of the
one that started it as its own until it runs its own program.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]

_NOT_PASSED_ON = ("PYTHONDONTWRITEBYTECODE", "PYTHONPROFILEIMPORTTIME", "MUDLINE_CACHE_DIR")
_MEGABYTE = 1e6
_MAXRSS = 1 if sys.platform == "darwin" else 1024


class Cost(NamedTuple):
    """What a process took: processor seconds (user and system), seconds by the clock, peak memory in 10^6 bytes."""

    cpu: float
    elapsed: float
    memory: float


class Figure(NamedTuple):
    """A quantity in each round, and the same made from the least times of all rounds."""

    values: list[float]
    least: float

    @property
    def median(self) -> float:
        """The value that the page shows and that a goal is compared with."""
        return statistics.median(self.values)


class PeerError(Exception):
    """A peer's program failed; `peer` is its name."""

    def __init__(self, peer: str, code: int) -> None:
        super().__init__(f"ended with {code}")
        self.peer = peer


@dataclass(frozen=True)
class Job:
    """A command to measure.

    `own_clock`: its processor time is not that of the whole process but the last line that it prints. `before` runs
    ahead of each measurement, and is not measured. `peer` names the peer that it runs, if it is not mudline.
    """

    words: Sequence[str | Path]
    own_clock: bool = False
    codes: frozenset[int] = frozenset({0})
    before: Callable[[], object] | None = None
    environment: Mapping[str, str] = field(default_factory=dict)
    peer: str = ""


def environment(job: Job) -> dict[str, str]:
    """The variables of a job's process: nothing that keeps byte code from being written or counts lines."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if name not in _NOT_PASSED_ON and not name.startswith(("COVERAGE", "COV_"))
    }
    if job.peer:
        kept.pop("PYTHONPATH", None)
    return {**kept, **job.environment}


def cost(job: Job) -> Cost:
    """Run a job once.

    Raises:
        PeerError: A peer failed; what it printed goes to standard error.
        SystemExit: Mudline failed.
    """
    if job.before:
        job.before()
    words = [str(word) for word in job.words]
    start = time.perf_counter()
    with subprocess.Popen(
        words,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env=environment(job),
        cwd=ROOT,
    ) as process:
        assert process.stdout
        printed = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        elapsed = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in job.codes:
        sys.stderr.write(printed[-2000:].decode("utf-8", "replace"))
        if job.peer:
            raise PeerError(job.peer, process.returncode)
        raise SystemExit(f"{' '.join(words[:4])} ... ended with {process.returncode}")
    cpu = float(printed.split()[-1]) if job.own_clock else used.ru_utime + used.ru_stime
    return Cost(cpu, elapsed, used.ru_maxrss * _MAXRSS / _MEGABYTE)


def alternate(jobs: Mapping[str, Job], rounds: int, *, warm: bool) -> dict[str, list[Cost]]:
    """The costs of each job: every round runs all of them in turn, so that a busy machine slows all of them alike.

    `warm` runs all of them once before, which is not counted. A peer that fails is left out, with a line about it.
    """
    taken: dict[str, list[Cost]] = {name: [] for name in jobs}
    failed: set[str] = set()
    for turn in range(rounds + warm):
        for name, job in jobs.items():
            if job.peer in failed:
                continue
            try:
                spent = cost(job)
            except PeerError as error:
                failed.add(job.peer)
                sys.stderr.write(f"{error.peer} is left out: it {error}\n")
                continue
            if turn >= warm:
                taken[name].append(spent)
    return {name: costs for name, costs in taken.items() if costs and jobs[name].peer not in failed}


def figure(values: Sequence[float], scale: float = 1.0) -> Figure:
    """A quantity by itself."""
    return Figure([value * scale for value in values], min(values) * scale)


def ratio(above: Sequence[float], below: Sequence[float]) -> Figure:
    """How many times the one is the other, within each round."""
    return Figure([a / b for a, b in zip(above, below, strict=True)], min(above) / min(below))


def cpu(costs: Sequence[Cost]) -> list[float]:
    """Processor seconds."""
    return [one.cpu for one in costs]


def elapsed(costs: Sequence[Cost]) -> list[float]:
    """Seconds by the clock."""
    return [one.elapsed for one in costs]
