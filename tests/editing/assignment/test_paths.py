"""Paths and values as they are written on the command line."""

from __future__ import annotations

import pytest

from mudline.editing.assignment.fields import target_of
from mudline.editing.assignment.paths import (
    PathError,
    Selector,
    WrittenOperand,
    parse_assignment,
)


@pytest.mark.parametrize(
    ("text", "keyword", "names", "value"),
    [
        ("TIME.step=0.05", "TIME", ("step",), "0.05"),
        ("time.STEP = 0.05 ", "TIME", ("step",), "0.05"),
        ("SEABED  PROPERTIES.friction.transverse=1e-1", "SEABED PROPERTIES", ("friction", "transverse"), "1e-1"),
        ("P-Y.depth=1", "P-Y", ("depth",), "1"),
        ("NODE,CURVILINEAR.x=1", "NODE,CURVILINEAR", ("x",), "1"),
        ("SEABED CONTACT.NODAL STIFFNESS=5", "SEABED CONTACT", ("nodal_stiffness",), "5"),
        ("OCEAN.depth==[a + b]", "OCEAN", ("depth",), "=[a + b]"),
        ("OCEAN.depth=a=b", "OCEAN", ("depth",), "a=b"),
    ],
)
def test_assignment(text: str, keyword: str, names: tuple[str, ...], value: str) -> None:
    found = parse_assignment(text)
    assert (found.path.keyword, found.path.names, found.value) == (keyword, names, value)
    assert (found.path.selectors, found.path.count) == ((), None)


def test_selectors() -> None:
    found = parse_assignment('SEABED STIFFNESS[name="Soft, wet"][Ratio=0.10].force[2]=3').path
    assert found.selectors == (
        Selector("name", WrittenOperand("Soft, wet")),
        Selector("ratio", WrittenOperand("0.10", 0.1)),
    )
    assert found.count == 2
    assert str(found) == 'SEABED STIFFNESS[name="Soft, wet"][Ratio=0.10].force[2]'
    assert parse_assignment("TIME[ set = a b ].step=1").path.selectors == (Selector("set", WrittenOperand("a b")),)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "TIME",
        "TIME=1",
        "TIME.step",
        "TIME.step=",
        "TIME.step= ",
        ".step=1",
        "TIME..step=1",
        "TIME.step[0]=1",
        "TIME[set=].step=1",
        "TIME.step=1\n*OCEAN",
        "TIME.step=a\x1b",
        "1TIME.step=1",
        "T.s=" * 999,
    ],
)
def test_what_is_no_assignment(text: str) -> None:
    with pytest.raises(PathError, match="expected"):
        parse_assignment(text)


def _fields(text: str) -> list[tuple[str, ...]]:
    assignment = parse_assignment(text)
    return [field.names for field in target_of(assignment.path, WrittenOperand.of(assignment.value)).fields]


def test_the_field_that_may_hold_the_value_is_meant() -> None:
    assert _fields("TIME.step=0.05") == [("fixed", "increment")]
    assert _fields("TIME.step=fixed") == [("step",)]
    assert _fields("SEABED PROPERTIES.stiffness=1") == [("sets", "stiffness")]
    assert _fields("SEABED PROPERTIES.suction.stiffness=1") == [("sets", "suction", "stiffness")]
    assert len(_fields("GEOMETRIC SETS.Do=1")) == 4


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("TIEM.step=1", r"\*TIEM is not a known keyword: did you mean TIME\?"),
        ("LINES.length=1", "passed through unchanged"),
        ("WAVE.height=1", "passed through unchanged"),
        ("OCEAN.dept=1", r"\*OCEAN has no field 'dept': did you mean depth\?"),
        ("GEOMETRIC SETS.OD=1", r"\*GEOMETRIC SETS has no field 'od': did you mean dd or do\?"),
        ("SEABED", r"'SEABED' cannot be read .*: expected KEYWORD.field=value, .*; quote what has a space$"),
        ("OCEAN.x=1", r"it has depth, density, gravity, viscosity"),
        ("OCEAN[depht=1].depth=1", r"has no field 'depht': did you mean depth\?"),
    ],
)
def test_what_no_deck_can_have(text: str, message: str) -> None:
    with pytest.raises(PathError, match=message):
        _fields(text)
