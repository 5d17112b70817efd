"""Smoothing at rest and at an impact."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.study.precision.exact_motions import reference_drop
from mudline.study.precision.smoothing import PUBLISHED, at_rest, impacts, weightless


def test_smoothing_reproduces_published_iterations() -> None:
    rows = {row.half_width: row for row in at_rest(PUBLISHED, np.array([0.0, 1e-6, 1e-4, 1e-3, 1e-2]))}
    tries = {width: (row.from_above, row.from_below) for width, row in rows.items()}
    assert tries == {0.0: (2, 1), 1e-6: (2, 1), 1e-4: (7, 6), 1e-3: (9, 8), 1e-2: (10, 9)}
    depths = [row.penetration for row in rows.values()]
    assert depths == pytest.approx(
        [9.999800004e-6, 9.999800004e-6, -3.6752122431e-5, -7.9984009590e-4, -9.3616510978e-3], rel=1e-9
    )


def test_smoothing_lessens_the_gain_at_impact() -> None:
    rows = [row for row in impacts(weightless(reference_drop())) if (row.scheme, row.omega_dt) == ("newmark", 0.5)]
    kinked, widest = rows[0].rebound, rows[-1].rebound
    assert kinked is not None
    assert widest is not None
    assert widest < 0.2 * kinked
    assert rows[-1].iterations > rows[0].iterations
