"""Published backbones: worked numbers, a second implementation, and the bound of the points."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from mudline.model.curves.backbones import MODELS, Backbone, Soil

CLAY = Soil(0.3, 5000.0, 1500.0, 6000.0)
UNIFORM = Soil(0.3, 5000.0, 0.0, 6000.0)
NAMES = sorted(MODELS)


def backbone(name: str, soil: Soil = CLAY) -> Backbone:
    return Backbone(MODELS[name], soil)


def forces(name: str, soil: Soil, *ratios: float) -> list[float]:
    return [float(force) for force in backbone(name, soil).force(np.array(ratios))]


def test_worked_numbers() -> None:
    published = [3618.1365802, 5094.1809012, 6821.261609, 7886.1539935, 8712.3072292]
    assert_allclose(forces("f114", UNIFORM, 0.05, 0.1, 0.3, 0.5, 0.7), published, rtol=1e-10)
    assert_allclose(forces("skempton", UNIFORM, 0.1), [5092.7680161], rtol=1e-10)
    # (7.5 s_u + w z) D beyond the cap
    assert_allclose(forces("skempton", UNIFORM, 5.0), [(7.5 * 5000.0 + 6000.0 * 1.5) * 0.3], rtol=1e-12)
    initial = [1067.9279169, 3268.0204652, 4863.4491181, 5977.5596821, 7830.3275104, 9761.1940299]
    dry = Soil(0.3, 5000.0, 1500.0)
    assert_allclose(forces("randolph-quiggin", dry, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0), initial, rtol=1e-10)
    # a r^b s_u D by hand at r = 1/2, s_u = 5000 + 1500 0.15 = 5225
    assert_allclose(forces("aubeny", dry, 0.5), [4.97 * 0.5**0.23 * 5225.0 * 0.3], rtol=1e-12)
    assert_allclose(forces("aubeny-rough", dry, 0.5), [6.73 * 0.5**0.29 * 5225.0 * 0.3], rtol=1e-12)
    half = np.pi * 0.3**2 / 8.0
    assert_allclose(forces("merifield", CLAY, 0.5), [5.66 * 0.5**0.32 * 1567.5 + 1.5 * 6000.0 * half], rtol=1e-12)
    assert_allclose(forces("merifield-rough", CLAY, 0.5), [7.4 * 0.5**0.4 * 1567.5 + 1.5 * 6000.0 * half], rtol=1e-12)


def test_f114_agrees_with_a_second_implementation() -> None:
    groundhog = pytest.importorskip(
        "groundhog.pipelinescables.stability.penetration", reason="groundhog is not installed"
    )
    for ratio in np.linspace(0.001, 0.5, 40).tolist():
        strength = CLAY.strength + CLAY.gradient * 0.3 * ratio
        other = groundhog.embedment_undrained_method2(0.3, 0.3 * ratio, strength / 1000.0, 6.0)["Qv [kN/m]"]
        assert forces("f114", CLAY, ratio)[0] == pytest.approx(1000.0 * float(other), rel=1e-12)


@pytest.mark.covered
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("tolerance", [0.02, 0.005, 0.0005])
def test_points_hold_the_bound_on_ten_thousand_ratios(name: str, tolerance: float) -> None:
    of = backbone(name)
    depth = of.model.published
    points = of.points(depth, tolerance)
    even = np.linspace(0.0, depth, 10_001)
    steep = depth * np.geomspace(1e-15, 1.0, 10_001)
    assert points[0].tolist() == [0.0, 0.0]
    assert points[-1, 0] == depth
    assert (np.diff(points[:, 0]) > 0.0).all()
    for ratios in (even, steep):
        model = of.force(ratios)
        assert np.abs(np.interp(ratios, *points.T) - model).max() <= tolerance * of.force(even).max()


@given(
    name=st.sampled_from(NAMES),
    diameter=st.floats(0.05, 2.0),
    strength=st.floats(100.0, 5e4),
    gradient=st.floats(0.0, 1e4),
    weight=st.floats(0.0, 1.2e4),
    share=st.floats(0.01, 1.0),
)
def test_the_bound_holds_in_any_soil(
    name: str, diameter: float, strength: float, gradient: float, weight: float, share: float
) -> None:
    of = backbone(name, Soil(diameter, strength, gradient, weight))
    depth = share * of.model.published
    points = of.points(depth, 0.01)
    ratios = depth * np.linspace(0.0, 1.0, 10_001) ** 2
    model = of.force(ratios)
    assert np.abs(np.interp(ratios, *points.T) - model).max() <= 0.01 * model.max()


@pytest.mark.covered
@pytest.mark.parametrize("name", NAMES)
def test_no_points_of_the_model_are_fewer(name: str) -> None:
    """Shortest path over 200 ratios: an arc is a chord that holds the tolerance."""
    of, tolerance = backbone(name), 0.02
    depth = of.model.published
    ratios = np.unique(np.concatenate(([0.0], depth * np.geomspace(1e-7, 1.0, 120), np.linspace(0.0, depth, 80))))
    fine = np.unique(np.concatenate((ratios, depth * np.geomspace(1e-9, 1.0, 2000))))
    model, ends = of.force(fine), of.force(ratios)
    allowed = tolerance * model.max()
    steps = np.full(len(ratios), np.inf)
    steps[0] = 1
    for end in range(1, len(ratios)):
        for start in range(end):
            if steps[start] + 1 < steps[end]:
                inside = (fine >= ratios[start]) & (fine <= ratios[end])
                chord = np.interp(fine[inside], ratios[[start, end]], ends[[start, end]])
                if np.abs(chord - model[inside]).max() <= allowed:
                    steps[end] = steps[start] + 1
    assert len(of.points(depth, tolerance)) <= steps[-1]


def test_the_deviation_of_chords_from_a_power_law() -> None:
    """a r^b is farthest from a chord where its tangent has the slope of the chord."""
    a, b = 4.97, 0.23
    of = backbone("aubeny", Soil(1.0, 1.0))
    points = np.array([(ratio, a * ratio**b) for ratio in (0.0, 0.02, 0.1, 0.5)])
    distances = []
    for (start, low), (end, high) in pairwise(points.tolist()):
        slope = (high - low) / (end - start)
        touching = (slope / (a * b)) ** (1.0 / (b - 1.0))
        distances.append(a * touching**b - low - slope * (touching - start))
    assert of.deviation(points[:2]) == pytest.approx(distances[0], rel=1e-3)
    assert of.deviation(points[1:]) == pytest.approx(max(distances[1:]), rel=1e-3)
    assert of.deviation(points) == pytest.approx(max(distances), rel=1e-3)
    assert of.largest(0.5) == pytest.approx(points[-1, 1], rel=1e-15)
