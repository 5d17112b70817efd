"""One cause, one finding: a fault is recovered from where it is found, and all checks see the recovered deck."""

from __future__ import annotations

from pathlib import Path

import pytest

from mudline.checks.engine import Fixing, LintSettings, lint_bytes, named_causes
from mudline.checks.fixing import lint_one
from mudline.checks.output import form_module
from mudline.checks.registry import rules, select
from mudline.language.deck.loading import load_bytes
from mudline.language.diagnostics import Diagnostic, Severity
from mudline.model.scene.model import resolve

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


SECTION = DECK[DECK.index(" SET=ALL\n 1.0E8") : DECK.index("*SEABED STIFFNESS")]


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


CAUSES = {
    "a misspelt *ELEMENT": (("*ELEMENT\n", "*ELEMNT\n"), "SYN009", 8),
    "a misspelt *NODE": (("*NODE\n", "*NODS\n"), "SYN009", 4),
    "a misspelt *ELEMENT SETS": (("*ELEMENT SETS\n", "*ELEMENT SET\n"), "SYN008", 11),
    "a misspelt *SEABED STIFFNESS": (("*SEABED STIFFNESS\n", "*SEABED STIFFNES\n"), "SYN009", 19),
    "a misspelt *GEOMETRIC SETS": (("*GEOMETRIC SETS\n", "*GEOMETRIC SET\n"), "SYN009", 16),
    "a misspelt GEN=": ((" GEN=1, 11\n", " GN=1, 11\n"), "SYN004", 7),
    "no $MODEL": (("$MODEL\n", ""), "SYN007", 1),
    "no *NODE": (("*NODE\n", ""), "SYN001", 4),
    "no *ELEMENT": (("*ELEMENT\n", ""), "REF007", 8),
    "no *ELEMENT SETS": (("*ELEMENT SETS\n", ""), "SYN004", 11),
    "no *SEABED STIFFNESS": (("*SEABED STIFFNESS\n", ""), "SYN004", 19),
    "no *SEABED PROPERTIES": (("*SEABED PROPERTIES\n", ""), "SYN004", 26),
    "a broken number of a node": ((" 1, -0.05, 0.0\n", " 1x, -0.05, 0.0\n"), "SYN002", 5),
    "a broken GEN= of nodes": ((" GEN=1, 11\n", " GEN=1, l1\n"), "SYN002", 7),
}


@pytest.mark.parametrize(("change", "code", "line"), CAUSES.values(), ids=CAUSES)
def test_a_fault_gives_the_one_finding_that_names_it(change: tuple[str, str], code: str, line: int) -> None:
    one = only(changed(change))
    assert (one.code, one.line, one.following) == (code, line, ())


PLAIN = {
    "no $MODEL behind $PREPROCESSOR": (("$MODEL\n", "$PREPROCESSOR\n*PARAMETERS\n od, 0.3\n"), "SYN008", 4),
    "no $LOAD CASE": (("$LOAD CASE\n", ""), "SYN008", 34),
    "no *NODE below a second $MODEL": (("*ELEMENT\n", "$MODEL\n"), "SYN011", 9),
    "points before their CURVE=": ((" CURVE=Clay\n", ""), "SYN001", 20),
    "an empty SET=": ((" SET=Left\n 1,", " SET=\n 1,"), "SYN003", 12),
    "a row without SET= above it": ((" SET=Right\n STIFF", " STIFF"), "SYN001", 31),
    "a row of another option": ((SECTION, " SET=ALL\n 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"), "SYN003", 18),
    "a name before a point": ((" 0.5, 20000.0\n", " Clay, 0.5, 20000.0\n"), "SYN003", 22),
}
"""Faults that nothing is known to correct: each has its finding, and there may be others."""


@pytest.mark.parametrize(("change", "code", "line"), PLAIN.values(), ids=PLAIN)
def test_a_fault_without_a_correction_is_found_at_its_place(change: tuple[str, str], code: str, line: int) -> None:
    assert (code, line) in {(one.code, one.line) for one in found(changed(change))}


