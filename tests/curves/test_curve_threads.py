"""Work arrays serve one query at a time."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np

from mudline.curves import ForceCurve
from mudline.curves.search import workspace


def test_nobody_gets_arrays_that_are_in_use() -> None:
    with workspace() as one, workspace() as other:
        assert one is not other
        assert not np.shares_memory(one.real, other.real)
    with workspace() as again:
        assert again is one


def test_queries_in_several_threads_do_not_mix() -> None:
    rng = np.random.default_rng(6)
    curves = [ForceCurve(np.column_stack((np.sort(rng.random(count)), rng.random(count)))) for count in (5, 50, 500)]
    jobs = [(curve, rng.random(60_000)) for curve in curves for _ in range(8)]
    with ThreadPoolExecutor(6) as pool:
        together = list(pool.map(lambda job: job[0].evaluate(job[1]), jobs))
    for (curve, query), (force, slope) in zip(jobs, together, strict=True):
        alone = curve.evaluate(query)
        assert np.array_equal(force, alone[0])
        assert np.array_equal(slope, alone[1])
