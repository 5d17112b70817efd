"""The largest stiffness and damping of each law, which a time step has to resolve: by hand, and at positions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.model.contact import ContactInput, ContactModel
from mudline.model.contact.arrays import FloatArray
from mudline.model.contact.laws import BUILT_IN, PathLaw, is_normal
from mudline.model.contact.stiffest import rounded_down
from mudline.model.contact.tables import LawTables, steepest_anywhere
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    at_depths,
    bridge_law,
    chain,
    everything,
    floats,
    friction,
    heave,
    law_of,
    on,
    suction,
)
from tests.model.contact.single import breakout, largest

NAN = np.nan


def figures(inputs: ContactInput, law: str) -> tuple[FloatArray, FloatArray, str]:
    """Stiffness, damping and what they are for."""
    found = law_of(ContactModel(inputs).stiffest(), law)
    return found.stiffness, found.damping, found.per


@pytest.mark.parametrize("name", [name for name in BUILT_IN if is_normal(name)])
def test_no_stiffness_of_a_law_exceeds_its_steepest_one_which_it_reaches(name: str) -> None:
    """At penetrations from the onset to one diameter, in `everything`; only on a path is a reversal still stiffer."""
    tables = LawTables(everything(60, seed=1))
    found = [rows for rows in (*tables.normal, *tables.nodal) if rows.law.name == name]
    assert found
    for rows in found:
        diameter = tables.diameter[rows.rows] if rows.law.acts_on == "elements" else np.zeros(len(rows.rows))
        onset = np.zeros(len(rows.rows)) if rows.curve else np.asarray(rows.law.onset(*rows.columns))
        z = onset + np.linspace(1e-6, 0.3, 3000)[:, None]
        values = np.empty((3, *z.shape))
        rows.write_reaction(z, diameter, values)
        so_far, steepest = np.maximum.accumulate(values[2]), np.broadcast_to(rows.steepest(z, diameter), z.shape)
        assert (so_far <= steepest * (1.0 + 1e-12)).all()
        assert (steepest <= steepest_anywhere(tables, rows) * (1.0 + 1e-12)).all()
        if not isinstance(rows.law, PathLaw):
            np.testing.assert_allclose(so_far[-1], steepest[-1], rtol=1e-3)


def test_normal_laws() -> None:
    """Of curves the steepest segment below the mudline over the diameter: 2000 / 0.1 = 20 kN/m per unit of ratio."""
    zone = on("smoothed", [2], stiffness=3e4, half_width=0.01)
    inputs = chain([CURVE, LINEAR, NONE, NONE], zone, diameter=[0.5, 0.3, 0.3, 0.3])
    for law, expected in (
        ("curve", [40000.0, NAN, NAN, NAN]),
        ("linear", [NAN, 50000.0, NAN, NAN]),
        ("smoothed", [NAN, NAN, 30000.0, NAN]),
    ):
        stiffness, damping, per = figures(inputs, law)
        np.testing.assert_array_equal(stiffness, expected)
        np.testing.assert_array_equal(damping, np.where(np.isnan(expected), NAN, 0.0))
        assert per == "length"
    with pytest.raises(KeyError, match="no law 'suction': there are 'linear', 'smoothed', 'curve'"):
        ContactModel(inputs).stiffest()["suction"]


def test_springs_of_nodes_are_those_of_the_stiffer_node_of_each_element() -> None:
    stiffness, damping, per = figures(chain([NONE] * 4, on("nodal", [0, 1, 4], stiffness=[1.0, 5.0, 3.0])), "nodal")
    np.testing.assert_array_equal(stiffness, [5.0, 5.0, NAN, 3.0])
    np.testing.assert_array_equal(damping, [0.0, 0.0, NAN, 0.0])
    assert per == "node"


def test_unloading_lines_are_as_stiff_as_the_steepest_slope_of_their_path_at_least() -> None:
    inputs = chain([CURVE, LINEAR, LINEAR, NONE], on("unloading", [0, 1, 3], stiffness=[1e5, 100.0, 100.0]))
    np.testing.assert_allclose(figures(inputs, "unloading")[0], [1e5, 5e4, NAN, 100.0])
    steep = chain([CURVE], on("unloading", 1, stiffness=100.0))
    assert figures(steep, "unloading")[0] == pytest.approx([20000.0 / 0.3])


def test_friction_with_a_constant_spring() -> None:
    """The stiffer of both directions, and of the two nodes of an element."""
    springs = friction([0], stiffness=(1e5, 2e4)), friction([1], stiffness=(3e3, 4e4))
    stiffness, damping, per = figures(chain([LINEAR] * 3, *springs), "friction")
    np.testing.assert_array_equal(stiffness, [1e5, 4e4, NAN])
    np.testing.assert_array_equal(damping, [0.0, 0.0, NAN])
    assert per == "node"


def test_friction_with_a_mobilisation_length_has_the_spring_of_the_static_weight() -> None:
    """600 N/m on elements of 2 and 4 m: nodes carry 600, 1800 and 1200 N; mu N / length with 0.8 and 0.02 m."""
    inputs = chain([LINEAR] * 2, friction(3, (0.5, 0.8), NAN, mobilisation=0.02), length=[2.0, 4.0])
    heavy = replace(inputs, weight=np.full(2, 600.0))
    assert figures(heavy, "friction")[0] == pytest.approx([0.8 * 1800.0 / 0.02] * 2)
    ends = chain([LINEAR] * 2, friction([0, 2], (0.5, 0.8), NAN, mobilisation=0.02), length=[2.0, 4.0])
    found = figures(replace(ends, weight=np.full(2, 600.0)), "friction")[0]
    assert found == pytest.approx([0.8 * 600.0 / 0.02, 0.8 * 1200.0 / 0.02])


@pytest.mark.parametrize("weight", [None, [NAN, 600.0, 600.0], [-5.0, 600.0, 600.0], [0.0, 600.0, 600.0]])
def test_where_the_static_weight_is_not_known_or_not_downwards_the_spring_is_not_known(
    weight: list[float] | None,
) -> None:
    inputs = chain([LINEAR] * 3, friction(4, (0.5, 0.8), NAN, mobilisation=0.02))
    stiffness = figures(replace(inputs, weight=None if weight is None else np.array(weight)), "friction")[0]
    expected = [NAN] * 3 if weight is None else [NAN, 48000.0, 48000.0]
    np.testing.assert_allclose(stiffness, expected)
    constant = chain([LINEAR] * 3, friction(4, stiffness=1e5))
    np.testing.assert_array_equal(figures(constant, "friction")[0], [1e5] * 3)


def test_suction_is_stiffest_at_the_velocity_of_its_cap_and_dampest_at_rest() -> None:
    """With Bridge's exponents: F_max / (0.2 Delta_B) at 1 mm/s, and (2 - 0.18) F_max / v_r at rest."""
    stiffness, damping, per = figures(chain([LINEAR, NONE], suction(bridge_law())), "suction")
    np.testing.assert_allclose(stiffness, [601.76573615 / (0.2 * 0.048791855079), NAN], rtol=1e-10)
    np.testing.assert_allclose(damping, [1.82 * 601.76573615 / 1e-3, NAN], rtol=1e-10)
    assert per == "length"


