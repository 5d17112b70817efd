"""Unloading and reloading beside the virgin path: cycle, raised stiffness, curves, properties."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.model.contact import ContactModel, ContactState
from mudline.model.contact.laws.linear import steepest_slope
from mudline.model.contact.laws.unloading import UnloadingHistory
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import CURVE, LINEAR, NONE, at_depths, chain, on

EPSILON = float(np.finfo(np.float64).eps)


class Reaction(NamedTuple):
    """What one element does in a step."""

    force: float
    stiffness: float
    uplift: float
    compressed: bool


def linear(loading: float, unloading: float) -> ContactModel:
    return ContactModel(
        chain([LINEAR], on("unloading", 1, stiffness=unloading), stiffness=loading, diameter=1.0, length=1.0)
    )


def curved(curve: ForceCurve, unloading: float) -> ContactModel:
    """A pipe of diameter 1."""
    return ContactModel(chain([CURVE], on("unloading", 1, stiffness=unloading), curves=(curve,), diameter=1.0))


def history_of(state: ContactState) -> UnloadingHistory:
    assert state.unloading is not None
    return state.unloading


def travel(
    contact: ContactModel, places: Sequence[float], state: ContactState | None = None
) -> tuple[list[Reaction], ContactState]:
    """Take the element through penetrations."""
    state = contact.initial_state() if state is None else state
    reactions = []
    for place in places:
        result, state = contact.step(at_depths([place, place]), None, state)
        bottom = history_of(state).bottom.item()
        uplift = bottom - result.depth.item()
        reactions.append(Reaction(result.force.item(), result.stiffness.item(), uplift, uplift < 0.0))
    return reactions, state


def forces(reactions: Sequence[Reaction]) -> list[float]:
    return [reaction.force for reaction in reactions]


SOFTENING = ForceCurve([(0.0, 0.0), (0.1, 10.0), (0.11, 110.0), (0.3, 129.0), (0.5, 100.0)])


def test_penetration_unloading_and_reloading() -> None:
    places = [-0.01, 0.02, 0.05, 0.0475, 0.045, 0.04, -0.1, 0.045, 0.0475, 0.05, 0.06]
    reactions, state = travel(linear(50000.0, 500000.0), places)
    expected = [0.0, 1000.0, 2500.0, 1250.0, 0.0, 0.0, 0.0, 0.0, 1250.0, 2500.0, 3000.0]
    assert forces(reactions) == pytest.approx(expected, rel=1e-12, abs=1e-10)
    stiffness = [reaction.stiffness for reaction in reactions]
    assert stiffness == [0.0, 5e4, 5e4, 5e5, *stiffness[4:5], 0.0, 0.0, *stiffness[7:8], 5e5, 5e5, 5e4]
    assert [reaction.compressed for reaction in reactions[5:7]] == [False, False]
    assert reactions[5].uplift == pytest.approx(0.005, rel=1e-12)
    assert reactions[6].uplift == pytest.approx(0.145, rel=1e-12)
    history = history_of(state)
    assert history.z_max.tolist() == [0.06]
    assert history.force_max.tolist() == pytest.approx([3000.0], rel=1e-15)
    assert history.bottom.tolist() == pytest.approx([0.054], rel=1e-12)


def test_a_soft_unloading_stiffness_is_raised_to_the_loading_slope() -> None:
    reactions, state = travel(linear(50000.0, 100.0), [0.05, 0.02, -0.01])
    assert forces(reactions) == pytest.approx([2500.0, 1000.0, 0.0], rel=1e-12)
    assert history_of(state).line.tolist() == [50000.0]
    assert history_of(state).bottom.item() == pytest.approx(0.0, abs=1e-15)


def test_a_path_that_jumps_at_the_mudline() -> None:
    jump = curved(ForceCurve([(0.0, 100.0), (1.0, 110.0)]), 20.0)
    reactions, state = travel(jump, [1e-320, 0.5, 0.25, 0.0, -1.0, 0.5])
    assert forces(reactions) == pytest.approx([100.0, 105.0, 52.5, 0.0, 0.0, 105.0], rel=1e-12)
    assert history_of(state).bottom.tolist() == [0.0]
    first = travel(jump, [1e-320, 0.5e-320, 1e-320])[0]
    assert all(np.isfinite(value) for reaction in first for value in (reaction.force, reaction.stiffness))
    assert first[2].force == 100.0


def test_past_its_peak_a_path_unloads_from_the_deepest_point() -> None:
    reactions, state = travel(curved(SOFTENING, 20000.0), [0.3, 0.5, 0.499, 0.4])
    assert forces(reactions) == pytest.approx([129.0, 100.0, 80.0, 0.0], rel=1e-9, abs=1e-9)
    assert reactions[1].stiffness == pytest.approx(-145.0)
    assert history_of(state).bottom.item() == pytest.approx(0.495, rel=1e-12)


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


def test_the_unloading_of_a_smoothed_law_is_never_softer_than_its_stiffness() -> None:
    """In the zone of 0.01 m the slope is 25 kN/m2 at its middle; ku' is 50 kN/m2 whatever ku is."""
    zone = on("smoothed", 1, stiffness=5e4, half_width=0.01, one_sided=1.0)
    contact = ContactModel(chain([NONE], zone, on("unloading", 1, stiffness=100.0)))
    reactions, state = travel(contact, [0.01, 0.009, 0.03, 0.02])
    assert forces(reactions) == pytest.approx([125.0, 75.0, 1000.0, 500.0])
    assert history_of(state).line.tolist() == [5e4]


