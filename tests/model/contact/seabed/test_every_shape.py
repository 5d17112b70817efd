"""What holds for every seabed."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact.seabed import Seabed
from tests.model.contact.seabed.shapes import SEABEDS, cloud, level, located

every_seabed = pytest.mark.parametrize("seabed", SEABEDS, ids=lambda seabed: seabed.describe())


@every_seabed
def test_a_point_on_the_seabed_has_no_gap(seabed: Seabed) -> None:
    points = cloud()
    points[:, 0] = level(seabed, points[:, 1], points[:, 2])
    points = points[np.isfinite(points[:, 0])]
    assert len(points) > 200
    assert np.abs(located(seabed, points)[0]).max() < 1e-12


@every_seabed
def test_normals_have_unit_length_and_point_up(seabed: Seabed) -> None:
    _, normal = located(seabed, cloud())
    assert np.abs(np.linalg.norm(normal, axis=1) - 1.0).max() < 1e-14
    assert (normal[:, 0] > 0.0).all()


@every_seabed
def test_the_gap_is_the_height_times_the_cosine_of_the_slope(seabed: Seabed) -> None:
    points = cloud()
    gap, normal = located(seabed, points)
    height = points[:, 0] - level(seabed, points[:, 1], points[:, 2])
    assert np.allclose(gap, height * normal[:, 0], rtol=1e-11, atol=1e-12, equal_nan=True)


@every_seabed
def test_no_seabed_is_nan_with_an_upward_normal(seabed: Seabed) -> None:
    points = cloud()
    gap, normal = located(seabed, points)
    void = np.isnan(gap)
    assert np.array_equal(void, np.isnan(level(seabed, points[:, 1], points[:, 2])))
    assert (normal[void] == (1.0, 0.0, 0.0)).all()


@every_seabed
def test_the_normal_is_that_of_the_elevation(seabed: Seabed) -> None:
    points, step = cloud(), 1e-6
    _, normal = located(seabed, points)
    for axis in (1, 2):
        ahead, behind = points.copy(), points.copy()
        ahead[:, axis] += step
        behind[:, axis] -= step
        rise = (level(seabed, *ahead[:, 1:].T) - level(seabed, *behind[:, 1:].T)) / (2.0 * step)
        error = np.abs(rise + normal[:, axis] / normal[:, 0])[np.isfinite(rise)]
        assert np.quantile(error, 0.99) < 1e-6 * max(1.0, np.nanmax(np.abs(rise)))


@every_seabed
def test_parts_and_shapes_give_the_same_as_the_whole(seabed: Seabed) -> None:
    points = cloud(40_000)
    gap, normal = located(seabed, points)
    series = points.reshape(4, 10_000, 3)
    gaps, normals = located(seabed, series)
    assert np.array_equal(gaps.ravel(), gap, equal_nan=True)
    assert np.array_equal(normals.reshape(-1, 3), normal)
    few, few_normals = located(seabed, points[30_000:30_007])
    assert np.array_equal(few, gap[30_000:30_007], equal_nan=True)
    assert np.array_equal(few_normals, normal[30_000:30_007])


@every_seabed
def test_the_shared_normal_is_that_of_all_points(seabed: Seabed) -> None:
    _, normal = located(seabed, cloud())
    shared = seabed.same_normal
    assert (shared is None) == bool(np.ptp(normal, axis=0).any())
    if shared is not None:
        assert np.allclose(shared, normal, rtol=0.0, atol=1e-15)
        assert not shared.flags.writeable


@every_seabed
@pytest.mark.parametrize("far", [1e9, 1e160, np.finfo(np.float64).max])
def test_far_points_have_a_gap_or_no_seabed_as_near_the_edge(seabed: Seabed, far: float) -> None:
    points = far * np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]])
    near = np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]]) * 1e6
    gap, normal = located(seabed, points)
    assert np.array_equal(np.isnan(gap), np.isnan(located(seabed, near)[0]))
    assert np.array_equal(normal, located(seabed, near)[1])
    assert np.isfinite(normal).all()