SUCTIONS: dict[str, tuple[dict[str, float], float, float]] = {
    "no cap": ({"regularisation": 0.0}, np.inf, np.inf),
    "the force grows faster than the depth": ({"force_exponent": 0.3}, np.inf, 1.7 * 1000.0 * 1e-3**0.3 / 1e-3),
    "an exponent above 1": ({"force_exponent": 1.2, "depth_exponent": 1.5}, 1e3 * 1e-3**1.2 / 0.1 / 1e-3**1.5, np.inf),
    "an exponent of 1": ({"force_exponent": 1.0, "depth_exponent": 1.0}, 1000.0 / 0.1, 1000.0),
    "an exponent of 1, no cap": (
        {"force_exponent": 1.0, "depth_exponent": 1.5, "regularisation": 0.0}, np.inf, 1000.0,
    ),
    "a force that does not grow": (
        {"force_exponent": 0.0, "depth_exponent": 0.0}, 1000.0 / 0.1, 2.0 * 1000.0 / 1e-3,
    ),
    "no strength": ({"force_factor": 0.0, "regularisation": 0.0}, 0.0, 0.0),
}  # fmt: skip
"""alpha_f 1000, alpha_D 0.5, corner 0.2, v_r 1 mm/s, exponents 0.18 and 0.26 but for what is said here."""


