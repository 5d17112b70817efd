"""Breakout and residual across the line: worked numbers, an independent program, what holds on any path, tangents."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from mudline.model.contact import ContactInput, ContactModel, LawAssignment
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws.breakout import F114_DISPLACEMENTS, F114_RESIDUAL
from mudline.model.contact.plan import Backend
from tests.helpers.builders.contact import LINEAR, chain, drawn, each_backend, friction, on, trench
from tests.helpers.builders.scenes import legal_scene, reported
from tests.model.contact.test_damping import DECK

N = 1000.0
"""Normal force of each node at the depth of `drawn`."""
PEAK, AT, RESIDUAL, END = 1.2, 0.03, 0.6, 0.3
D = 0.3


def pipe(peak: float = PEAK, at: float = AT, residual: float = RESIDUAL, end: float = END) -> ContactInput:
    """An element of 2 m with K = 50000."""
    lateral = on("breakout", 2, peak_displacement=at, residual=residual / peak, residual_displacement=end)
    return chain([LINEAR], friction(2, (0.5, peak), (1e5, np.nan), mobilisation=at), lateral)


def published(peak: float) -> ContactInput:
    """As `LATERAL=F114` of a pipe of 0.3 m."""
    residual, growth = F114_RESIDUAL
    first, rise, last = F114_DISPLACEMENTS
    lateral = on(
        "breakout", 2, peak_displacement=first * D, peak_growth=rise * D, residual=residual / peak,
        residual_growth=growth / peak, residual_displacement=last * D,
    )  # fmt: skip
    law = friction(2, (0.5, peak), (1e5, np.nan), mobilisation=first * D)
    return chain([LINEAR], law, lateral, diameter=D)


def lateral(
    given_pipe: ContactInput, path: Sequence[float], depth: float = 0.02, backend: Backend = "numpy"
) -> FloatArray:
    """Lateral force over N of the first node, in the sense of the resistance, at places along u2."""
    result = ContactModel(given_pipe, backend=backend).evaluate(drawn([(0.0, x) for x in path], depth))
    assert result.friction is not None
    found: FloatArray = -result.friction[:, 0, 1] / result.normal_force[:, 0]
    return found


def program(
    path: Sequence[float], peak: float, at: float, residual: float, end: float, pieces: int = 200
) -> list[float]:
    """The force over N in small steps, from its rates: no anchor, no reversal is looked for."""
    x = far = force = 0.0
    found = []
    for target in path:
        start = x
        for piece in range(1, pieces + 1):
            new = start + (target - start) * piece / pieces
            force += peak / at * (new - x)
            x, far = new, max(far, abs(new))
            share = far / at * peak if far <= at else peak + (residual - peak) * min((far - at) / (end - at), 1.0)
            force = min(max(force, -share), share)
        found.append(force)
    return found


@each_backend
def test_peak_residual_and_unloading(backend: Backend) -> None:
    path = [0.0, 0.015, 0.03, 0.165, 0.3, 0.4, 0.39, 0.37, 0.355, 0.3, 0.45]
    expected = [0.0, 0.6, 1.2, 0.9, 0.6, 0.6, 0.2, -0.6, -0.6, -0.6, 0.6]
    assert_allclose(lateral(pipe(), path, backend=backend), expected, atol=1e-9)


@each_backend
def test_published_factors(backend: Backend) -> None:
    """F114 at z/D = 0.3: residual 0.62534231277, and breakout at 0.0285 m for D = 0.3 m (best estimate)."""
    path = [0.0, 0.01425, 0.0285, 0.45, 0.6]
    found = lateral(published(1.5), path, 0.09, backend)
    assert_allclose(found, [0.0, 0.75, 1.5, 0.62534231277, 0.62534231277], rtol=1e-9, atol=1e-12)
    # a breakout below the residual has no fall
    assert_allclose(lateral(published(0.5), path, 0.09, backend), [0.0, 0.25, 0.5, 0.5, 0.5], rtol=1e-9, atol=1e-12)


def test_breakout_is_had_once_until_contact_is_lost() -> None:
    places = [(0.0, x) for x in (0.0, 0.5, -0.5, 0.03, 0.0, 0.0, 0.03)]
    result = ContactModel(pipe()).evaluate(drawn(places, [0.02] * 4 + [-0.01, 0.02, 0.02]))
    assert result.friction is not None
    assert_allclose(-result.friction[:, 0, 1] / N, [0.0, 0.6, -0.6, 0.6, 0.0, 0.0, 1.2], atol=1e-9)


laws = st.tuples(st.floats(0.5, 2.0), st.floats(0.005, 0.05), st.floats(0.1, 0.5), st.floats(0.06, 0.5))
paths = st.lists(st.one_of(st.floats(-0.6, 0.6), st.floats(-0.05, 0.05)), min_size=1, max_size=8)


@given(laws, paths)
def test_against_an_independent_program(law: tuple[float, float, float, float], path: list[float]) -> None:
    found = lateral(pipe(*law), [0.0, *path])[1:]
    assert_allclose(found, program(path, *law), atol=1e-9 * law[0])


def finer(path: Sequence[float], parts: int) -> list[float]:
    places = [path[0]]
    for one, other in pairwise(path):
        places += [one + (other - one) * part / parts for part in range(1, parts)] + [other]
    return places


@given(laws, paths)
def test_the_path_alone_counts(law: tuple[float, float, float, float], path: list[float]) -> None:
    coarse, fine = lateral(pipe(*law), [0.0, *path]), lateral(pipe(*law), finer([0.0, *path], 10))
    assert_allclose(fine[::10], coarse, atol=1e-12 * law[0] / law[1])


@given(laws, paths)
def test_bounds_continuity_and_work(law: tuple[float, float, float, float], path: list[float]) -> None:
    places = np.array(finer([0.0, *path, 0.0], 100))
    force = lateral(pipe(*law), places.tolist())
    assert (np.abs(force) <= law[0] * (1.0 + 1e-12)).all()
    steepest = max(law[0] / law[1], (law[0] - law[2]) / (law[3] - law[1]))
    assert (np.abs(np.diff(force)) <= steepest * np.abs(np.diff(places)) * (1.0 + 1e-9) + 1e-12).all()
    # corners between two places cost the trapezoids less than the largest difference of slopes
    work = 0.5 * (force[1:] + force[:-1]) @ np.diff(places)
    assert work >= -len(path) * steepest * np.abs(np.diff(places)).max() ** 2 * 4.0


@pytest.mark.parametrize("where", ["rise", "fall", "residual", "unloading", "turned"])
def test_tangent(where: str) -> None:
    contact = ContactModel(pipe())
    before, place = {
        "rise": ([(0.0, 0.0)], (0.001, 0.01)),
        "fall": ([(0.0, 0.0), (0.002, 0.1)], (0.003, 0.12)),
        "residual": ([(0.0, 0.0), (0.002, 0.5)], (0.003, 0.6)),
        "unloading": ([(0.0, 0.0), (0.002, 0.5)], (0.003, 0.49)),
        "turned": ([(0.0, 0.0), (0.002, -0.1)], (0.003, -0.12)),
    }[where]
    state = contact.initial_state()
    for points in drawn(before):
        _, state = contact.step(points, None, state)
    points = drawn([place])[0]
    points[1, 2] += 0.002
    matrix = contact.tangent(points, None, state).by_position.dense()
    for column, at in enumerate(np.ndindex(points.shape)):
        moved = [points.copy(), points.copy()]
        moved[0][at] += 1e-7
        moved[1][at] -= 1e-7
        reactions = [contact.step(each, None, state)[0].reaction for each in moved]
        assert_allclose(matrix[:, column], (reactions[0] - reactions[1]).ravel() / 2e-7, rtol=1e-5, atol=2e-2)
    if where in {"fall", "turned"}:
        assert matrix[2, 2] == pytest.approx(N * (PEAK - RESIDUAL) / (END - AT), rel=0.1)  # it softens


def test_a_node_between_it_and_a_trench_has_the_breakout() -> None:
    lateral_law = on("breakout", [1], peak_displacement=AT, residual=RESIDUAL / PEAK, residual_displacement=END)
    sliding = friction(3, (0.5, PEAK), (1e5, np.nan), mobilisation=AT)
    inputs = chain([LINEAR] * 2, sliding, lateral_law, trench([1], 0.2, 2.0, 300.0))
    result = ContactModel(inputs).evaluate(drawn([(0.0, 0.0), (0.0, 0.55)], 0.02, 3))
    assert result.friction is not None
    expected = [PEAK * N, RESIDUAL * 2.0 * N, PEAK * N + 300.0]
    assert_allclose(-result.friction[1, :, 1], expected, rtol=1e-12)


@pytest.mark.parametrize("beside", [(friction(2, (0.5, 1.0), ellipse=True),), ()])
def test_what_it_does_not_go_with(beside: tuple[LawAssignment, ...]) -> None:
    law = on("breakout", 2, peak_displacement=0.01, residual=0.5, residual_displacement=0.1)
    with pytest.raises(ValueError, match="friction in a box"):
        ContactModel(chain([LINEAR], *beside, law))


BLOCK = """\
*SEABED FRICTION
 SET=ALL
 COEFFICIENTS=0.3, 0.6
 STIFFNESS=20000.0, 40000.0
 LATERAL={}
