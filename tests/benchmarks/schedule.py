"""A simulated scheduler: chunks of work on many workers that differ, slow down and die, sent by one process.

Everything that a real one does takes its time here: the client and scheduler need a moment for each chunk, one after
the other; a worker takes a chunk when it has none; a chunk whose worker dies is done again by another.
"""

from __future__ import annotations

import heapq
import math
import random
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cluster:
    """Workers and what befalls them. Times in seconds, failures in hours of one worker.

    `overhead` is what each chunk costs the client and the scheduler. A share `slow` of the chunks takes `slower` times
    as long. A worker that dies is missed after `missed`, and another one is there after `restart`.
    """

    workers: int
    overhead: float
    start: float = 60.0
    spread: float = 0.1
    slow: float = 0.01
    slower: float = 5.0
    failure_hours: float = 1000.0
    missed: float = 30.0
    restart: float = 120.0


@dataclass(frozen=True, slots=True)
class Outcome:
    """Seconds until all is done, the share of the workers' time that was work, and chunks that were done again."""

    seconds: float
    efficiency: float
    repeated: int


def simulate(work: float, chunk: float, cluster: Cluster, seed: int = 1) -> Outcome:
    """Do `work` seconds in chunks of `chunk` seconds each."""
    rng = random.Random(seed)  # noqa: S311 - the same runs each time
    left = math.ceil(work / chunk)
    speeds = [rng.lognormvariate(0.0, cluster.spread) for _ in range(cluster.workers)]
    free = [(cluster.start, number) for number in range(cluster.workers)]
    heapq.heapify(free)
    lost: list[float] = []
    sender = end = 0.0
    repeated = 0
    while left or lost:
        at, number = heapq.heappop(free)
        if not left:  # what a dead worker had is known to be lost only later
            at = max(at, lost[0])
        if lost and lost[0] <= at:
            heapq.heappop(lost)
            repeated += 1
        else:
            left -= 1
        sender = max(sender, at) + cluster.overhead
        took = chunk * speeds[number] * (cluster.slower if rng.random() < cluster.slow else 1.0)
        done = sender + took
        if rng.random() < took / (3600.0 * cluster.failure_hours):
            died = sender + took * rng.random()
            heapq.heappush(lost, died + cluster.missed)
            heapq.heappush(free, (died + cluster.restart, number))
            continue
        end = max(end, done)
        heapq.heappush(free, (done, number))
    return Outcome(end, work / (end * cluster.workers), repeated)
