"""STY001 to STY009: what is found, what is left alone, and that mended decks say the same as before."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.basics.limits import MOST_REPORTED
from mudline.checks.context import LintContext
from mudline.checks.engine import Fixing, LintSettings, lint_bytes
from mudline.checks.fixing import FixResult, fix_bytes
from mudline.checks.registry import select
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.loading import load_bytes
from mudline.language.rules import first_reported
from tests.checks.findings import CLAY, CURVES, found, messages
from tests.helpers.growth import call_growth

CODES = [f"STY00{number}" for number in range(1, 10)]
STYLE = select(CODES)
GOOD = """\
C A riser on clay
$PREPROCESSOR
*PARAMETERS
 2D4, 5.0
 depth, 1.5E2
$MODEL
*OCEAN
C mudline: ignore-block UNT001
 =[depth], 1025.0, 9.81
*NODE
 1, -0.05, 0.0
 11, -0.05, 1.0E2
 GEN=1, 11
*ELEMENT
 1, 1, 2
 GEN=1, 10
*ELEMENT SETS
 SET=1D3
 1, 2, 3
 SET=Pipe
 GEN=4, 7
*SEABED STIFFNESS
 CURVE=Clay
C remoulded
 0.0, 0.0
 0.5, 4.2E3
 CURVE=2D4
 0.0, 0.0
 1.0, 250.0
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.6E9, 0.5, 0.46, 7850.0
 COMPRESSION CHECK=YES
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=1D3
 STIFFNESS=Clay
*LINE PATHS
 as\tit  is 1.0D3
