"""Unloading and reloading beside the virgin path: cycle, raised stiffness, curves, properties."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mudline.contact.arrays import FloatArray
from mudline.contact.laws.unloading import UnloadingHistory, UnloadingReaction, VirginPath, steepest_slope, step
from mudline.curves import ForceCurve

Virgin = Callable[[FloatArray], VirginPath]


def linear(stiffness: float) -> Virgin:
    def virgin(z: FloatArray) -> VirginPath:
        slope = np.where(z > 0.0, stiffness, 0.0)
        return VirginPath(stiffness * np.maximum(z, 0.0), slope, slope)

    return virgin


def curved(curve: ForceCurve) -> Virgin:
    """A pipe of diameter 1."""

    def virgin(z: FloatArray) -> VirginPath:
        force, slope = curve.evaluate(z)
        above = z <= 0.0
        steepest = steepest_slope(curve, np.maximum(z, 0.0))
        return VirginPath(*(np.where(above, 0.0, values) for values in (force, slope, steepest)))

    return virgin


def travel(
    virgin: Virgin, stiffness: float, places: Sequence[float], history: UnloadingHistory | None = None
) -> tuple[list[UnloadingReaction], UnloadingHistory]:
    history = UnloadingHistory.initial(np.array([stiffness])) if history is None else history
    reactions = []
    for place in places:
        z = np.array([place])
        reaction, history = step(history, z, virgin(z))
        reactions.append(reaction)
    return reactions, history


def forces(reactions: Sequence[UnloadingReaction]) -> list[float]:
    return [reaction.force.item() for reaction in reactions]


SOFTENING = ForceCurve([(0.0, 0.0), (0.1, 10.0), (0.11, 110.0), (0.3, 129.0), (0.5, 100.0)])


def test_penetration_unloading_and_reloading() -> None:
    places = [-0.01, 0.02, 0.05, 0.0475, 0.045, 0.04, -0.1, 0.045, 0.0475, 0.05, 0.06]
    reactions, history = travel(linear(50000.0), 500000.0, places)
    expected = [0.0, 1000.0, 2500.0, 1250.0, 0.0, 0.0, 0.0, 0.0, 1250.0, 2500.0, 3000.0]
    assert forces(reactions) == pytest.approx(expected, rel=1e-12, abs=1e-10)
    stiffness = [reaction.stiffness.item() for reaction in reactions]
    assert stiffness == [0.0, 5e4, 5e4, 5e5, *stiffness[4:5], 0.0, 0.0, *stiffness[7:8], 5e5, 5e5, 5e4]
    assert [reaction.compressed.item() for reaction in reactions[5:7]] == [False, False]
    assert reactions[5].uplift.item() == pytest.approx(0.005, rel=1e-12)
    assert reactions[6].uplift.item() == pytest.approx(0.145, rel=1e-12)
    assert history.z_max.tolist() == [0.06]
    assert history.force_max.tolist() == pytest.approx([3000.0], rel=1e-15)
    assert history.z_p.tolist() == pytest.approx([0.054], rel=1e-12)


def test_before_the_first_contact() -> None:
    reactions, history = travel(linear(50000.0), 500000.0, [-0.1, 0.0, -0.0])
    assert forces(reactions) == [0.0] * 3
    assert [reaction.uplift.item() for reaction in reactions] == [0.1, 0.0, 0.0]
    assert not any(reaction.compressed.item() for reaction in reactions)
    for reaction in reactions:
        assert not np.signbit(reaction.force.item())
    assert history.z_p.tolist() == [0.0]


def test_the_old_history_is_not_changed() -> None:
    history = travel(linear(5.0), 50.0, [1.0])[1]
    kept = [values.tolist() for values in (history.stiffness, history.z_max, history.force_max, history.z_p)]
    travel(linear(500.0), 50.0, [2.0, 0.5, 3.0], history)
    now = [values.tolist() for values in (history.stiffness, history.z_max, history.force_max, history.z_p)]
    assert now == kept


def test_a_soft_unloading_stiffness_is_raised_to_the_loading_slope() -> None:
    reactions, history = travel(linear(50000.0), 100.0, [0.05, 0.02, -0.01])
    assert forces(reactions) == pytest.approx([2500.0, 1000.0, 0.0], rel=1e-12)
    assert history.stiffness.tolist() == [50000.0]
    assert history.z_p.item() == pytest.approx(0.0, abs=1e-15)


def test_one_step_over_several_segments_is_the_same_as_many() -> None:
    once, many = (
        travel(curved(SOFTENING), 50.0, places)[1] for places in ([0.25], np.linspace(0.0, 0.25, 26).tolist())
    )
    assert once.stiffness.tolist() == many.stiffness.tolist() == pytest.approx([10000.0])
    assert once.z_p.tolist() == many.z_p.tolist()
    back = travel(curved(SOFTENING), 50.0, [0.25, 0.245, 0.25])[0]
    assert back[1].force.item() == pytest.approx(124.0 - 50.0, rel=1e-9)
    assert back[2].force.item() == back[0].force.item()


def test_at_a_point_of_the_curve_the_steeper_segment_is_not_reached_yet() -> None:
    reactions, history = travel(curved(SOFTENING), 500.0, [0.1, 0.09])
    assert reactions[0].stiffness.item() == pytest.approx(10000.0)
    assert history.stiffness.tolist() == [500.0]
    assert reactions[1].force.item() == pytest.approx(5.0, rel=1e-12)


def test_the_slope_alone_already_keeps_the_trench_below_the_mudline() -> None:
    virgin = VirginPath(np.array([124.0]), np.array([100.0]), np.array([100.0]))
    history = step(UnloadingHistory.initial(np.array([50.0])), np.array([0.25]), virgin)[1]
    assert history.z_p.tolist() == [0.0]
    half = step(history, np.array([0.125]), virgin)[0]
    assert half.force.item() == pytest.approx(62.0, rel=1e-12)
    assert half.stiffness.item() == pytest.approx(124.0 / 0.25, rel=1e-12)


def test_a_path_that_jumps_at_the_mudline() -> None:
    jump = curved(ForceCurve([(0.0, 100.0), (1.0, 110.0)]))
    reactions, history = travel(jump, 20.0, [1e-320, 0.5, 0.25, 0.0, -1.0, 0.5])
    assert forces(reactions) == pytest.approx([100.0, 105.0, 52.5, 0.0, 0.0, 105.0], rel=1e-12)
    assert history.z_p.tolist() == [0.0]
    first = travel(jump, 20.0, [1e-320, 0.5e-320, 1e-320])[0]
    assert all(np.isfinite(value) for reaction in first for value in (reaction.force, reaction.stiffness))
    assert first[2].force.item() == 100.0


def test_past_its_peak_a_path_unloads_from_the_deepest_point() -> None:
    reactions, history = travel(curved(SOFTENING), 20000.0, [0.3, 0.5, 0.499, 0.4])
    assert forces(reactions) == pytest.approx([129.0, 100.0, 80.0, 0.0], rel=1e-9, abs=1e-9)
    assert reactions[1].stiffness.item() == pytest.approx(-145.0)
    assert history.z_p.item() == pytest.approx(0.495, rel=1e-12)


def test_a_path_that_pulls_leaves_no_reaction_on_the_way_back() -> None:
    reactions, history = travel(curved(ForceCurve([(0.0, 0.0), (1.0, -5.0)])), 20.0, [0.5, 0.4, 0.5, 0.6])
    assert forces(reactions) == pytest.approx([-2.5, 0.0, 0.0, -3.0])
    assert history.z_p.tolist() == [0.6]
    assert not any(reaction.compressed.item() for reaction in reactions)


@pytest.mark.parametrize("stiffness", [1e-300, 1.0, 1e20, 1.7e308])
@pytest.mark.parametrize("depth", [5e-324, 1e-300, 1.0, 1e300])
def test_extremes_are_finite_and_quiet(stiffness: float, depth: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        reactions, history = travel(linear(2.0), stiffness, [depth, 0.75 * depth, 0.0, -depth, depth])
    for values in (*(value for reaction in reactions for value in reaction), history.z_p, history.stiffness):
        assert np.isfinite(values).all()
    assert reactions[0].force.item() == reactions[4].force.item() == 2.0 * depth
    assert 0.0 <= history.z_p.item() <= depth


def test_steepest_slope_of_a_curve_between_the_mudline_and_a_depth() -> None:
    curve = ForceCurve([(-1.0, -100.0), (-0.5, 0.0), (0.5, 10.0), (1.0, 20.0), (2.0, 25.0), (3.0, 125.0)])
    ratio = np.array([1e-9, 0.4, 0.5, 0.7, 1.5, 2.0, 2.5, 3.0, 9.0])
    assert steepest_slope(curve, ratio) == pytest.approx([10.0, 10.0, 10.0, 20.0, 20.0, 20.0, 100.0, 100.0, 100.0])
    late = ForceCurve([(1.0, 0.0), (2.0, 5.0), (3.0, 15.0)])
    assert steepest_slope(late, np.array([0.5, 1.5, 2.5])) == pytest.approx([5.0, 5.0, 10.0])
    pair = ForceCurve([(0.0, 0.0), (1.0, 5.0)])
    assert steepest_slope(pair, np.array([0.5, 1.0, 3.0])).tolist() == [5.0] * 3
    ended = ForceCurve([(-2.0, 0.0), (-1.5, 50.0), (-1.0, 60.0)])
    assert steepest_slope(ended, np.array([0.5])) == pytest.approx([20.0])


segments = st.lists(st.tuples(st.floats(0.01, 0.3), st.integers(-50, 500)), min_size=1, max_size=5)
starts = st.integers(0, 100).map(float)
places = st.lists(st.floats(-0.2, 1.0), min_size=1, max_size=12)


def path_of(pieces: list[tuple[float, int]], start: float) -> Virgin:
    """A curve from (0, `start`) on, flat at its end, with the force never negative."""
    points = [(0.0, start)]
    for width, rise in pieces:
        points.append((points[-1][0] + width, max(points[-1][1] + rise, 0.0)))
    points.append((points[-1][0] + 1.0, points[-1][1]))
    return curved(ForceCurve(points))


@given(pieces=segments, start=starts, stiffness=st.floats(1.0, 1e5), path=places)
def test_reaction_lies_between_nothing_and_the_virgin_path(
    pieces: list[tuple[float, int]], start: float, stiffness: float, path: list[float]
) -> None:
    virgin = path_of(pieces, start)
    history, bottom = UnloadingHistory.initial(np.array([stiffness])), 0.0
    for place in path:
        z = np.array([place])
        reaction, history = step(history, z, virgin(z))
        force, limit = reaction.force.item(), virgin(z).force.item()
        assert 0.0 <= force <= limit * (1.0 + 1e-9) + 1e-9
        assert reaction.compressed.item() or force == 0.0
        assert not (place == history.z_max.item() and force != history.force_max.item())
        assert 0.0 <= bottom <= history.z_p.item() <= history.z_max.item()
        assert reaction.uplift.item() == history.z_p.item() - place
        bottom = history.z_p.item()


@given(pieces=segments, start=starts, stiffness=st.floats(1.0, 1e5), deepest=st.floats(0.01, 1.0))
def test_unloading_and_reloading_meet_the_virgin_path(
    pieces: list[tuple[float, int]], start: float, stiffness: float, deepest: float
) -> None:
    virgin = path_of(pieces, start)
    history = travel(virgin, stiffness, [deepest])[1]
    at, here = history.z_max.item(), np.array([deepest])
    near = [np.nextafter(at, 0.0), at, np.nextafter(at, 2.0)]
    values = forces([travel(virgin, stiffness, [z], history)[0][0] for z in near])
    scale = max(virgin(here).force.item(), 1.0)
    assert values == pytest.approx([virgin(here).force.item()] * 3, abs=1e-6 * scale)
    assert values[1] == history.force_max.item()
    z_p = history.z_p.item()
    around = [travel(virgin, stiffness, [z], history)[0][0] for z in (z_p, np.nextafter(z_p, 2.0))]
    assert around[0].force.item() == 0.0
    assert around[1].force.item() <= 1e-6 * scale


@settings(max_examples=30)
@given(pieces=segments, start=starts, stiffness=st.floats(1.0, 1e5), path=places)
def test_a_closed_loop_takes_work(
    pieces: list[tuple[float, int]], start: float, stiffness: float, path: list[float]
) -> None:
    legs = [np.linspace(here, there, 40) for here, there in pairwise([-0.2, *path, -0.2])]
    places = np.concatenate(legs)
    force = np.array(forces(travel(path_of(pieces, start), stiffness, places.tolist())[0]))
    mean, way = 0.5 * (force[1:] + force[:-1]), np.diff(places)
    within = 0.5 * np.abs(np.diff(force) * way)  # where between two places the kink lies is not seen
    assert np.sum(mean * way) >= -np.sum(within) - 1e-9


@given(stiffness=st.floats(1.0, 1e5), path=places, cut=st.integers(0, 12))
def test_going_on_from_a_history_is_the_whole_path(stiffness: float, path: list[float], cut: int) -> None:
    virgin = curved(SOFTENING)
    whole, last = travel(virgin, stiffness, path)
    first, middle = travel(virgin, stiffness, path[:cut])
    second, end = travel(virgin, stiffness, path[cut:], middle)
    assert forces([*first, *second]) == forces(whole)
    assert end.z_p.tolist() == last.z_p.tolist()


@given(path=places, seed=st.integers(0, 1000))
def test_rows_do_not_know_each_other(path: list[float], seed: int) -> None:
    random = np.random.default_rng(seed)
    stiffness, order = random.uniform(1e3, 1e5, 7), random.permutation(7)
    history = UnloadingHistory.initial(stiffness)
    shuffled = UnloadingHistory.initial(stiffness[order])
    for place in path:
        z = place + random.uniform(-0.1, 0.1, 7)
        reaction, history = step(history, z, curved(SOFTENING)(z))
        other, shuffled = step(shuffled, z[order], curved(SOFTENING)(z[order]))
        for values, values_shuffled in zip(reaction, other, strict=True):
            assert np.array_equal(values[order], values_shuffled)
