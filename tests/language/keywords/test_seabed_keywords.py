"""The seabed profile and the extension keywords: what fits together, numbers and words in one field."""

from __future__ import annotations

import json
import re
from typing import cast

import numpy as np
import pytest

from mudline.editing.formatting.document import formatted
from mudline.language.deck.document import FORMAT
from mudline.language.deck.keyword_text import to_keyword
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.diagnostics import DeckError
from mudline.language.keywords.library.seabed_lateral import Centreline, SeabedTrench, TrenchSet
from mudline.language.keywords.library.seabed_normal import CyclicLoading, SeabedSoil, SeabedSuction, SuctionSet
from mudline.language.keywords.writer import block_lines
from tests.helpers.builders.documents import validator

TRENCH = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 2, 3\n"


def told(text: str) -> list[tuple[str, str]]:
    deck = load_bytes(f"$MODEL\n{text}".encode(), "deck.keyxm")
    return [(found.code, found.message) for found in deck.diagnose(deck.problems)]


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (" TYPE=SLOPING\n", "TYPE=SLOPING needs SLOPE="),
        (" TYPE=2D\n", "TYPE=2D needs FILE="),
        (" TYPE=2D\n FILE=a\n SLOPE=1\n", "TYPE=2D takes no SLOPE="),
        (" TYPE=SLOPING\n SLOPE=1\n FILE=a\n", "TYPE=SLOPING takes no FILE="),
        (" TYPE=2D\n INTERPOLATION=CUBIC\n FILE=a\n", "not CUBIC"),
        (" TYPE=3D\n INTERPOLATION=CUBIC SPLINE\n FILE=a\n", "not CUBIC SPLINE"),
    ],
)
def test_each_type_of_profile_has_its_own_settings(lines: str, message: str) -> None:
    ((code, found),) = told(f"*SEABED PROFILE\n{lines}")
    assert code == "SYN001"
    assert message in found


@pytest.mark.parametrize(
    ("lines", "code", "message"),
    [
        (" SMOOTHING=AUT\n", "SYN005", "expected a number, AUTO or NONE (did you mean AUTO?)"),
        (" SMOOTHING=1E999\n", "SYN002", "too large"),
        (" SMOOTHING==[h\n", "SYN006", "not closed"),
    ],
)
def test_a_number_or_a_word(lines: str, code: str, message: str) -> None:
    found = told(f"*SEABED CONTACT\n SET=ALL\n{lines}")
    assert [one for one, _ in found] in ([code], ["SYN014"])
    assert message in found[0][1]


def test_two_points_or_a_word() -> None:
    text = "*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 2, 3\n PEAK=4\n CENTRELINE={}\n"
    assert told(text.format("LAID")) == told(text.format("0, 0, 1, 1")) == []
    ((code, message),) = told(text.format("LAYD"))
    assert (code, message.partition(": ")[2]) == ("SYN005", "expected LAID or y0, z0, y1, z1 (did you mean LAID?)")


def test_a_setting_that_a_record_must_have() -> None:
    ((code, message),) = told("*SEABED TRENCH\n SET=ALL\n PEAK=4\n")
    assert (code, message) == ("SYN001", "GEOMETRY= is missing here")


def suctions(lines: str) -> list[SuctionSet]:
    deck = load_bytes(f"$MODEL\n*SEABED SUCTION\n SET=ALL\n{lines}".encode(), "deck.keyxm")
    assert deck.problems == []
    return cast("SeabedSuction", deck.sections[0].blocks[0]).sets


def trenches(lines: str) -> list[TrenchSet]:
    deck = load_bytes(f"$MODEL\n{TRENCH}{lines}".encode(), "deck.keyxm")
    assert deck.problems == []
    return cast("SeabedTrench", deck.sections[0].blocks[0]).sets


