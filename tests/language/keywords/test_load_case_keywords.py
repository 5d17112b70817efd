"""Keywords of load cases and of soil springs: what is read, and what is kept because its form is not public."""

from __future__ import annotations

import pytest

from mudline.language.deck.loading import dump
from mudline.language.deck.model import Opaque
from mudline.language.diagnostics import Severity
from mudline.language.keywords import catalogue
from mudline.language.keywords.contents import is_read
from tests.helpers.builders.scenes import deck_of, faults
from tests.language.deck.test_forms import held

Lines = list[str]


def values(section: str, lines: str) -> dict[str, object]:
    """The only block of a deck as it stands in a document; reading it finds nothing, and it goes through every form."""
    deck = deck_of(f"${section}\n{lines}")
    assert deck.problems == []
    held(deck)
    (found,) = deck.sections[0].blocks
    assert not isinstance(found, Opaque)
    return found.model_dump(mode="json", exclude_defaults=True)


def test_friction_belongs_in_two_sections() -> None:
    assert catalogue.sections_of("FRICTION") == ("LOAD CASE", "MODES")
    assert len(catalogue.declarations("FRICTION")) == 1
    assert faults("$MODEL\n*FRICTION\n 1.0, 2.0\n")[0].startswith("2:1 SYN008 *FRICTION does not belong in $MODEL")
    assert values("MODES", "*FRICTION\n ,250\n") == {"transverse": 250.0}


def test_soil_springs() -> None:
    lines = "*P-Y\n TYPE=user\n SET=Pipe\n DEPTH=-1\n 0, 0\n 5e3, =[y]\n NODE={Mudline}\n 1, 2\n 3, 4\n"
    lines += " SET=Pile\n FILE=a.py\n"
    curves: list[dict[str, object]] = [
        {"depth": -1.0, "points": [[0.0, 0.0], [5000.0, "=[y]"]]},
        {"node": "{Mudline}", "points": [[1.0, 2.0], [3.0, 4.0]]},
    ]
    conductor = {"type": "USER", "set": "Pipe", "curves": curves}
    assert values("MODEL", lines) == {"sets": [conductor, {"set": "Pile", "file": "a.py"}]}
    axial = {"set": "a", "curves": [{"depth": 2.0, "points": [[1.0, 2.0], [3.0, 4.0]]}]}
    assert values("MODEL", "*T-Z\n SET=a\n DEPTH=2\n 1, 2\n 3, 4\n") == {"sets": [axial]}


def test_resistance_comes_first() -> None:
    for keyword in ("P-Y", "T-Z"):
        text = f"$MODEL\n*{keyword}\n SET=a\n DEPTH=2\n 1, 2, 3\n 1, x\n"
        assert faults(text) == [
            "5:2 SYN003 2 fields expected (`resistance, displacement`), found 3",
            "6:5 SYN002 'x' is not a number: expected a number or an equation =[...] for displacement",
        ]


def test_boundary() -> None:
    lines = (
        "*BOUNDARY\n TYPE=constant\n 1, 2\n {Top}, 3, , FIXATION = relative\n GEN=1, 9, , 4, 0.5\n GEN=1, 9, 2\n"
        "C below\n GEN=1, 9, 2, 3, fixation=RELATIVE\n GEN=1, 9, 2, 0.25\n"
    )
    entries: list[dict[str, object]] = [
        {"node": 1, "dof": 2},
        {"node": "{Top}", "dof": 3, "fixation": "RELATIVE"},
        {"generate": [1, 9, None, 4, 0.5]},
        {"generate": [1, 9, 2]},
        {"generate": [1, 9, 2, 3], "fixation": "RELATIVE"},
        {"generate": [1, 9, 2, 0.25]},
    ]
    found = values("LOAD CASE", lines)
    assert found == {"types": [{"type": "CONSTANT", "entries": entries, "comments": [{"before": 4, "text": " below"}]}]}


FAULTS = [
    ("*BOUNDARY\n 1, 2\nC between\n", ["3:2 SYN001 expected TYPE= before this line"]),
    ("*BOUNDARY\n TYP=CONSTANT\n", ["3:2 SYN004 *BOUNDARY has no setting TYP= (did you mean TYPE?)"]),
    (
        "*BOUNDARY\n TYPE=CONSTANT\n 1, two\n 1, 3, FIXATION=ABSOLUTE\n AMPLITUDE=2\n",
        ["4:5 SYN002 'two'", "5:17 SYN005 'ABSOLUTE' is not allowed for FIXATION=", "6:2 SYN004 *BOUNDARY has no"],
    ),
    ("*TIME\n", ["2:1 SYN014 the file is incomplete: missing STEP="]),
    ("*TIME\n STEP=FIXED\n", ["3:2 SYN014 the file is incomplete: missing a row"]),
    ("*TIME\n STEP=\n 0, 100\n", ["3:2 SYN003 STEP= has no value"]),
    ("*TIME\n STEP=FIXED\n 0, sixty, 1\n", ["4:5 SYN002 'sixty' is not a number"]),
    ("*TIME\n STEP=FIXED\n 0, 100, 1, 2, 3\n", ["4:2 SYN003 2 to 4 fields expected"]),
    ("*TIME\n STEP=FIXED\n 0, =[a\n", ["4:5 SYN006"]),
    ("*TIME\n STEP=FIXED\n 0, 1\n SPAN=2\n", ["5:2 SYN004 *TIME has no setting SPAN="]),
    ("*RESTART\n", ["2:1 SYN001 LAST= is missing here"]),
    ("*RESTART\n TYPE=DYNAMIC\n", ["2:1 SYN001 LAST= is missing here"]),
]


@pytest.mark.parametrize(("lines", "expected"), FAULTS)
def test_faults_of_a_known_form_are_told(lines: str, expected: Lines) -> None:
    text = f"$LOAD CASE\n{lines}"
    found = faults(text)
    assert [message.startswith(words) for message, words in zip(found, expected, strict=True)] == [True] * len(expected)


KEPT = [
    "LOAD CASE|*BOUNDARY\n TYPE=CONSTANT\n 1, 2\n TYPE=VESSEL\n VESSEL=Semi\n 201, 1\n",
    *("LOAD CASE|*BOUNDARY\n TYPE=SINUSOIDAL, AMPLITUDE=2\n 1\n", "LOAD CASE|*RESTART\n FROM=static\n"),
    *("MODES|*FRICTION\n MODE=1\n", "MODEL|*P-Y\n TYPE=SAND\n SET=Pile\n 35.0, 10.0\n"),
    *("MODEL|*P-Y\n Clay above the pile\n", "MODEL|*T-Z\n TYPE=USER\n SET=Pile\n"),
]


@pytest.mark.parametrize("case", KEPT)
def test_a_form_that_is_not_public_is_kept_with_an_info_at_most(case: str) -> None:
    section, lines = case.split("|")
    text = f"${section}\n{lines}"
    deck = deck_of(text)
    assert [problem for problem in deck.problems if problem.weight is not Severity.INFO] == []
    (block,) = deck.sections[0].blocks
    assert isinstance(block, Opaque) or not is_read(block)
    assert dump(deck, "keyword") == text
    held(deck)
