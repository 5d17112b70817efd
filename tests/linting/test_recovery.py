"""One cause, one finding: a fault is recovered from where it is found, and all checks see the recovered deck."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mudline.deck.loading import load_bytes
from mudline.diagnostics import Diagnostic, Severity
from mudline.linting.engine import Fixing, LintSettings, lint_bytes, named_causes
from mudline.linting.fixing import lint_one
from mudline.linting.output import LintRun, form_module
from mudline.linting.registry import rules, select
from mudline.scene.model import resolve
from tests.cli.runner import run

DECK = """\
$MODEL
*OCEAN
 500.0, 1025.0, 9.81
*NODE
 1, -0.05, 0.0
 11, -0.05, 100.0
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=Left
 1, 2, 3, 4, 5
 SET=Right
 6, 7, 8, 9, 10
*GEOMETRIC SETS
 SET=ALL
 1.0E8, 1.0E8, 8.0E7, 3.5E9, 130.0, 0.0, 0.2889, 0.3239, 0.3239, 0.3239
*SEABED STIFFNESS
 CURVE=Clay
 0.0, 0.0
 0.5, 20000.0
 CURVE=Sand
 0.0, 0.0
 0.5, 40000.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Left
 STIFFNESS=Clay
 FRICTION=0.3, 0.5
 SET=Right
 STIFFNESS=Sand
 FRICTION=0.3, 0.5
$LOAD CASE
*ANALYSIS TYPE
 TYPE=STATIC
*BOUNDARY
 TYPE=CONSTANT
 1, 1
 1, 2
 11, 3
