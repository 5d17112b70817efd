"""The largest and the smallest numbers, in scenes and decks: right or a named error, and never a warning of numpy."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from mudline.language.diagnostics import DeckError
from mudline.model.contact import ContactModel, ContactResult, ElementError, PositionError
from mudline.model.contact.laws.friction import on_ellipse
from mudline.model.contact.seabed import FlatSeabed, PlanesSeabed, Seabed, SlopingSeabed, heading
from mudline.model.contact.seabed.profile import ProfileSeabed
from mudline.model.results.evaluation import as_deck_errors
from tests.helpers.builders.contact import everything, journey
from tests.helpers.builders.scenes import scene_of
from tests.model.contact.exact import BOUND
from tests.model.contact.extreme_decks import FAMILIES, Verdict, judge

pytestmark = pytest.mark.slow

LEAST = 5e-324
sizes = st.sampled_from([0.0, LEAST, 1e-300, 1e-160, 1e-12, 1e-3, 1.0, 1e3, 1e12, 1e150, 1e160, 1e300, 1.7e308])
SEABEDS: list[Seabed] = [
    FlatSeabed(),
    SlopingSeabed(30.0, 45.0),
    PlanesSeabed(
        [[0.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [-20.0, 20.0], bounds=[[-1e9, 3.0, -1e9, 1e9], [3.0, 1e9, -1e9, 1e9]]
    ),
    ProfileSeabed([0.0, 5.0, 9.0], [0.0, -1.0, 1.0], "CUBIC SPLINE"),
]


def sound(result: ContactResult) -> bool:
    """Whether everything that exists is finite."""
    floats = (result.force, result.stiffness, result.normal_force, result.reaction, result.friction)
    return not np.isinf(result.gap).any() and all(part is None or bool(np.isfinite(part).all()) for part in floats)


@given(st.integers(1, 4), st.integers(0, 999), st.tuples(sizes, sizes, sizes), sizes, st.sampled_from(SEABEDS))
@example(2, 1, (1e300, 0.0, 0.0), 1e6, SEABEDS[0])
@example(2, 1, (0.0, 0.0, 0.0), 0.0, SEABEDS[1])
@example(3, 2, (LEAST, LEAST, LEAST), LEAST, SEABEDS[0])
def test_places_and_velocities_of_any_size(
    elements: int, seed: int, scale: tuple[float, float, float], speed: float, seabed: Seabed
) -> None:
    contact = ContactModel(everything(elements, seed, seabed))
    positions, velocities, _ = journey(elements, 4, seed)
    signs = np.sign(positions)
    signs[-1, :, 0] *= -1.0
    with np.errstate(over="ignore"):
        path, rates = np.clip(positions * scale, -1.7e308, 1.7e308), np.clip(velocities * speed, -1.7e308, 1.7e308)
    path = np.where(np.isfinite(path), path, signs)
    state, refused = contact.initial_state(), ""
    for place, rate in zip(path, rates, strict=True):
        try:
            result, after = contact.step(place, rate, state)
            tangent = contact.tangent(place, rate, state)
        except (ElementError, PositionError) as error:
            refused = str(error)
            break
        assert sound(result)
        assert len(tangent.by_position.values) == len(tangent.by_position.rows)
        state = after
    assert not refused or " at step 0: " in refused


PIPE = """\
$MODEL
*NODE
 1, -0.05, 0.0, 0.0
 2, -0.05, 2.0, 0.0
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.3, 0.15, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=50000.0
"""
RUBS = """\
*SEABED FRICTION
 SET=ALL
 COEFFICIENTS=0.4, 0.7
 STIFFNESS=40000.0, 20000.0
 DIRECTIONS=-180.0
"""


@pytest.mark.parametrize(
    ("degrees", "cosine", "sine"),
    [
        (89.9999999999, 1.7453603996790573e-12, 1.0),
        (179.9999999999, -1.0, 1.7451123734747545e-12),
        (-1e-300, 1.0, -1.7453292519943296e-302),
        (-450.0, 0.0, -1.0),
        (60.0, 0.5, 0.8660254037844386),
    ],
)
def test_angles_in_degrees_keep_all_digits(degrees: float, cosine: float, sine: float) -> None:
    found = heading(degrees)
    assert found == pytest.approx((cosine, sine), rel=4e-16, abs=0.0)
    assert not np.signbit(np.array(found)[np.array(found) == 0.0]).any()


@pytest.mark.parametrize(
    ("trial", "limit", "force"),
    [
        ((1e300, 0.0), (1e-300, 1e-300), (1e-300, 0.0)),
        ((100.0, 200.0), (1e3, 5e-321), (2.5e-321, 5e-321)),
        ((100.0, 0.0), (1e3, 5e-321), (100.0, 0.0)),
    ],
)
def test_an_ellipse_of_a_tiny_limit_is_no_silent_zero(
    trial: tuple[float, float], limit: tuple[float, float], force: tuple[float, float]
) -> None:
    with np.errstate(all="ignore"):
        *found, _ = on_ellipse(*trial, *limit)
    assert found == pytest.approx(force, rel=1e-15, abs=1e-323)


def test_reactions_have_no_zero_with_a_minus() -> None:
    scene = scene_of(PIPE + RUBS)
    points = np.array([[[-0.01, 0.0, 0.0], [-0.01, 2.0, 0.0]], [[-0.01, 0.001, 0.0], [-0.01, 2.001, 0.0]]])
    reaction = scene.contact().evaluate(points).reaction
    assert not np.signbit(reaction[reaction == 0.0]).any()
    assert (reaction[1, :, 2] == 0.0).all()  # u1 is exactly -Y


def test_what_is_refused_at_a_node_has_its_line() -> None:
    scene = scene_of(PIPE + RUBS)
    points = np.array([[-0.01, 0.0, 0.0], [np.inf, 2.0, 0.0]])
    with pytest.raises(DeckError, match="node 2 at step 0") as caught, as_deck_errors(scene):
        scene.contact().evaluate(points)
    assert caught.value.diagnostics[0].line == 4


def test_a_friction_spring_without_end_is_refused_at_its_node() -> None:
    what = "node 1: its friction coefficient divided by its mobilisation length"
    with pytest.raises(DeckError, match=what) as caught:
        scene_of(PIPE + " FRICTION=1E200, 0.7, 1E-200, 1.0\n").contact()
    assert caught.value.diagnostics[0].line == 3


@pytest.mark.covered
@pytest.mark.parametrize("family", FAMILIES)
def test_every_deck_is_right_within_its_bound_or_refused_with_a_line(family: str) -> None:
    values, deck = FAMILIES[family]
    found = [judge(family, value, deck(value)) for value in values]
    assert not [one for one in found if one.verdict is Verdict.WRONG]
    assert any(one.verdict is Verdict.RIGHT for one in found)
    assert 0.0 < max(one.error for one in found) <= BOUND


@pytest.mark.parametrize(
    ("family", "value", "message"),
    [
        ("linear stiffness", "1E309", "line 14: SYN002"),
        ("curve: forces", "1E309", "line 18: SYN002"),
        ("mobilisation length", "5E-324", "line 3: RUN001"),
    ],
)
def test_refusals_name_the_line_of_the_number(family: str, value: str, message: str) -> None:
    assert judge(family, value, FAMILIES[family][1](value)).message.startswith(message)
