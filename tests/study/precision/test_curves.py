"""The curve part of the precision study: exact arithmetic, methods, closed forms."""

from __future__ import annotations

import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.curves import ForceCurve
from mudline.study.precision import curves as curve_study
from mudline.study.precision.curves import (
    DEEPEST,
    evaluate_methods,
    exact_forces,
    f114,
    largest_error,
    methods,
    randolph_quiggin,
    sampled_backbones,
)
from mudline.study.report import Omission, StudyOptions

CLAY = ForceCurve([(0.0, 0.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)], "clay")


@pytest.fixture(autouse=True)
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(curve_study, "_TIMED", 1000)
    monkeypatch.setattr(curve_study, "_CHECKED", 200)


def test_exact_forces_are_exact() -> None:
    found = exact_forces(CLAY, np.array([0.0, 0.25, 0.75, -0.5, 0.5]))
    assert found[0] == 0
    assert found[4] == 6000
    quarter = Fraction(2000) + 2500 / (Fraction(0.3) - Fraction(0.1)) * (Fraction(0.25) - Fraction(0.1))
    assert found[1] == quarter
    assert float(found[2]) == pytest.approx(7875.0)
    assert float(found[3]) == pytest.approx(-10000.0)


@given(st.lists(st.floats(-1.0, 2.0), min_size=1, max_size=20))
def test_evaluator_is_exact_to_round_off(ratios: list[float]) -> None:
    query = np.array(ratios)
    assert largest_error(CLAY.evaluate(query)[0], exact_forces(CLAY, query), 6000.0) < 1e-14


def test_what_is_not_finite_is_wrong_without_bound() -> None:
    assert largest_error(np.array([np.nan]), [Fraction(0)], 1.0) == float("inf")


def test_rows_distinguish_the_methods() -> None:
    curve = ForceCurve([(0.0, 0.0), (0.0123, 900.0), (0.1, 2000.0), (0.3, 4500.0), (0.5, 6000.0)])
    rows = {row.method: row for row in evaluate_methods("clay", curve, StudyOptions(), [])}
    assert list(rows)[:6] == ["mudline, numpy", "mudline, fast", "np.interp", "scipy PPoly", "scipy PCHIP", "float32"]
    assert max(rows[name].error for name in ("mudline, numpy", "mudline, fast", "np.interp", "scipy PPoly")) < 1e-15
    assert rows["mudline, numpy"].beyond < 1e-15
    assert rows["np.interp"].beyond > 0.01
    assert 1e-9 < rows["float32"].error < 1e-6
    assert rows["scipy PCHIP"].error > 1e-3
    tables = [row.error for row in rows.values() if row.family.startswith("uniform")]
    assert len(tables) == 7
    assert tables[-1] < 1e-2 * tables[0]
    assert all(0.0 < row.nanoseconds <= row.median for row in rows.values())


def test_missing_extra_is_an_omission(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "mudline.curves.compiled", None)
    omissions: list[Omission] = []
    rows = list(evaluate_methods("clay", CLAY, StudyOptions(full=True), omissions))
    assert "mudline, fast" not in {row.method for row in rows}
    assert [omission.what for omission in omissions] == ["mudline, fast on clay"]


def test_every_method_agrees_at_the_ends() -> None:
    for method in methods((16,)):
        ends = np.asarray(method.prepare(CLAY)(np.array([0.0, 0.5])), np.float64)
        assert ends == pytest.approx([0.0, 6000.0], abs=1e-3)


def test_backbones_have_the_published_values() -> None:
    ratios = np.array([0.05, 0.1, 0.3, 0.5, 0.7])
    expected = [3618.1365802, 5094.1809012, 6821.261609, 7886.1539935, 8712.3072292]
    assert f114(ratios) == pytest.approx(expected, rel=1e-10)
    ratios = np.array([0.01, 0.05, 0.1, 0.2, 0.5, 1.0])
    expected = [1067.9279169, 3268.0204652, 4863.4491181, 5977.5596821, 7830.3275104, 9761.1940299]
    assert randolph_quiggin(ratios) == pytest.approx(expected, rel=1e-10)
    assert f114(np.array([0.0]))[0] == randolph_quiggin(np.array([0.0]))[0] == 0.0


def test_graded_points_beat_even_ones() -> None:
    rows = {(row.backbone, row.spacing, row.points): row for row in sampled_backbones()}
    for name in {key[0] for key in rows}:
        assert rows[name, "graded", 100].linear < 0.6 * rows[name, "even", 100].linear
        assert rows[name, "even", 300].linear < rows[name, "even", 10].linear
        assert 0.0 < rows[name, "graded", 300].pchip < 1e-2
    assert DEEPEST == 0.5
