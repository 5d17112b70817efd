"""Whole numbers as spans of consecutive ones: what GEN= generates is compared without being listed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

Spans = NDArray[np.int64]
"""First and last numbers (k, 2) in ascending order, with a gap between one span and the next."""

NO_SPANS: Spans = np.zeros((0, 2), dtype=np.int64)
_AT_ONCE = 100_000


def spans_of(numbers: NDArray[np.int64]) -> Spans:
    """The spans of numbers in any order."""
    return _joined(numbers, numbers)


def spans_of_run(start: int, end: int, step: int) -> Spans:
    """The spans of start, start + step, ... up to end; the step is at least 1."""
    if step == 1:
        return np.array([(start, end)] * (start <= end), dtype=np.int64).reshape(-1, 2)
    numbers = np.arange(start, end + 1, step, dtype=np.int64)
    return np.broadcast_to(numbers[:, np.newaxis], (len(numbers), 2))


def union(parts: Sequence[Spans]) -> Spans:
    """The spans of all numbers in any of several."""
    parts = [part for part in parts if len(part)]
    if len(parts) == 1:
        return parts[0]
    return _joined(*(np.concatenate([NO_SPANS[:, end], *(part[:, end] for part in parts)]) for end in (0, 1)))


def text_of(spans: Spans) -> str:
    """Spans as a text: `1-20, 25`."""
    return ", ".join(_pieces(spans))


def _joined(firsts: NDArray[np.int64], lasts: NDArray[np.int64]) -> Spans:
    """Spans that may overlap or touch as ones with gaps between them."""
    if not len(firsts):
        return NO_SPANS
    if not (firsts[1:] >= firsts[:-1]).all():
        alone = firsts is lasts
        order = np.argsort(firsts, kind="stable")
        firsts = firsts[order]
        lasts = firsts if alone else lasts[order]
    if firsts is lasts and (firsts[1:] - firsts[:-1] > 1).all():  # none is next to another: the numbers are the spans
        return np.broadcast_to(firsts[:, np.newaxis], (len(firsts), 2))
    reached = np.maximum.accumulate(lasts)
    begins = np.flatnonzero(firsts[1:] - reached[:-1] > 1) + 1
    ends = np.append(begins - 1, len(firsts) - 1)
    return np.column_stack([firsts[np.append(0, begins)], reached[ends]])


def _pieces(spans: Spans) -> Iterator[str]:
    """Pieces of the text, each of many spans: a text for each span would take several times the memory."""
    for start in range(0, len(spans), _AT_ONCE):
        some = spans[start : start + _AT_ONCE].tolist()
        yield ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in some)
