"""Nanoseconds a ratio of `ForceCurve.evaluate` beside numpy's and scipy's ways: python -m tests.benchmarks.curves

Each round times every way once, so that a busy machine slows all of them alike; printed are the least processor times,
as JSON. The ratios are spread evenly from a tenth of the range below the points to a tenth above.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterator

import numpy as np

from mudline.contact.arrays import FloatArray
from mudline.curves import ForceCurve
from tests.benchmarks.studies.curves import METHODS, Evaluation

SHOWN = ("mudline", "np.interp", "scipy PPoly")


def seconds(way: Evaluation, ratios: FloatArray) -> float:
    """Processor time of one evaluation."""
    start = time.process_time()
    way(ratios)
    return time.process_time() - start


def rows(points: int, total: int, rounds: int) -> Iterator[tuple[int, str, list[float]]]:
    """Curves of so many points, spaced in two ways."""
    rng = np.random.default_rng(1)
    ratios = rng.uniform(-0.1, 1.1, total)
    for spacing, knots in (("even", np.linspace(0.0, 1.0, points)), ("geometric", np.geomspace(1e-6, 1.0, points))):
        curve = ForceCurve(np.column_stack((knots, rng.random(points))))
        ways = [METHODS[name](curve) for name in SHOWN]
        taken = [[seconds(way, ratios) for way in ways] for _ in range(1 + rounds)]
        yield points, spacing, [1e9 * min(column) / total for column in zip(*taken, strict=True)]


def main() -> None:
    """Time curves of growing numbers of points."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ratios", type=int, default=10**6, help="random ratios to evaluate (default 10^6)")
    parser.add_argument("--rounds", type=int, default=3, help="rounds to take the least of (default 3)")
    parser.add_argument("--points", type=int, nargs="+", default=[4, 16, 10_000])
    given = parser.parse_args()
    found = [row for points in given.points for row in rows(points, given.ratios, given.rounds)]
    print(json.dumps({"heads": SHOWN, "rows": found}))


if __name__ == "__main__":
    main()
