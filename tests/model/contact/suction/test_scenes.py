"""Published numbers of suction through the whole evaluator: from positions and velocities to nodal forces."""

from __future__ import annotations

import numpy as np
import pytest

from mudline.model.contact import ContactModel, ElementError
from mudline.model.curves import ForceCurve
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    PULLING,
    bridge_law,
    chain,
    each_backend,
    heave,
    on,
    suction,
    walk,
)
from tests.model.contact.comparison import plain_loops
from tests.model.contact.single import BROKEN, COMPRESSION, DEPTH, FORCE, SUCTION

pytestmark = pytest.mark.slow

TABLE = [
    # D, c_u, v, F_max / L, Delta_B, dF/dv
    (0.3, 5000.0, 0.1, 1378.5656595, 0.16156501691, 2481.4181871),
    (0.3, 5000.0, 0.01, 910.80929887, 0.08878658058, 16394.56738),
    (0.3, 5000.0, 0.001, 601.76573615, 0.048791855079, 108317.83251),
    (0.3, 5000.0, 1.0, 2086.5435606, 0.294, 375.57784091),
    (0.1683, 3500.0, 0.1, 600.72408159, 0.090637974489, 1081.3033469),
    (0.1683, 3500.0, 0.01, 396.89446477, 0.049809271705, 7144.1003658),
    (0.5, 2000.0, 0.3, 1021.6102644, 0.35830065844, 612.96615862),
    (0.27305, 10000.0, 0.05, 2252.9482273, 0.12280059122, 8110.6136184),
    (0.3, 5000.0, 1e-6, 173.55113405, 0.0080974323878, 31239204.13),
    (0.3, 5000.0, 1e-5, 262.68027113, 0.014734904669, 4728244.8803),
    (0.3, 5000.0, 1e-4, 397.58267911, 0.026813118677, 715648.82239),
]


def pipe(diameter: float = 0.3, cohesion: float = 5000.0, regularisation: float = 1e-3) -> ContactModel:
    """An element of 2 m on a linear seabed."""
    law = bridge_law(1, cohesion, diameter, regularisation)
    return ContactModel(chain([LINEAR], suction(law), diameter=diameter))


@pytest.mark.parametrize(("diameter", "cohesion", "v", "force", "depth", "slope"), TABLE)
def test_largest_force_and_breakout(
    diameter: float, cohesion: float, v: float, force: float, depth: float, slope: float
) -> None:
    contact = pipe(diameter, cohesion, 1e-3 if v >= 1e-3 else 0.0)
    results = walk(contact, *heave([0.01, -0.5 * depth, -depth * (1.0 - 1e-9), -depth * (1.0 + 1e-9)], [0.0, v, v, v]))
    assert [result.state for result in results] == [COMPRESSION, SUCTION, SUCTION, BROKEN]
    assert results[1].force == pytest.approx([-force], rel=1e-10)
    assert results[1].normal_force == pytest.approx([-force, -force], rel=1e-10)
    assert results[2].force == pytest.approx([-5e-9 * force], rel=0.1)
    assert not results[3].force.any()
    positions, velocities = heave([0.01, -0.5 * depth], [0.0, v])
    _, state = contact.step(positions[0], velocities[0], contact.initial_state())
    damping = contact.tangent(positions[1], velocities[1], state).by_velocity.dense()
    assert damping[np.ix_([0, 3], [0, 3])] == pytest.approx(np.full((2, 2), -0.5 * slope), rel=1e-10)


TRAPEZOID = [
    # x / Delta_B, suction, its derivative by penetration
    (0.05, 344.64141487, 42662.876092),
    (0.1, 689.28282974, 42662.876092),
    (0.2, FORCE, None),
    (0.5, FORCE, 0.0),
    (0.8, FORCE, None),
    (0.9, 689.28282974, -42662.876092),
    (0.95, 344.64141487, -42662.876092),
]


@pytest.mark.parametrize(("share", "force", "stiffness"), TRAPEZOID)
def test_trapezoid(share: float, force: float, stiffness: float | None) -> None:
    result = walk(pipe(), *heave([0.01, -share * DEPTH], [0.0, 0.1]))[1]
    assert result.force == pytest.approx([-force], rel=1e-9)
    if stiffness is not None:
        assert result.stiffness == pytest.approx([stiffness], rel=1e-9)
        assert result.slope == pytest.approx([0.3 * stiffness], rel=1e-9)


def test_net_force_on_a_slow_pull_out() -> None:
    depths = [0.02, 0.01, 0.0, -0.01, -0.032313003383, -0.08, -0.14, -0.17]
    expected = [1000.0, 500.0, 0.0, -426.62876092, -FORCE, -FORCE, -920.02564453, 0.0]
    results = walk(pipe(), *heave(depths, [0.1] * 8))
    assert [result.force.item() for result in results] == pytest.approx(expected, rel=1e-9)


