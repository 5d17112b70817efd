"""Streaming a series needs memory for a few steps, however many there are."""

from __future__ import annotations

import tracemalloc

import numpy as np

from mudline.contact import ContactModel
from tests.builders.contact import everything, mixed

SLACK = 2**16
NODES = 10_001


def peak(model: ContactModel, node_steps: int, *, clock: bool) -> int:
    """Largest memory while the results of a line that lies still are looked at one part after the other."""
    points = model.input.coordinates
    steps = node_steps // len(points)
    series = np.broadcast_to(points, (steps, *points.shape))
    times = np.arange(float(steps)) if clock else None
    tracemalloc.start()
    try:
        seen = sum(len(part.result.depth) for part in model.stream(series, times=times))
        assert seen == steps
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_ten_million_node_steps_need_no_more_than_one_million() -> None:
    model = ContactModel(mixed(NODES - 1, 3), backend="numpy")
    peak(model, 10**5, clock=False)  # tables are made, work arrays lent
    assert peak(model, 10**7, clock=False) < peak(model, 10**6, clock=False) + SLACK


def test_a_scene_with_history_keeps_the_last_state_only() -> None:
    model = ContactModel(everything(4000, 3), backend="numpy")  # a few steps at a time
    peak(model, 10**4, clock=True)
    assert peak(model, 4 * 10**5, clock=True) < peak(model, 10**5, clock=True) + SLACK
