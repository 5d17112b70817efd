"""Names that variations and combinations use: reported when undefined, in any deck, and only then."""

from __future__ import annotations

import pytest

from mudline.deck.loading import dump, load_bytes
from mudline.linting.engine import lint_bytes
from mudline.linting.registry import select
from mudline.variations.planning import plan
from tests.samples import SAMPLES

CODES = ["REF001", "REF013", "SYN009", "SYN010"]
PARAMETERS = "$PREPROCESSOR\n*PARAMETERS\n Offset, 0.0\n Soil, /soft:5 stiff:9/\n"
VARIATION = "*VARIATION\n NAME=Near Shore\n PARA=offset, VALUE=1, 2\n PARA=Soil_soft, VALUE=5, 6\n"
COMBINATIONS = "*COMBINATIONS\n DIRECTORY=%OFFSET%\n DESCRIPTION=a, SUBDIRECTORY=% soil_stiff %, FILENAME=%Offset%\n"
CALLS = ' VARIATIONS="near  shore", All\n'
WHOLE = PARAMETERS + VARIATION + COMBINATIONS + CALLS


def reported(text: str, name: str = "deck.keyxm") -> list[str]:
    found = lint_bytes(text.encode(), name, select(CODES))
    return [f"{one.line}:{one.column} {one.severity.value} {one.code} {one.message}" for one in found]


def test_nothing_is_reported_where_can_be_expanded() -> None:
    assert reported(WHOLE) == []
    assert reported((SAMPLES / "variations.keyxm").read_text()) == []
    assert len(plan(load_bytes(WHOLE.replace(" soil_stiff ", "soil_stiff").encode(), "deck.keyxm")).decks) == 2


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("PARA=offset", "PARA=Offsett", "7:7 error REF013 parameter 'Offsett' is not defined (did you mean Offset?)"),
        ("PARA=Soil_soft", "PARA=Soil", "8:7 error REF013 parameter 'Soil' is not defined: define it in *PARAMETERS"),
        ("=%OFFSET%", "=a%Ofset%", "10:12 error REF013 parameter 'Ofset' is not defined (did you mean Offset?)"),
        ("% soil_stiff %", "%stiff%", "11:30 error REF013 parameter 'stiff' is not defined: define it in *PARAMETERS"),
        ("FILENAME=%Offset%", "FILENAME=%q%", "11:55 error REF013 parameter 'q' is not defined: define it in"),
        (", All", ", Near Shor", "12:28 error REF001 there is no variation 'Near Shor' (did you mean Near Shore?)"),
    ],
)
def test_a_name_that_leads_nowhere(old: str, new: str, message: str) -> None:
    (found,) = reported(WHOLE.replace(old, new))
    assert found.startswith(message)
    document = dump(load_bytes(WHOLE.replace(old, new).encode(), "deck.keyxm"), "json")
    assert [line.split(" ", 1)[1] for line in reported(document, "deck.json")] == [found.split(" ", 1)[1]]


@pytest.mark.parametrize(
    ("action", "messages"),
    [
        ("ACTION=ADD, KEYWORD=OCEAN, SECTION=$MODEL", []),
        ("ACTION=ADD, KEYWORD=SOMETHING NEW, SECTION=A NEW ONE", []),
        ("ACTION=ADD, KEYWORD=OCAEN", ["9:22 warning SYN009 keyword *OCAEN is not known (did you mean OCEAN?)"]),
        ("ACTION=ADD, KEYWORD=OCEAN, SECTION=LOADCASE", ["9:37 warning SYN010 section $LOADCASE is not known"]),
        ('ACTION=REMOVE, KEYWORD="OCEAN", SECTION="MODEL"', []),
        ("ACTION=ADD, KEYWORD=VESSEL, INTEGRATED, SECTION=MODEL", []),
    ],
)
def test_keywords_and_sections_of_actions(action: str, messages: list[str]) -> None:
    found = reported(PARAMETERS + VARIATION + f" {action}\n" + COMBINATIONS + CALLS)
    assert [one.startswith(words) for one, words in zip(found, messages, strict=True)] == [True] * len(messages)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (" Offset, 0.0\n", " , 0.0\n"),
        (" Offset, 0.0\n", " Offset\n"),
        (" Offset, 0.0\n", " OFF=SET\n"),
        ("*PARAMETERS", "*PARAMETER"),
    ],
)
def test_a_parameter_that_could_not_be_read_may_be_the_one(old: str, new: str) -> None:
    assert [one for one in reported(WHOLE.replace(old, new)) if "REF013" in one] == []


@pytest.mark.parametrize("name", ["NAME=", "NMAE=Near Shore"])
def test_a_variation_that_could_not_be_read_may_be_the_one(name: str) -> None:
    found = reported(WHOLE.replace("NAME=Near Shore", name, 1))
    assert [one for one in found if "REF001" in one] == []


def test_a_sheet_may_hold_the_variations() -> None:
    rest = WHOLE.replace("All", "Sheet")
    assert [one.split()[2] for one in reported(rest)] == ["REF001"]
    assert reported(rest + "*EXCEL VARIATIONS\n FILE=a.xls\n") == []


def test_broken_lines_are_no_hindrance() -> None:
    lines = (
        "*VARIATION\n NAME=a\n PARA=, VALUE=1\n ACTION=ADD, KEYWORD=\n ACTION=AD\n"
        "*COMBINATIONS\n DESCRIPTION=a\n VARIATIONS=\n"
    )
    assert reported(WHOLE + lines) == []


def test_a_deck_without_variations_has_no_names() -> None:
    assert reported("$MODEL\n*OCEAN\n 100.0\n") == []