def test_work_to_breakout() -> None:
    corners = np.array([0.0, 0.2, 0.8, 1.0])
    shares = np.unique(np.concatenate([np.linspace(0.0, 1.0, 101), corners]))
    contact = ContactModel(chain([NONE], suction(bridge_law())))
    uplifts = shares * DEPTH
    results = walk(contact, *heave([0.01, *(0.0 - uplifts)], [0.0, *[0.1] * len(uplifts)]))
    pull = np.array([-result.reaction[:, 0].sum() for result in results[1:]]) / 2.0
    assert np.sum(0.5 * (pull[1:] + pull[:-1]) * np.diff(uplifts)) == pytest.approx(178.18238727, rel=1e-9)


@pytest.mark.parametrize(("v", "force"), [(5e-4, 424.24484398), (0.0, 0.0), (1e-300, 0.0)])
def test_cap_below_the_regularisation_velocity(v: float, force: float) -> None:
    result = walk(pipe(), *heave([0.01, -0.02], [0.0, v]))[1]
    assert result.force == pytest.approx([-force], rel=1e-10, abs=1e-9)


def test_results_say_where_the_force_is_less_than_the_power_gives() -> None:
    """Below v_r, in suction only, and not where the exponent is so large that there is no cap."""
    law = bridge_law(3, regularisation=[1e-3, 0.0, 1e-3])._replace(force_exponent=np.array([0.18, 0.18, 2.0]))
    contact = ContactModel(chain([LINEAR] * 3, suction(law)))
    results = walk(contact, *heave([0.01, -0.001, -0.002, -0.003, 0.01], [0.0, 5e-4, 1e-3, -5e-4, 5e-4], nodes=4))
    told = [None if result.regularised is None else result.regularised.tolist() for result in results]
    nowhere = [False, False, False]
    assert told == [nowhere, [True, False, False], nowhere, nowhere, nowhere]
    assert ContactModel(chain([LINEAR])).evaluate().regularised is None


# --------------------------------------------------------------------------------------------- beside other normal laws

MOVES = heave([0.02, -0.004, -0.004 - 0.1 * DEPTH, -0.004 - 0.5 * DEPTH], [0.0, 0.1, 0.1, 0.1])


def test_on_springs_of_nodes_the_uplift_begins_where_the_wider_zone_ends() -> None:
    """Half widths of 0.004 and 0.001 at the two nodes."""
    springs = on("nodal", 2, stiffness=5e4, half_width=[0.001, 0.004])
    results = walk(ContactModel(chain([NONE], springs, suction(bridge_law()))), *MOVES)
    assert [result.state for result in results] == [COMPRESSION, SUCTION, SUCTION, SUCTION]
    assert [result.force.item() for result in results] == pytest.approx(
        [0.0, 0.0, -FORCE / 2, -FORCE], rel=1e-9, abs=1e-9
    )
    assert results[0].contact.all()
    above = walk(ContactModel(chain([NONE], springs, suction(bridge_law()))), *heave([-0.003, -0.005], [0.0, 0.1]))
    assert [result.state for result in above] == [COMPRESSION, SUCTION]
    assert [bool(result.contact[0]) for result in above] == [True, False]


PULLS = ForceCurve([(0.0, 0.0), (0.1, 100.0), (0.2, -50.0)], name="pulls")


@each_backend
def test_a_curve_that_pulls_beside_suction_is_refused_where_it_does(backend: str) -> None:
    """It pulls from a ratio of 0.167 on, 0.05 m."""
    inputs = chain([CURVE] * 2, suction(bridge_law(1), [1]), curves=(PULLS,))
    contact = ContactModel(inputs, backend=backend)  # type: ignore[arg-type]  # from the parameters
    positions, velocities = heave([0.02, 0.04, 0.06, -0.08], [0.0, 0.0, 0.0, 0.1], nodes=3)
    with plain_loops():
        with pytest.raises(ElementError, match="element 12 at step 2: its curve pulls there, and suction acts") as info:
            contact.evaluate(positions, velocities=velocities)
        assert (info.value.element, info.value.step) == (12, 2)
        _, state = contact.step(positions[1], velocities[1], contact.initial_state())
        with pytest.raises(ElementError, match="element 12 at step 0: its curve pulls there"):
            contact.step(positions[2], velocities[2], state)


def test_a_curve_that_pulls_is_accepted_where_it_is_cut_or_its_element_has_no_suction() -> None:
    positions, velocities = heave([0.04, 0.06, -0.08], [0.0, 0.0, 0.1], nodes=3)
    laws = suction(bridge_law(1), [1])
    cut = ContactModel(chain([CURVE] * 2, laws, curves=(PULLS,), tension="cut"))
    assert cut.evaluate(positions, velocities=velocities).cut.tolist() == [[False] * 2, [True] * 2, [False] * 2]
    beside = ContactModel(chain([CURVE, LINEAR], laws, curves=(PULLS,)))
    assert beside.evaluate(positions, velocities=velocities).force[1, 0] < 0.0
    elsewhere = ContactModel(chain([CURVE, CURVE], laws, curves=(PULLS, PULLING), curve_index=[0, 1], diameter=1.0))
    with pytest.raises(ElementError, match="element 12 at step 0: its curve pulls there"):
        elsewhere.evaluate(positions, velocities=velocities)
