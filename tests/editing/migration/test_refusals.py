"""What the new family cannot say stops the migration, with a place and a reason."""

from __future__ import annotations

import pytest

from mudline.checks.context import LintContext
from mudline.checks.engine import lint_context
from mudline.checks.registry import rules
from mudline.editing.migration.migrating import migrate, verify
from mudline.editing.migration.refusals import superseded_blocks
from mudline.editing.migration.rewriting import curve_names
from mudline.language.diagnostics import DeckError
from tests.helpers.builders.decks import PIPE_WITH_SETS
from tests.helpers.builders.scenes import deck_of

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
        (f"{SURFACE}\n 0, 0\n 1, 1\n*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=1\n", 5, 1, "*SEABED PROFILE and the slope"),
        ("*ELASTIC SURFACE\n 1e4, 1.0, 0.5, , , , 2.0\n", 2, 23, "the largest longitudinal characteristic length"),
        (f"{SURFACE}\n*SEABED PROPERTIES\n TYPE=ELASTIC\n SET=West\n STIFFNESS=1\n", 3, 1, "is used next to legacy"),
        (f"{SURFACE}\n$LOAD CASE\n*RESTART\n LAST=base\n", 4, 1, "*RESTART continues another deck"),
        (f"{SURFACE}\n*EMBEDMENT\nCURVE=x\n SET=West\n 0, 0\n 1, 1\n", 1, 1, "would be lost or read as data"),
    ],
)
def test_the_reason_and_its_place(text: str, line: int, column: int, words: str) -> None:
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(PIPE_WITH_SETS + text))
    (found,) = [one for one in caught.value.diagnostics if words in one.message]
    assert (found.code, found.line, found.column) == ("MIG001", LINES + line, column)


def test_a_second_surface_is_reported_and_no_more_of_it() -> None:
    length = ", 0.3, 0.5, , , , 2.0\n"
    with pytest.raises(DeckError) as caught:
        migrate(deck_of(f"{PIPE_WITH_SETS}*ELASTIC SURFACE\n 1e4{length}*ELASTIC SURFACE\n 2e4{length}"))
    assert [(one.line - LINES, one.message[:16]) for one in caught.value.diagnostics] == [
        (2, "the largest long"),
        (3, "a second surface"),
    ]


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


@pytest.mark.parametrize("surface", ["ELASTIC SURFACE", "RIGID SURFACE"])
def test_surfaces_come_before_curves(surface: str) -> None:
    deck = deck_of(f"{PIPE_WITH_SETS}{CURVE}*{surface}\n 0.3\n")
    assert [block.keyword for _, block in superseded_blocks(deck)] == [surface, "EMBEDMENT"]


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


@pytest.mark.parametrize(
    "bed",
    [
        f"{SURFACE}\n*SEABED PROFILE\n TYPE=SLOPING\n SLOPE=1\n",
        "*ELASTIC SURFACE\n 1e4, 0, 0.5, , , , 2.0\n",
        "*ELASTIC SURFACE\n 1e4, , 0.5, , , , 2.0\n",
        "*ELASTIC SURFACE\n 1e4, 0.3, 0.5, , , , 2.0, , , 0.1\n",
    ],
    ids=["a shape of its own", "no friction", "no friction given", "a mobilisation length"],
)
def test_what_has_no_effect_is_no_obstacle(bed: str) -> None:
    assert verify(migrate(deck_of(PIPE_WITH_SETS + bed))).differences == ()


def test_decks_that_continue_this_one() -> None:
    with pytest.raises(DeckError, match=r"dynamic.keyxm continues this deck"):
        migrate(deck_of(PIPE_WITH_SETS + SURFACE + "\n"), ["dynamic.keyxm"])


def test_default_lengths_of_the_unit_system_are_no_obstacle() -> None:
    imperial = (PIPE_WITH_SETS + f"{SURFACE}, , , , 10.0, 10.0\n").encode()
    assert b"left out" in migrate(deck_of(imperial, "deck.keyxi")).content
    with pytest.raises(DeckError):
        migrate(deck_of(imperial, "deck.keyxm"))


def test_names_of_curves() -> None:
    names = ["Clay", "clay", "12", "1e5", "nan", "=[x]", "CLAY curve", "Sand", "3 m"]
    found = list(curve_names(names, ["SAND", "12 curve"]))
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


BED = "*ELASTIC SURFACE\n 1e4, 0.3, 0.6\n"
OF_LINES = "$MODEL\n*LINES\n LINE=Riser\n SECTION=West, 10\n"
FIRST, SECOND = " 0, 0\n 1, 5\n", " 0, 0\n 1, 7\n"


def seabed_after(head: str, bed: str, *, extended: bool = False) -> str:
    """The seabed of the new deck, which is verified."""
    found = migrate(deck_of(head + bed), extended=extended)
    assert verify(found).differences == ()
    text = found.content.decode()
    assert text.startswith(head)
    return text.removeprefix(head)


