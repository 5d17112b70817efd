"""Processor time of a call: what other programs do at the same time does not count."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from time import get_clock_info, process_time

from mudline.study.timing import Timing

_LEAST = 1e-3
_TICKS = 20.0
_SLOW = 1.0
"""Seconds of one run from which on two runs are enough."""


def spent(call: Callable[[], object], *, runs: int = 5, at_least: float = 0.03) -> Timing:
    """Processor seconds of a call: once to warm up, then `runs` times and until `at_least` seconds are spent.

    Short calls are repeated within a run until the clock is fine enough.
    """
    once = _seconds(call, 1)
    repeats = max(1, round(max(_LEAST, _TICKS * get_clock_info("process_time").resolution) / max(once, 1e-7)))
    if once > _SLOW:
        runs, at_least = 2, 0.0
    taken: list[float] = []
    while len(taken) < runs or repeats * sum(taken) < at_least:
        taken.append(max(_seconds(call, repeats), 1e-9 * repeats) / repeats)
    return Timing(min(taken), statistics.median(taken), len(taken))


def _seconds(call: Callable[[], object], repeats: int) -> float:
    start = process_time()
    for _ in range(repeats):
        call()
    return process_time() - start
