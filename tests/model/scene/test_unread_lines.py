"""What is told of lines that are not read: names, files, equations and numbers whose meaning is certain."""

from __future__ import annotations

import pytest

from mudline.language.deck.loading import dump
from mudline.language.diagnostics import Diagnostic
from mudline.model.scene.model import resolve
from tests.helpers.builders.scenes import deck_of, diagnostics, scene_of

MODEL = """$PREPROCESSOR
*PARAMETERS
 Ks, 2.0
$MODEL
*NODE
 1, 0.0, 0.0
 2, 0.0, 1.0
*ELEMENT
 1, 1, 2
*ELEMENT SETS
 SET=Riser
 1
*MOMENT-CURVATURE
 CURVE=Bend
 0.0, 0.0
 1.0, 0.1
*VESSEL,INTEGRATED
 VESSEL=Semi
 INITIAL POSITION=0.0, 0.0, 0.0
"""
_NOT_READ = "; the line is not read"


def told(text: str) -> list[str]:
    return _told(diagnostics(scene_of(MODEL + text)))


def _told(found: list[Diagnostic]) -> list[str]:
    own = [one for one in found if one.message.endswith(_NOT_READ)]
    assert all(one.severity.value == "warning" for one in own)
    return [f"{one.code} {one.message.removesuffix(_NOT_READ).split(':')[0]}" for one in own]


# -------------------------------------------------------------------------------------------------------------- vessels


@pytest.mark.parametrize(
    ("lines", "found"),
    [
        (" 2, Sami\n", ["REF019 vessel 'Sami' is not defined (did you mean Semi?)"]),
        (" 2, Semi, 3\n {Top}, Semi\n =[Ks], Semi\n", []),
        (" 7, Semi\n", ["REF006 node 7 is not defined"]),
        (" 7, 3, Sami\n", ["REF006 node 7 is not defined", "REF019 vessel 'Sami' is not defined (did you mean Semi?)"]),
        (" VESSEL=Semi\n 7, 3\n", ["REF006 node 7 is not defined"]),
        (" 2, 3\n TYPE=FILE\n 7, Sami\n", []),
    ],
)
def test_node_and_vessel_of_a_condition(lines: str, found: list[str]) -> None:
    assert told(f"$LOAD CASE\n*BOUNDARY\n TYPE=VESSEL\n{lines}") == found


def test_lines_of_a_block_that_has_an_error_too() -> None:
    faulty = "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1, 2, 3, 4\n TYPE=VESSEL\n 1, =[p]\n 7, Semi\n"
    found = diagnostics(scene_of(MODEL + faulty))
    first = MODEL.count("\n") + 4  # the line with an error of reading
    assert [(one.code, one.line, one.column) for one in found] == [("REF013", first + 2, 5), ("REF006", first + 3, 2)]


# --------------------------------------------------------------------------------------------------------------- curves


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("SET=Riser, CURVE=Bent", ["REF002 curve 'Bent' is not defined (did you mean Bend?)"]),
        ("12, 13, CURVE=Damp", ["REF002 curve 'Damp' is not defined"]),
        ("{Top}, CURVE=Damp", ["REF002 curve 'Damp' is not defined"]),
        ("GEN=1, 5, CURVE=Damp", ["REF002 curve 'Damp' is not defined"]),
        ("VESSEL=Semi, CURVE=Damp", ["REF002 curve 'Damp' is not defined"]),
        ('SET=Riser, CURVE="bend"', []),
        ("SET=Riser, CURVE=", []),
        ("SET=Riser, CURVE==[Ks]", []),
        ("CURVE=Damp", []),  # it may define it
        ("CURVE=Damp, SET=Riser", []),
        ("Steel, CURVE=Damp", []),
        ("TYPE=LINEAR, CURVE=Damp", []),
    ],
)
def test_a_curve_that_a_line_uses(line: str, found: list[str]) -> None:
    assert told(f"*COATINGS\n {line}\n") == found
    assert told(f"$LOAD CASE\n*WIND\n {line}\n") == found


@pytest.mark.parametrize(
    "other",
    [
        "*STIFFENER\n CURVE=Damp\n 1.0, 2.0\n",
        "*DAMPER\n NAME = damp , TYPE=LINEAR\n",
        "*DAMPER\n Damp  1.0\n",
        '*DAMPER\n 1, "Damp", 3.0\n',
        "*NEW KEYWORD\n CURVE=Damp\n",
        "*DAMPER DATA\n NAME=Damp\n 0.0, 0.0\n 1.0, 1.0\n",
        "*DAMPER DATA\n CURVE=Damp\n 0.0, 0.0\n 1.0, 1.0\n",
        "*SEABED STIFFNESS\n CURVE=damp\n 0.0, 0.0\n 1.0, 1.0\n",
        "$LOAD CASE\n*RESTART\n LAST=before\n",
    ],
)
def test_another_line_may_define_it(other: str) -> None:
    assert told(f"*COATINGS\n SET=Riser, CURVE=Damp\n{other}") == []


