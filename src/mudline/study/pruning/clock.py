"""Processor time of a call: what other programs do at the same time does not count."""

from __future__ import annotations

import statistics
from collections.abc import Callable
from time import get_clock_info, process_time

from mudline.study.timing import Timing

_RUNS = 5
_AT_LEAST = 0.03
_LEAST = 1e-3
_TICKS = 20.0
_SLOW = 1.0
"""Seconds of one run from which on two runs are enough."""


def spent(call: Callable[[], object], *, few: bool = False) -> Timing:
    """Processor seconds of a call: once to warm up, then several times; `few`: not so often.

    Short calls are repeated within a run until the clock is fine enough.
    """
    once = _seconds(call, 1)
    repeats = max(1, round(max(_LEAST, _TICKS * get_clock_info("process_time").resolution) / max(once, 1e-7)))
    runs, at_least = (2, 0.0) if few or once > _SLOW else (_RUNS, _AT_LEAST)
    taken: list[float] = []
    while len(taken) < runs or repeats * sum(taken) < at_least:
        taken.append(max(_seconds(call, repeats), 1e-9 * repeats) / repeats)
    return Timing(min(taken), statistics.median(taken), len(taken))


def _seconds(call: Callable[[], object], repeats: int) -> float:
    start = process_time()
    for _ in range(repeats):
        call()
    return process_time() - start
