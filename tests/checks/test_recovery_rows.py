"""One cause, one finding: faults of rows, values and copies."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mudline.checks.engine import Fixing, LintSettings
from mudline.checks.fixing import lint_one
from mudline.checks.registry import rules
from mudline.language.diagnostics import Severity
from tests.checks.test_recovery import DECK, changed, found, only
from tests.cli.runner import run

NODES = DECK[DECK.index("*NODE") : DECK.index("*ELEMENT\n")]
ROWS = "*NODE\n" + "".join(f" {number}, -0.05, {10.0 * number - 10.0}\n" for number in range(1, 12))
LISTED = DECK.replace(NODES, ROWS)


CURVE = " CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n"
POINTS = " CURVE=Clay\n 1, 0.0, 0.0\n 2, 0.1, 8000.0\n 3, 0.3, 15000.0\n 4, 0.5, 20000.0\n"
SECTION = " SET=ALL\n 1.0E8, 1.0E8, 8.0E7, 3.5E9, 130.0, 0.0, 0.2889, 0.3239, 0.3239, 0.3239\n"
STEEL = " OPTION=RIGID\n SET=ALL\n 207.0E9, 79.6E9, 0.3239, 0.2889, 7850.0\n"


def summary(text: str, name: str = "deck.keyxm") -> list[tuple[str, int, int]]:
    return [(one.code, one.line, len(one.following)) for one in found(text, name)]


def test_the_same_fault_in_row_after_row_is_one_finding() -> None:
    (one,) = (each for each in found(changed((CURVE, POINTS))) if each.code == "SYN003")
    assert one.message == (
        "2 fields expected (`ratio, force`), found 3; and 3 more rows of this block (2, 3, 4), the last in line 24"
    )
    assert (one.line, [each.line for each in one.following]) == (21, [22, 23, 24])


def test_rows_of_which_something_else_is_said_are_apart() -> None:
    wrong = [" 0.1x, 1.0\n", " O.2, 2.0\n", " 0..3, 3.0\n", " --0.4, 4.0\n"]
    text = changed((CURVE, " CURVE=Clay\n 0.0, 0.0\n" + "".join(wrong) + " 0.5, 20000.0\n"))
    assert [one.line for one in found(text) if one.code == "SYN002"] == [22, 23, 24, 25]


def test_values_of_a_misread_row_are_not_judged() -> None:
    text = changed((SECTION, STEEL.replace("207.0E9, 79.6E9", "207.0E9 79.6E9")))
    (one,) = found(text)
    assert (one.code, one.line) == ("SYN003", 19)


def test_what_can_be_said_without_an_unknown_value_is_told() -> None:
    wrong = STEEL.replace("0.3239, 0.2889, 7850.0", "0.3239, 0.4889, 785O.0")
    assert told(changed((SECTION, wrong))) == [("GEO001", 19), ("SYN002", 19)]
    forces = " CURVE=Clay\n 0.0, 0.0\n 0.5, 20000.0\n 0.5, 30000.0\n 0.7, 3OOOO.0\n"
    assert told(changed((CURVE, forces))) == [("CRV003", 23), ("SYN002", 24)]


def test_decimal_commas_are_recovered_from_and_the_deck_keeps_its_error(tmp_path: Path) -> None:
    law = (" FRICTION=0.3, 0.5\n SET=Right", " FRICTION=0,3, 0,5\n SET=Right")
    text = changed((SECTION, STEEL.replace("79.6E9, 0.3239, 0.2889", "79,6E9, 0,3239, 0,2889")), law)
    assert told(text) == [("SYN015", 19), ("SYN015", 31)]
    deck = tmp_path / "deck.keyxm"
    deck.write_text(text, encoding="utf-8")
    assert "1 of 1 deck has errors" in run("validate", str(deck)).out
    settings = LintSettings(tuple(rules()), fixing=Fixing.UNSAFE)
    assert lint_one("deck.keyxm", text.encode(), settings).changed == changed((SECTION, STEEL)).encode()


def test_the_one_curve_that_nothing_uses_is_named_where_one_is_not_defined() -> None:
    one = only(changed(("STIFFNESS=Clay", "STIFFNESS=Silt")))
    assert (one.code, one.line) == ("REF002", 29)
    assert "(did you mean Clay, which nothing uses?)" in one.message


def test_a_number_that_fits_no_neighbour_is_not_guessed() -> None:
    twice = LISTED.replace(" 7, -0.05", " 6, -0.05")
    assert "number 6 is given twice, and 7 is not defined: is this one 7?" in "".join(
        one.message for one in found(twice)
    )
    text = LISTED.replace(" 7, -0.05", " 3, -0.05").replace("*ELEMENT\n 1, 1, 2", "*ELEMENT\n 1, 1, 99")
    assert "is this one 99" not in "".join(one.message for one in found(text))


def test_two_softening_parts_of_a_curve_are_two_findings() -> None:
    text = " CURVE=Clay\n 0.0, 0.0\n 0.1, 3000.0\n 0.2, 2000.0\n 0.3, 5000.0\n 0.4, 4000.0\n 0.5, 9000.0\n"
    assert [one[:2] for one in summary(changed((CURVE, text)))] == [("CRV005", 23), ("CRV005", 25)]


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
    assert one.fix is not None


def test_a_missing_keyword_line_is_put_in_by_an_unsafe_fix() -> None:
    wrong = DECK.replace("*GEOMETRIC SETS\n", "").encode()
    done = lint_one("deck.keyxm", wrong, LintSettings(rules(), fixing=Fixing.UNSAFE))
    assert done.changed == DECK.encode()


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


# --------------------------------------------------------------------------------------------- what is not recovered


@pytest.mark.parametrize("command", ["validate", "evaluate"])
def test_other_commands_take_the_deck_as_it_is_written(command: str, tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    deck.write_text(changed(("*NODE\n", "*NODS\n")), encoding="utf-8")
    done = run(command, str(deck), "-v") if command == "validate" else run(command, str(deck))
    assert done.code != 0
    assert "SYN009" in done.out + done.err


@pytest.mark.parametrize("command", ["study", "curves", "evaluate", "migrate"])
def test_a_refusal_names_the_causes(command: str, tmp_path: Path) -> None:
    deck = tmp_path / "deck.keyxm"
    text = SURFACE.replace("*ELEMENT SETS\n", "ELEMENT SETS\n").replace(" SET=Right\n 0", " SET=Rigth\n 0")
    deck.write_text(text, encoding="utf-8")
    done = run(command, str(deck))
    assert done.code != 0
    told_ = re.findall(r":([0-9]+):[0-9]+: \w+: ([A-Z]+[0-9]+) ", done.err)
    assert told_ == [("11", "SYN003"), ("25", "REF001")]


@pytest.mark.parametrize(
    "command", [["convert", "--to", "json"], ["diff", "deck.keyxm"], ["expand", "--dry-run"], ["format", "--check"]]
)
def test_a_deck_that_cannot_be_read_is_refused_with_the_cause(
    command: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("deck.keyxm").write_text(DECK.replace("*ELEMENT SETS\n", ""), encoding="utf-8")
    done = run(*command, "deck.keyxm")
    assert re.findall(r":([0-9]+):[0-9]+: \w+: ([A-Z]+[0-9]+) ", done.err) == [("11", "SYN004")]


def test_a_keyword_whose_block_does_not_read_is_not_taken_for_another_one() -> None:
    text = changed(("*NODE\n", "*NODS\n"), (" 11, -0.05, 100.0\n", " 11, -0.05\n"))
    assert {"SYN009", "REF006"} <= {one.code for one in found(text)}


def test_a_value_that_cannot_be_read_stays_unknown() -> None:
    falling = " CURVE=Clay\n 0.0, 0.0\n 0.2, 9OO.0\n 0.5, 500.0\n 0.6, 600.0\n"
    assert [one.code for one in found(changed((CURVE, falling)))] == ["SYN002"]
