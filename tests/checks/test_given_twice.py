"""What may stand once and stands twice: each kind is told, and what may be repeated is not."""

from __future__ import annotations

import pytest

from tests.checks.findings import found, messages

VESSELS = "$MODEL\n*VESSEL\n VESSEL=A\n INITIAL POSITION=0, 0, 0\n VESSEL=B\n INITIAL POSITION=0, 0, 0\n$LOAD CASE\n"
ROWS = " 0.9, 0.4, 0.0, 0.0, 0.0, 1.1\n 10.0, 90.0, 0.0, 0.0, 0.0, -80.0\n"
SPRINGS = "$MODEL\n*P-Y\n SET=ALL\n DEPTH=0.0\n 0, 0\n 1, 1\n DEPTH={}\n 0, 0\n 2, 1\n"
COEFFICIENTS = "$MODEL\n*HYDRODYNAMIC SETS\n SET=ALL\n 1.0\n*HYDRODYNAMIC SETS\n SET={}\n 1.2\n"
STEEL = " 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"
SECTIONS = "$MODEL\n*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n" + STEEL + " SET={}\n" + STEEL


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("$MODEL\n*OCEAN\n 500.0\n*OCEAN\n 400.0\n", (4, 1)),
        (VESSELS + "*OFFSET\n VESSEL=A\n OFFSET=0, 1\n*OFFSET\n VESSEL=a\n OFFSET=0, 2\n", (12, 9)),
        (VESSELS + "*RAO\n VESSEL=A\n FILE=a\n VESSEL=A\n FILE=b\n", (11, 9)),
        (VESSELS + f"*RAO\n VESSEL=A\n HEADING=0\n 0.1\n{ROWS} HEADING=0.0\n 0.1\n{ROWS}", (14, 10)),
        (VESSELS + f"*RAO\n VESSEL=A\n HEADING=0\n 0.1\n{ROWS} 0.1\n{ROWS}", (14, 2)),
        (COEFFICIENTS.format('"all"'), (6, 6)),
        (SECTIONS.format("All"), (6, 6)),
    ],
)
def test_the_later_one_is_told(text: str, place: tuple[int, int]) -> None:
    assert found(text, "REF022") == [("REF022", *place)]


@pytest.mark.parametrize(
    "text",
    [
        "$MODEL\n*OCEAN\n 500.0\n$LOAD CASE\n*DATABASE\n TIME=ALL\n$LOAD CASE\n*DATABASE\n TIME=ALL\n",
        VESSELS + "*OFFSET\n VESSEL=A\n OFFSET=0, 1\n VESSEL=B\n OFFSET=0, 2\n",
        VESSELS + "*DRIFT\n VESSEL=A, TYPE=SINUSOIDAL\n 2, 4, 0, 90\n VESSEL=A, TYPE=SINUSOIDAL\n 3, 4, 0, 90\n",
        VESSELS + f"*RAO\n VESSEL=A\n HEADING=0\n 0.1\n{ROWS} HEADING=90\n 0.1\n{ROWS}",
        VESSELS + f"*RAO\n VESSEL=A\n HEADING=0\n x\n{ROWS} y\n{ROWS}",
        SPRINGS.format("1"),
        SPRINGS.format("1") + SPRINGS.format("1").replace("$MODEL\n", "").replace("ALL", "B"),
        COEFFICIENTS.format("Upper"),
        SECTIONS.format(""),
    ],
)
def test_what_may_be_repeated(text: str) -> None:
    assert found(text, "REF022") == []


def test_which_one_holds_is_said() -> None:
    assert (
        "'ALL' is already given in *GEOMETRIC SETS, and the later one holds"
        in messages(SECTIONS.format("ALL"), "REF022")[0]
    )
    twice = VESSELS + f"*RAO\n VESSEL=A\n HEADING=0\n 0.1\n{ROWS} HEADING=0.0\n 0.1\n{ROWS}"
    assert "is already given in *RAO, and which of them holds is not" in messages(twice, "REF022")[0]