c kept
CURVE=Clay
"""
KEPT = GOOD[GOOD.index("*LINE PATHS") :].encode()


def fixed(text: str, *codes: str) -> FixResult:
    settings = LintSettings(select(codes or CODES), fixing=Fixing.SAFE)
    return fix_bytes(text.encode(), "deck.keyxm", settings)


def mended(text: str, *codes: str) -> str:
    """The text after all safe fixes, of which none may be refused."""
    result = fixed(text, *codes)
    assert result.note == ""
    assert result.changed is not None
    return result.changed.decode()


def test_a_good_deck_has_no_finding() -> None:
    assert [str(one) for one in load_bytes(GOOD.encode(), "deck.keyxm").problems if one.code.code != "SYN009"] == []
    assert found(GOOD, *CODES) == []
    assert fixed(GOOD).changed is None


DATA = re.compile(r" [-+.\d]")


@st.composite
def spoilt(draw: st.DrawFn) -> str:
    """The good deck, its lines written as people and programs do."""
    lines = GOOD[: GOOD.index("*LINE PATHS")].splitlines()
    return "\n".join(draw(_spoilt(line)) for line in lines) + f"\n{KEPT.decode()}"


@st.composite
def _spoilt(draw: st.DrawFn, line: str) -> str:
    if draw(st.booleans()):
        return line
    blanks = st.sampled_from([" ", "  ", "\t", " \t "])
    if line[0] in "$*":
        line = draw(st.sampled_from(["", " ", "\t"])) + draw(st.sampled_from([line, line.lower(), line.title()]))
    elif line[0] == "C":
        line = draw(st.sampled_from("cC")) + line[1:]
    elif line.startswith((" CURVE", " COMPRESSION")):
        key, _, value = line[1:].partition("=")
        line = draw(st.sampled_from([key, key.lower(), key.title()])) + f"={value}"
    elif DATA.match(line) and "D" not in line:
        line = line.replace("E", draw(st.sampled_from("EDd")))
        part = draw(st.sampled_from([",", ", "])) if draw(st.booleans()) else draw(blanks)
        line = draw(blanks) + line.strip().replace(", ", part)
    elif line.startswith(" GEN"):
        line = line.replace(", ", draw(blanks))
    return line + draw(st.sampled_from(["", "", " ", "\t", "  "]))


@given(spoilt(), st.sampled_from(["\n", "\r\n", "\r"]))
def test_a_mended_deck_says_the_same_and_has_no_finding(text: str, end: str) -> None:
    data = text.replace("\n", end).encode()
    result = fix_bytes(data, "deck.keyxm", LintSettings(STYLE, fixing=Fixing.SAFE))
    after = data if result.changed is None else result.changed
    assert result.note == ""
    assert lint_bytes(after, "deck.keyxm", STYLE) == []
    assert load_bytes(after, "deck.keyxm").sections == load_bytes(GOOD.encode(), "deck.keyxm").sections
    assert re.findall(rb"\r\n|\r|\n", after) == re.findall(rb"\r\n|\r|\n", data)
    assert after.endswith(KEPT.replace(b"\n", end.encode()))
    assert b"C mudline: ignore-block UNT001" in after


def test_names_equations_and_labels_are_no_numbers() -> None:
    text = (
        "$PREPROCESSOR\n*PARAMETERS\n 1D3, 5.0\n$MODEL\n*ELEMENT SETS\n SET=1D3\n 1, 2\n"
        "*NODE\n {1D3}, 0.0, =[1D3*2]\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=1D3\n STIFFNESS=50.0\n"
    )
    assert found(text, "STY003") == []


def test_numbers_of_every_place_are_seen() -> None:
    text = (
        "$PREPROCESSOR\n*PARAMETERS\n width, 1.5D0\n$MODEL\n*NODE\n 1D0, 2D1, 3.0\n"
        "*ELEMENT SETS\n SET=a\n 1D0, 2\n GEN=4D0, 7d0\n"
        "*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 2.07D11, 7.9D10, 0.5, 0.46, 7850.0\n"
    )
    places = [("STY003", line, column) for line, column in [(3, 9), (6, 2), (9, 2), (10, 6), (14, 2)]]
    assert found(text, "STY003") == places
    assert found(mended(text, "STY003"), "STY003") == []
    assert messages(text, "STY003")[1] == "the exponent D is Fortran's: write 1E0 (and 1 more on this line)"


def test_what_could_not_be_read_is_no_number() -> None:
    assert found(f"{CURVES} CURVE=a\n 0.0, 1D3x\n", "STY003") == []
    assert found("$MODEL\n*OCEAN\n 1D2, 1D3, 1D1, 1D1, 1D1, 1D1\n", "STY003") == [("STY003", 3, 2)]
    assert found("$MODEL\n*ELEMENT SETS\n SET=a\n x, 1D0\n TYPE=1D2\n", "STY003") == [("STY003", 4, 5)]


def test_small_letters_of_comments_are_seen_outside_kept_blocks() -> None:
    text = f"c one\nc\nc---\n$MODEL\nc two\n{CURVES[7:]}{CLAY}c mudline: ignore STY001\n*LINE PATHS\nc kept\n"
    lines = [line for _, line, _ in found(text, "STY002")]
    assert lines == [1, 2, 3, 5, 10]
    after = mended(text, "STY002")
    assert after.endswith("C mudline: ignore STY001\n*LINE PATHS\nc kept\n")
    assert after.startswith("C one\nC\nC---\n$MODEL\nC two\n")


@pytest.mark.parametrize("key", ["CURVE", "curve", "Curve"])
def test_settings_in_the_place_of_a_comment_are_seen(key: str) -> None:
    text = f"{CURVES}{CLAY.replace(' CURVE', key)}"
    assert found(text, "STY008") == [("STY008", 3, 1)]
    assert mended(text, "STY008") == text.replace(key, f" {key}")


@pytest.mark.parametrize("line", ["C CURVE=Sand", "CURV=Sand", "curv=Sand", "SET=ALL", "Calm"])
def test_comments_and_other_settings_in_column_one_are_told_by_others_or_not_at_all(line: str) -> None:
    assert found(f"{CURVES}{line}\n{CLAY}", "STY008") == []


@pytest.mark.parametrize("line", [" C note", "\tc note", "  C---", " C a=5", " C mudline: ignore CRV005"])
@pytest.mark.parametrize("before", ["", "$MODEL\n", CURVES, f"{CURVES}{CLAY}"])
def test_indented_comments_are_seen_wherever_they_are_data(before: str, line: str) -> None:
    text = f"{before}{line}\n" + ("" if before else "$MODEL\n")
    indent = len(line) - len(line.lstrip())
    assert found(text, "STY009") == [("STY009", before.count("\n") + 1, indent + 1)]


@pytest.mark.parametrize("line", ["C note", " C", " CURVE=Sand", " Clay, 2", " C-flex, 1", " 1, C 2"])
def test_other_lines_are_no_indented_comments(line: str) -> None:
    assert found(f"{CURVES}{line}\n{CLAY}", "STY009") == []


def test_what_looks_like_a_comment_in_a_kept_block_is_left() -> None:
    assert found("$MODEL\n*LINE PATHS\n C note\nc note\nCURVE=x\n\tx 1.0D3 \n", *CODES) == []


def test_a_tab_in_a_name_is_found_and_left() -> None:
    text = "$MODEL\n*ELEMENT SETS\n SET=A\tB\n 1, 2\n"
    assert found(text, "STY001") == [("STY001", 3, 7)]
    assert fixed(text, "STY001").changed is None


@pytest.mark.parametrize(
    ("line", "after"),
    [
        ("\t1,\t2", "        1,      2"),
        (" 1,\t\t2\t", " 1,             2"),
        (" SET=\tA", " SET=   A"),
        (" 1, 2 \t ", " 1, 2"),
    ],
)
def test_tabs_become_blanks_up_to_the_next_stop(line: str, after: str) -> None:
    text = f"$MODEL\n*ELEMENT SETS\n SET=x\n 1\n{line}\n" + (" 1, 2\n" if "SET" in line else "")
    text = text.replace(" 1\n", "" if "SET" not in line else " 1\n", 1)
    assert mended(text, "STY001") == text.replace(line, after)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", ""])
def test_a_tab_at_the_end_of_a_line_goes_with_the_blanks_beside_it(end: str) -> None:
    text = f"$MODEL\n*OCEAN\n 500.0 \t \t{end}".replace("\n", end or "\n")
    (found_one,) = lint_bytes(text.encode(), "deck.keyxm", select(["STY001"]))
    assert found_one.fix
    assert found_one.fix.message == "remove it"
    assert mended(text, "STY001") == text.replace(" \t \t", "")


def test_a_tab_in_a_key_is_left_and_tabs_in_comments_do_not_count() -> None:
    key = "$MODEL\n*GEOMETRIC SETS\n OPTION=RIGID\n SET=ALL\n 1E9, 1E9, 0.5, 0.4, 7850.0\n COMPRESSION\tCHECK=YES\n"
    assert found(key, "STY001") == [("STY001", 6, 13)]
    assert fixed(key, "STY001").changed is None
    assert found("C a\tb\n$MODEL\n*OCEAN\t\nC\ta\tb\n\t\n 500.0\n", "STY001") == []


def test_names_with_blanks_are_no_numbers_parted_by_blanks() -> None:
    assert found("$MODEL\n*ELEMENT SETS\n SET=1 2\n 1, 2\n", "STY004") == []
    assert found("$MODEL\n*OCEAN\n 500.0 1025.0-\n", "STY004") == []


def test_heads_are_mended_in_the_preamble_and_at_the_very_beginning() -> None:
    assert mended(" $model\n\t*Ocean\n 500.0\n", "STY005", "STY006") == "$MODEL\n*OCEAN\n 500.0\n"
    assert found(" *ocean\n", "STY005", "STY006") == [("STY005", 1, 2), ("STY006", 1, 2)]


def test_trailing_blanks_go_from_every_line_that_is_not_kept() -> None:
    text = "C a \r\n  \r\n$MODEL\t\r\n*OCEAN \r\nC  \r\n 500.0 \r\n*LINE PATHS \r\n x \r\n"
    after = "C a\r\n\r\n$MODEL\r\n*OCEAN\r\nC\r\n 500.0\r\n*LINE PATHS\r\n x \r\n"
    assert mended(text, "STY007") == after
    assert mended("$MODEL\n*OCEAN\n 500.0 ", "STY007") == "$MODEL\n*OCEAN\n 500.0"


def test_a_document_has_no_style() -> None:
    data = to_json(load_bytes(GOOD.encode(), "deck.keyxm")).encode()
    assert lint_bytes(data, "deck.json", STYLE) == []


def test_of_many_findings_the_first_are_told_and_a_long_table_is_quick() -> None:
    def table(rows: int) -> LintContext:
        text = f"{CURVES} CURVE=a\n" + "".join(f" {row}.0, {row}.0D2\n" for row in range(rows))
        return LintContext(load_bytes(text.encode(), "deck.keyxm"))

    def exponents(context: LintContext) -> list[str]:
        return [problem.message for rule in select(["STY003"]) for problem in rule.findings(context)]

    short, long = table(25_000), table(50_000)
    assert call_growth(exponents, short, long) == 1.0
    told = exponents(long)
    assert len(told) == MOST_REPORTED + 1
    assert "and more" in told[-1]
    assert first_reported([]) == []