"""


def changed(*changes: tuple[str, str]) -> str:
    text = DECK
    for old, new in changes:
        assert text.count(old) >= 1, old
        text = text.replace(old, new, 1)
    return text


def found(text: str, name: str = "deck.keyxm") -> list[Diagnostic]:
    return lint_bytes(text.encode(), name, rules())


def only(text: str) -> Diagnostic:
    (one,) = found(text)
    return one


def test_the_deck_without_a_fault_is_clean() -> None:
    assert found(DECK) == []


CAUSES = {
    "a misspelt *ELEMENT": (("*ELEMENT\n", "*ELEMNT\n"), "SYN009", 8),
    "a misspelt *NODE": (("*NODE\n", "*NODS\n"), "SYN009", 4),
    "a misspelt *ELEMENT SETS": (("*ELEMENT SETS\n", "*ELEMENT SET\n"), "SYN008", 11),
    "a misspelt *SEABED STIFFNESS": (("*SEABED STIFFNESS\n", "*SEABED STIFFNES\n"), "SYN009", 19),
    "a misspelt *GEOMETRIC SETS": (("*GEOMETRIC SETS\n", "*GEOMETRIC SET\n"), "SYN009", 16),
    "a misspelt GEN=": ((" GEN=1, 11\n", " GN=1, 11\n"), "SYN004", 7),
    "no $MODEL": (("$MODEL\n", ""), "SYN007", 1),
    "no $MODEL behind $PREPROCESSOR": (("$MODEL\n", "$PREPROCESSOR\n*PARAMETERS\n od, 0.3\n"), "SYN008", 4),
    "no $LOAD CASE": (("$LOAD CASE\n", ""), "SYN008", 34),
    "no *NODE": (("*NODE\n", ""), "SYN001", 4),
    "no *ELEMENT": (("*ELEMENT\n", ""), "REF007", 8),
    "no *ELEMENT SETS": (("*ELEMENT SETS\n", ""), "SYN004", 11),
    "no *SEABED STIFFNESS": (("*SEABED STIFFNESS\n", ""), "SYN004", 19),
    "no *SEABED PROPERTIES": (("*SEABED PROPERTIES\n", ""), "SYN004", 26),
    "a broken number of a node": ((" 1, -0.05, 0.0\n", " 1x, -0.05, 0.0\n"), "SYN002", 5),
    "a broken GEN= of nodes": ((" GEN=1, 11\n", " GEN=1, l1\n"), "SYN002", 7),
    "points before their CURVE=": ((" CURVE=Clay\n", ""), "SYN001", 20),
    "points above their CURVE=": (
        (" CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n", " 0.0, 0.0\n 0.5, 20000.0\n CURVE=Clay\n"),
        "SYN001",
        20,
    ),
    "an empty SET=": ((" SET=Left\n 1,", " SET=\n 1,"), "SYN003", 12),
}


@pytest.mark.parametrize(("change", "code", "line"), CAUSES.values(), ids=CAUSES)
def test_a_fault_gives_the_one_finding_that_names_it(change: tuple[str, str], code: str, line: int) -> None:
    one = only(changed(change))
    assert (one.code, one.line, one.following) == (code, line, ())


@pytest.mark.parametrize("change", [change for change, _, _ in CAUSES.values()], ids=CAUSES)
def test_a_deck_that_is_refused_is_refused_with_the_cause(change: tuple[str, str]) -> None:
    deck = load_bytes(changed(change).encode(), "deck.keyxm")
    refused = deck.diagnose(resolve(deck).blocking())
    if refused:
        assert named_causes(deck, refused, rules()) == [only(changed(change))]


SECOND = {
    "an element in a set": ((" 6, 7, 8, 9, 10\n", " 6, 7, 8, 9, 99\n"), ("REF005", 15)),
    "a curve that is not defined": (("STIFFNESS=Clay", "STIFFNESS=Mud"), ("REF002", 29)),
    "a set that is not defined": ((" SET=Right\n STIFF", " SET=Wrong\n STIFF"), ("REF001", 31)),
    "a diameter": (("0.3239, 0.3239, 0.3239", "0.3239, 0.3239, 0.1239"), ("GEO001", 18)),
    "a number": ((" 0.5, 40000.0\n", " 0.5, 4OOOO.0\n"), ("SYN002", 25)),
}
FIRST = ["a misspelt *ELEMENT", "a misspelt *NODE", "no *NODE", "no *ELEMENT", "a broken number of a node"]


@pytest.mark.parametrize("first", FIRST)
@pytest.mark.parametrize("second", SECOND)
def test_a_second_fault_stays_beside_the_first(first: str, second: str) -> None:
    change, code, line = CAUSES[first]
    other, (wanted, at) = SECOND[second]
    places = {(one.code, one.line) for one in found(changed(change, other))}
    at -= first in ("no *NODE", "no *ELEMENT")
    assert {(code, line), (wanted, at)} <= places


def test_what_is_found_beside_a_missing_line_is_told_of_the_deck_as_meant() -> None:
    fewer = (" 1, 2, 3, 4, 5\n", " 1, 2, 3, 4\n")
    assert [(one.code, one.line) for one in found(changed(fewer))] == [("SBD006", 10)]
    both = found(changed(fewer, ("*SEABED PROPERTIES\n", "")))
    assert [(one.code, one.line) for one in both] == [("SBD006", 10), ("SYN004", 26)]


TWICE = {
    "a keyword": ("*ELEMENT SETS", "*ELEMENT SETZ", ("SYN009", 11)),
    "a setting": (" STIFFNESS=", " STIFNESS=", ("SYN004", 29)),
    "the name of a set": ("SET=Left\n STIFFNESS=Clay", "SET=Lift\n STIFFNESS=Clay\n SET=Lift", ("REF001", 28)),
}


@pytest.mark.parametrize(("right", "wrong", "expected"), TWICE.values(), ids=TWICE)
def test_the_same_slip_twice_is_one_finding(right: str, wrong: str, expected: tuple[str, int]) -> None:
    text = DECK.replace(" SET=Right\n 6", "*ELEMENT SETS\n SET=Right\n 6") if right == "*ELEMENT SETS" else DECK
    causes = [each for each in found(text.replace(right, wrong)) if each.code == expected[0]]
    assert [(one.code, one.line) for one in causes] == [expected]
    assert "; the same in line " in causes[0].message
    assert causes[0].fix is not None
    assert len(causes[0].fix.edits) == 2


def test_two_slips_alike_are_two_findings() -> None:
    text = changed((" SET=Left\n STIFF", " SET=Lift\n STIFF"), (" SET=Right\n STIFF", " SET=Wright\n STIFF"))
    assert [one.line for one in found(text) if one.code == "REF001"] == [28, 31]


def test_a_name_below_its_points_is_to_be_moved() -> None:
    (one,) = found(changed((" CURVE=Clay\n 0.0, 0.0\n", " 0.0, 0.0\n CURVE=Clay\n")))
    assert one.message.startswith("CURVE=Clay in line 21 stands below its points: move it up")
    others = found(changed((" CURVE=Clay\n", " 0.0, 0.0\n 0.5, 900.0\n CURVE=Clay\n")))
    assert [(each.line, "move it up" in each.message) for each in others] == [(20, False)]


def test_a_missing_option_is_named() -> None:
    section = DECK[DECK.index(" SET=ALL\n 1.0E8") : DECK.index("*SEABED STIFFNESS")]
    pipe = " 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"
    (one,) = found(changed((section, f" SET=Left\n{pipe} SET=Right\n{pipe}")))
    assert (one.code, one.line) == ("SYN003", 18)
    assert one.message == "5 values are not FLEXIBLE's: OPTION=RIGID seems to be missing above line 17"


@pytest.mark.parametrize(("keyword", "line"), [("*ELEMENT", 9), ("*SEABED PROPERTIES", 27)])
def test_a_missing_first_keyword_of_a_section_is_named(keyword: str, line: int) -> None:
    text = DECK.replace(f"{keyword}\n", "$MODEL\n")
    one = only(text)
    assert (one.code, one.line) == ("SYN011", line)
    assert f"read as {keyword}: that line seems to be missing above them" in one.message


def test_a_title_below_a_section_is_no_keyword() -> None:
    (one,) = found(DECK.replace("$MODEL\n", "$MODEL\n Flowline 12, as laid\n"))
    assert one.message.startswith("1 line of $MODEL under no keyword")


def test_two_slips_are_two_findings() -> None:
    both = found(changed(("*ELEMENT\n", "*ELEMNT\n"), ("*SEABED STIFFNESS\n", "*SEABED STIFFNES\n")))
    assert [(one.code, one.line) for one in both] == [("SYN009", 8), ("SYN009", 19)]


def test_what_follows_is_not_left_out_where_its_cause_is_not_reported() -> None:
    text = changed(("*NODE\n", "*NODS\n"))
    chosen = select(["REF006"])
    lacking = lint_bytes(text.encode(), "deck.keyxm", chosen)
    assert [(one.line, [each.line for each in one.following]) for one in lacking] == [(9, []), (9, [10])]
    suppressed = text.replace("*NODS\n", "C mudline: ignore SYN009\n*NODS\n")
    assert {one.code for one in found(suppressed)} >= {"REF006"}


def test_numbers_that_fit_another_keyword_of_the_deck_are_not_taken_for_its_lines() -> None:
    text = changed((" 0.5, 20000.0\n", " 1, 20000.0, 5\n 2, 30000.0, 6\n"))
    assert not any("seems to be missing" in one.message for one in found(text))


def test_a_row_that_stays_wrong_is_no_cause() -> None:
    codes = [one.code for one in found(changed((" 0.5, 20000.0\n", " 0,5, 20000,5\n")))]
    assert "SYN015" in codes
    assert "SYN003" in codes


def test_the_severity_of_the_configuration_holds_for_the_cause() -> None:
    text = changed(("*NODE\n", "*NODS\n")).encode()
    mild = LintSettings(tuple(rules()), severities={"SYN009": Severity.INFO})
    (one,) = lint_one("deck.keyxm", text, mild).found
    assert (one.code, one.severity) == ("SYN009", Severity.INFO)


def test_a_refused_deck_is_refused_with_the_cause() -> None:
    deck = load_bytes(changed(("*NODE\n", "*NODS\n")).encode(), "deck.keyxm")
    refused = deck.diagnose(resolve(deck).blocking())
    assert [one.code for one in refused] == ["REF006"] * 3
    assert [(one.code, one.line) for one in named_causes(deck, refused, rules())] == [("SYN009", 4)]


def test_a_missing_line_is_named() -> None:
    assert only(changed(("*NODE\n", ""))).message.startswith("this line and those below it read as *NODE: ")
    assert only(changed(("$MODEL\n", ""))).message.startswith("the line $MODEL is missing above this one: ")


@pytest.mark.parametrize("name", ["deck.keyxm", "deck.keyx"])
@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_line_ends_and_units_change_nothing(name: str, end: str) -> None:
    for change, code, line in CAUSES.values():
        told = [one for one in found(changed(change).replace("\n", end), name) if one.code != "STY006"]
        assert (code, line) in [(one.code, one.line) for one in told]
        assert len(told) == 1 or name == "deck.keyx"


def test_a_fix_is_made_as_before() -> None:
    text = changed(("*NODE\n", "*NODS\n"))
    result = lint_one("deck.keyxm", text.encode(), LintSettings(tuple(rules()), fixing=Fixing.UNSAFE))
    assert result.changed == DECK.encode()
    assert result.found == ()


# ---------------------------------------------------------------------------------------------- what to write instead


@pytest.mark.parametrize("mark", ["#", "//", "!", ";", "--"])
def test_a_comment_of_another_program_is_named(mark: str) -> None:
    one = only(changed(("*NODE\n", f"*NODE\n{mark} the nodes, as laid\n")))
    assert one.message == f"'{mark} the nodes, as laid' is read as data: begin a comment with C and a space"
    assert (one.line, one.column) == (5, 1)


def test_the_table_of_an_interface_is_named() -> None:
    table = "*EMBEDMENT\n Left, 0.1, 1000\n Left, 0.2, 2000\n Right, 0.1, 1500\n Right, 0.2, 2500\n"
    curves = DECK[DECK.index("*SEABED STIFFNESS") : DECK.index("$LOAD CASE")]
    text = changed((curves, "*ELASTIC SURFACE\n 50000.0, 0.3, 0.5\n" + table))
    (one,) = (each for each in found(text) if each.severity is Severity.ERROR)
    assert (one.code, one.line) == ("SYN003", 22)
    assert one.message.endswith("write SET=Left on a line of its own, and 0.1, 1000 below it")


def test_hints_of_a_setting_say_what_to_write() -> None:
    (empty,) = found(changed((" SET=Left\n STIFF", " SET=\n STIFF")))
    assert empty.message == "SET= has no value: write the name of a set after it (ALL is every element)"
    by_set = found(changed((" CURVE=Clay\n", " SET=Left\n")))
    assert "name the curve by CURVE= here, and give it to the set in STIFFNESS=" in by_set[0].message


def test_a_setting_of_another_name_is_no_row() -> None:
    (one,) = (each for each in found("$MODEL\n*SEABED UNLOADING\n SET=ALL\n KU=4E5\n") if each.code == "SYN004")
    assert one.message == "*SEABED UNLOADING has no setting KU=: it takes SET=, STIFFNESS="


def test_nodes_out_of_sight_are_one_info() -> None:
    nodes = DECK[DECK.index("*NODE") : DECK.index("*ELEMENT\n")]
    one = only(changed((nodes, "*CABLE\n 1, 1, 11, 100.0\n*NODE,CURVILINEAR\n 1, 1, 0.0\n 11, 1, 100.0\n")))
    assert (one.code, one.severity, one.line, one.blocks) == ("REF006", Severity.INFO, 6, True)
    assert "*NODE,CURVILINEAR may define nodes that this deck does not show" in one.message


def test_files_are_looked_for_once_more(tmp_path: Path) -> None:
    (tmp_path / "static.keyxm").write_text(DECK, encoding="utf-8")
    text = "$LOAD CASE\n*RESTRAT\n LAST=static\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n*TIME\n STEP=FIXED\n 0, 10, 0.1\n"
    (one, *_) = lint_bytes(text.encode(), "dynamic.keyxm", rules(), folder=tmp_path)
    assert one.code == "SYN009"


@pytest.mark.parametrize("form", ["concise", "json", "jsonl", "github", "gitlab", "junit", "sarif"])
def test_what_follows_is_in_no_output(form: str) -> None:
    text = changed(("*NODE\n", "*NODS\n"))
    written = "".join(form_module(form).write(found(text), LintRun(["deck.keyxm"], "1.0")))
    assert "SYN009" in written
    assert "REF006" not in written


# ------------------------------------------------------------------------------- findings about rows, values and copies

NODES = DECK[DECK.index("*NODE") : DECK.index("*ELEMENT\n")]
ROWS = "*NODE\n" + "".join(f" {number}, -0.05, {10.0 * number - 10.0}\n" for number in range(1, 12))
LISTED = DECK.replace(NODES, ROWS)
CURVE = " CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n"
POINTS = " CURVE=Clay\n 1, 0.0, 0.0\n 2, 0.1, 8000.0\n 3, 0.3, 15000.0\n 4, 0.5, 20000.0\n"
SECTION = " SET=ALL\n 1.0E8, 1.0E8, 8.0E7, 3.5E9, 130.0, 0.0, 0.2889, 0.3239, 0.3239, 0.3239\n"
STEEL = " OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"


def summary(text: str, name: str = "deck.keyxm") -> list[tuple[str, int, int]]:
    return [(one.code, one.line, len(one.following)) for one in found(text, name)]


def test_the_decks_without_a_fault_are_clean() -> None:
    assert found(LISTED) == []
    assert found(changed((SECTION, STEEL))) == []


def test_the_same_fault_in_row_after_row_is_one_finding() -> None:
    (one,) = (each for each in found(changed((CURVE, POINTS))) if each.code == "SYN003")
    assert one.message == (
        "3 fields, expected 2 (`ratio, force`); and 3 more rows of this block (2, 3, 4), the last in line 24"
    )
    assert (one.line, [each.line for each in one.following]) == (21, [22, 23, 24])


def test_two_rows_may_each_have_a_fault() -> None:
    text = changed((CURVE, "".join(POINTS.splitlines(keepends=True)[:3])))
    assert [one.line for one in found(text) if one.code == "SYN003"] == [21, 22]


def test_rows_of_which_something_else_is_said_are_apart() -> None:
    wrong = [" 0.1x, 1.0\n", " O.2, 2.0\n", " 0..3, 3.0\n", " --0.4, 4.0\n"]
    text = changed((CURVE, " CURVE=Clay\n 0.0, 0.0\n" + "".join(wrong) + " 0.5, 20000.0\n"))
    assert [one.line for one in found(text) if one.code == "SYN002"] == [22, 23, 24, 25]


def test_the_fields_of_a_heading_are_one_finding() -> None:
    (one,) = found(LISTED.replace("*NODE\n", "*NODE\n Node, X, Y\n"))
    assert (one.code, one.line, len(one.following)) == ("SYN002", 5, 2)
    assert one.message.endswith("; and 2 more fields of this row")


def test_values_of_a_misread_row_are_not_judged() -> None:
    text = changed((SECTION, STEEL.replace("207.0E9, 79.6E9", "207.0E9 79.6E9")))
    (one,) = found(text)
    assert (one.code, one.line) == ("SYN003", 19)


def test_what_can_be_said_without_an_unknown_value_is_told() -> None:
    wrong = STEEL.replace("0.3239, 0.2889, 7850.0", "0.3239, 0.4889, 785O.0")
    assert told(changed((SECTION, wrong))) == [("GEO001", 19), ("SYN002", 19)]
    forces = " CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n 0.5, 30000.0\n 0.7, 3OOOO.0\n"
    assert told(changed((CURVE, forces))) == [("CRV003", 23), ("SYN002", 24)]


def test_decimal_commas_are_recovered_from_and_the_deck_stays_illegal(tmp_path: Path) -> None:
    law = (" FRICTION=0.3, 0.5\n SET=Right", " FRICTION=0,3, 0,5\n SET=Right")
    text = changed((SECTION, STEEL.replace("79.6E9, 0.3239, 0.2889", "79,6E9, 0,3239, 0,2889")), law)
    assert told(text) == [("SYN015", 19), ("SYN015", 31)]
    deck = tmp_path / "deck.keyxm"
    deck.write_text(text, encoding="utf-8")
    assert "illegal" in run("validate", str(deck)).out
    settings = LintSettings(tuple(rules()), fixing=Fixing.UNSAFE)
    assert lint_one("deck.keyxm", text.encode(), settings).changed == changed((SECTION, STEEL)).encode()


def test_a_setting_that_stands_twice_lacks_the_name_of_its_set() -> None:
    one = only(DECK.replace(" SET=Right\n STIFF", " STIFF"))
    assert (one.code, one.line) == ("SYN001", 31)
    assert one.message.endswith("a line SET= seems to be missing above this one")


def test_the_one_curve_that_nothing_uses_is_named_where_one_is_not_defined() -> None:
    one = only(changed(("STIFFNESS=Clay", "STIFFNESS=Silt")))
    assert (one.code, one.line) == ("REF002", 29)
    assert "(did you mean Clay, which nothing uses?)" in one.message


ONE_CAUSE = {
    "a keyword line without its star": (("*ELEMENT\n", "ELEMENT\n"), "SYN003", 16),
    "a number used twice": ((" 7, -0.05", " 6, -0.05"), "REF007", 11),
    "nodes pasted twice": ((ROWS, ROWS + ROWS), "REF007", 17),
    "a letter in a density": ((" 500.0, 1025.0", " 500.0, l025.0"), "SYN002", 3),
    "laws without their keyword line": (("*SEABED PROPERTIES\n TYPE", "*LINE PATHS\n x\n TYPE"), "SBD006", 36),
}


@pytest.mark.parametrize(("change", "code", "line"), ONE_CAUSE.values(), ids=ONE_CAUSE)
def test_a_slip_is_one_finding(change: tuple[str, str], code: str, line: int) -> None:
    assert LISTED.count(change[0]) == 1
    (one,) = (each for each in found(LISTED.replace(*change)) if each.severity != "info")
    assert (one.code, one.line) == (code, line)


def test_a_number_that_fits_no_neighbour_is_not_guessed() -> None:
    text = LISTED.replace(" 7, -0.05", " 3, -0.05").replace("*ELEMENT\n 1, 1, 2", "*ELEMENT\n 1, 1, 99")
    assert "is this one 99" not in "".join(one.message for one in found(text))


FALLING = " CURVE=Clay\n 0.0, 3000.0\n 0.1, 2000.0\n 0.5, 0.0\n"


def test_the_shape_of_a_curve_is_one_finding() -> None:
    assert summary(changed((CURVE, FALLING))) == [("CRV005", 22, 2)]
    far = " CURVE=Clay\n 0.0, 0.0\n 10.0, 800.0\n 0.2, 1200.0\n 0.5, 20000.0\n"
    assert [one[:2] for one in summary(changed((CURVE, far)))] == [("CRV010", 22)]


def test_two_softening_parts_of_a_curve_are_two_findings() -> None:
    text = " CURVE=Clay\n 0.0, 0.0\n 0.1, 3000.0\n 0.2, 2000.0\n 0.3, 5000.0\n 0.4, 4000.0\n 0.5, 9000.0\n"
    assert [one[:2] for one in summary(changed((CURVE, text)))] == [("CRV005", 23), ("CRV005", 25)]


def test_names_come_from_the_findings_and_not_from_their_words() -> None:
    text = changed((" SET=Left\n STIFF", " SET=O'Brien's\n STIFF"), (" SET=Left\n 1,", " SET=\n 1,"))
    assert [(one.code, one.line) for one in found(text)][:1] == [("SYN003", 12)]


# ------------------------------------------------------------------------------ names and numbers that are not defined

LONG = (
    DECK.replace("Left", "Riser")
    .replace("Right", "Flowline")
    .replace("Clay", "Soft Clay")
    .replace("Sand", "Dense Sand")
)
SURFACE = (
    DECK[: DECK.index("*SEABED STIFFNESS")]
    + "*ELASTIC SURFACE\n 0.0, 0.3, 0.5\n*EMBEDMENT\n SET=Left\n 0.0, 0.0\n 0.5, 20000.0\n SET=Right\n 0.0, 0.0\n"
    + " 0.5, 40000.0\n"
    + DECK[DECK.index("$LOAD CASE") :]
)


def told(text: str) -> list[tuple[str, int]]:
    return [(one.code, one.line) for one in found(text) if one.severity is not Severity.INFO]


MISSPELT = {
    "a set of a law": (LONG, " SET=Flowline\n STIFF", " SET=Flwline\n STIFF", ("REF001", 31)),
    "a set where it is defined": (LONG, " SET=Flowline\n 6", " SET=Flwline\n 6", ("REF001", 31)),
    "a curve": (LONG, "STIFFNESS=Dense Sand", "STIFFNESS=Dense Snad", ("REF002", 32)),
    "a curve where it is defined": (LONG, "CURVE=Dense Sand", "CURVE=Dense Sad", ("REF002", 32)),
    "a subset": (LONG, "10\n*GEO", "10\n SET=Line\n SUBSET=Risr\n*GEO", ("REF008", 17)),
    "another curve": (
        LONG.replace("*GEO", "*MOMENT-CURVATURE\n CURVE=Pipe\n 0.0, 0.0\n 5.0E4, 0.01\n*GEO").replace(
            " 1.0E8,", " ,", 1
        ),
        "*GEOMETRIC SETS\n SET=ALL",
        "*GEOMETRIC SETS\n SET=ALL, EIYY=Pipp",
        ("REF002", 21),
    ),
    "a set of a legacy curve": (SURFACE, " SET=Right\n 0.0", " SET=Rigth\n 0.0", ("REF001", 25)),
}


@pytest.mark.parametrize(("text", "right", "wrong", "expected"), MISSPELT.values(), ids=MISSPELT)
def test_a_misspelt_name_is_read_as_the_one_near_it(
    text: str, right: str, wrong: str, expected: tuple[str, int]
) -> None:
    assert text.count(right) == 1
    (one,) = (each for each in found(text.replace(right, wrong)) if each.severity is not Severity.INFO)
    assert (one.code, one.line) == expected
    assert one.fix is not None
    assert one.fix.applicability == "unsafe"


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        (" SET=Flowline\n STIFF", " SET=Flwline\n STIFF"),
        ("STIFFNESS=Dense Sand", "STIFFNESS=Dense Snad"),
        ("*ELEMENT SETS\n", "ELEMENT SETS\n"),
        ("*BOUNDARY\n", "BOUNDARY\n"),
    ],
)
def test_the_fix_of_a_recovered_name_is_made(right: str, wrong: str) -> None:
    settings = LintSettings(tuple(rules()), fixing=Fixing.UNSAFE)
    assert lint_one("deck.keyxm", LONG.replace(right, wrong).encode(), settings).changed == LONG.encode()


def test_of_two_names_equally_near_none_is_taken() -> None:
    other = " CURVE=Soft Clai\n 0.0, 0.0\n 0.5, 3000.0\n CURVE=Dense"
    text = LONG.replace(" CURVE=Dense", other).replace("STIFFNESS=Soft Clay", "STIFFNESS=Soft Claz")
    (one,) = found(text)
    assert (one.code, one.line, one.fix) == ("REF002", 32, None)
    assert "(did you mean soft clay or soft clai?)" in one.message.lower()


@pytest.mark.parametrize(("defined", "used"), [("Clay 1", "Clay 2"), ("Clay A", "Clay B"), ("Mud", "Mut")])
def test_names_that_tell_things_apart_are_not_near(defined: str, used: str) -> None:
    (one,) = found(
        LONG.replace("CURVE=Soft Clay", f"CURVE={defined}").replace("STIFFNESS=Soft Clay", f"STIFFNESS={used}")
    )
    assert (one.code, one.fix) == ("REF002", None)


def test_a_set_is_no_part_of_itself_because_of_a_name_near_it() -> None:
    text = LONG.replace(" 6, 7, 8, 9, 10\n", " 6, 7, 8, 9, 10\n SUBSET=Flowlin\n")
    assert told(text) == [("REF008", 16)]


@pytest.mark.parametrize(
    ("text", "line"), [(DECK.replace(" CURVE=Sand\n", ""), 23), (SURFACE.replace(" SET=Right\n 0", " 0"), 25)]
)
def test_points_that_begin_again_lack_their_name(text: str, line: int) -> None:
    (one,) = (each for each in found(text) if each.severity is not Severity.INFO)
    assert (one.code, one.line) == ("SYN001", line)
    assert "seems to be missing above this one" in one.message
    assert one.fix is not None


ROWS_OF_ELEMENTS = "".join(f" {number}, {number}, {number + 1}\n" for number in range(1, 11))
LISTED_ELEMENTS = DECK.replace(" 1, 1, 2\n GEN=1, 10\n", ROWS_OF_ELEMENTS)


def test_a_number_that_cannot_be_read_excuses_those_that_one_edit_of_it_gives() -> None:
    wrong = LISTED_ELEMENTS.replace(" 5, 5, 6\n", " S, 5, 6\n").replace(" 6, 7, 8, 9, 10\n", " 6, 7, 8, 9, 99\n")
    first, second = found(wrong)
    assert (first.code, first.line, second.code, second.line) == ("SYN002", 13, "REF005", 23)
    assert first.message.endswith("(did you mean 5?)")
    assert first.fix is not None
    both = wrong.replace(" 6, 6, 7\n", "").replace("99\n", "10\n")
    assert told(both) == [("SYN002", 13)]


def test_a_number_that_may_be_one_of_two_is_not_guessed() -> None:
    text = DECK.replace(" 1, 1\n 1, 2\n", " 21, 1\n 1, 2\n").replace(" 11, -0.05", " x1, -0.05")
    (one,) = (each for each in found(text) if each.code == "SYN002")
    assert one.fix is None
    assert "REF006" not in {each.code for each in found(text) if "21" in each.message}


# ---------------------------------------------------------------------------------------------- lines of other keywords

CAUSES_OF_LINES = {
    "a star before a word that may be a label": ("*GEOMETRIC SETS\n", "GEOMETRIC SETS\n", "SYN001", 16),
    "a star in a block that is passed through": ("*BOUNDARY\n", "BOUNDARY\n", "SYN001", 37),
    "a star before a word with C": (
        " TYPE=STATIC\n",
        " TYPE=STATIC\nCURRENT\n TYPE=UNIFORM\n 0.5, 180.0\n",
        "SYN013",
        37,
    ),
    "a star below $MODEL": ("*OCEAN\n", "OCEAN\n", "SYN011", 2),
    "a keyword of sections": ("*GEOMETRIC SETS\n", "", "SYN002", 17),
}


@pytest.mark.parametrize(("right", "wrong", "code", "line"), CAUSES_OF_LINES.values(), ids=CAUSES_OF_LINES)
def test_a_line_of_another_keyword_is_one_finding(right: str, wrong: str, code: str, line: int) -> None:
    (one,) = (each for each in found(DECK.replace(right, wrong, 1)) if each.code != "GEO008")  # of the current itself
    assert (one.code, one.line) == (code, line)
    assert (one.fix is None) == (wrong == "")


def test_a_line_that_several_keywords_can_have_names_them() -> None:
    law = "*SEABED UNLOADING\n SET=Left\n STIFFNESS=4E5\n"
    text = DECK.replace("*SEABED PROPERTIES\n", f"*OCEAN\n 500.0\n SET=Left\n STIFFNESS=4E5\n{law}*SEABED PROPERTIES\n")
    (one,) = (each for each in found(text) if each.severity is Severity.ERROR)
    assert one.message.startswith(
        "this line and those below it are of another keyword, *SEABED PROPERTIES or *SEABED UNL"
    )
    text = text.replace(law, "")
    (one,) = (each for each in found(text) if each.severity is Severity.ERROR)
    assert one.message.startswith("this line and those below it read as *SEABED UNLOADING")


def test_a_row_under_another_option_is_told_once() -> None:
    for option, line in ((" OPTION=FLEXIBLE\n", 19), ("", 18)):
        one = only(changed((SECTION, STEEL.replace(" OPTION=RIGID\n", option))))
        assert (one.code, one.line) == ("SYN003", line)
        assert "OPTION=RIGID" in one.message


# --------------------------------------------------------------------------------------------- what is not recovered


@pytest.mark.parametrize("command", ["validate", "evaluate"])
def test_other_commands_take_the_deck_as_it_is_written(command: str, tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(changed(("*NODE\n", "*NODS\n")), encoding="utf-8")
    done = run(command, str(deck), "-v") if command == "validate" else run(command, str(deck))
    assert done.code != 0
    assert ("REF006" if command == "validate" else "SYN009") in done.out + done.err


@pytest.mark.parametrize("command", ["study", "curves", "evaluate", "migrate"])
def test_a_refusal_names_the_causes(command: str, tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    text = SURFACE.replace("*ELEMENT SETS\n", "ELEMENT SETS\n").replace(" SET=Right\n 0", " SET=Rigth\n 0")
    deck.write_text(text, encoding="utf-8")
    done = run(command, str(deck))
    assert done.code != 0
    told_ = re.findall(r":([0-9]+):[0-9]+: \w+: ([A-Z]+[0-9]+) ", done.err)
    assert told_ == [("11", "SYN003"), ("25", "REF001")]


def test_a_keyword_whose_block_does_not_read_is_not_taken_for_another_one() -> None:
    text = changed(("*NODE\n", "*NODS\n"), (" 11, -0.05, 100.0\n", " 11, -0.05\n"))
    assert {"SYN009", "REF006"} <= {one.code for one in found(text)}


def test_a_value_that_cannot_be_read_stays_unknown() -> None:
    falling = " CURVE=Clay\n 0.0, 0.0\n 0.2, 9OO.0\n 0.5, 500.0\n 0.6, 600.0\n"
    assert [one.code for one in found(changed((CURVE, falling)))] == ["SYN002"]
