"""Each kind of fault is told once, at its exact place, whatever the line ends; a bad line never hides another."""

from __future__ import annotations

from typing import cast

import pytest

from mudline.language.diagnostics import Severity
from mudline.language.keywords.library.seabed_curves import SeabedStiffness
from tests.helpers.builders.scenes import deck_of

Found = tuple[str, int, int]
Faults = list[tuple[str, list[Found]]]
ENDS = {"LF": "\n", "CRLF": "\r\n", "CR": "\r"}
MODEL = "$MODEL\n"


def problems(text: str, name: str = "deck.keyxm") -> list[Found]:
    """Code, line and column of what was noticed in reading a text."""
    deck = deck_of(text, name)
    return [(found.code, found.line, found.column) for found in deck.diagnose(deck.problems)]


def messages(text: str) -> list[str]:
    deck = deck_of(text)
    return [found.message for found in deck.diagnose(deck.problems)]


SEABED = "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=a\n"
CURVE = "*SEABED STIFFNESS\n CURVE=a\n 0, 0\n"
GEOMETRIC = "*GEOMETRIC SETS\n OPTION=RIGID\n SET=a\n"

IN_MODEL: Faults = [
    ("*OCEAN\n 1O0.0, 1025.0\n", [("SYN002", 3, 2)]),
    ("*OCEAN\n 100.0, 1e400, nan,\tx\n", [("SYN002", 3, 9), ("SYN002", 3, 16), ("SYN002", 3, 21)]),
    ("*OCEAN\n 1.0, 2.0, [a]\n", [("SYN002", 3, 12)]),
    ("*OCEAN\n  1,2,3,4,5\n", [("SYN003", 3, 3)]),
    ("*OCEAN\n , 1025.0\n", [("SYN003", 3, 2)]),
    ("*OCEAN\n 1\n  2\n", [("SYN001", 4, 3)]),
    ("*OCEAN\n=[a, 1\n*NODE\n 1, =[x, 2\n 2, 3, 4\n", [("SYN006", 3, 1), ("SYN006", 5, 5)]),
    ('*ELEMENT SETS\n SET="a, b\n SET={a\n', [("SYN006", 3, 6), ("SYN006", 4, 6)]),
    (SEABED.replace("ELASTIC", "ELSTIC"), [("SYN005", 3, 7)]),
    (SEABED + "  STIFNESS = 1\n STIFFNESS=1\n", [("SYN004", 5, 3)]),
    (SEABED + " FRICTION=1, FRICTON=2\n", [("SYN004", 5, 14)]),
    (SEABED + " STIFFNESS=1\n STIFFNESS=2\n", [("SYN001", 6, 2)]),
    (SEABED + " 0.3\n LATERAL=1\n", [("SYN001", 5, 2)]),
    (SEABED + " LATERAL=\n SUCTION=,1\n", [("SYN003", 5, 2), ("SYN003", 6, 10)]),
    (SEABED + " LATERAL=soft\n SUCTION=1, hard\n", [("SYN002", 5, 10), ("SYN002", 6, 13)]),
    (SEABED + " STIFFNESS=a, b\n", [("SYN003", 5, 12)]),
    (
        "*NODE\n 1.5, 0, 0\n 2, 0\n 3, , 5\n 4, 0, x, y\n",
        [*(("SYN002", 3, 2), ("SYN003", 4, 2), ("SYN003", 5, 4), ("SYN002", 6, 8), ("SYN002", 6, 11))],
    ),
    ("*NODE\n 9007199254740994, 0, 0\n GEN=1, b\n GEN=1\n", [("SYN002", 3, 2), ("SYN002", 4, 9), ("SYN003", 5, 6)]),
    ("*NODE\n 1, 0.5, 0, 0, 0\n 1 0.5 0 0 0\n", [("SYN003", 3, 2), ("SYN003", 4, 2)]),
    ("*ELEMENT\n 1, 2\n 1, 2, 3, x\n 1, 2, {a\n", [("SYN003", 3, 2), ("SYN002", 4, 11), ("SYN006", 5, 8)]),
    (
        "*ELEMENT SETS\n 1, 2\n SET=a\n GEN=1\n GEN=1,,x\n",
        [*(("SYN001", 3, 2), ("SYN003", 5, 6), ("SYN003", 6, 8), ("SYN002", 6, 9))],
    ),
    ("*GEOMETRIC SETS\n SET=a\n SET=b\n 1,2,3,4,5,6,7,8,9\n", [("SYN001", 4, 2)]),
    ("*GEOMETRIC SETS\n SET=a, BUOYANCY=D\n 1,2,3,4,5,6,7,8,9\n", [("SYN005", 3, 18)]),
    ("*GEOMETRIC SETS\n OPTION=MOORING\n SET=a\n 1,2\n", [("SYN003", 5, 2)]),
    ("*BOUNDARY\n 1\n  *HYDRODYNAMIC SET\n*NEW THING\n", [("SYN008", 2, 1), ("SYN009", 4, 3), ("SYN009", 5, 1)]),
    (CURVE + " 0.1\n 1, 2, 3\n x, 1\n", [("SYN003", 5, 2), ("SYN003", 6, 2), ("SYN002", 7, 2)]),
    (CURVE + " 0,05, 480,5\n", [("SYN015", 5, 2)]),
    ("*OCEAN\n 100,0, 1025,0, 9,81\n", [("SYN015", 3, 2)]),
    (SEABED + " STIFFNESS=1,2\n", [("SYN015", 5, 12)]),
    ("*ELEMENT SETS\n SET=a\n Spool End, 3, x.5\n", [("SYN016", 4, 2), ("SYN016", 4, 16)]),
    ("*ELEMENT\n 1, Hang Off, 2\n 2, 2,Tie-in\n", [("SYN016", 3, 5), ("SYN016", 4, 7)]),
    ("*UNITS\n", [("SYN008", 2, 1)]),
    ("title\n more\n*OCEAN\n 1\n", [("SYN011", 2, 1)]),
]

