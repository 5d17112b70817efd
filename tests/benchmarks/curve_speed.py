"""Nanoseconds a ratio of `ForceCurve.evaluate` beside numpy's own ways: python tests/benchmarks/curve_speed.py

Each round times every method once, so that a busy machine slows all of them alike. Printed are the medians over the
rounds, and how many times the time of `ForceCurve` each method takes.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from mudline.curves import ForceCurve

Floats = NDArray[np.float64]
Method = Callable[[ForceCurve, Floats, Floats, Floats], object]

_BLOCK = 16384


def whole_curve(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """Force and slope."""
    curve.evaluate(ratios, out=(force, slope))


def numpy_interp(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """Force alone, in blocks; constant beyond the ends."""
    del slope
    for start in range(0, len(ratios), _BLOCK):
        part = slice(start, start + _BLOCK)
        force[part] = np.interp(ratios[part], curve.ratios, curve.forces)


def numpy_searchsorted(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """Force and slope, in blocks; unguarded."""
    for start in range(0, len(ratios), _BLOCK):
        part = slice(start, start + _BLOCK)
        segment = np.searchsorted(curve.ratios[1:-1], ratios[part], side="right")
        slope[part] = curve.slopes[segment]
        force[part] = curve.forces[segment] + slope[part] * (ratios[part] - curve.ratios[segment])


METHODS: dict[str, Method] = {
    "ForceCurve": whole_curve,
    "np.interp": numpy_interp,
    "np.searchsorted": numpy_searchsorted,
}


def medians(curve: ForceCurve, ratios: Floats, rounds: int) -> dict[str, float]:
    """Median nanoseconds a ratio of each method."""
    force, slope = np.zeros_like(ratios), np.zeros_like(ratios)
    taken: dict[str, list[float]] = {name: [] for name in METHODS}
    for _ in range(rounds):
        for name, method in METHODS.items():
            start = time.perf_counter()
            method(curve, ratios, force, slope)
            taken[name].append((time.perf_counter() - start) / len(ratios) * 1e9)
    return {name: statistics.median(times) for name, times in taken.items()}


def main() -> None:
    """Time curves of growing numbers of unevenly spaced points."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ratios", type=int, default=10**7, help="random ratios to evaluate (default 10^7)")
    parser.add_argument("--rounds", type=int, default=5, help="rounds to take the median of (default 5)")
    parser.add_argument("--points", type=int, nargs="+", default=[4, 8, 16, 17, 100, 1000, 100_000])
    arguments = parser.parse_args()
    rng = np.random.default_rng(1)
    print(f"{'points':>8}" + "".join(f"{name + ' [ns]':>24}" for name in METHODS))
    for count in arguments.points:
        knots = np.cumsum(rng.random(count) + 1e-3)
        curve = ForceCurve(np.column_stack((knots / knots[-1], rng.random(count))))
        ratios = rng.uniform(-0.1, 1.1, arguments.ratios)
        taken = medians(curve, ratios, arguments.rounds)
        cells = (f"{value:.2f} (x {value / taken['ForceCurve']:.2f})" for value in taken.values())
        print(f"{count:>8}" + "".join(f"{cell:>24}" for cell in cells))


if __name__ == "__main__":
    main()
