"""What holds for every floor."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.floors import Floor
from tests.contact.floors.beds import FLOORS, cloud, level, located

every_floor = pytest.mark.parametrize("floor", FLOORS, ids=lambda floor: floor.describe())


@every_floor
def test_a_point_on_the_bed_has_no_gap(floor: Floor) -> None:
    points = cloud()
    points[:, 0] = level(floor, points[:, 1], points[:, 2])
    points = points[np.isfinite(points[:, 0])]
    assert len(points) > 200
    assert np.abs(located(floor, points)[0]).max() < 1e-12


@every_floor
def test_normals_have_unit_length_and_point_up(floor: Floor) -> None:
    _, normal = located(floor, cloud())
    assert np.abs(np.linalg.norm(normal, axis=1) - 1.0).max() < 1e-14
    assert (normal[:, 0] > 0.0).all()


@every_floor
def test_the_gap_is_the_height_times_the_cosine_of_the_slope(floor: Floor) -> None:
    points = cloud()
    gap, normal = located(floor, points)
    height = points[:, 0] - level(floor, points[:, 1], points[:, 2])
    assert np.allclose(gap, height * normal[:, 0], rtol=1e-11, atol=1e-12, equal_nan=True)


@every_floor
def test_no_seabed_is_nan_with_an_upward_normal(floor: Floor) -> None:
    points = cloud()
    gap, normal = located(floor, points)
    void = np.isnan(gap)
    assert np.array_equal(void, np.isnan(level(floor, points[:, 1], points[:, 2])))
    assert (normal[void] == (1.0, 0.0, 0.0)).all()


@every_floor
def test_the_normal_is_that_of_the_elevation(floor: Floor) -> None:
    points, step = cloud(), 1e-6
    _, normal = located(floor, points)
    for axis in (1, 2):
        ahead, behind = points.copy(), points.copy()
        ahead[:, axis] += step
        behind[:, axis] -= step
        rise = (level(floor, *ahead[:, 1:].T) - level(floor, *behind[:, 1:].T)) / (2.0 * step)
        error = np.abs(rise + normal[:, axis] / normal[:, 0])[np.isfinite(rise)]
        assert np.quantile(error, 0.99) < 1e-6 * max(1.0, np.nanmax(np.abs(rise)))


@every_floor
def test_parts_and_shapes_give_the_same_as_the_whole(floor: Floor) -> None:
    points = cloud(40_000)
    gap, normal = located(floor, points)
    series = points.reshape(4, 10_000, 3)
    gaps, normals = located(floor, series)
    assert np.array_equal(gaps.ravel(), gap, equal_nan=True)
    assert np.array_equal(normals.reshape(-1, 3), normal)
    few, few_normals = located(floor, points[30_000:30_007])
    assert np.array_equal(few, gap[30_000:30_007], equal_nan=True)
    assert np.array_equal(few_normals, normal[30_000:30_007])


@every_floor
def test_outputs_and_points_may_be_strided(floor: Floor) -> None:
    points = cloud(50)
    gap, normal = located(floor, points)
    spread, spread_normal = np.zeros((2, 50)), np.zeros((50, 6))
    floor.locate(np.asfortranarray(points), spread.T[:, 1], spread_normal[:, ::2])
    assert np.array_equal(spread[1], gap, equal_nan=True)
    assert np.array_equal(spread_normal[:, ::2], normal)


@every_floor
def test_on_a_facet_a_step_along_the_normal_changes_the_gap_by_the_step(floor: Floor) -> None:
    points, step = cloud(), 1e-3
    gap, normal = located(floor, points)
    moved, new_normal = located(floor, points - step * normal)
    same = (normal == new_normal).all(axis=1) & np.isfinite(gap) & np.isfinite(moved)
    assert not floor.facetted or same.sum() > 200
    assert np.allclose(moved[same], gap[same] - step, rtol=0.0, atol=1e-11)


@every_floor
def test_the_shared_normal_is_that_of_all_points(floor: Floor) -> None:
    _, normal = located(floor, cloud())
    shared = floor.same_normal
    assert (shared is None) == bool(np.ptp(normal, axis=0).any())
    if shared is not None:
        assert np.allclose(shared, normal, rtol=0.0, atol=1e-15)
        assert not shared.flags.writeable


@every_floor
@pytest.mark.parametrize("far", [1e9, 1e160, np.finfo(np.float64).max])
def test_far_points_have_a_gap_or_no_seabed_as_near_the_edge(floor: Floor, far: float) -> None:
    points = far * np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]])
    near = np.array([[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, -1.0]]) * 1e6
    gap, normal = located(floor, points)
    assert np.array_equal(np.isnan(gap), np.isnan(located(floor, near)[0]))
    assert np.array_equal(normal, located(floor, near)[1])
    assert np.isfinite(normal).all()


@every_floor
def test_minus_zero_never_comes_out(floor: Floor) -> None:
    gap, normal = located(floor, [[-0.0, -0.0, -0.0], [0.0, -0.0, 0.0], [0.0, -200.0, 200.0]])
    for values in (gap, normal, level(floor, [-0.0, 0.0, -200.0], [-0.0, 0.0, 200.0])):
        assert not (np.signbit(values) & (values == 0.0)).any()


@every_floor
def test_no_points_are_no_points(floor: Floor) -> None:
    gap, normal = located(floor, np.zeros((3, 0, 3)))
    assert gap.shape == (3, 0)
    assert normal.shape == (3, 0, 3)
