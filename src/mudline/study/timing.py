"""Run times: the best and the middle one of repeated runs."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from time import perf_counter
from typing import NamedTuple


class Timing(NamedTuple):
    """Seconds of one run, of so many that were made.

    best: what the machine does when it is left alone.
    median: what it did this time.
    """

    best: float
    median: float
    runs: int


def timed(call: Callable[[], object], *, runs: int = 7, at_least: float = 0.0, warm: bool = True) -> Timing:
    """Time a call `runs` times, and more often until `at_least` seconds are spent; `warm`: once before, untimed."""
    if warm:
        call()
    taken: list[float] = []
    while len(taken) < runs or sum(taken) < at_least:
        start = perf_counter()
        call()
        taken.append(perf_counter() - start)
    return Timing(min(taken), statistics.median(taken), len(taken))
