"""The engine: all findings of a file in its order, for any form and any content."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.context import LintContext, read_deck
from mudline.checks.engine import lint_bytes, lint_context
from mudline.checks.registry import rules, select
from mudline.language.deck.forms.json import to_json
from mudline.language.deck.forms.yaml import to_yaml
from mudline.language.deck.loading import load_bytes
from mudline.language.deck.reading import TextOrigin
from mudline.language.diagnostics import Diagnostic, Severity
from tests.checks.findings import CLAY, PIPE, PROPERTIES, RESTART, found
from tests.helpers.builders.keyword_texts import mutated
from tests.language.deck.test_round_trips import texts as valid_texts

# A line and, behind the bar, the codes that are found in it.
FAULTY = """\
*TIME                                  | SYN001 SYN007
$PREPROCESSOR                          |
*PARAMETERS                            |
 depth, 500.0                          |
 half, =[depth/]                       | SYN017
 soil, "Soft clay                      | SYN006
$MODEL                                 |
 12.5, 13.5                            | SYN011
*OCEAN                                 |
 =[depth], 1025.0, 9.8l                | SYN002
*NODE                                  |
 1, 0.0, 0.0                           |
 2, 0.0, nan                           | SYN002
 3, 0.0                                | SYN003
 4, 0.0, 30.0                          |
*LINES                                 |
 LINE=Riser                            |
*ELEMENT                               |
 1, 1, 2                               |
 2, 2, Buoy                            | SYN016
 3, 3, 4                               |
*ELEMENT SETS                          |
 SET=Flowline                          |
 1, 2                                  |
 GAN=1, 3                              | SYN004
*GEOMETRIC SETS                        |
 OPTION=RIGID                          |
 SET=Flowline                          |
 207.0E9, 79.9E9, 0.3239, 0.2731       | SYN003
*SEABED STIFFNESS                      |
 CURVE=Soft clay                       |
 0.0, 0.0                              |
Carried over from the survey           | SYN013
 0,1, 1200,0                           | SYN015
 0.2, 1e400                            | SYN002
 0.5, 10000.0                          |
*SEABED PROPERTIES                     |
 TYPE=ELSTIC                           | SYN005
 SET=Flowline                          |
 STIFFNESS=Soft clay                   |
 50000.0                               | SYN001
*OCAEN                                 | SYN009
 500.0                                 |
*BOUNDARY                              | SYN008
 TYPE=CONSTANT                         |
$LOADCASE                              | SYN010
*LOAD                                  |
C \x02                                 | SYN012
$MODEL                                 |
*SEABED STIFFNESS                      |
 CURVE=Stiff clay                      |
 0.0, 0.0                              |
 0.1, 1.0E                             | SYN014\
"""
SYNTAX = select(["SYN"])


def test_no_fault_hides_another() -> None:
    lines = [line.partition("|") for line in FAULTY.split("\n")]
    deck = "\n".join(text.rstrip() for text, _, _ in lines)
    expected = [(number, code) for number, (_, _, codes) in enumerate(lines, 1) for code in codes.split()]
    found = lint_bytes(deck.encode(), "deck.keyxm", SYNTAX)
    assert len(expected) == 21
    alone = {"SYN018", "SYN019"}  # of files that are no decks
    assert {code for _, code in expected} == {rule.code.code for rule in SYNTAX} - alone
    assert [(one.line, one.code) for one in found] == expected


PLAIN = """\
$MODEL
*OCEAN
 500.0, 1025.0, 9.81
*NODE
 1, 5.0, 0.0
 2, 5.0, 10.0
*ELEMENT
 1, 1, 2
*GEOMETRIC SETS
 OPTION=RIGID
 SET=ALL
 207.0E9, 79.9E9, 0.3239, 0.2731, 7850.0
*SEABED STIFFNESS
 CURVE=Soft clay
 0.0, 0.0
 0.1, 1200.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=ALL
 STIFFNESS=Soft clay