def test_the_factor_of_cyclic_loading_alone_or_with_a_floor() -> None:
    for written, factor in (("0.9", 0.9), ("0.9,", 0.9), ("0.9, ,", 0.9), ("=[a]", "=[a]")):
        assert suctions(f" CYCLIC={written}\n")[0].cyclic == factor
    for written, factor in (("0.9, 0.5", 0.9), ("0.9 0.5", 0.9), ("0.9,0.5,", 0.9), ("=[a], 0.5", "=[a]")):
        cyclic = suctions(f" CYCLIC={written}\n")[0].cyclic
        assert isinstance(cyclic, CyclicLoading)
        assert (cyclic.factor, cyclic.floor) == (factor, 0.5)
    assert suctions("")[0].cyclic is None


@pytest.mark.parametrize(
    ("written", "code", "message"),
    [
        ("", "SYN003", "CYCLIC= has no value"),
        ("x", "SYN002", "for CYCLIC="),
        ("x, 0.5", "SYN002", "for factor"),
        (", 0.5", "SYN003", "factor is missing"),
        ("0.9, 0.5, 0.1", "SYN003", "(`factor, floor`), found 3"),
    ],
)
def test_cyclic_loading_that_cannot_be_read(written: str, code: str, message: str) -> None:
    ((found, words),) = told(f"*SEABED SUCTION\n SET=ALL\n CYCLIC={written}\n COHESION=5000\n")
    assert found == code
    assert message in words


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"factor": 0.9}, "cyclic.floor: is missing"),
        ({"factor": 0.9, "floor": "x"}, "cyclic.floor: expected a number"),
        ([0.9, 0.5], "cyclic: expected an object or a number"),
    ],
)
def test_cyclic_loading_of_a_document(given: object, message: str) -> None:
    sets = [{"set": "ALL", "cyclic": given}]
    model = {"name": "MODEL", "blocks": [{"keyword": "SEABED SUCTION", "sets": sets}]}
    with pytest.raises(DeckError, match=re.escape(message)):
        load_bytes(json.dumps({"format": FORMAT, "sections": [model]}).encode(), "deck.json")


def test_the_model_of_a_trench() -> None:
    assert trenches(" MODEL=wall\n")[0].model == "WALL"
    assert trenches(" MODEL=PEAK\n PEAK=4\n")[0].model == "PEAK"
    trench = trenches(" PEAK=4\n")[0]
    assert (trench.model, trench.peak, trench.table) == (None, 4.0, None)


def test_a_table_of_resistance_and_what_follows_it() -> None:
    lines = " PEAK=table\n 0, 0\nC of the wall\n 1.5, 800\n 3.0, =[a]\n CENTRELINE=0, 0, 9, 9\n"
    first, second = trenches(lines + " SET=Left\n GEOMETRY=1, 2, 3\n PEAK=7\n")
    assert (first.peak, second.peak) == ("TABLE", 7.0)
    assert first.table is not None
    np.testing.assert_array_equal(first.table.values, [[0.0, 0.0], [1.5, 800.0], [3.0, np.nan]])
    assert first.table.words == {(2, 1): "=[a]"}
    assert isinstance(first.centreline, Centreline)
    assert first.centreline.z1 == 9.0
    assert trenches(" PEAK=TABLE\n")[0].table is None


@pytest.mark.parametrize(
    ("lines", "code", "message"),
    [
        (" PEAK=5\n 0, 0\n", "SYN001", "rows belong to PEAK=TABLE only"),
        (" 0, 0\n PEAK=TABLE\n", "SYN001", "expected PEAK= before this line"),
        (" MODEL=WALL\n 0, 0\n", "SYN001", "expected PEAK= before this line"),
        (" PEAK=TABEL\n", "SYN005", "expected a number or TABLE (did you mean TABLE?)"),
        (" MODEL=SLOPE\n", "SYN005", "expected PEAK or WALL"),
        (" PEAK=TABLE\n 0, 0\n 1\n", "SYN014", "1 field, expected 2 (`offset, resistance`)"),
        (" PEAK=TABLE\n 0, 0\n 1, x\n", "SYN002", "for resistance"),
    ],
)
def test_a_trench_that_cannot_be_read(lines: str, code: str, message: str) -> None:
    found = told(TRENCH + lines)
    assert [one for one, _ in found] in ([code], ["SYN003"])
    assert message in found[0][1]


