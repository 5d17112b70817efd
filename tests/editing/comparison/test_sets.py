"""Numbers as spans of consecutive ones, and sets that are compared by them."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.editing.comparison.comparing import compare
from mudline.editing.comparison.model import Spans, spans_of, spans_of_run, text_of, union
from mudline.language.deck.loading import load_bytes
from mudline.model.scene.model import resolve

NUMBERS = st.lists(st.integers(-30, 30))
Run = tuple[int, int, int]
RUNS = st.lists(st.tuples(st.integers(-30, 30), st.integers(-30, 30), st.integers(1, 4)))


def listed(spans: Spans) -> set[int]:
    return {number for first, last in spans.tolist() for number in range(first, last + 1)}


def check(spans: Spans, numbers: set[int]) -> None:
    assert listed(spans) == numbers
    assert (spans[1:, 0] - spans[:-1, 1] > 1).all()


@given(NUMBERS)
def test_numbers_in_any_order(numbers: list[int]) -> None:
    check(spans_of(np.array(numbers, dtype=np.int64)), set(numbers))


@given(NUMBERS, RUNS)
def test_unions(numbers: list[int], runs: list[tuple[int, int, int]]) -> None:
    parts = [spans_of_run(start, end, step) for start, end, step in runs]
    wanted = {number for start, end, step in runs for number in range(start, end + 1, step)}
    check(union([*parts, spans_of(np.array(numbers, dtype=np.int64))]), wanted | set(numbers))
    check(union(parts), wanted)


def test_numbers_with_one_step_are_a_range() -> None:
    assert text_of(spans_of_run(0, 400_000, 2)) == "0-400000 step 2"
    assert text_of(spans_of(np.array([1, 2, 3, 5, 7, 9, 11, 13, 20, 22, 24, 30]))) == "1-3, 5-13 step 2, 20, 22, 24, 30"


def read_back(text: str) -> list[int]:
    """The numbers that a text of spans names, in its order."""
    numbers: list[int] = []
    for piece in filter(None, text.split(", ")):
        span, _, step = piece.partition(" step ")
        first, _, last = span.partition("-")
        numbers += range(int(first), int(last or first) + 1, int(step or 1))
    return numbers


STEPPED = st.lists(st.tuples(st.integers(0, 200), st.integers(1, 60), st.sampled_from([1, 1, 2, 3, 7])), max_size=6)


@given(STEPPED)
def test_a_text_names_all_numbers(runs: list[tuple[int, int, int]]) -> None:
    numbers = sorted({number for first, size, step in runs for number in range(first, first + size, step)})
    assert read_back(text_of(spans_of(np.array(numbers, dtype=np.int64)))) == numbers


@pytest.mark.parametrize("step", [1, 2, 7])
def test_sets_of_the_same_lines_are_not_generated(step: int) -> None:
    """Also with an increment, under which no two numbers make a span."""
    text = f"$MODEL\n*LINES\n x\n*ELEMENT SETS\n SET=A\n GEN=1, {step * 10**7}, {step}\n 4, 9\n"
    before, after = (resolve(load_bytes(text.encode(), "deck.keyxm")) for _ in range(2))
    tracemalloc.start()
    try:
        assert not compare(before, after)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 5_000_000


@given(NUMBERS, RUNS, RUNS)
def test_sets_differ_by_what_they_hold(numbers: list[int], runs: list[Run], more: list[Run]) -> None:
    """However the numbers are given: in lists, ranges, or both."""
    lines = "".join(f" GEN={start}, {end}, {step}\n" for start, end, step in runs)
    listed = sorted({n for start, end, step in runs for n in range(start, end + 1, step)} | set(numbers))
    given = "".join(f" {number}\n" for number in numbers)
    written = [f"{lines}{given}", "".join(f" {number}\n" for number in listed)]
    extra = {n for start, end, step in more for n in range(start, end + 1, step)} - set(listed)
    written.append(written[0] + "".join(f" {number}\n" for number in sorted(extra)))
    head = "$MODEL\n*LINES\n x\n*ELEMENT SETS\n SET=A\n"
    scenes = [resolve(load_bytes(f"{head}{text}".encode(), "deck.keyxm")) for text in written]
    assert not compare(scenes[0], scenes[1])
    assert bool(compare(scenes[1], scenes[2])) == bool(extra)
