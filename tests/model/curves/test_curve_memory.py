"""Work arrays have a fixed size, however long the query."""

from __future__ import annotations

import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest

from mudline.model.curves import FloatArray, ForceCurve

CURVES = {
    "few": ForceCurve([(0.0, 0.0), (0.1, 2.0), (0.3, 4.0), (0.5, 6.0)]),
    "even": ForceCurve(np.column_stack((np.linspace(0.0, 1.0, 200), np.arange(200.0)))),
    "crowded": ForceCurve(
        np.column_stack(([0.0, *(0.5 + 2.0**-53 * np.arange(0.0, 400.0, 2.0)), 1.0], np.arange(202.0)))
    ),
}
FIXED = 3 * 2**20
QUERY = 2**20


def peak(action: Callable[[], object]) -> int:
    tracemalloc.start()
    try:
        action()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("name", CURVES)
def test_evaluating_into_given_arrays(name: str) -> None:
    curve = CURVES[name]
    wide = np.random.default_rng(1).random((QUERY, 2))
    force, slope = np.empty(QUERY), np.empty(QUERY)
    views = [wide[:, 0].copy(), wide[:, 0], wide[::-1, 1], wide[:, 0].astype(np.float32), wide.T.reshape(-1)[:QUERY]]
    for view in views:
        assert peak(lambda query=view: curve.evaluate(query, out=(force, slope))) < FIXED  # type: ignore[misc]
    same = wide[:, 0].copy()
    assert peak(lambda: curve.evaluate(same, out=(same, slope))) < FIXED


@pytest.mark.parametrize("name", CURVES)
def test_results_are_all_that_grows(name: str) -> None:
    curve = CURVES[name]
    query: FloatArray = np.random.default_rng(2).random(QUERY)
    assert peak(lambda: curve.evaluate(query)) < 16 * QUERY + FIXED
    assert peak(lambda: curve.segment(query)) < 8 * QUERY + FIXED
    assert peak(lambda: curve.extrapolated(query)) < QUERY + FIXED
