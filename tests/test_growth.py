"""The measures of growth tell quadratic work from linear work."""

from __future__ import annotations

import gc
import re
import sys
from collections.abc import Callable

import pytest

from tests.growth import FOURFOLD, TWOFOLD, call_growth, calls, growth

BACKTRACKING = re.compile("a*b")
POSSESSIVE = re.compile("a*+b")


def of_each(size: int) -> list[int]:
    return [abs(number) for number in range(size)]


def of_each_pair(size: int) -> list[int]:
    return [abs(other) for number in range(size) for other in range(number)]


def place_of_each(size: int) -> list[int]:
    numbers = list(range(size))
    return [numbers.index(number) for number in numbers]


def backtracking(size: int) -> None:
    assert BACKTRACKING.search("a" * size) is None


def without_backtracking(size: int) -> None:
    assert POSSESSIVE.fullmatch("a" * size) is None


def test_calls_are_counted_exactly() -> None:
    def work() -> None:
        inner()
        abs(-1)

    def inner() -> None:
        sorted([3, 1], key=lambda number: -number)

    assert calls(lambda: None) == 1
    assert calls(work) == 6  # work, inner, sorted, its key twice, abs
    assert calls(work) == calls(work)


def test_calls_tell_quadratic_work_from_linear_work() -> None:
    assert 1.9 < call_growth(of_each, 100, 200) < TWOFOLD
    assert call_growth(of_each_pair, 100, 200) > 3.9 > TWOFOLD


@pytest.mark.parametrize("work", [place_of_each, backtracking])
def test_processor_time_tells_quadratic_work_that_calls_hide(work: Callable[[int], object]) -> None:
    assert call_growth(work, 1000, 2000) < TWOFOLD
    assert growth(work, 1000, 4000) > FOURFOLD


@pytest.mark.parametrize("work", [of_each, without_backtracking])
def test_processor_time_of_linear_work(work: Callable[[int], object]) -> None:
    assert growth(work, 5_000, 20_000) < FOURFOLD


def test_work_that_does_not_grow() -> None:
    assert call_growth(abs, 1000, 2000) == 1.0
    assert growth(abs, 1000, 4000) < 2.0


def test_work_that_fails_leaves_no_trace() -> None:
    before = sys.getprofile()
    with pytest.raises(ValueError, match="invalid literal"):
        calls(lambda: int("x"))
    with pytest.raises(ZeroDivisionError):
        growth(lambda given: 1 // given, 0, 0)
    assert sys.getprofile() is before
    assert gc.isenabled()
