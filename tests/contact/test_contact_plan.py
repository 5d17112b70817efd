"""What a scene needs, what is left out and why, and that what is left out is not even imported."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace

import pytest

from mudline.contact import ContactModel, LawKind
from mudline.contact.extras import Extras
from tests.contact.chains import CLAY, CURVE, LINEAR, NONE, RIGID, SAND, at_depths, chain
from tests.contact.joined import drawn, model, trench
from tests.contact.scenes import everything

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
        ([CURVE, CURVE, LINEAR], "2 elements on 1 force-embedment curve; 1 element with a linear stiffness"),
        ([LINEAR, NONE, NONE], "1 element with a linear stiffness; 2 elements without a law"),
        ([NONE], "no element has a curve or a linear stiffness; 1 element without a law"),
    ],
)
def test_the_normal_law_says_what_it_holds(laws: Sequence[LawKind], why: str) -> None:
    stage = ContactModel(chain(laws)).plan["normal law"]
    assert stage.why == why
    assert stage.active == (laws != [NONE])


def test_a_rigid_bed_is_a_constraint_without_a_reaction_here() -> None:
    contact = ContactModel(chain([RIGID, RIGID]))
    assert not contact.plan["normal law"].active
    assert not contact.plan["assembly"].active
    assert "2 elements on a rigid bed: a constraint, told as restrained nodes" in str(contact.plan)
    result = contact.evaluate(at_depths([0.1, 0.1, 0.1]))
    assert result.contact.all()
    assert not result.force.any()
    assert not result.reaction.any()


def test_two_curves_and_a_cut() -> None:
    inputs = chain([CURVE, CURVE], curves=(CLAY, SAND), curve_index=[0, 1], tension="cut")
    assert ContactModel(inputs).plan["normal law"].why == (
        "2 elements on 2 force-embedment curves, pulling forces cut to 0"
    )


def test_the_scene_may_say_why_something_is_left_out() -> None:
    reasons = {"friction": "FRICTION= is not evaluated by this version", "floor": "SLOPE= is not"}
    plan = ContactModel(replace(chain([CURVE]), left_out=reasons)).plan
    assert plan["friction"].why == "FRICTION= is not evaluated by this version"
    assert not plan["friction"].active
    assert plan["floor"].why == "one flat bed at X = 0; SLOPE= is not"
    with pytest.raises(KeyError, match="waves"):
        plan["waves"]


def test_the_plan_as_text() -> None:
    lines = str(ContactModel(chain([LINEAR])).plan).splitlines()
    assert lines[0] == "floor      yes one flat bed at X = 0"
    assert lines[4] == "suction    no  no element has a suction law"
    assert lines[-1] == "history    no  all steps at once"


LAW_MODULES = {
    "mudline.contact.normal",
    "mudline.contact.assembly",
    "mudline.contact.laws.curve",
    "mudline.contact.laws.linear",
    "mudline.curves",
}

PROGRAM = """
import sys
import numpy as np
from mudline.contact import ContactInput, ContactModel
law = {law}
curves = ()
if law == 1:
    from mudline.curves import ForceCurve
    curves = (ForceCurve([(0, 0), (1, 1)]),)
one, zero = np.ones(1), np.zeros(1, int)
nodes = np.array([[0, 1]])
inputs = ContactInput(nodes[0], np.zeros((2, 3)), zero, nodes, one, one, zero + law, zero, curves, one)
ContactModel(inputs).evaluate(np.full((2, 3), -1.0))
print(*(name for name in sys.modules if name.startswith("mudline")))
"""


@pytest.mark.parametrize(
    ("law", "needed"),
    [
        (NONE, set()),
        (RIGID, set()),
        (LINEAR, {"mudline.contact.normal", "mudline.contact.assembly", "mudline.contact.laws.linear"}),
        (CURVE, LAW_MODULES - {"mudline.contact.laws.linear"}),
    ],
)
def test_only_the_modules_that_are_needed_are_imported(law: LawKind, needed: set[str]) -> None:
    run = [sys.executable, "-W", "error", "-c", PROGRAM.format(law=int(law))]
    imported = set(subprocess.run(run, capture_output=True, text=True, check=True).stdout.split())
    assert imported & LAW_MODULES == needed


def test_the_plan_of_a_scene_with_everything() -> None:
    plan = ContactModel(everything(9, seed=4)).plan
    assert plan.history
    assert [stage.stage for stage in plan if not stage.active] == []
    why = {stage.stage: stage.why for stage in plan}
    assert "nodes with a stiffness of their own" in why["normal law"]
    assert why["unloading"].endswith("on unloading lines, from the deepest point so far")
    assert "after Bridge et al., with a state each; " in why["suction"]
    assert why["suction"].endswith("with a spring up to an extent, without history (inferred)")
    assert "nodes with a constant spring, " in why["friction"]
    assert why["lateral"].endswith("with a spring to where it touched down (inferred), in place of friction")
    assert why["trench"].endswith("the bed is not lowered")


def test_a_trench_without_friction_does_nothing_and_the_plan_says_so() -> None:
    contact = model(chain([LINEAR]), Extras(trench=trench(2, 0.1, 0.5, 600.0)))
    assert not contact.plan["trench"].active
    assert contact.plan["trench"].why == "a trench adds to the limits of friction, and no node has a friction law"
    assert not contact.evaluate(drawn([(0.0, 0.0), (0.0, 0.2)])).reaction[..., 1:].any()
