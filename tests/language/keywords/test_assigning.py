"""Fields, lists and tables that a program changes: validated at once, and as before where they are refused."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from copy import deepcopy
from typing import Any

import numpy as np
import pytest

from mudline.language.keywords.library.ocean import Ocean
from mudline.language.keywords.library.seabed_curves import Embedment, SeabedStiffness, StiffnessCurve
from mudline.language.keywords.library.seabed_properties import SeabedProperties
from mudline.language.keywords.library.springs import SpringElements
from mudline.language.keywords.model import Part

POINTS = [(0, 0), (0.1, 1200)]


def ocean() -> Ocean:
    return Ocean(depth=500.0)


def curves() -> SeabedStiffness:
    return SeabedStiffness.model_validate({"curves": [{"name": name, "points": POINTS} for name in ("clay", "Sand")]})


@pytest.mark.parametrize("value", [1200, 1200.0, np.float32(1200), np.int64(1200), np.array(1200.0)])
def test_numbers_of_every_kind_are_numbers(value: float) -> None:
    block = ocean()
    block.depth = value
    assert block.depth == 1200.0
    assert type(block.depth) is float
    block.depth = "=[depth + 5]"  # type: ignore[assignment]  # pydantic makes an equation of it
    assert str(block.depth) == "=[depth + 5]"


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("deep", r"Ocean.depth: expected a number or an equation =\[...\], found 'deep'"),
        (-5, "Ocean.depth: -5.0 is out of range: it must be greater than 0"),
        (None, "Ocean.depth: expected a number"),
        ([1.0], "Ocean.depth: expected a number .*, found a list"),
        (float("nan"), "Ocean.depth: expected a number .*, found nan"),
        (True, "Ocean.depth: expected a number .*, found True"),
    ],
)
def test_a_bad_value_is_refused_and_changes_nothing(value: object, message: str) -> None:
    block = ocean()
    with pytest.raises(ValueError, match=message):
        block.depth = value  # type: ignore[assignment]  # it is what is tested
    assert block == ocean()
    assert block.model_fields_set == ocean().model_fields_set


def test_a_misspelt_field_is_refused_with_what_was_meant() -> None:
    with pytest.raises(ValueError, match=r"Ocean has no field 'dept': did you mean depth\?"):
        ocean().dept = 3.0  # type: ignore[attr-defined]  # it is what is tested


def test_a_rule_of_the_whole_part_leaves_it_as_it_was() -> None:
    spring = SpringElements.model_validate(
        {"springs": [{"elements": [12], "type": "LINEAR", "stiffness": 5.0}]}
    ).springs[0]
    before = deepcopy(spring)
    with pytest.raises(ValueError, match=r"Springs: .*expected stiffness"):
        spring.points = POINTS
    assert spring == before


def test_several_values_fill_a_row() -> None:
    block = SeabedProperties.model_validate({"sets": [{"set": "TDZ"}]})
    entry = block.sets[0]
    entry.friction = (0.3, np.float64(0.5))  # type: ignore[assignment]  # the values of the row, in their order
    assert entry.friction is not None
    assert (entry.friction.longitudinal, entry.friction.transverse) == (0.3, 0.5)
    with pytest.raises(ValueError, match=r"friction.transverse: -0.5 is out of range"):
        entry.friction = (0.3, -0.5)  # type: ignore[assignment]  # as above
    with pytest.raises(ValueError, match="8 values, at most 7 expected"):
        entry.friction = [0.1] * 8  # type: ignore[assignment]  # as above
    assert entry.friction
    assert entry.friction.transverse == 0.5


# --------------------------------------------------------------------------------------------------------------- tables


@pytest.mark.parametrize("points", [[(0, 0), (0.5, 3)], np.array([[0.0, 0.0], [0.5, 3.0]]), "0, 0\n0.5, 3"])
def test_a_table_is_set_as_a_whole_and_gone_through(points: object) -> None:
    curve = curves().curves[0]
    curve.points = points  # type: ignore[assignment]  # pydantic makes a table of them
    assert list(curve.points) == [(0.0, 0.0), (0.5, 3.0)]
    assert (curve.points[-1], curve.points[:1]) == ((0.5, 3.0), [(0.0, 0.0)])
    assert np.asarray(curve.points).tolist() == [[0.0, 0.0], [0.5, 3.0]]
    with pytest.raises(IndexError):
        curve.points[2]


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0, 0)], "StiffnessCurve.points: 1 point: a curve needs at least 2"),
        ([(0, 0), (1, "x")], r"StiffnessCurve.points\[1\]\[1\]: 'x' is not a number"),
        ([(0, 0), (1, 2, 3)], r"StiffnessCurve.points\[1\]: 3 fields, expected 2"),
        (5, "StiffnessCurve.points: expected rows"),
    ],
)
def test_a_table_that_is_none_is_refused(points: object, message: str) -> None:
    curve = curves().curves[0]
    with pytest.raises(ValueError, match=message):
        curve.points = points  # type: ignore[assignment]  # pydantic makes a table of them
    assert list(curve.points) == [(0.0, 0.0), (0.1, 1200.0)]


# ---------------------------------------------------------------------------------------------------------------- lists


def test_records_are_found_by_their_names() -> None:
    block: Any = curves()
    assert block.curves["CLAY"] is block.curves[0]
    with pytest.raises(KeyError, match="no entry 'rock': there are 'clay', 'Sand'"):
        block.curves["rock"]
    block.curves.append(block.curves[0])
    with pytest.raises(KeyError, match=r"'clay' is the name of 2 entries: take one by its index, of \[0, 2\]"):
        block.curves["clay"]
    of_sets: Any = Embedment.model_validate({"curves": [{"points": POINTS}]})
    assert of_sets.curves["all"] is of_sets.curves[0]


def test_what_is_put_into_a_list_is_validated() -> None:
    block: Any = curves()
    record = {"name": "rock", "points": POINTS}
    block.curves.append(record)
    block.curves.extend([StiffnessCurve.model_validate(record)])
    block.curves.insert(0, record)
    block.curves[1] = record
    block.curves += [record]
    block.curves[2:3] = [record, record]
    assert [type(one) for one in block.curves] == [StiffnessCurve] * 7
    for change in (
        block.curves.append,
        lambda bad: block.curves.extend([record, bad]),
        lambda bad: block.curves.insert(0, bad),
        lambda bad: block.curves.__setitem__(0, bad),
        lambda bad: block.curves.__iadd__([bad]),
    ):
        with pytest.raises(ValueError, match=r"SeabedStiffness.curves\[\d\].points: is missing"):
            change({"name": "x"})
    assert len(block.curves) == 7


@pytest.mark.parametrize("twin", [deepcopy, lambda part: pickle.loads(pickle.dumps(part))])  # noqa: S301 - our own
def test_copies_are_equal_and_validate_too(twin: Callable[[Any], Any]) -> None:
    block: Part = curves()
    other = twin(block)
    assert other == block
    with pytest.raises(ValueError, match="is missing"):
        other.curves.append({"name": "x"})
