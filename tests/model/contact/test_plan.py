"""What a scene needs, what is left out and why, and that what is left out is not even imported."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from mudline.basics.short_repr import UnknownNameError
from mudline.model.contact import ContactModel, LawKind
from mudline.model.contact.laws import known_laws
from tests.helpers.builders.contact import (
    CLAY,
    CURVE,
    LINEAR,
    NONE,
    RIGID,
    SAND,
    at_depths,
    bridge_law,
    chain,
    drawn,
    everything,
    friction,
    on,
    suction,
    trench,
)

STAGES = ["floor", "normal law", "smoothing", "unloading", "suction", "friction", "lateral", "trench", "assembly"]


def test_the_stages_stand_in_order() -> None:
    plan = ContactModel(chain([CURVE, LINEAR])).plan
    assert [stage.stage for stage in plan] == STAGES
    assert [stage.stage for stage in plan if stage.active] == ["floor", "normal law", "assembly"]
    assert plan.history is False
    assert plan.steps == "all steps at once"
    assert replace(plan, history=True).steps == "one step after the other"


@pytest.mark.parametrize(
    ("laws", "why"),
    [
        ([CURVE], "1 element on 1 force-embedment curve"),
        (
            [CURVE, CURVE, LINEAR],
            "2 elements on 1 force-embedment curve; 1 element with a linear stiffness, at the mean depth (inferred)",
        ),
        (
            [LINEAR, NONE, NONE],
            "1 element with a linear stiffness, at the mean depth (inferred); 2 elements without a law",
        ),
        ([NONE], "no element has a curve or a linear stiffness; 1 element without a law"),
    ],
)
def test_the_normal_law_says_what_it_holds(laws: Sequence[str], why: str) -> None:
    stage = ContactModel(chain(laws)).plan["normal law"]
    assert stage.why == why
    assert stage.active == (laws != [NONE])


def test_a_rigid_seabed_is_a_constraint_without_a_reaction_here() -> None:
    contact = ContactModel(chain([RIGID, RIGID]))
    assert not contact.plan["normal law"].active
    assert not contact.plan["assembly"].active
    assert "2 elements on a rigid seabed: a constraint, listed as restrained nodes" in str(contact.plan)
    result = contact.evaluate(at_depths([0.1, 0.1, 0.1]))
    assert result.contact.all()
    assert not result.force.any()
    assert not result.reaction.any()


def test_nodes_of_a_rigid_seabed_are_restrained_at_it_and_below() -> None:
    result = ContactModel(chain([RIGID, LINEAR])).evaluate(at_depths([[0.1, 0.0, 0.1], [0.1, -0.1, 0.1]]))
    assert result.rigid is not None
    assert result.restrained is not None
    assert result.rigid.tolist() == [True, True, False]
    assert result.restrained.tolist() == [[True, True, False], [True, False, False]]
    assert ContactModel(chain([LINEAR])).evaluate().restrained is None


def test_two_curves_and_a_cut() -> None:
    inputs = chain([CURVE, CURVE], curves=(CLAY, SAND), curve_index=[0, 1], tension="cut")
    assert ContactModel(inputs).plan["normal law"].why == (
        "2 elements on 2 force-embedment curves, pulling forces cut to 0"
    )


def test_the_kinds_of_law_of_the_elements() -> None:
    inputs = chain([CURVE, LINEAR, RIGID, NONE, NONE], on("nodal", [3, 4], stiffness=1.0))
    expected = [LawKind.CURVE, LawKind.LINEAR, LawKind.RIGID, LawKind.NODAL, LawKind.NONE]
    assert inputs.law.tolist() == expected
    assert inputs.curve_index.tolist() == [0, -1, -1, -1, -1]
    smooth = chain([NONE, CURVE], on("smoothed", [0], stiffness=1.0, half_width=0.1))
    assert smooth.law.tolist() == [LawKind.LINEAR, LawKind.CURVE]
    assert smooth.curve_index.tolist() == [-1, 0]


def test_the_scene_may_say_why_something_is_left_out() -> None:
    reasons = {"friction": "FRICTION= is not evaluated by this version", "floor": "SLOPE= is not"}
    plan = ContactModel(replace(chain([CURVE]), left_out=reasons)).plan
    assert plan["friction"].why == "FRICTION= is not evaluated by this version"
    assert not plan["friction"].active
    assert plan["floor"].why == "one flat seabed at X = 0; SLOPE= is not"


def test_a_stage_that_is_not_there() -> None:
    plan = ContactModel(chain([CURVE])).plan
    with pytest.raises(KeyError, match="waves") as caught:
        plan["waves"]
    assert isinstance(caught.value, UnknownNameError)
    first = "'floor', 'normal law', 'smoothing', 'unloading', 'suction'"
    assert str(caught.value) == f"no stage 'waves': there are {first}, 'friction', 'lateral', 'trench', 'assembly'"


def test_the_plan_as_text() -> None:
    lines = str(ContactModel(chain([LINEAR])).plan).splitlines()
    assert lines[0] == "floor      yes one flat seabed at X = 0"
    assert lines[4] == "suction    no  no element has a suction law"
    assert lines[-1] == "history    no  all steps at once"


def test_the_plan_says_below_which_velocity_suction_is_capped() -> None:
    one = ContactModel(chain([LINEAR], suction(bridge_law()))).plan["suction"].why
    assert one == "1 element after Bridge et al., with a state each, less force than alpha v^n below v = 0.001"
    two = ContactModel(chain([LINEAR] * 2, suction(bridge_law(2, regularisation=[0.0, 0.02])))).plan["suction"].why
    assert two.endswith("less force than alpha v^n below v = 0 to 0.02")
    assert "below v" not in ContactModel(chain([LINEAR], suction(bridge_law(regularisation=0.0)))).plan["suction"].why


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


def test_the_plan_of_a_scene_with_everything() -> None:
    plan = ContactModel(everything(9, seed=4)).plan
    assert plan.history
    assert [stage.stage for stage in plan if not stage.active] == []
    why = {stage.stage: stage.why for stage in plan}
    assert "nodes with a stiffness of their own" in why["normal law"]
    assert why["unloading"].endswith("on unloading lines, from the deepest point so far")
    assert "after Bridge et al., with a state each, " in why["suction"]
    assert why["suction"].endswith("with a spring up to an extent, without history (inferred)")
    assert "nodes with a constant spring, " in why["friction"]
    assert why["lateral"].endswith("with a spring to where it touched down (inferred), in place of friction")
    assert why["trench"].endswith("the seabed is not lowered")


OF_THEIR_OWN = {"hyperbolic", "breakout", "damping", "nodal damping", "trench level"}
"""Laws that what holds of everything does not hold of; random scenes have all but the first, of these tests alone."""


def test_everything_has_every_law() -> None:
    assert set(everything(60, seed=1).assigned) == set(known_laws()) - OF_THEIR_OWN


def test_a_trench_without_friction_does_nothing_and_the_plan_says_so() -> None:
    contact = ContactModel(chain([LINEAR], trench(1, 0.1, 0.5, 600.0)))
    assert not contact.plan["trench"].active
    assert contact.plan["trench"].why == "a trench adds to the limits of friction, and no node has a friction law"
    assert not contact.evaluate(drawn([(0.0, 0.0), (0.0, 0.2)])).reaction[..., 1:].any()


# -------------------------------------------------------------------------------------------- modules that are imported
