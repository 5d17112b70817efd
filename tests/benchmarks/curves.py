"""Nanoseconds a ratio of `ForceCurve.evaluate` beside numpy's own ways: python -m tests.benchmarks.curves

Each round times every method once, so that a busy machine slows all of them alike. Printed are, of the times of the
rounds, the medians for both backends of `ForceCurve` (numpy alone, and the compiled loops of `mudline[fast]`), and how
many times the time of np.searchsorted in blocks and of copying the arrays each backend takes, medians of the ratios
within a round. The least times follow: what the machine does when it is left alone.

The ratios are spread evenly from a tenth of the range below the points to a tenth above, but in the rows "log", where
they are spread like the points, and "knots", where they are the points themselves.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mudline.curves import ForceCurve

Floats = NDArray[np.float64]
Method = Callable[[ForceCurve, Floats, Floats, Floats], object]

_BLOCK = 16384
_PEERS = ("searchsorted", "copies")


class Case(NamedTuple):
    """A curve and the ratios it is asked for."""

    spacing: str
    curve: ForceCurve
    ratios: Floats


def with_numpy(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """Force and slope, numpy alone."""
    curve.evaluate(ratios, out=(force, slope), backend="numpy")


def with_fast(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """Force and slope, compiled loops."""
    curve.evaluate(ratios, out=(force, slope), backend="fast")


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


def copies(curve: ForceCurve, ratios: Floats, force: Floats, slope: Floats) -> None:
    """No values: the ratios copied into both arrays."""
    del curve
    force[...] = ratios
    slope[...] = ratios


METHODS: dict[str, Method] = {
    "numpy": with_numpy,
    "searchsorted": numpy_searchsorted,
    "interp": numpy_interp,
    "copies": copies,
}
if find_spec("numba"):
    METHODS["fast"] = with_fast


def cases(count: int, total: int) -> Iterator[Case]:
    """Curves of `count` points, spaced in different ways."""
    rng = np.random.default_rng(1)
    forces = rng.random(count)
    spread = rng.uniform(-0.1, 1.1, total)
    geometric = np.geomspace(1e-6, 1.0, count)
    crowded = np.sort(np.append(rng.random(count // 2), 0.5 + 2.0**-53 * np.arange((count + 1) // 2)))
    for spacing, knots in (
        ("even", np.linspace(0.0, 1.0, count)),
        ("random", np.sort(rng.random(count))),
        ("geometric", geometric),
        ("crowded", crowded),
    ):
        yield Case(spacing, ForceCurve(np.column_stack((knots, forces))), spread)
    yield Case("log", ForceCurve(np.column_stack((geometric, forces))), np.exp(rng.uniform(-14.0, 0.1, total)))
    yield Case("knots", ForceCurve(np.column_stack((crowded, forces))), rng.choice(crowded, total))


def timed(case: Case, rounds: int) -> dict[str, list[float]]:
    """Nanoseconds a ratio of each method in each round, after one to warm up."""
    force, slope = np.zeros_like(case.ratios), np.zeros_like(case.ratios)
    taken: dict[str, list[float]] = {name: [] for name in METHODS}
    for _ in range(rounds + 1):
        for name, method in METHODS.items():
            start = time.perf_counter()
            method(case.curve, case.ratios, force, slope)
            taken[name].append((time.perf_counter() - start) / len(case.ratios) * 1e9)
    return {name: times[1:] for name, times in taken.items()}


def quotient(taken: dict[str, list[float]], method: str, peer: str) -> float:
    """Median over the rounds of how many times the time of `peer` the method takes."""
    return statistics.median(mine / other for mine, other in zip(taken[method], taken[peer], strict=True))


def main() -> None:
    """Time curves of growing numbers of points."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ratios", type=int, default=10**7, help="random ratios to evaluate (default 10^7)")
    parser.add_argument("--rounds", type=int, default=3, help="rounds to take the median of (default 3)")
    parser.add_argument("--points", type=int, nargs="+", default=[4, 8, 16, 100, 10_000])
    parser.add_argument("--json", action="store_true", help="print the figures as JSON")
    arguments = parser.parse_args()
    ours = [name for name in ("numpy", "fast") if name in METHODS]
    heads = [*(f"{name} [ns]" for name in METHODS)]
    heads += [f"{name}/{peer}" for name in ours for peer in _PEERS]
    heads += [f"least {name}" for name in ours]
    rows: list[tuple[int, str, list[float]]] = []
    if not arguments.json:
        print(f"{'points':>8}{'spacing':>11}" + "".join(f"{head:>19}" for head in heads))
    for count in arguments.points:
        for case in cases(count, arguments.ratios):
            taken = timed(case, arguments.rounds)
            cells = [statistics.median(taken[name]) for name in METHODS]
            cells += [quotient(taken, name, peer) for name in ours for peer in _PEERS]
            cells += [min(taken[name]) for name in ours]
            rows.append((count, case.spacing, cells))
            if not arguments.json:
                print(f"{count:>8}{case.spacing:>11}" + "".join(f"{cell:>19.2f}" for cell in cells), flush=True)
    if arguments.json:
        print(json.dumps({"heads": heads, "rows": rows}))


if __name__ == "__main__":
    main()