segments = st.lists(st.tuples(st.floats(0.01, 0.3), st.integers(-50, 500)), min_size=1, max_size=5)
starts = st.integers(0, 100).map(float)
places = st.lists(st.floats(-0.2, 1.0), min_size=1, max_size=12)


def path_of(pieces: list[tuple[float, int]], start: float) -> ForceCurve:
    """A curve from (0, `start`) on, flat at its end, with the force never negative."""
    points = [(0.0, start)]
    for width, rise in pieces:
        points.append((points[-1][0] + width, max(points[-1][1] + rise, 0.0)))
    points.append((points[-1][0] + 1.0, points[-1][1]))
    return ForceCurve(points)


def virgin(curve: ForceCurve, z: float) -> float:
    """The force of a curve in contact."""
    return float(curve.evaluate(z)[0]) if z > 0.0 else 0.0


@given(pieces=segments, start=starts, stiffness=st.floats(1.0, 1e5), path=places)
@example(
    pieces=[(0.296875, 125), (0.2736917183623665, 197), (0.296875, 214)],
    start=5.0,
    stiffness=1.0,
    path=[0.59375, 0.6011578925111181],
)
def test_reaction_lies_between_nothing_and_the_virgin_path(
    pieces: list[tuple[float, int]], start: float, stiffness: float, path: list[float]
) -> None:
    curve = path_of(pieces, start)
    contact = curved(curve, stiffness)
    state, bottom = contact.initial_state(), 0.0
    for place in path:
        result, state = contact.step(at_depths([place, place]), None, state)
        z, force, history = result.depth.item(), result.force.item(), history_of(state)
        assert 0.0 <= force <= virgin(curve, z) * (1.0 + 1e-9) + 1e-9
        assert z > history.bottom.item() or force == 0.0
        assert not (z == history.z_max.item() and force != history.force_max.item())
        assert history.bottom.item() <= history.z_max.item()
        # two lines of one slope round apart: the bottom is a difference of penetrations
        assert 0.0 <= bottom <= history.bottom.item() + 4.0 * EPSILON * history.z_max.item()
        bottom = history.bottom.item()


@given(pieces=segments, start=starts, stiffness=st.floats(1.0, 1e5), deepest=st.floats(0.01, 1.0))
def test_unloading_and_reloading_meet_the_virgin_path(
    pieces: list[tuple[float, int]], start: float, stiffness: float, deepest: float
) -> None:
    curve = path_of(pieces, start)
    contact = curved(curve, stiffness)
    state = travel(contact, [deepest])[1]
    history = history_of(state)
    at, force = history.z_max.item(), virgin(curve, deepest)
    near = [float(np.nextafter(at, 0.0)), at, float(np.nextafter(at, 2.0))]
    values = forces([travel(contact, [z], state)[0][0] for z in near])
    scale = max(force, 1.0)
    assert values == pytest.approx([force] * 3, abs=1e-6 * scale)
    assert values[1] == history.force_max.item()
    bottom = history.bottom.item()
    around = [travel(contact, [z], state)[0][0] for z in (bottom, float(np.nextafter(bottom, 2.0)))]
    assert around[0].force == 0.0
    assert around[1].force <= 1e-6 * scale
