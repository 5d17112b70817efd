"""A scene as users see it: names without case, units, what refuses it, and the evaluator that it makes."""

from __future__ import annotations

import pickle
import subprocess
import sys
from typing import Any, cast

import pytest

from mudline.basics.short_repr import UnknownNameError
from mudline.language.codes import RUN001
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import DeckError
from mudline.model.contact import ContactModel
from mudline.model.contact.input import LawKind
from mudline.model.scene.model import resolve
from mudline.model.scene.resolved import ByName
from tests.helpers.builders.decks import CLAY, CURVED_BED, METRIC, PIPE, STEEL, line_deck
from tests.helpers.builders.scenes import scene_of
from tests.helpers.processes import TIMEOUT

FULL = PIPE + STEEL + CLAY + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=Clay\n"


def refusal(text: str) -> list[tuple[str, int, str]]:
    """Code, line and message of what keeps the evaluator from being made."""
    with pytest.raises(DeckError) as raised:
        scene_of(text).contact()
    return [(found.code, found.line, found.message) for found in raised.value.diagnostics]


@pytest.mark.parametrize(
    ("name", "gravity", "units"),
    [
        ("a.keyxm", "32.2", "metric"),
        ("a.keyxi", "9.81", "imperial"),
        ("a.keyx", "32.2", "imperial"),
        ("a", "1", "user"),
    ],
)
def test_units_are_those_of_the_deck(name: str, gravity: str, units: str) -> None:
    assert scene_of(f"$MODEL\n*OCEAN\n 100, 1025, {gravity}\n", name).units == units


def test_what_a_scene_holds() -> None:
    scene = scene_of(FULL)
    assert scene.require() is scene
    assert scene.node_ids.tolist()[:3] == [1, 11, 2]
    assert scene.coordinates.shape == (11, 3)
    assert scene.element_ids.tolist() == list(range(1, 11))
    assert scene.element_nodes[0].tolist() == [0, 2]
    assert scene.length.tolist() == [10.0] * 10
    assert scene.diameter.tolist() == [0.25] * 10
    assert scene.law.tolist() == [LawKind.CURVE] * 10
    assert list(scene.sets) == ["ALL"]
    assert list(scene.curves) == ["Clay"]


def test_curves_that_are_not_used_are_handed_over_and_do_not_shift_the_others() -> None:
    deck = FULL.replace(" CURVE=Clay", " CURVE=Unused\n 0, 0\n 1, 1\n CURVE=Clay")
    given = scene_of(deck).contact_input()
    assert [curve.name for curve in given.curves] == ["Unused", "Clay"]
    assert given.curve_index.tolist() == [1] * 10


# --------------------------------------------------------------------------------------------------------- refusals


def test_elements_at_nodes_of_lines_are_refused() -> None:
    text = "$MODEL\n*LINES\n LINE=SCR\n*NODE\n 1, 0, 0\n 2, 0, 1\n*ELEMENT\n 1, 1, 2\n 7, 1, {End}\n"
    scene = scene_of(text)
    assert scene.require() is scene
    message = "element 7 ends at a node that is not known; this cannot be evaluated"
    assert refusal(text) == [(RUN001.code, 9, message)]
    text += " 8, 1, 5\n"
    ((code, line, message),) = refusal(text)
    assert (code, line) == ("REF006", 10)
    assert message.startswith("element 8 ends at node 5, which is not defined: define it; *LINES, which is not read,")