WHOLE: Faults = [
    ("*OCEAN\n 1\n$MODEL\n", [("SYN007", 1, 1)]),
    ("title\n 1 2\n*OCEAN\n$MODEL\n stray\n", [("SYN007", 3, 1), ("SYN011", 1, 1), ("SYN011", 5, 2)]),
    ("$LOADCASE\n $WHATEVER\n", [("SYN010", 1, 1), ("SYN010", 2, 2)]),
    (
        "$PREPROCESSOR\n*PARAMETERS\n a, =[1\n b\n c, 1, x\n d, /1, 2\n",
        [*(("SYN006", 3, 5), ("SYN003", 4, 2), ("SYN003", 5, 2), ("SYN006", 6, 5))],
    ),
    ("$ANALYSIS\n*UNITS\n UNITS=METRICAL\n", [("SYN005", 3, 8)]),
    ("$PREPROCESSOR\n*NODE\n 1, x\n", [("SYN008", 2, 1)]),
]

FAULTS: Faults = [(MODEL + text, found) for text, found in IN_MODEL] + WHOLE


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("mark", ["", "\ufeff"], ids=["plain", "BOM"])
@pytest.mark.parametrize(("text", "found"), FAULTS)
def test_places(text: str, found: list[Found], end: str, mark: str) -> None:
    assert sorted(problems(mark + text.replace("\n", ENDS[end]))) == sorted(found)


def test_faults_of_all_blocks_are_told_together() -> None:
    text, wanted = "", []
    for block, found in IN_MODEL:
        if not block.startswith("title"):
            shift = text.count("\n") - 1
            wanted += [(code, line + shift, column) for code, line, column in found]
            text += block
    shifted = [(code, line + 1, column) for code, line, column in wanted]
    assert sorted(problems(MODEL + text)) == sorted(shifted)


