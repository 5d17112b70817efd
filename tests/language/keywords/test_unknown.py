"""Values that could not be read: a kind of their own, and nothing is concluded from them."""

from __future__ import annotations

import math
from typing import cast

import pytest

from mudline.language.deck.loading import load_bytes
from mudline.language.keywords.library.seabed_curves import SeabedStiffness
from mudline.language.keywords.library.seabed_properties import SeabedProperties
from mudline.language.keywords.table import Table
from mudline.language.keywords.values import UNKNOWN, UNKNOWN_NAME
from tests.checks.findings import found

HEAD = "$MODEL\n"


def laws_of(text: str) -> SeabedProperties:
    return cast("SeabedProperties", load_bytes((HEAD + text).encode(), "deck.keyxm").sections[0].blocks[0])


def test_it_is_neither_absent_nor_a_number() -> None:
    assert UNKNOWN is not None
    assert math.isnan(UNKNOWN)
    assert bool(UNKNOWN)
    assert not UNKNOWN > 0
    assert not UNKNOWN < 0
    assert UNKNOWN not in (0, None)
    assert UNKNOWN.part.other is UNKNOWN
    assert UNKNOWN.method(1) is UNKNOWN
    assert UNKNOWN[0] is UNKNOWN
    assert (list(UNKNOWN), len(UNKNOWN)) == ([], 0)
    assert (repr(UNKNOWN), repr(UNKNOWN_NAME), UNKNOWN_NAME) == ("UNKNOWN", "UNKNOWN_NAME", "")
    assert not hasattr(UNKNOWN, "__wrapped__")


@pytest.mark.parametrize(
    ("line", "name", "expected"),
    [
        ("FRICTION=0.3, 0.6", "stiffness", None),
        ("STIFFNESS=", "stiffness", UNKNOWN),
        ("STIFFNESS=5, 6, 7", "stiffness", UNKNOWN),
        ("FRICTION=0.3, x.6", "stiffness", None),
        ("XYZW=5", "stiffness", UNKNOWN),
    ],
)
def test_what_is_missing_is_unknown_where_it_may_be_there(line: str, name: str, expected: object) -> None:
    block = laws_of(f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=A\n STIFFNESS=1.0\n SET=B\n {line}\n")
    first, second = block.sets
    assert first.stiffness == 1.0
    assert getattr(second, name) is expected


def test_one_value_of_a_row_hides_no_other() -> None:
    row = laws_of("*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=A\n FRICTION=0.3, 0.6x, 0.01\n").sets[0].friction
    assert row is not None
    assert (row.longitudinal, row.longitudinal_mobilisation) == (0.3, 0.01)
    assert row.transverse is UNKNOWN


def test_a_field_of_a_table_is_unknown_where_it_has_no_word() -> None:
    def table(rows: str) -> Table:
        block = load_bytes(f"{HEAD}*SEABED STIFFNESS\n CURVE=a\n{rows}".encode(), "deck.keyxm").sections[0].blocks[0]
        return cast("SeabedStiffness", block).curves[0].points

    assert not table(" 0, 0\n 1, =[5*2]\n").unknown
    assert table(" 0, 0\n 1, 5x\n").unknown
    assert table(" 0, 0\n#\n").unknown


def test_what_can_be_said_is_said_beside_a_row_that_cannot_be_read() -> None:
    text = HEAD + "*SEABED STIFFNESS\n CURVE=Clay\n 0.0, 0.0\n 0.2, 100.0\n 0.2, 300.0\n 0.3, 4x0.0\n 0.5, 900.0\n"
    assert found(text, "CRV003", "SYN002") == [("CRV003", 6, 2), ("SYN002", 7, 7)]


@pytest.mark.filterwarnings("ignore:Pydantic serializer warnings")
def test_a_block_with_unknown_values_is_written_as_values() -> None:
    text = f"$PREPROCESSOR\n*VARIATION\n PARA=su, GEN\n{HEAD}*OCEAN\n 35O.0, 1025.0\n*ELASTIC SURFACE\n"
    deck = load_bytes(text.encode(), "deck.keyxm")
    variation, ocean, surface = (block for section in deck.sections for block in section.blocks)
    assert '"generate":null' in variation.model_dump_json()
    assert str(ocean.model_dump()["depth"]) == "UNKNOWN"
    assert surface.model_dump()["properties"] is UNKNOWN
