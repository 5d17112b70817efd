"""Run times, of the wall clock or of the processor, and the machine they were measured on."""

from __future__ import annotations

import os
import platform
import statistics
from collections.abc import Callable, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from time import get_clock_info, perf_counter, process_time
from typing import NamedTuple

REPEATS = 5
"""Of calls that are paired, where nothing else is asked for."""
_LEAST = 1e-3
_TICKS = 20.0
_PACKAGES = ("mudline", "numpy", "scipy", "mpmath", "matplotlib", "numba")
_PROCESSORS = Path("/proc/cpuinfo")


class Timing(NamedTuple):
    """Seconds of one run, out of `runs`.

    best: without disturbance by other programs.
    median: of this measurement.
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


class Spread(NamedTuple):
    """Seconds of a call, or a ratio of two, over some repeats: the least, the quartiles and the median between them."""

    least: float
    lower: float
    median: float
    upper: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Spread:
        """The spread of one value or more; quartiles are interpolated."""
        several = [*values, *values] if len(values) == 1 else values
        lower, median, upper = statistics.quantiles(several, n=4, method="inclusive")
        return cls(min(several), lower, median, upper)

    def times(self, factor: float) -> Spread:
        """All of them in another unit."""
        return Spread(*[factor * value for value in self])


def paired(calls: Sequence[Callable[[], object]], repeats: int | None = None) -> list[list[float]]:
    """Processor seconds of each call in each repeat (default `REPEATS`), after one to warm up.

    The calls take turns, in reverse order every other time: a busy machine slows all of them, and the ratios of one
    repeat are of the same moment. Short calls are repeated within a turn until the clock is fine enough. The time of
    other programs is not counted.
    """
    once = [timed(call, runs=1, clock=process_time).best for call in calls]
    fine = max(_LEAST, _TICKS * get_clock_info("process_time").resolution)
    turns = [(index, call, max(1, round(fine / max(once[index], 1e-7)))) for index, call in enumerate(calls)]
    taken: list[list[float]] = [[] for _ in calls]
    for _ in range(repeats or REPEATS):
        for index, call, inner in turns:
            taken[index].append(timed(call, runs=1, repeats=inner, clock=process_time).best)
        turns.reverse()
    return taken


def ratios(over: Sequence[float], under: Sequence[float]) -> Spread:
    """The spread of the ratios of two paired calls."""
    return Spread.of([one / other for one, other in zip(over, under, strict=True)])


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
    """The model name that the system reports; Python alone knows it on few systems only."""
    try:
        lines = listing.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        lines = []
    names = (line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    return next(names, "") or platform.processor() or "unknown"