def test_a_law_that_the_deck_before_may_define_is_refused() -> None:
    text = "$LOAD CASE\n*RESTART\n LAST=x\n" + FULL.replace("STIFFNESS=Clay", "STIFFNESS=Sand")
    message = "curve 'Sand' is not defined: *SEABED STIFFNESS has no such curve; the deck that *RESTART continues may "
    assert refusal(text) == [("REF002", 23, message + "define it")]
    scene = scene_of(text)
    assert scene.require() is scene
    assert scene.law_names == ["curve"] * 10


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("STIFFNESS=Clay", "STIFFNESS==[cu(2)]", 20),
        ("0.5, 4000.0", "0.5, =[cu(2)]", 16),
        ("0.25, 0.22", "=[cu(2)], 0.22", 12),
        ("11, -0.05", "11, =[cu(2)]", 4),
    ],
)
def test_what_an_unknown_function_leaves_unknown_is_refused_at_the_equation(old: str, new: str, line: int) -> None:
    """An unknown function is a warning: the deck may be fine where it runs. A result cannot be made of it."""
    text = FULL.replace(old, new)
    scene = scene_of(text)
    assert scene.require() is scene
    code, at, found = refusal(text)[0]
    assert (code, at) == ("SYN017", line)
    assert found.startswith("'=[cu(2)]': the function 'cu' is not known")


def test_what_an_unknown_function_leaves_unknown_in_a_parameter_is_refused_where_the_model_uses_it() -> None:
    parameters = "$PREPROCESSOR\n*PARAMETERS\n p, =[cu(2)]\n"
    assert isinstance(scene_of(parameters + FULL).contact(), ContactModel)
    assert [found[:2] for found in refusal(parameters + FULL.replace("0.5, 4000.0", "0.5, =[p]"))] == [("SYN017", 3)]


def test_a_length_that_overflows_is_refused_unless_nothing_needs_it() -> None:
    far = "$MODEL\n*NODE\n 1, -1, -1.0E308\n 2, -1, 1.0E308\n*ELEMENT\n 1, 1, 2\n"
    spring = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1\n"
    assert refusal(far + spring) == [
        (RUN001.code, 6, "element 1 has no known finite length; this cannot be evaluated"),
    ]
    assert scene_of(far).contact().evaluate().force.tolist() == [0.0]
    near = far.replace("-1.0E308", "0").replace("1.0E308", "1.0E300")
    assert scene_of(near + spring).contact().evaluate().reaction[:, 0].tolist() == [5e299, 5e299]


# -------------------------------------------------------------------------------------------------------- left out


def left_out(lines: str) -> dict[str, str]:
    contact = resolve(load_bytes((FULL + lines).encode(), "deck.keyxm")).contact()
    return {stage.stage: stage.why for stage in contact.plan if stage.stage in contact.input.left_out}


def test_a_plain_deck_leaves_nothing_out() -> None:
    assert left_out("") == {}
    assert left_out(" FRICTION=0, 0\n LATERAL=0\n SUCTION=0\n") == {}


def test_what_is_not_evaluated_is_said_by_stage() -> None:
    found = left_out(
        " FRICTION=0.3, 0.4, 0.1, 0.1, 5, 2\n LATERAL=5\n SUCTION=5\n SET=ALL\n STIFFNESS=Clay\n"
        " FRICTION=0.3, 0.4, 0.1, 0.1, 5, 2\n LATERAL=5\n SUCTION=5\n"
    )
    assert found == {
        "suction": "SUCTION= without an extent of its zone has no effect: 10 elements",
        "friction": (
            "11 nodes with a mobilisation length, Kt = mu N / length (inferred); "
            "LATERAL= replaces the transverse coefficient; "
            "the constant friction force coefficient is not evaluated: the manual does not say what it means; "
            "friction stiffnesses of FRICTION= are for modal and frequency runs (inferred)"
        ),
    }


def test_legacy_surfaces_are_evaluated_the_same_way() -> None:
    text = PIPE + STEEL + "*ELASTIC SURFACE\n 500, 0.3, 0.4, 0, 7, 1\n 3.0\n"
    plan = scene_of(text).contact().plan
    assert plan["seabed surface"].why == "plane through the origin, slope 3 deg, direction 0 deg, without end"
    assert plan["friction"].why.startswith("11 nodes with a mobilisation length")
    assert plan["suction"].why == "10 elements with a spring up to an extent, without history (inferred)"
    profile = PIPE + "*RIGID SURFACE\n 0.3\n 0, 0\n 10, 1\n"
    plan = scene_of(profile).contact().plan
    assert plan["seabed surface"].why.startswith("straight lines through 2 points")
    assert plan["friction"].why == "none on a rigid seabed, whose reaction is that of a constraint: 10 elements"


