"""What the ladder of extremes found: angles next to a wall, tiny limits, minus zeros, refusals without lines."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.contact.laws.friction import on_ellipse
from mudline.contact.seabed import PlanesSeabed, SlopingSeabed, heading
from mudline.diagnostics import DeckError
from mudline.results.evaluation import as_deck_errors
from tests.builders.scenes import scene_of

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


@pytest.mark.parametrize("slope", [5e-324, 1e-20, 45.0, 89.9999, -89.99999999999999])
def test_a_slope_and_a_plane_have_the_same_normal_up_to_the_wall(slope: float) -> None:
    plane = PlanesSeabed([(0.0, 0.0, 0.0)], [slope], [30.0]).same_normal
    assert plane is not None
    assert plane == pytest.approx(SlopingSeabed(slope, 30.0).same_normal, rel=1e-15, abs=1e-320)


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


def test_an_ellipse_of_an_infinite_limit_has_no_force() -> None:
    with np.errstate(all="ignore"):
        assert np.isnan(on_ellipse(1.0, 1.0, 1.0, np.inf)[:2]).all()


def test_reactions_have_no_zero_with_a_minus() -> None:
    scene = scene_of(PIPE + RUBS)
    points = np.array([[[-0.01, 0.0, 0.0], [-0.01, 2.0, 0.0]], [[-0.01, 0.001, 0.0], [-0.01, 2.001, 0.0]]])
    reaction = scene.contact().evaluate(points).reaction
    assert not np.signbit(reaction[reaction == 0.0]).any()
    assert (reaction[1, :, 2] == 0.0).all()  # u1 is exactly -Y


def test_a_lateral_spring_whose_half_a_node_can_bear_touches_down() -> None:
    scene = scene_of(PIPE + " LATERAL=1.5E308\n")
    assert scene.contact().evaluate().friction is not None


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
