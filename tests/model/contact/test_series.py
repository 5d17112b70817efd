"""Time series, number types, and positions for some of the nodes."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mudline.model.contact import ContactModel, ContactResult, ContactState
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import CURVE, LINEAR, at_depths, chain, everything, friction, journey, mixed
from tests.model.contact.comparison import same_bits


def series(steps: int, nodes: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    rng = np.random.default_rng(steps)
    positions = rng.normal(size=(steps, nodes, 3))
    positions[..., 0] *= 0.05
    return positions


def test_shapes() -> None:
    contact = ContactModel(chain([CURVE, LINEAR]))
    one, many, none = contact.evaluate(series(1, 3)[0]), contact.evaluate(series(5, 3)), contact.evaluate(series(0, 3))
    for result, steps in ((one, ()), (many, (5,)), (none, (0,))):
        for name in ("depth", "ratio", "contact", "force", "slope", "stiffness", "cut"):
            assert getattr(result, name).shape == (*steps, 2)
        assert result.gap.shape == result.normal_force.shape == (*steps, 3)
        assert result.normal.shape == result.reaction.shape == (*steps, 3, 3)


def test_number_types_and_layouts(tmp_path: Path) -> None:
    contact = ContactModel(mixed(13, seed=3))
    single = series(40, 14).astype(np.float32)
    expected = contact.evaluate(single.astype(np.float64))
    np.save(tmp_path / "positions.npy", single)
    mapped = np.load(tmp_path / "positions.npy", mmap_mode="r")
    for same in (single, mapped, single.astype(">f4"), np.asfortranarray(single), single.astype(np.longdouble)):
        assert same_bits(contact.evaluate(same), expected)
    assert same_bits(contact.evaluate(single[::2]), contact.evaluate(single[::2].copy()))
    whole = np.rint(single[0] * 10.0).astype(np.int64)
    assert same_bits(contact.evaluate(whole), contact.evaluate(whole.tolist()))


def test_elements_without_all_their_nodes_are_left_out() -> None:
    contact = ContactModel(mixed(6, seed=4))
    positions = series(9, 7)
    complete = contact.evaluate(positions)
    present = np.array([True, True, True, False, True, True, True])
    positions[:, 3] = np.nan
    partial = contact.evaluate(positions, present=present)
    assert partial.evaluated.tolist() == [True, True, False, False, True, True]
    assert partial.present.tolist() == present.tolist()
    for name in ("depth", "ratio", "force", "slope", "stiffness"):
        assert np.array_equal(
            getattr(partial, name)[:, partial.evaluated], getattr(complete, name)[:, partial.evaluated]
        )
        assert np.isnan(getattr(partial, name)[:, ~partial.evaluated]).all()
    assert not partial.contact[:, ~partial.evaluated].any()
    for name in ("gap", "reaction", "normal_force"):
        assert np.isnan(getattr(partial, name)[:, 3]).all()
        assert np.array_equal(getattr(partial, name)[:, [0, 1, 5, 6]], getattr(complete, name)[:, [0, 1, 5, 6]])
    # A neighbour of the absent node has the reaction of the element that is left.
    half = 0.5 * contact.input.length[1] * partial.force[:, 1]
    assert half.any()
    assert partial.normal_force[:, 2] == pytest.approx(half, rel=1e-15)


SLACK = 2**16
NODES = 10_001


def peak(model: ContactModel, node_steps: int, *, clock: bool) -> int:
    """Largest memory while the results of a line that lies still are looked at one part after the other."""
    points = model.input.coordinates
    steps = node_steps // len(points)
    series = np.broadcast_to(points, (steps, *points.shape))
    times = np.arange(float(steps)) if clock else None
    tracemalloc.start()
    try:
        seen = sum(len(part.result.depth) for part in model.stream(series, times=times))
        assert seen == steps
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_ten_million_node_steps_need_no_more_than_one_million() -> None:
    model = ContactModel(mixed(NODES - 1, 3), backend="numpy")
    peak(model, 10**5, clock=False)  # tables are made, work arrays lent
    assert peak(model, 10**7, clock=False) < peak(model, 10**6, clock=False) + SLACK


def test_a_scene_with_history_keeps_the_last_state_only() -> None:
    model = ContactModel(everything(4000, 3), backend="numpy")  # a few steps at a time
    peak(model, 10**4, clock=True)
    assert peak(model, 4 * 10**5, clock=True) < peak(model, 10**5, clock=True) + SLACK


# ------------------------------------------------------------------------------------- arrays of an earlier step, again


@pytest.mark.parametrize("backend", ["numpy", "fast"])
def test_steps_into_arrays_of_earlier_steps_give_the_same_bits(backend: Backend) -> None:
    contact = ContactModel(replace(everything(40, 2), tension="cut"), backend=backend)
    positions, velocities, _ = journey(40, 12, 3)
    expected = contact.evaluate(positions, velocities=velocities)
    state = contact.initial_state()
    pairs: list[tuple[ContactResult, ContactState]] = []
    for step, (place, rate) in enumerate(zip(positions, velocities, strict=True)):
        out = pairs[step % 2] if step > 1 else None
        found = contact.step(place, rate, state, out=out)
        assert out is None or (found[0] is out[0] and found[1] is out[1])
        assert same_bits(found[0], expected.step(step))
        pairs, state = [*pairs, found], found[1]


def test_what_cannot_be_written_again_is_refused() -> None:
    contact, place = ContactModel(chain([CURVE], friction(2))), at_depths([0.1, 0.1])
    start = contact.initial_state()
    one, other = (contact.step(place, None, start) for _ in range(2))
    foreign = ContactModel(contact.input).step(place, None, start)
    for out in (foreign, (one[0], other[1]), (one[0],), (contact.evaluate(place), one[1])):
        with pytest.raises(ValueError, match="out must be the result and the state that a step of this model returned"):
            contact.step(place, None, start, out=out)  # type: ignore[arg-type]  # on purpose
    with pytest.raises(ValueError, match="out holds the state that the step begins with"):
        contact.step(place, None, one[1], out=one)
    with pytest.raises(TypeError, match="out must be"):
        contact.step(place, None, start, out=[*one])  # type: ignore[arg-type]  # on purpose