def group(name: str, stiffness: str) -> str:
    return f" SET={name}\n STIFFNESS={stiffness}\n FRICTION=0.3, 0.6\n"


def left_out(*lines: str) -> str:
    return "".join(f"C{line}\n" for line in (" left out, as no element is on this curve:", *lines))


NO_STIFFNESS = "*SEABED PROPERTIES\nC stiffness 1e4 left out, as every element is on a curve\n TYPE=ELASTIC\n"


def test_curves_for_all_elements_replace_the_stiffness() -> None:
    head = PIPE_WITH_SETS.replace(" SET=7\n 3, 9\n", " SET=7\n 11, 12\n")
    curves = f" SET=West\n{FIRST} SET=East Bank\n{SECOND} SET=7\n{FIRST}"
    named = curves.replace("SET=7", "SET=7 curve").replace("SET=", "CURVE=")
    assert seabed_after(head, f"{BED}*EMBEDMENT\n{curves}") == (
        NO_STIFFNESS
        + group("West", "West")
        + group("East Bank", "East Bank")
        + group("7", "7 curve")
        + f"*SEABED STIFFNESS\n{named}"
    )


@pytest.mark.parametrize(
    ("head", "extended"), [(PIPE_WITH_SETS + "*LINES\n LINE=Riser\n", False), (PIPE_WITH_SETS, True)]
)
def test_the_stiffness_stays_where_there_may_be_more_elements(head: str, *, extended: bool) -> None:
    head = head.replace(" SET=7\n 3, 9\n", " SET=Pipe\n GEN=1, 12\n")
    found = seabed_after(head, f"{BED}*EMBEDMENT\n SET=Pipe\n{FIRST}", extended=extended)
    assert found.startswith("*SEABED PROPERTIES\n TYPE=ELASTIC\n" + group("ALL", "1e4") + group("Pipe", "Pipe"))


@pytest.mark.parametrize("head", [PIPE_WITH_SETS, OF_LINES], ids=["elements", "lines"])
def test_an_earlier_curve_of_a_set_stays_in_comments(head: str) -> None:
    bed = f"*EMBEDMENT\n SET=West\nC rev A\n{FIRST}\n{BED}*EMBEDMENT\n SET=west\n{SECOND}"
    assert seabed_after(head, bed) == (
        "C *EMBEDMENT\n"
        + left_out("  SET=West")
        + "C rev A\nC  0, 0\nC  1, 5\n\n*SEABED PROPERTIES\n TYPE=ELASTIC\n"
        + group("ALL", "1e4")
        + group("west", "west")
        + f"*SEABED STIFFNESS\n CURVE=west\n{SECOND}"
    )


def test_curves_before_one_for_all_are_left_out() -> None:
    bed = f"{BED}*EMBEDMENT\n SET=West\n{FIRST} SET=ALL\n{SECOND} SET=7\n{FIRST}"
    assert seabed_after(PIPE_WITH_SETS, bed) == (
        NO_STIFFNESS
        + group("ALL", "ALL")
        + group("7", "7 curve")
        + "*SEABED STIFFNESS\n"
        + left_out("  SET=West", "  0, 0", "  1, 5")
        + f" CURVE=ALL\n{SECOND} CURVE=7 curve\n{FIRST}"
    )


def test_a_rigid_seabed_without_friction_is_for_all() -> None:
    left = "C largest characteristic lengths (longitudinal 2.0) left out: the default, or without effect\n"
    assert seabed_after(PIPE_WITH_SETS, "*RIGID SURFACE\n , , 2.0\n") == (
        f"*SEABED PROPERTIES\n{left} TYPE=RIGID\n SET=ALL\n"
    )
    found = seabed_after(PIPE_WITH_SETS, f"*ELASTIC SURFACE\n , , , , , , 2.0\n*EMBEDMENT\n SET=West\n{FIRST}")
    assert found.startswith(f"*SEABED PROPERTIES\n{left} TYPE=ELASTIC\n SET=West\n STIFFNESS=West\n*SEABED STIFFNESS")


def test_blank_lines_stay_where_they_are() -> None:
    found = seabed_after(
        PIPE_WITH_SETS, "*ELASTIC SURFACE\n\n 1e4\n  \n 2.5\n*EMBEDMENT\n\n SET=West\n\n 0, 0\n\n 1, 5\n"
    )
    assert found == (
        "*SEABED PROPERTIES\n\n TYPE=ELASTIC\n SET=ALL\n STIFFNESS=1e4\n SET=West\n STIFFNESS=West\n"
        "*SEABED PROFILE\n  \n TYPE=SLOPING\n SLOPE=2.5\n"
        "*SEABED STIFFNESS\n\n CURVE=West\n\n 0, 0\n\n 1, 5\n"
    )