@pytest.mark.parametrize("name", SUCTIONS)
def test_suction_of_other_exponents(name: str) -> None:
    changes, stiffness, damping = SUCTIONS[name]
    law = bridge_law()._replace(force_factor=floats(1000.0), depth_factor=floats(0.5))
    law = law._replace(**{key: floats(value) for key, value in changes.items()})
    found = figures(chain([LINEAR], suction(law)), "suction")
    assert found[0].item() == pytest.approx(stiffness, rel=1e-12)
    assert found[1].item() == pytest.approx(damping, rel=1e-12)


@given(
    st.floats(0.0, 1.0), st.floats(0.0, 1.5), st.floats(1e-4, 0.5),
    st.lists(st.floats(1e-8, 1e3), min_size=1, max_size=9),
)  # fmt: skip
def test_no_velocity_makes_suction_stiffer_or_damper(n: float, m: float, slow: float, speeds: list[float]) -> None:
    law = bridge_law(regularisation=slow)._replace(force_exponent=floats(n), depth_exponent=floats(m))
    stiffness, damping, _ = figures(chain([LINEAR], suction(law)), "suction")
    for v in speeds:
        force, by_velocity = largest(law, floats(v))
        assert (force / (0.2 * breakout(law, floats(v)))).item() <= stiffness.item() * (1.0 + 1e-12)
        assert by_velocity.item() <= damping.item() * (1.0 + 1e-12)


# --------------------------------------------------------------------------------------------------------- at positions


def test_normal_laws_at_positions() -> None:
    """The largest over all steps; 0 for an element that is nowhere in contact."""
    zone = on("smoothed", [2], stiffness=3e4, half_width=0.01)
    contact = ContactModel(chain([CURVE, LINEAR, NONE], zone))
    steps = at_depths([[-0.02] * 4, [0.2, 0.2, -0.2, 0.2], [0.05, 0.05, -0.1, 0.1]])
    found = contact.stiffest(steps)
    # ratios of 0.67 and 0.17; then 0, where the zone is at its middle
    np.testing.assert_allclose(law_of(found, "curve").stiffness, [12500.0 / 0.3, NAN, NAN])
    np.testing.assert_array_equal(law_of(found, "linear").stiffness, [NAN, 0.0, NAN])
    np.testing.assert_allclose(law_of(found, "smoothed").stiffness, [NAN, NAN, 15000.0])
    one = contact.stiffest(steps[1])
    np.testing.assert_allclose(law_of(one, "curve").stiffness, [7500.0 / 0.3, NAN, NAN])


def test_suction_at_positions_and_velocities() -> None:
    """At 0.1 m/s, of both velocities the faster one: F_max / (0.2 Delta_B), and dF/dv at the slower one."""
    contact = ContactModel(chain([LINEAR], suction(bridge_law())))
    found = law_of(contact.stiffest(*heave([0.02, -0.05, -0.06], [-0.1, 0.1, 0.01])), "suction")
    assert found.stiffness == pytest.approx([910.80929887 / (0.2 * 0.08878658058)], rel=1e-10)
    assert found.damping == pytest.approx([1.82 * 601.76573615 / 1e-3])  # at rest, as it moved down
    moving = law_of(contact.stiffest(*heave([0.02, -0.05, -0.06], [0.1, 0.1, 0.01])), "suction")
    assert moving.damping == pytest.approx([16394.56738], rel=1e-9)


def test_the_stiffest_of_all_laws_per_length() -> None:
    """Springs of nodes count over the length that is asked for."""
    inputs = chain([LINEAR, NONE, NONE], on("nodal", [1, 2], stiffness=[1e5, 4e5]), on("lateral", [0], stiffness=1e6))
    found = ContactModel(inputs).stiffest()
    np.testing.assert_array_equal(found.per_length(np.full(3, 2.0)), [1e6, 2e5, 2e5])
    assert np.isnan(ContactModel(chain([NONE])).stiffest().per_length(np.ones(1))).all()


def test_steps_have_three_digits_that_are_not_above_them() -> None:
    assert [rounded_down(step) for step in (0.0042481, 0.021356, 1.0, 9.999, 1e-300)] == [
        *(0.00424, 0.0213, 1.0, 9.99, 1e-300)
    ]
