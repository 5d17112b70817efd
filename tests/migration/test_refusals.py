"""What the new family cannot say stops the migration, with a place and a reason."""

from __future__ import annotations

import pytest

from mudline.diagnostics import DeckError
from mudline.linting.engine import lint_context
from mudline.linting.registry import rules
from mudline.linting.rule import LintContext
from mudline.migration.migrating import migrate
from mudline.migration.rewriting import curve_names
from tests.builders.decks import PIPE_WITH_SETS
from tests.builders.scenes import deck_of

LINES = PIPE_WITH_SETS.count("\n")
SURFACE = "*ELASTIC SURFACE\n 1e4, 0.3, 0.5"


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        (f"{SURFACE}, , , , 2.0\n", 2, 23, "the largest longitudinal characteristic length"),
        (f"{SURFACE}, , , , , 10\n", 2, 25, "the largest transverse characteristic length"),
        ("*RIGID SURFACE\n 0.3, 0.5, 2.0\n", 2, 12, "give the mobilisation length instead"),
        (f"{SURFACE}\n*ELASTIC SURFACE\n 2e4\n", 3, 1, "a second surface"),
        (f"{SURFACE}\n 2.5\n 0, 0\n 1, 1\n", 3, 2, "a slope and a profile"),
        (f"{SURFACE}\n 0, 0\n =[1+1], 1\n", 4, 2, "an equation in a profile"),
        (f"{SURFACE}\n 2.5\n*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=1\n", 4, 1, "*SEABED PROFILE and the slope"),
        (f"{SURFACE}\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=West\n STIFFNESS=1\n", 3, 1, "is used beside legacy"),
        (f"{SURFACE}\n$LOAD CASE\n*RESTART\n LAST=base\n", 4, 1, "*RESTART continues another deck"),
        (f"{SURFACE}\n*EMBEDMENT\nCURVE=x\n SET=West\n 0, 0\n 1, 1\n", 1, 1, "would be lost or read as data"),
    ],
)
def test_the_reason_and_its_place(text: str, line: int, column: int, words: str) -> None:
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(PIPE_WITH_SETS + text))
    (found,) = [one for one in caught.value.diagnostics if words in one.message]
    assert (found.code, found.line, found.column) == ("MIG001", LINES + line, column)


LINES_DECK = "$MODEL\n*LINES\n LINE=Riser\n 1, 2\n"
CURVE = "*EMBEDMENT\n SET=West\n 0, 0\n 1, 5\n"


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (
            f"{LINES_DECK}*ELASTIC SURFAC\n 1e4, 0.3\n{CURVE}",
            5,
            "*ELASTIC SURFAC, which is not known, may be meant as *ELASTIC SURFACE (SBD005)",
        ),
        (
            f"{PIPE_WITH_SETS}*ELASTIC SURFACE\n ,0.3\n*EMBEDMNT\n SET=West\n 0, 0\n 1, 5\n",
            LINES + 3,
            "*EMBEDMNT, which is not known, may be meant as *EMBEDMENT (SBD004)",
        ),
        (
            f"{PIPE_WITH_SETS}{SURFACE}\n*SEABED PROPERTYES\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=5\n",
            LINES + 3,
            "*SEABED PROPERTYES, which is not known, may be meant as *SEABED PROPERTIES",
        ),
        (
            PIPE_WITH_SETS.replace("*ELEMENT SETS", "*ELEMENT SETSX").replace("=West\n 2", "=ALL\n 2")
            + f"{SURFACE}\n{CURVE}",
            9,
            "*ELEMENT SETSX, which is not known, may be meant as *ELEMENT SETS (REF001)",
        ),
    ],
    ids=["surface", "embedment", "properties", "sets"],
)
def test_a_misspelt_keyword_does_not_soften_a_refusal(text: str, line: int, message: str) -> None:
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(text))
    found = [(one.code, one.line, one.message) for one in caught.value.diagnostics]
    assert found == [("MIG001", line, f"{message}: correct or remove it first")]
    lint = lint_context(LintContext(deck_of(text)), rules())
    assert not any(one.fix for one in lint if one.code == "LEG001")


def test_what_lines_may_define_is_no_obstacle() -> None:
    """A set that only the lines may make is a warning, and its name stays."""
    found = migrate(deck_of(f"{LINES_DECK}*ELASTIC SURFACE\n 1e4\n{CURVE}"))
    assert found.content.endswith(b" SET=West\n STIFFNESS=West\n*SEABED STIFFNESS\n CURVE=West\n 0, 0\n 1, 5\n")


VARIED = "$PREPROCESSOR\n*VARIATION\n NAME=Soil\n ACTION={}, KEYWORD={}\n"


@pytest.mark.parametrize(
    ("action", "keyword"), [("ADD", "EMBEDMENT"), ("REMOVE", "elastic  surface"), ("REMOVE", "SEABED STIFFNESS")]
)
def test_variations_of_seabed_keywords(action: str, keyword: str) -> None:
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(VARIED.format(action, keyword) + PIPE_WITH_SETS + SURFACE + "\n"))
    ((code, line),) = [(one.code, one.line) for one in caught.value.diagnostics]
    assert (code, line) == ("MIG001", 4)
    assert migrate(deck_of(VARIED.format("ADD", "OCEAN") + PIPE_WITH_SETS + SURFACE + "\n")).replaced


def test_a_value_of_an_equation_is_neither_zero_nor_the_default() -> None:
    head = "$PREPROCESSOR\n*PARAMETERS\n mu, 0\n Lc, 3.048\n"
    for fields in (", =[mu], 0.5, , , , 2.0", ", 0.3, 0.5, , , , =[Lc]"):
        with pytest.raises(DeckError, match="characteristic length"):
            migrate(deck_of(head + PIPE_WITH_SETS + f"*ELASTIC SURFACE\n 1e4{fields}\n"))


def test_decks_that_continue_this_one() -> None:
    with pytest.raises(DeckError, match=r"dynamic.keyxm continues this deck"):
        migrate(deck_of(PIPE_WITH_SETS + SURFACE + "\n"), ["dynamic.keyxm"])


def test_a_deck_with_errors_is_left_alone() -> None:
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(PIPE_WITH_SETS + SURFACE.replace("1e4", "-1e4") + "\n"))
    assert [found.code for found in caught.value.diagnostics] == ["SBD010"]


def test_default_lengths_of_the_unit_system_are_no_obstacle() -> None:
    imperial = (PIPE_WITH_SETS + f"{SURFACE}, , , , 10.0, 10.0\n").encode()
    assert b"left out" in migrate(deck_of(imperial, "deck.keyxi")).content
    with pytest.raises(DeckError):
        migrate(deck_of(imperial, "deck.keyxm"))


def test_a_length_in_a_direction_without_friction_is_no_obstacle() -> None:
    found = migrate(deck_of(PIPE_WITH_SETS + "*ELASTIC SURFACE\n 1e4, 0.0, , , , , 2.0, 2.0\n"))
    assert b"(longitudinal 2.0, transverse 2.0) left out" in found.content


def test_names_of_curves() -> None:
    names = ["Clay", "clay", "12", "1e5", "nan", "=[x]", "CLAY curve", "Sand", "3 m"]
    found = curve_names(names, ["SAND", "12 curve"])
    assert found == [
        "Clay",
        "clay curve",
        "12 curve 2",
        "1e5 curve",
        "nan curve",
        "curve",
        "CLAY curve curve",
        "Sand curve",
        "3 m",
    ]