# --------------------------------------------------------------------------------------- sets, vessels, files, values


@pytest.mark.parametrize("other", ["*DAMPER\n 1, CURVE=Damp\n", "*DAMPER\nC CURVE=Damp\n", "*DAMPER\n CURVE=Damper\n"])
def test_uses_comments_and_parts_of_names_define_none(other: str) -> None:
    assert "REF002 curve 'Damp' is not defined" in told(f"*COATINGS\n SET=Riser, CURVE=Damp\n{other}")[0]


@pytest.mark.parametrize(
    ("block", "found"),
    [
        ("$MODEL\n*COATINGS\n SET=Risser\n", ["REF001 set 'Risser' is not defined (did you mean Riser?)"]),
        (
            "$DATABASE POSTPROCESSING\n*ELEMENT SET\n SET=Hots\n 1\n*STATISTICS\n SET=Hott\n",
            ["REF001 set 'Hott' is not defined (did you mean Hots?)"],
        ),
        ("$DATABASE POSTPROCESSING\n*ELEMENT SET\n SET=Hot\n 1\n*STATISTICS\n SET=hot\n SET=riser\n", []),
        ("$DATABASE POSTPROCESSING\n*ELEMENT SETS\n set = Hot\n 1\n*STATISTICS\n SET=Hot\n", []),
        ("$LIFETIME FATIGUE\n*HOT SPOT SETS\n SET=Hot\n", []),
        ("$LOAD CASE\n*RESTART\n LAST=before\n*WIND\n SET=a, VESSEL=b\n", []),
        ("$LOAD CASE\n*WIND\n VESSEL=Sami\n", ["REF019 vessel 'Sami' is not defined (did you mean Semi?)"]),
        ("*TENSIONER\n 1, -12O0.5E3, l.5\n", ["SYN002 '-12O0.5E3' is not a number"]),
        ("*GUIDE\n LENGTH=1O.0, NAME=1O.0, FILE=2.o\n 2.O, O.O, v1.O1, 1.O.0, 1O\n", ["SYN002 '1O.0' is not a number"]),
        ("*NEW KEYWORD\n 12O0.0\n", []),
        ("*FLEX JOINTS\n 1, =[2*Ks\n", ["SYN006 =[ is not closed"]),
        ('*TITLE\n a {b, "c, [d\n', []),
    ],
)
def test_other_slips(block: str, found: list[str]) -> None:
    assert told(block) == found


@pytest.mark.parametrize("kind", ["SOFT CLAY", "SAND"])
def test_soil_of_a_type_that_is_not_public_is_passed_through(kind: str) -> None:
    rows = " SET=Riser\n DEPTH=0.0\n 10.0\n SET=Riser\n 5.0, 6.0, 7.0\n"
    assert diagnostics(scene_of(f"{MODEL}*P-Y\n TYPE={kind}\n{rows}")) == []
    scene = scene_of(f"{MODEL}*P-Y\n TYPE={kind}\n{rows} SET=Rizer\n TYPE=USER\n SET=Risser\n DEPTH=0.0\n 0.0, 0.0\n")
    codes = [f"{one.severity.value} {one.code}" for one in diagnostics(scene)]
    assert codes == ["warning REF001", "error REF001", "error CRV001"]


# ------------------------------------------------------------------------------------------------------------ documents


PARTLY = """*CABLE
 CABLE=a
 TYPE=OTHER, SET=Rizer
C CURVE=Damp
 SET=Riser, CURVE=Damp
*P-Y
 TYPE=SAND
 SET=Rizer, 1O.0
 TYPE=USER
 SET=Riser
 DEPTH=0.0
 0.0, 0.0
 1.0, 1.0
 OTHER==[Kss]
"""


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_lines_that_a_document_keeps_are_looked_at(form: str) -> None:
    deck = deck_of(MODEL + PARTLY)
    wanted = diagnostics(resolve(deck))
    document = deck_of(dump(deck, form), f"deck.{form}")
    found = diagnostics(resolve(document))
    assert len(_told(wanted)) == 4
    assert [(one.code, one.message) for one in found] == [(one.code, one.message) for one in wanted]
    lines = dump(deck, form).splitlines()
    for one in found:
        if one.message.endswith(_NOT_READ):
            assert "Rizer" in lines[one.line - 1] or "Damp" in lines[one.line - 1]