@pytest.mark.parametrize(
    "bad", [" x, 1", " 1", " 1, 2, 3", " {a", " =[1, 2", " CURV=b", "\x0b", " C indented", ' "', " 1e400, 2"]
)
@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_bad_line_hides_no_other(bad: str, place: int) -> None:
    rows = [" 0, 0", " 1, ten", " 2, 20"]
    rows.insert(place, bad)
    line = 4 + rows.index(" 1, ten")
    found = problems(MODEL + "*SEABED STIFFNESS\n CURVE=a\n" + "\n".join(rows) + "\n*OCEAN\n 1O\n")
    assert ("SYN002", line, 5) in found
    assert ("SYN002", 9, 2) in found
    assert len([one for one in found if one[1] == 4 + place]) >= 1


@pytest.mark.parametrize(
    "line", ["C", "c", "C text", "c lower", "C\ttab", "C---", "C***", "C  =====", "C-- =[ {", "C.. SET=a", "C x, 1"]
)
def test_comment_lines(line: str) -> None:
    assert problems(MODEL + CURVE + line + "\n 1, 1\n") == []


@pytest.mark.parametrize("line", ["Csomething", "Clay, 1", "Cd, 1.2", "CURV=b", "Cxx"])
def test_a_c_before_a_letter_is_a_comment_with_a_warning(line: str) -> None:
    deck = deck_of(MODEL + CURVE + line + "\n 1, 1\n")
    (found,) = deck.diagnose(deck.problems)
    assert (found.code, found.severity, found.line, found.column) == ("SYN013", Severity.WARNING, 5, 1)
    assert line in found.message
    _, block = next(deck.blocks("SEABED STIFFNESS"))
    curve = cast("SeabedStiffness", block).curves[0]
    assert curve.points.values.tolist() == [[0.0, 0.0], [1.0, 1.0]]
    assert [(comment.before, comment.text) for comment in curve.comments] == [(1, line[1:])]


@pytest.mark.parametrize(
    ("line", "stiffness"),
    [
        *((" STIFFNESS==[k]", "=[k]"), (" stiffness = =[ a, b ]", "=[ a, b ]"), (" Stiffness=Soft Clay", "Soft Clay")),
        *((' STIFFNESS="a, b"', '"a, b"'), (" STIFFNESS=1D3,", 1000.0), ("STIFFNESS\t=\t.5, ,", 0.5)),
    ],
)
def test_settings(line: str, stiffness: object) -> None:
    deck = deck_of(MODEL + SEABED + line + "\n")
    assert deck.problems == []
    _, block = next(deck.blocks("SEABED PROPERTIES"))
    assert block.sets[0].stiffness == stiffness


