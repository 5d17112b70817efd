"""The seabed profile and the extension keywords: what fits together, numbers and words in one field."""

from __future__ import annotations

import pytest

from mudline.deck.keyword_form import to_keyword
from mudline.deck.loading import load_bytes


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
    ((code, message),) = told("*SEABED TRENCH\n SET=ALL\n GEOMETRY=1, 2, 3\n")
    assert (code, message) == ("SYN001", "PEAK= is missing here")


def test_direction_stands_on_the_line_of_interpolation_only() -> None:
    for lines in (
        " TYPE=SLOPING\n DIRECTION=30.0\n SLOPE=2.5\n",
        " TYPE=2D\n INTERPOLATION=LINEAR, DIRECTION=30.0\n FILE=bed.txt\n",
        " TYPE=2D\n DIRECTION=30.0\n FILE=bed.txt\n",
    ):
        text = f"$MODEL\n*SEABED PROFILE\n{lines}"
        assert to_keyword(load_bytes(text.encode(), "deck.keyxm")) == text
