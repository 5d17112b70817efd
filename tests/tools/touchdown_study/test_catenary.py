"""Catenaries against closed forms, their balance, and the lines that have none."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mudline.tools.touchdown_study.catenary import HangingLine, NoRestShapeError, rest


def even(length: float = 1000.0, weight: float = 800.0, count: int = 200, slope: float = 0.0) -> HangingLine:
    return HangingLine(np.full(count, length / count), np.full(count, weight), slope)


def test_a_uniform_line_is_the_catenary_of_the_textbook() -> None:
    """Height a (cosh(x/a) - 1), length a sinh(x/a), the rest lies."""
    a, x = 300.0, 250.0
    height, hanging = a * (math.cosh(x / a) - 1.0), a * math.sinh(x / a)
    found = rest(even(), 1000.0 - hanging + x, (0.0, height))
    assert found.tension == pytest.approx(800.0 * a, rel=1e-6)
    assert found.lying[0] == pytest.approx((0.0, 1000.0 - hanging), rel=1e-6)
    assert found.vertical[-1] == pytest.approx(800.0 * hanging, rel=1e-5)
    assert found.height == pytest.approx(
        np.maximum(a * (np.cosh(np.maximum(found.distance - (1000.0 - hanging), 0.0) / a) - 1.0), 0.0), abs=1e-3
    )


def test_both_ends_may_hang() -> None:
    """Two halves of the same line, with one piece lying between them."""
    one = rest(even(500.0, count=100), 400.0, (0.0, 200.0))
    both = rest(even(), 800.0, (200.0, 200.0))
    assert both.tension == pytest.approx(one.tension, rel=1e-6)
    first, last = both.lying[0]
    assert (500.0 - first, last - 500.0) == pytest.approx((one.lying[0][1],) * 2)
    assert both.distance[-1] == pytest.approx(800.0)
    assert both.vertical[0] == pytest.approx(-both.vertical[-1], rel=1e-6)


def test_along_a_slope_the_line_leaves_the_seabed_at_its_angle() -> None:
    slope = math.tan(math.radians(5.0))
    found = rest(even(slope=slope), 750.0, (0.0, 400.0))
    lies = found.lying[0][1]
    behind = np.flatnonzero(even().arcs > lies)[0]
    assert found.vertical[behind] / found.tension == pytest.approx(slope, abs=0.03)
    assert found.distance[behind - 1] == pytest.approx(even().arcs[behind - 1] * math.cos(math.atan(slope)))
    assert found.height[-1] == pytest.approx(400.0)


def lazy_wave(buoyancy: float) -> HangingLine:
    lengths = np.full(200, 5.0)
    weights = np.full(200, 500.0)
    weights[110:140] = -buoyancy
    return HangingLine(lengths, weights)


def test_a_lazy_wave_hangs_over_its_buoys() -> None:
    found = rest(lazy_wave(900.0), 760.0, (0.0, 300.0))
    hog = int(np.argmax(found.height[:150]))
    assert 110 < hog < 150
    assert found.height[hog] > found.height[hog:].min() > 0.0
    lies = found.lying[0][1]
    assert found.vertical[-1] == pytest.approx(lazy_wave(900.0).carried[-1] - 500.0 * lies, rel=1e-6)


def test_a_sag_that_comes_down_lies_too() -> None:
    line = HangingLine(np.full(200, 5.0), np.where((np.arange(200) >= 60) & (np.arange(200) < 80), -600.0, 500.0))
    found = rest(line, 800.0, (0.0, 300.0))
    (_, leaves), (lands, lifts) = found.lying
    assert leaves < 300.0
    assert 400.0 < lands < lifts
    assert found.height.min() > -1e-6
    assert line.weight_to(lands) == pytest.approx(line.weight_to(leaves), rel=1e-6)
    assert (found.distance[-1], found.height[-1]) == pytest.approx((800.0, 300.0))


@pytest.mark.parametrize(
    ("line", "distance", "heights", "words"),
    [
        (even(), 900.0, (0.0, 500.0), "taut: its ends are 1029.56 apart"),
        (even(), 860.0, (0.0, 500.0), "hangs free of the seabed"),
        (even(), 100.0, (0.0, 500.0), "slack"),
        (even(weight=-5.0), 700.0, (0.0, 500.0), "floats: -5 per unit length"),
    ],
)
def test_lines_without_a_shape(line: HangingLine, distance: float, heights: tuple[float, float], words: str) -> None:
    with pytest.raises(NoRestShapeError, match=words):
        rest(line, distance, heights)
