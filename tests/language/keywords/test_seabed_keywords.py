"""The seabed profile and the extension keywords: what fits together, numbers and words in one field."""

from __future__ import annotations

from typing import cast

import numpy as np
import pytest

from mudline.language.deck.loading import load_bytes
from mudline.language.keywords.library.seabed_lateral import Centreline, SeabedTrench, TrenchSet
from mudline.language.keywords.library.seabed_normal import CyclicLoading, SeabedSuction, SuctionSet

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
        (" PEAK=TABLE\n 0, 0\n 1\n", "SYN014", "2 fields expected (`offset, resistance`), found 1"),
        (" PEAK=TABLE\n 0, 0\n 1, x\n", "SYN002", "for resistance"),
    ],
)
def test_a_trench_that_cannot_be_read(lines: str, code: str, message: str) -> None:
    found = told(TRENCH + lines)
    assert [one for one, _ in found] in ([code], ["SYN003"])
    assert message in found[0][1]