"""


def test_a_finding_says_file_code_severity_and_place() -> None:
    bad = PLAIN.replace("5.0, 10.0", "5.0, 1O.0")
    assert lint_bytes(bad.encode(), "decks/a.keyxm", SYNTAX) == [
        Diagnostic(
            file="decks/a.keyxm",
            code="SYN002",
            slug="bad-number",
            severity=Severity.ERROR,
            message="'1O.0' is not a number: expected a number or an equation =[...] for y",
            line=6,
            column=10,
            end_line=6,
            end_column=14,
            blocks=True,
        )
    ]


def test_findings_stand_in_the_order_of_the_file_whatever_the_order_of_the_rules() -> None:
    deck = load_bytes(FAULTY.replace("|", "").encode(), "deck.keyxm")
    found = lint_context(LintContext(deck), rules())
    assert found == lint_context(LintContext(deck), rules()[::-1])
    assert found == lint_context(LintContext(deck), rules())
    assert [one.sort_key for one in found] == sorted(one.sort_key for one in found)


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_places_count_any_line_end_once_and_no_byte_order_mark(end: str, mark: bytes) -> None:
    bad = ("C \U0001f6a2\n" + PLAIN.replace("500.0", "5O0.0")).replace("\n", end)
    found = lint_bytes(mark + bad.encode(), "deck.keyxm", SYNTAX)
    assert [(one.line, one.column, one.end_line, one.end_column) for one in found] == [(4, 2, 4, 7)]


MEANT = PLAIN.replace("500.0", "=[1/0]") + "*RIGID SURFACE\n 0.3, 0.5\n"


def test_json_and_yaml_decks_have_places_too() -> None:
    deck = load_bytes(MEANT.encode(), "deck.keyxm")
    for text, name in ((to_json(deck), "deck.json"), (to_yaml(deck), "deck.yaml")):
        lines = text.split("\n")
        found = lint_bytes(text.encode(), name, select(["SYN017", "LEG001"]))
        assert [one.code for one in found] == ["SYN017", "LEG001"]
        assert "=[1/0]" in lines[found[0].line - 1][found[0].column - 1 :]
        assert "RIGID SURFACE" in "".join(lines[found[1].line - 1 : found[1].end_line])


def test_a_name_that_is_not_defined_is_one_finding_in_every_form() -> None:
    text = PLAIN + "".join(f"*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Wets\n STIFFNESS={at}000.0\n" for at in (5, 6, 7))
    deck = load_bytes(text.encode(), "deck.keyxm")
    for written, name in ((text, "deck.keyxm"), (to_json(deck), "deck.json"), (to_yaml(deck), "deck.yaml")):
        (found,) = lint_bytes(written.encode(), name, select(["REF001"]))
        assert "the same in 2 more lines" in found.message
        assert "Wets" in written.split("\n")[found.line - 1]


@pytest.mark.parametrize(
    ("content", "name", "code"),
    [
        (b'{"format": "mudline-deck/1", "sections": [', "deck.json", "DOC001"),
        (b'{"format": "mudline-deck/1", "sections": 3}', "deck.json", "DOC002"),
        (b"format: [", "deck.yaml", "DOC001"),
        (b"", "deck.yml", "DOC002"),
        (b"\xff", "deck.yaml", "DOC001"),
    ],
)
def test_a_document_that_holds_no_deck_says_why_whatever_rules_are_chosen(content: bytes, name: str, code: str) -> None:
    found = lint_bytes(content, name, ())
    assert [(one.code, one.severity, one.file) for one in found] == [(code, Severity.ERROR, name)]


def _check(content: bytes, name: str) -> None:
    """Findings are in order, stand within the text, and say something on one line."""
    found = lint_bytes(content, name, rules())
    lines = re.split(r"\r\n|\r|\n", _text(content.removeprefix(b"\xef\xbb\xbf")))
    assert [one.sort_key for one in found] == sorted(one.sort_key for one in found)
    for one in found:
        start, end = (one.line, one.column), (one.end_line, one.end_column)
        assert (1, 1) <= start <= end <= (len(lines), len(lines[-1]) + 1), one
        if name.endswith("keyxm"):
            assert one.column <= len(lines[one.line - 1]) + 1, one
            assert one.end_column <= len(lines[one.end_line - 1]) + 1, one
        assert one.message.strip(), one
        assert "\n" not in one.message, one


def _text(content: bytes) -> str:
    try:
        return content.decode()
    except UnicodeDecodeError:
        return content.decode("latin-1")


HEADS = [line for line in FAULTY.replace("|", "\n").split("\n") if line[:1] in ("$", "*")]
LINES = """\
$MODEL/$LOAD CASE/$PREPROCESSOR/$ANALYSIS/*NODE/*ELEMENT/*ELEMENT SETS/*GEOMETRIC SETS/*SEABED PROPERTIES/*OCEAN
*SEABED STIFFNESS/*EMBEDMENT/*ELASTIC SURFACE/*RIGID SURFACE/*PARAMETERS/*UNITS/*LINES/*RESTART
 1, 0.0, 0.0/ 2, 0.0, 10.0/ 1, 1, 2/ 2, 2, 3/ 0.5, =[a*2]/ 1.5, 2, 3/ 99999999999999999999, 1, 2/ 1e308, -1e308
 GEN=1, 10, 2/ GEN=2, 1/ GEN==[a], 3/ GEN=/ GEN=1,/ GEN=-5, 5, -1/ GEN=1, 9007199254740992/ GEN=1, 3000000000
 SET=a/ SET=b/ SET=ALL/ SET=/ SET==[a]/ SUBSET=a/ SUBSET=b/ SET=ALL, BUOYANCY=DISTRIBUTED, EIYY=x
 OPTION=RIGID/ OPTION=MOORING/ OPTION=TRUSS/ OPTION=x/ COMPRESSION CHECK=a/ 207.0E9, 79.9E9, 0.3239, 0.2731, 7850.0
 ,,,,100.0,1.0,0.2,0.3,0.3/ 1.0E8, 150.0, 0.3/ TYPE=ELASTIC/ TYPE=RIGID/ TYPE=x/ STIFFNESS=5000.0/ STIFFNESS=clay
 STIFFNESS==[a]/ STIFFNESS=-1/ FRICTION=0.3, 0.5/ FRICTION=,,,/ LATERAL=1/ SUCTION=1, 2/CURVE=clay/ CURVE=clay/ CURVE=
 0, 0/ 0.1, 1000/ 0.1, 2000/ 1e-300, 1e300/ =[b], =[a]/ a, 5/ b, =[a]/ a, =[b]/ d, "text"/ UNITS=METRIC/ UNITS=
 hello/ {lab}, 1/ 1, {lab}, 2/ 1, lab, 2/C comment/C/c x/Clay/C---/,/ ,,/ 1e400/ nan/ -/ 1.0E/ =[/ {/ "/ 1 2 3/ =/ ==
 A=B=C/ SET/ [x]/ =[[1]]/ =[a(]/ =["x"]/ 1,2,3,4,5,6,7,8,9,10,11,12/ LINE=r, SECTION=q/ FILE=x/ \x00/ \x1a/ \u2028\x85
"""
_fragment = st.sampled_from([*LINES.replace("\n", "/").split("/"), " c, /x:1, y=[a], 3/", *HEADS])
_noise = st.text(st.sampled_from('*$=[]{}"/,.-+eE01 CX\t\0Øé\u00a0'), max_size=8)
_line = st.one_of(
    _fragment, _fragment, _fragment, st.builds(lambda line, noise: line + noise, _fragment, _noise), _noise
)
_decks = st.builds(
    lambda start, lines, end, tail: (start + end.join(lines) + tail).encode(),
    st.sampled_from(["$MODEL\n", "$MODEL\n", "$MODEL\n*NODE\n 1, 0, 0\n 2, 0, 1\n*ELEMENT\n 1, 1, 2\n", ""]),
    st.lists(_line, max_size=25),
    st.sampled_from(["\n", "\n", "\r\n", "\r"]),
    st.sampled_from(["\n", ""]),
)


@given(_decks)
def test_nothing_deck_like_raises(content: bytes) -> None:
    _check(content, "deck.keyxm")


@pytest.mark.parametrize(
    "text",
    [
        RESTART + "*TIME\n 0, 100\n*BOUNDARY\n TYPE=CONSTANT\n 1, 1\n",
        "$LOAD CASE\n*WAVE-REGULAR\n 2, 10\n",
        "$MODEL\n*LINES\n LINE=SCR, SECTION=TDZ\n*GEOMETRIC SETS\n SET=scr\n ,,,, 100, 1, 0.2, 0.3, 0.3\n"
        "*SEABED STIFFNESS\n" + CLAY + "*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=Tdz\n STIFFNESS=Clay\n",
        PIPE
        + "$LOAD CASE\n*BOUNDARY\n TYPE=CONSTANT\n$MODEL\n*SEABED STIFFNESS\n"
        + CLAY
        + PROPERTIES
        + " STIFFNESS=Clay\n",
        "$DATABASE POSTPROCESSING\n*ELEMENT SETS\n SET=a\n 1, 2\n",
    ],
)
def test_decks_of_which_nothing_is_to_be_said(text: str) -> None:
    assert found(text) == []


@given(mutated(valid_texts.map(str.encode)), st.integers(0, 3))
def test_a_block_that_was_read_before_somewhere_else(data: bytes, lines: int) -> None:
    read_deck(data, "a.keyxm")
    moved = b"C a line more\n" * lines + data
    plain, again = load_bytes(moved, "a.keyxm"), read_deck(moved, "a.keyxm")
    assert again == plain
    assert again.problems == plain.problems
    assert isinstance(plain.origin, TextOrigin)
    assert isinstance(again.origin, TextOrigin)
    assert again.origin.read.keys() == plain.origin.read.keys()
    for place, block in plain.origin.read.items():
        other = again.origin.read[place]
        assert other.places == block.places
        assert (other.problems, other.trailing, other.lost) == (block.problems, block.trailing, block.lost)