def test_rows_that_no_table_asks_for_in_a_document() -> None:
    trench = {"set": "ALL", "geometry": {"depth": 1, "bottom_width": 2, "upper_width": 3}, "table": [[0, 1], [1, 2]]}
    model = {"name": "MODEL", "blocks": [{"keyword": "SEABED TRENCH", "sets": [trench]}]}
    with pytest.raises(DeckError, match="table: rows belong to PEAK=TABLE only"):
        load_bytes(json.dumps({"format": FORMAT, "sections": [model]}).encode(), "deck.json")


TRENCHES = """\
*SEABED TRENCH
 SET=ALL
 GEOMETRY=1.0, 2.0, 3.0
 MODEL=PEAK
 PEAK=TABLE
 0.0, 0.0
C a wall
 1.5, 800.0
 CENTRELINE=LAID
 SET=Left
 GEOMETRY=1.0, 2.0, 3.0
 MODEL=WALL
 SET=Right
 GEOMETRY=1.0, 2.0, 3.0
 PEAK=4.0
"""


@pytest.mark.parametrize(
    "block",
    [
        "*SEABED SUCTION\n SET=ALL\n COHESION=5000.0\n CYCLIC=0.9, 0.5\n SET=Left\n CYCLIC=0.8\n",
        TRENCHES,
    ],
)
def test_every_form_holds_cyclic_loading_and_trenches(block: str) -> None:
    text = f"$MODEL\n{block}"
    deck = load_bytes(text.encode(), "deck.keyxm")
    assert dump(deck, "keyword") == text
    for form in ("json", "yaml"):
        again = load_bytes(dump(deck, form).encode(), f"deck.{form}")
        assert again.sections == deck.sections
        assert dump(again, "keyword") == text
    validator().validate(json.loads(dump(deck, "json")))
    assert load_bytes(formatted(text.encode(), "deck.keyxm"), "deck.keyxm").sections == deck.sections


def test_direction_stands_on_the_line_of_interpolation_only() -> None:
    for lines in (
        " TYPE=SLOPING\n DIRECTION=30.0\n SLOPE=2.5\n",
        " TYPE=2D\n INTERPOLATION=LINEAR, DIRECTION=30.0\n FILE=bed.txt\n",
        " TYPE=2D\n DIRECTION=30.0\n FILE=bed.txt\n",
    ):
        text = f"$MODEL\n*SEABED PROFILE\n{lines}"
        assert to_keyword(load_bytes(text.encode(), "deck.keyxm")) == text


def test_a_soil_with_all_of_its_settings_and_with_one() -> None:
    text = (
        "*SEABED SOIL\n SET=Left\n STRENGTH=5000, 1500\n BEARING=6, 0.25\n STIFFNESS=200\n SUCTION=0.6, 1\n"
        " REPENETRATION=0.3\n BUOYANCY=1.5, 6000\n SET=Right\n STRENGTH=8000\n"
    )
    deck = load_bytes(f"$MODEL\n{text}".encode(), "deck.keyxm")
    assert deck.problems == []
    block = cast("SeabedSoil", deck.sections[0].blocks[0])
    left, right = block.sets
    assert left.buoyancy is not None
    assert left.suction is not None
    assert (left.strength.mudline, left.strength.gradient, left.stiffness) == (5000.0, 1500.0, 200.0)
    assert (left.suction.ratio, left.suction.decay, left.buoyancy.weight) == (0.6, 1.0, 6000.0)
    assert (right.strength.mudline, right.strength.gradient, right.bearing) == (8000.0, None, None)
    again = load_bytes("$MODEL\n{}\n".format("\n".join(block_lines(block))).encode(), "deck.keyxm")
    assert again.sections[0].blocks[0] == block
    ((code, message),) = told("*SEABED SOIL\n SET=ALL\n STIFFNESS=200\n")
    assert (code, message) == ("SYN001", "STRENGTH= is missing here")