DECK = """$MODEL
*NODE
 1, -0.1, 0
 2, -0.1, 1
*ELEMENT
 1, 1, 2
*ELEMENT SETS
 SET=Fatigue Hot Spot
 1
*SEABED STIFFNESS
 CURVE=Soft Clay
 0, 0
 1, 5
 CURVE=SAND
 0, 0
 1, 9
"""


@pytest.mark.parametrize("name", ["Fatigue Hot Spot", "FATIGUE hot spot", "{fatigue hot spot}"])
def test_set_is_found_without_case(name: str) -> None:
    assert scene_of(DECK).sets[name].tolist() == [1]
    assert scene_of(DECK).sets["all"].tolist() == [1]


def test_names_are_those_of_the_deck() -> None:
    scene = scene_of(DECK)
    assert list(scene.curves) == [curve.name for curve in scene.curves.values()] == ["Soft Clay", "SAND"]
    assert dict(scene.sets).keys() == {"ALL", "Fatigue Hot Spot"}
    assert scene.curves._ipython_key_completions_() == ["Soft Clay", "SAND"]
    assert scene.curves == dict(scene.curves)


def message_of(held: ByName[Any], name: object) -> str:
    with pytest.raises(KeyError) as caught:
        held[cast("str", name)]
    assert isinstance(caught.value, UnknownNameError)
    assert str(pickle.loads(pickle.dumps(caught.value))) == str(caught.value)  # noqa: S301 - our own bytes
    assert name not in held
    assert held.get(cast("str", name)) is None
    assert held.get(cast("str", name), 3) == 3
    return str(caught.value)


def test_missing_name_says_which_there_are() -> None:
    scene = scene_of(DECK)
    assert message_of(scene.curves, "Soft Caly") == (
        "no curve 'Soft Caly' (did you mean Soft Clay?): there are 'Soft Clay', 'SAND'"
    )
    assert message_of(scene.curves, "Rock") == "no curve 'Rock': there are 'Soft Clay', 'SAND'"
    assert message_of(scene.sets, "TDZ") == "no set 'TDZ': there are 'ALL', 'Fatigue Hot Spot'"
    assert message_of(scene.curves, 2) == "a curve is found by its name, a str, not by int"
    assert message_of(scene_of("$MODEL\n").curves, "a") == "no curve 'a': there are no curves"
    assert message_of(scene_of("$MODEL\n").sets, "a") == "no set 'a': there is 'ALL'"


PROGRAM = """
import sys
from mudline.language.deck.loading import load_bytes
from mudline.model.scene.model import resolve
scene = resolve(load_bytes(sys.argv[1].encode(), "deck.keyxm"))
scene.contact().evaluate()
print(*(name for name in sys.modules if name.startswith(("mudline.", "scipy"))))
"""


def imported(seabed: str) -> set[str]:
    run = [sys.executable, "-W", "error", "-c", PROGRAM, line_deck(METRIC, seabed)]
    return set(subprocess.run(run, capture_output=True, text=True, timeout=TIMEOUT, check=True).stdout.split())


def test_a_deck_of_curves_on_a_flat_bed_imports_no_other_feature() -> None:
    found = imported(CURVED_BED)
    assert "mudline.model.curves" in found
    assert "scipy" not in found
    assert not {name for name in found if name.startswith("mudline.model.contact.seabed.")}
    laws = {name.rpartition(".")[2] for name in found if name.startswith("mudline.model.contact.laws.")}
    assert laws == {"linear"}
    assert "mudline.model.scene.contact_input" in found