@pytest.mark.parametrize(
    ("text", "found"),
    [
        *((CURVE + " 1, 3.0E", [("SYN014", 5, 5)]), (CURVE + " 1, 3.0E-", [("SYN014", 5, 5)])),
        *((CURVE + " 1, =[x", [("SYN014", 5, 5)]), (CURVE + " 1, 3.0E\n", [("SYN002", 5, 5)])),
        *((CURVE + " 1, -", [("SYN014", 5, 5)]), (CURVE + " 1, x", [("SYN002", 5, 5)])),
        *((CURVE + " 1, 3.", []), ("*OCEAN\n", [("SYN014", 2, 1)]), ("*OCEAN", [("SYN014", 2, 1)])),
        *(("*GEOMETRIC SETS\n SET=a\n", [("SYN014", 3, 2)]), ("*OCEAN\n*NODE\n 1,1,1\n", [("SYN001", 2, 1)])),
        ("*ELEMENT SETS\n SET={a", [("SYN014", 3, 6)]),
        *((SEABED + " STIFFNESS=85.0E", [("SYN014", 5, 12)]), (SEABED + " STIFFNESS=-", [("SYN014", 5, 12)])),
        *((SEABED + " STIFFNESS=85.0E\n", []), (SEABED + " STIFFNESS=Clay", [])),
        *(("*NODE\n 1, 0, 0\n 2, -", [("SYN014", 4, 2)]), ("*NODE\n 1, 0, 0\n 2, -\n", [("SYN003", 4, 2)])),
        *(("*ELEMENT\n 1, 2,", [("SYN014", 3, 7)]), ("*ELEMENT\n 1, 2,\n", [("SYN003", 3, 7)])),
        *((GEOMETRIC + " 207E9, 79E9", [("SYN014", 5, 2)]), (GEOMETRIC + " 207E9, 79E9\n", [("SYN003", 5, 2)])),
        *((GEOMETRIC + " 1, 1, 1, 1, 1, , , , , , , 9", [("SYN003", 5, 2)]), (CURVE + " 1, 2, 3", [("SYN003", 5, 2)])),
        *(("*SEABED PROP", [("SYN014", 2, 1)]), ("*SEABED PROP\n", [("SYN009", 2, 1)]), ("*XYZ", [("SYN009", 2, 1)])),
    ],
)
def test_files_that_were_cut_off(text: str, found: list[Found]) -> None:
    assert problems(MODEL + text) == found


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (GEOMETRIC + " 207E9, 79,6E9, 0,2191, 0.19, 7850\n", [("SYN015", 5, 9)]),
        (SEABED + " FRICTION=0,5, 0,8\n", [("SYN015", 5, 11)]),
        (SEABED + " FRICTION=0,5\n", []),
        (SEABED + " FRICTION=0.5,0, 3,1\n", []),
        (SEABED + " FRICTION=0,5,0, 8\n", []),
        ("*NODE\n 1, 0,0, 5\n", []),
        ("*NODE\n 1,0, 5,5\n", []),
        ("*ELEMENT SETS\n SET=a\n 1,2, 3,4, 5,6\n", []),
    ],
)
def test_commas_without_a_blank_among_others(text: str, found: list[Found]) -> None:
    assert problems(MODEL + text) == found


def test_severities() -> None:
    text = "x\n$MODEL\n*OCEAN\n 1,0, 2,0\nCx\n*NEW THING\n*HYDRODYNAMIC SET\n$NEW\n$LOADCASE\n"
    deck = deck_of(text)
    found = [(one.code, one.severity.value) for one in deck.diagnose(deck.problems)]
    wanted = "SYN011 info, SYN015 warning, SYN013 warning, SYN009 info, SYN009 warning, SYN010 info, SYN010 warning"
    assert ", ".join(f"{code} {severity}" for code, severity in found) == wanted


@pytest.mark.parametrize(
    ("text", "word"),
    [
        *((MODEL + SEABED + " STIFNESS=1\n", "did you mean STIFFNESS?"), ("$LOADCASE\n", "did you mean LOAD CASE?")),
        *((MODEL + "*EMBEDMNT\n", "did you mean EMBEDMENT?"), (MODEL + "*BOUNDARY\n", "it belongs in $LOAD CASE")),
        *((MODEL + "*OCEAN\n 1e400\n", "too large"), (MODEL + "*OCEAN\n NaN\n", "not a finite number")),
        *((MODEL + "*ELEMENT SETS\n SET=a\n Tie-in\n", "{Tie-in}"), (MODEL + CURVE + " 0,5, 1,5\n", "write 0.5")),
        (MODEL + "*OCEAN\n 1,2,3,4,5\n", "depth [, density] [, gravity] [, viscosity]"),
    ],
)
def test_messages_say_what_to_do(text: str, word: str) -> None:
    assert any(word in message for message in messages(text))


LIMIT = "needs a whole number of at most 2^53 (9007199254740992)"


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        ("*NODE\n 99999999999999999999, 0.5, 10.0\n", f"99999999999999999999 is too large: node {LIMIT}"),
        ("*NODE\n -1E300, 0.5, 10.0\n", f"-1E300 is too large: node {LIMIT}"),
        ("*NODE\n 3.5, 0.5, 10.0\n", "3.5 is not a whole number: node needs one"),
        ("*NODE\n GEN=1, 99999999999999999999\n", f"99999999999999999999 is too large: end {LIMIT}"),
        ("*NODE\n GEN=1, 2.5\n", "2.5 is not a whole number: end needs one"),
    ],
)
def test_words(lines: str, message: str) -> None:
    assert messages(f"$MODEL\n{lines}") == [message]
