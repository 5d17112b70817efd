"""What is no curve, and what has no force."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from mudline.model.curves import CurveError, ForceCurve

LINE = ForceCurve([(0.0, 0.0), (1.0, 1.0)])


@pytest.mark.parametrize(
    ("points", "code", "index"),
    [
        ([], "CRV001", -1),
        ([(0.0, 1.0)], "CRV001", -1),
        ([(0.0, 1.0), (0.0, 1.0), (-0.0, 1.0)], "CRV001", -1),
        ([(0.0, 0.0), (0.0, 1.0)], "CRV003", 1),
        ([(1.0, 5.0), (0.0, 0.0), (2.0, 7.0), (1.0, 6.0)], "CRV003", 3),
        ([(0.0, 1.0), (1.0, 1.0), (-0.0, 2.0)], "CRV003", 2),
        ([(-1.7e308, 0.0), (1.7e308, 1.0)], "CRV011", 1),
        ([(1.0, 1e308), (1.0 + 2**-52, 0.0)], "CRV011", 1),
        ([(3.0, 3.0), (5e-324, 1.0), (0.0, 0.0)], "CRV011", 2),
        ([(0.0, 0.0), (1e300, 1e-300)], "CRV011", 1),
        ([(0.0, 0.0), (1e10, 1e-300)], "CRV011", 1),
        ([(0.0, 0.0), (1e300, 1e-300), (1.5e300, 5.0)], "CRV011", 1),
        ([(0.5, 1.0)] * 60 + [(0.5, 2.0), (0.0, 0.0)] + [(0.5, 1.0)] * 60, "CRV003", 60),
        ([(0.0, 0.0), (1.0, math.nan)], "SYN002", 1),
        ([(math.inf, 0.0), (1.0, 0.0)], "SYN002", 0),
    ],
)
def test_points_that_make_no_curve(points: list[tuple[float, float]], code: str, index: int) -> None:
    with pytest.raises(CurveError) as caught:
        ForceCurve(points)
    assert (caught.value.code, caught.value.index) == (code, index)
    assert isinstance(caught.value, ValueError)


def test_messages_count_points_from_one_and_say_what_clashes() -> None:
    with pytest.raises(CurveError, match=r"two forces at ratio 0\.5: 1\.0 \(point 1\) and 2\.0 \(point 3\)"):
        ForceCurve([(0.5, 1.0), (0.0, 0.0), (0.5, 2.0)])
    for points, count in (([], 0), ([(0.0, 1.0), (0.0, 1.0)], 1)):
        with pytest.raises(CurveError, match=f"a curve needs two distinct points or more, not {count}"):
            ForceCurve(points)
    with pytest.raises(CurveError, match="width between points 2 and 1 is too large"):
        ForceCurve([(1.7e308, 1.0), (-1.7e308, 0.0)])
    with pytest.raises(CurveError, match="slope between points 1 and 2 is too small"):
        ForceCurve([(0.0, 0.0), (1e300, 1e-300)])
    with pytest.raises(CurveError, match=r"point 2 is not finite: \(1\.0, inf\)"):
        ForceCurve([(0.0, 0.0), (1.0, math.inf)])


@pytest.mark.parametrize("points", [[1.0, 2.0, 3.0], [(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)], [("0", "0"), ("1", "1")]])
def test_points_of_another_shape_or_kind(points: ArrayLike) -> None:
    with pytest.raises(ValueError, match="points must be"):
        ForceCurve(points)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_query_that_is_not_finite_is_named(value: float) -> None:
    for curve in (LINE, ForceCurve([(0.0, 5.0), (1.0, 5.0)])):
        for ask in (curve.evaluate, curve.segment, curve.extrapolated):
            with pytest.raises(ValueError, match=rf"at ratio {value!r} \(index 3\): it is not finite"):
                ask([[0.0, 1.0], [2.0, value]])


@pytest.mark.parametrize("count", [2, 40])
def test_a_force_that_overflows_is_named_whatever_block_it_is_in(count: int) -> None:
    ratios = np.linspace(0.0, 1.0, count)
    curve = ForceCurve(np.column_stack((ratios, 1e200 * ratios)))
    query = np.zeros(100_000)
    query[[70_001, 90_000]] = 1e200, -1e200
    with pytest.raises(ValueError, match=r"ratio 1e\+200 \(index 70001\): the force there overflows"):
        curve.evaluate(query)


def test_an_out_that_does_not_fit() -> None:
    good = np.empty(3)
    single: NDArray[Any] = np.empty(3, np.float32)
    misfits: list[NDArray[np.float64]] = [np.empty(2), np.empty((3, 1)), single]
    for bad in misfits:
        for out in ((good, bad), (bad, good)):
            with pytest.raises(ValueError, match=r"out must be float64 of shape \(3,\)"):
                LINE.evaluate([0.0, 1.0, 2.0], out=out)


def test_an_out_that_is_not_two_arrays_that_can_be_written() -> None:
    good, kept = np.empty(3), np.empty(3)
    kept.flags.writeable = False
    misfits: list[tuple[Any, type[Exception], str]] = [
        ([good, good], TypeError, "out must be two arrays .force, slope., not list"),
        ((good, [0.0, 0.0, 0.0]), TypeError, "out must be two arrays .force, slope., not list"),
        ((good, good, good), ValueError, "out must be two arrays .force, slope., not 3"),
        ((good, kept), ValueError, "out must be arrays that can be written"),
    ]
    for out, error, message in misfits:
        with pytest.raises(error, match=message):
            LINE.evaluate([0.0, 1.0, 2.0], out=out)