"""


@pytest.mark.parametrize(
    ("lines", "coefficient", "numbers"),
    [
        ("PEAK-RESIDUAL\n PEAK=1.2, 0.03\n RESIDUAL=0.6, 0.3", 1.2, (0.03, 0.0, 0.5, 0.0, 0.3)),
        ("F114\n PEAK=0.8", 0.8, (0.006, 0.075, 0.4, 1.0, 0.45)),
    ],
)
def test_in_a_deck(lines: str, coefficient: float, numbers: tuple[float, ...]) -> None:
    assigned = (
        legal_scene(DECK.replace("*SEABED CONTACT\n SET=ALL\n", BLOCK.format(lines))).contact_input("keep").assigned
    )
    assert np.ravel(assigned["breakout"].columns).reshape(5, -1)[:, 2] == pytest.approx(numbers, rel=1e-12)
    sliding = assigned["friction"]
    assert sliding["lateral_coefficient"] == pytest.approx([coefficient] * 5)
    assert sliding["lateral_mobilisation"] == pytest.approx([numbers[0]] * 5)
    assert sliding["axial_stiffness"] == pytest.approx([20000.0] * 5)


@pytest.mark.parametrize(
    ("lines", "places"),
    [
        ("PEAK-RESIDUAL\n PEAK=1.2, 0.03", [(23, 10)]),
        ("PEAK-RESIDUAL\n PEAK=1.2\n RESIDUAL=0.6, 0.3", [(23, 10)]),
        ("PEAK-RESIDUAL\n PEAK=1.2, 0.03\n RESIDUAL=1.3, 0.3", [(25, 2)]),
        ("F114", [(23, 10)]),
        ("F114\n PEAK=0.8\n RESIDUAL=0.6, 0.3", [(25, 2)]),
        ("F114\n PEAK=0.8, 0.03", [(24, 2)]),
        ("COULOMB\n PEAK=0.8, 0.03", [(24, 2)]),
        ("F114\n PEAK=0.8\n CRITERION=ELLIPSE", [(25, 12)]),
        ("F114\n PEAK=0.8\n*SEABED TRENCH\n SET=ALL\n GEOMETRY=0.5, 1.0, 3.0\n PEAK=2000.0", [(23, 10)]),
    ],
)
def test_what_a_deck_may_not_say(lines: str, places: list[tuple[int, int]]) -> None:
    found = reported(DECK.replace("*SEABED CONTACT\n SET=ALL\n", BLOCK.format(lines)))
    assert [(line, column) for _, code, line, column in found if code == "EXT013"] == places
