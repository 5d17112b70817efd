"""What a scene needs, what is left out and why, and that what is left out is not even imported."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mudline.basics.short_repr import UnknownNameError
from mudline.model.contact import ContactModel, LawKind
from mudline.model.contact.laws import BUILT_IN, known_laws
from tests.helpers.builders.contact import (
    CURVE,
    LINEAR,
    NONE,
    RIGID,
    at_depths,
    chain,
    drawn,
    everything,
    friction,
    on,
    trench,
)
from tests.model.contact.random_scenes import LAWS

STAGES = "seabed surface,normal law,smoothing,unloading,suction,friction,lateral,trench,assembly"


def test_the_stages_stand_in_order() -> None:
    plan = ContactModel(chain([CURVE, LINEAR])).plan
    assert ",".join(stage.stage for stage in plan) == STAGES
    assert [stage.stage for stage in plan if stage.active] == ["seabed surface", "normal law", "assembly"]
    assert plan.history is False
    assert plan.steps == "all steps at once"
    assert replace(plan, history=True).steps == "one step after the other"


def test_a_rigid_seabed_is_a_constraint_without_a_reaction_here() -> None:
    contact = ContactModel(chain([RIGID, RIGID]))
    assert not contact.plan["normal law"].active
    assert not contact.plan["assembly"].active
    assert "2 elements on a rigid seabed: a constraint, listed as restrained nodes" in str(contact.plan)
    result = contact.evaluate(at_depths([0.1, 0.1, 0.1]))
    assert result.contact.all()
    assert not result.force.any()
    assert not result.reaction.any()


def test_the_kinds_of_law_of_the_elements() -> None:
    inputs = chain([CURVE, LINEAR, RIGID, NONE, NONE], on("nodal", [3, 4], stiffness=1.0))
    expected = [LawKind.CURVE, LawKind.LINEAR, LawKind.RIGID, LawKind.NODAL, LawKind.NONE]
    assert inputs.law.tolist() == expected
    assert inputs.curve_index.tolist() == [0, -1, -1, -1, -1]
    smooth = chain([NONE, CURVE], on("smoothed", [0], stiffness=1.0, half_width=0.1))
    assert smooth.law.tolist() == [LawKind.LINEAR, LawKind.CURVE]
    assert smooth.curve_index.tolist() == [-1, 0]


def test_a_stage_that_is_not_there() -> None:
    plan = ContactModel(chain([CURVE])).plan
    with pytest.raises(KeyError, match="waves") as caught:
        plan["waves"]
    assert isinstance(caught.value, UnknownNameError)
    first = "'seabed surface', 'normal law', 'smoothing', 'unloading', 'suction'"
    assert str(caught.value) == f"no stage 'waves': there are {first}, 'friction', 'lateral', 'trench', 'assembly'"


def test_the_plan_says_of_which_trenches_the_depth_counts() -> None:
    widths = {"bottom": 0.5, "upper": 1.7}
    laws = (
        on("trench peak", [0], peak=1.0, **widths),
        on("trench wall", [1, 2], depth=0.1, **widths),
        on("trench table", [3], table=0, **widths),
    )
    contact = ContactModel(chain([LINEAR] * 4, friction(5), *laws, tables=(np.zeros((1, 2)),)))
    assert contact.plan["trench"].active
    assert contact.plan["trench"].why == (
        "1 element with a peak resistance of the walls (inferred), where the depth has no effect (MODEL=WALL uses it); "
        "1 element with a tabulated resistance of the walls (inferred), where depth and widths have no effect; "
        "2 elements with sloped walls (inferred); the seabed is not lowered"
    )


OF_THEIR_OWN = {"hyperbolic", "breakout", "damping", "nodal damping", "trench level"}
"""Laws that what holds of everything does not hold of; random scenes have all but the first, of these tests alone."""


def test_everything_has_every_law() -> None:
    assert set(everything(60, seed=1).assigned) == set(known_laws()) - OF_THEIR_OWN


def test_random_scenes_draw_every_law() -> None:
    assert sorted(LAWS) == sorted(BUILT_IN)


def test_a_trench_without_friction_does_nothing_and_the_plan_says_so() -> None:
    contact = ContactModel(chain([LINEAR], trench(1, 0.1, 0.5, 600.0)))
    assert not contact.plan["trench"].active
    assert contact.plan["trench"].why == "a trench adds to the limits of friction, and no node has a friction law"
    assert not contact.evaluate(drawn([(0.0, 0.0), (0.0, 0.2)])).reaction[..., 1:].any()