@pytest.mark.parametrize("change", [change for change, _, _ in CAUSES.values()], ids=CAUSES)
def test_a_deck_that_is_refused_is_refused_with_the_cause(change: tuple[str, str]) -> None:
    deck = load_bytes(changed(change).encode(), "deck.keyxm")
    refused = deck.diagnose(resolve(deck).blocking())
    if refused:
        assert named_causes(deck, refused) == [only(changed(change))]


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


def test_a_warning_is_an_error_where_the_deck_as_written_is_illegal() -> None:
    row = " 1.0E8, 1.0E8, 8.0E7, 3.5E9, 130.0, 0.0, 0.2889, 0.3239, 0.3239, 0.3239\n"
    text = changed((" SET=ALL\n" + row, " OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0,3239, 0.2889, 7850.0\n"))
    assert not load_bytes(text.encode(), "deck.keyxm").errors()
    (one,) = found(text)
    assert (one.code, one.severity, one.blocks) == ("SYN015", Severity.ERROR, True)


def test_decimal_commas_of_a_row_with_too_many_fields_are_an_error() -> None:
    (one,) = found(changed((" 0.5, 20000.0\n", " 0,5, 20000,5\n")))
    assert (one.code, one.severity) == ("SYN015", Severity.ERROR)
    assert one.fix is not None
    assert [edit.text for edit in one.fix.edits] == ["0.5, 20000.5"]


def test_the_severity_of_the_configuration_holds_for_the_cause() -> None:
    text = changed(("*NODE\n", "*NODS\n")).encode()
    mild = LintSettings(tuple(rules()), severities={"SYN009": Severity.INFO})
    (one,) = lint_one("deck.keyxm", text, mild).found
    assert (one.code, one.severity) == ("SYN009", Severity.INFO)


def test_a_refused_deck_is_refused_with_the_cause() -> None:
    deck = load_bytes(changed(("*NODE\n", "*NODS\n")).encode(), "deck.keyxm")
    refused = deck.diagnose(resolve(deck).blocking())
    assert [one.code for one in refused] == ["REF006"] * 3
    assert [(one.code, one.line) for one in named_causes(deck, refused)] == [("SYN009", 4)]


def test_a_proposed_line_ends_as_those_of_the_file() -> None:
    (one,) = (one for one in found(changed(("*NODE\n", "")).replace("\n", "\r\n")) if one.code != "STY006")
    assert one.fix is not None
    assert [edit.text for edit in one.fix.edits] == ["*NODE\r\n"]


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
    cable = "*CABLE\n 1, 1, 11, 100.0\n*NODE,CURVILINEAR\n 1, 1, 0.0\n 11, 1, 100.0\n CURV=1, 11, CABLE=1\n"
    one = only(changed((nodes, cable)))
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
    written = "".join(form_module(form).write(found(text), ["deck.keyxm"]))
    assert "SYN009" in written
    assert "REF006" not in written


@pytest.mark.parametrize(
    "above",
    [
        "*MOMENT-CURVATURE\n CURVE=Bend\n 0.0, 0.0\n 0.01, 5000.0\n",
        "*LINES\n LINE=abc\n 1.0, 2.0\n",
    ],
)
def test_curves_that_the_block_above_can_have_are_those_that_the_deck_lacks(above: str) -> None:
    text = changed(("*SEABED STIFFNESS\n", above))
    errors = [one for one in found(text) if one.severity is Severity.ERROR]
    line = text[: text.index(" CURVE=Clay")].count("\n") + 1
    assert [(one.line, one.code) for one in errors] == [(line, "SYN001")]
    assert "*SEABED STIFFNESS" in errors[0].message


def test_a_curve_that_its_own_kind_uses_stays_where_it_is() -> None:
    text = changed(
        ("*SEABED STIFFNESS\n", "*MOMENT-CURVATURE\n"),
        (" SET=ALL\n 1.0E8, 1.0E8,", " SET=ALL, EIYY=Clay, EIZZ=Sand\n , ,"),
    )
    assert {"REF002"} <= {one.code for one in found(text)}
