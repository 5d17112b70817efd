"""Curves and sets are found without case; what is not there says what is."""

from __future__ import annotations

import pickle
from typing import Any, cast

import pytest

from mudline.scene.resolved import ByName
from mudline.short_repr import UnknownNameError
from tests.builders.scenes import scene_of

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


@pytest.mark.parametrize("name", ["Soft Clay", "SOFT CLAY", "soft clay", " soft Clay\t"])
def test_curve_is_found_without_case(name: str) -> None:
    curves = scene_of(DECK).curves
    assert curves[name].name == "Soft Clay"
    assert curves.get(name) is curves[name]
    assert name in curves


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


def test_many_names_are_cut() -> None:
    many = ByName("curve", [(f"Soil {number:03}", number) for number in range(300)])
    assert message_of(many, "Soil 2999") == (
        "no curve 'Soil 2999' (did you mean Soil 299?): there are 'Soil 000', 'Soil 001', 'Soil 002', 'Soil 003', "
        "'Soil 004', 'Soil 005', 'Soil 006', 'Soil 007', and 292 more"
    )
    assert repr(many) == (
        "<300 curves: 'Soil 000', 'Soil 001', 'Soil 002', 'Soil 003', 'Soil 004', 'Soil 005', 'Soil 006', 'Soil 007', "
        "and 292 more>"
    )
    long = ByName("set", [("x" * 500, 1)])
    assert len(message_of(long, "y" * 500)) < 200


def test_repr() -> None:
    assert repr(scene_of(DECK).curves) == "<2 curves: 'Soft Clay', 'SAND'>"
    assert repr(scene_of("$MODEL\n").sets) == "<1 set: 'ALL'>"
    assert repr(scene_of("$MODEL\n").curves) == "<no curves>"
    assert str(UnknownNameError()) == ""
