"""Run times, of the wall clock or of the processor, and the machine they were measured on."""

from __future__ import annotations

import os
import platform
import statistics
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from time import get_clock_info, perf_counter, process_time
from typing import NamedTuple

_RUNS = 5
_AT_LEAST = 0.03
_LEAST = 1e-3
_TICKS = 20.0
_SLOW = 1.0
"""Seconds of one run from which on two runs are enough."""
_PACKAGES = ("mudline", "numpy", "scipy", "mpmath", "matplotlib", "numba")
_PROCESSORS = Path("/proc/cpuinfo")


class Timing(NamedTuple):
    """Seconds of one run, of so many that were made.

    best: what the machine does when it is left alone.
    median: what it did this time.
    """

    best: float
    median: float
    runs: int


def timed(
    call: Callable[[], object],
    *,
    runs: int,
    at_least: float = 0.0,
    repeats: int = 1,
    clock: Callable[[], float] = perf_counter,
) -> Timing:
    """Time `repeats` calls `runs` times, and more often until `at_least` seconds are spent; no time is 0."""
    taken: list[float] = []
    while len(taken) < runs or repeats * sum(taken) < at_least:
        start = clock()
        for _ in range(repeats):
            call()
        taken.append(max(clock() - start, 1e-9 * repeats) / repeats)
    return Timing(min(taken), statistics.median(taken), len(taken))


def processor_time(call: Callable[[], object], *, few: bool = False) -> Timing:
    """Processor seconds of a call, so that other programs do not count: once to warm up, then several times.

    `few`: not so often. Short calls are repeated within a run until the clock is fine enough.
    """
    once = timed(call, runs=1, clock=process_time).best
    repeats = max(1, round(max(_LEAST, _TICKS * get_clock_info("process_time").resolution) / max(once, 1e-7)))
    runs, at_least = (2, 0.0) if few or once > _SLOW else (_RUNS, _AT_LEAST)
    return timed(call, runs=runs, at_least=at_least, repeats=repeats, clock=process_time)


def machine() -> dict[str, str]:
    """Return processor, cores, system and versions, by name; nothing that names the machine or its user."""
    return {
        "processor": _processor(),
        "cores": str(os.cpu_count() or "unknown"),
        "system": f"{platform.system()} {platform.machine()}",
        "Python": f"{platform.python_implementation()} {platform.python_version()}",
        **{name: found for name in _PACKAGES if (found := _version(name))},
    }


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


def _processor(listing: Path = _PROCESSORS) -> str:
    """The model name as the system tells it; Python alone knows it on few systems."""
    try:
        lines = listing.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or "unknown"
