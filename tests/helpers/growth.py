"""How work grows with its input: in calls, which every machine counts alike, or in processor time, with wide margins.

Calls do not show what a regular expression, a copy of a text or an operation on an array does inside; time does.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import thread_time
from types import FrameType
from typing import TypeVar

Given = TypeVar("Given")

TWOFOLD = 2.5
"""Bound of `call_growth` to an input twice as large: linear work has at most 2, quadratic work 4."""

FOURFOLD = 9.0
"""Bound of `growth` to an input four times as large: linear work has about 4, quadratic work 16."""

_ROUNDS = 5
_AT_LEAST = 0.05 if sys.platform == "win32" else 0.02
"""Seconds of each measurement; the clock of Windows advances by a sixtieth of a second, whatever it says."""
_ENOUGH = 10.0
"""Seconds after which there is no other round."""


def calls(work: Callable[[], object]) -> int:
    """Calls of functions, of C functions those by Python; `work` itself counts, a generator each time it goes on."""
    count = 0

    def profile(_frame: FrameType, event: str, _argument: object) -> None:
        nonlocal count
        count += event in {"call", "c_call"}

    before = sys.getprofile()
    with _no_collection():
        sys.setprofile(profile)
        try:
            work()
        finally:
            sys.setprofile(before)
    return count - 1  # the last call of setprofile is not part of the work


def call_growth(work: Callable[[Given], object], small: Given, large: Given) -> float:
    """How many times the calls for the small input the large one takes, when caches are filled."""
    for given in (small, large):
        work(given)
    return calls(lambda: work(large)) / calls(lambda: work(small))


def growth(work: Callable[[Given], object], small: Given, large: Given) -> float:
    """How many times the processor time for the small input the large one takes, by the shortest of several runs.

    What the work makes of the large input should be a few megabytes only: where the processor's cache ends, linear work
    takes several times as long for each item.
    """
    of_small: list[float] = []
    of_large: list[float] = []
    start = thread_time()
    with _no_collection():
        while len(of_small) < _ROUNDS and thread_time() - start < _ENOUGH:
            of_small.append(_seconds(work, small))
            of_large.append(_seconds(work, large))
    return min(of_large) / min(of_small)


def _seconds(work: Callable[[Given], object], given: Given) -> float:
    """Processor time of this thread for one run, the mean of as many as the clock needs."""
    runs = 0
    start = now = thread_time()
    while now - start < _AT_LEAST:
        work(given)
        runs += 1
        now = thread_time()
    return (now - start) / runs


@contextmanager
def _no_collection() -> Iterator[None]:
    """No collection of garbage, which comes at times that do not depend on the work alone."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
