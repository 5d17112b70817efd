"""Names of new files: none leaves the folder, none fails on another system."""

from __future__ import annotations

import os
from pathlib import PurePosixPath, PureWindowsPath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.editing.variations.files import path_fault
from mudline.language.deck.loading import dump, load_bytes
from tests.helpers.builders.decks import varied_deck
from tests.helpers.builders.scenes import only, planned, refused

BAD = [
    ("../a", "leads out of the output folder with .."),
    ("a/../../b", "leads out of the output folder with .."),
    ("/a", "is absolute"),
    ("//server/a", "is absolute"),
    ("C:a", "is absolute"),
    ("c:/a", "is absolute"),
    ("a/b:c", "holds :"),
    ("a\\b", "holds a backslash"),
    ("..\\a", "holds a backslash"),
    ("a\0b", "holds U+0000"),
    ("a\x1b[2Jb", "holds U+001B"),
    ("a*", "holds *"),
    ("what?", "holds ?"),
    ("a//b", "has a part without a name"),
    ("a/./b", "has a part without a name"),
    ("", "has a part without a name"),
    (" /b", "has a part without a name"),
    ("a./b", "ends with a space or a dot"),
    ("a /b", "ends with a space or a dot"),
    ("nul", "has the part nul, which is a device"),
    ("Con.keyx", "has the part Con, which is a device"),
    ("lpt1 .a/b", "has the part lpt1, which is a device"),
    ("a" * 241, "longer than 240 bytes"),
    ("\u00e9" * 121, "longer than 240 bytes"),
    ("a/" * 501, "is longer than 1000 bytes"),
]


@pytest.mark.parametrize(("path", "fault"), BAD)
def test_names_that_are_refused(path: str, fault: str) -> None:
    assert fault in path_fault(path)


@pytest.mark.parametrize(
    "path", ["a", "a/b c.keyx", ".a", "...a", "console", "nulls/com10", "-a", "\u00e9\u6f22/100 %", "a" * 240]
)
def test_names_that_may_be_used(path: str) -> None:
    assert path_fault(path) == ""


@pytest.mark.parametrize(
    "folder", ["..", "a/../..", "/srv", "C:", '"C:/a"', "a\\b", "\\\\server\\share", "a\0", "aux", "b."]
)
@pytest.mark.parametrize("key", ["DIRECTORY", "SUBDIRECTORY", "%Folder%", "%Folder%/%Folder%"])
def test_no_folder_leads_out_of_the_output_folder(folder: str, key: str) -> None:
    match key:
        case "DIRECTORY":
            content = varied_deck("", f" DIRECTORY={folder}\n DESCRIPTION=d, FILENAME=a\n")
        case "SUBDIRECTORY":
            content = varied_deck("", f" DESCRIPTION=d, SUBDIRECTORY={folder}, FILENAME=a\n")
        case _:
            content = varied_deck(f" NAME=v\n PARA=Folder, VALUE={folder}\n", f" DESCRIPTION=d, SUBDIRECTORY={key}\n")
    assert only(refused(content))[0] == "EXP001"


def test_an_empty_folder_is_refused() -> None:
    assert (
        "has a folder without a name"
        in only(refused(varied_deck("", ' DESCRIPTION=d, SUBDIRECTORY="", FILENAME=a\n')))[3]
    )


def test_a_slash_in_a_folder_makes_folders() -> None:
    found = planned("", " DIRECTORY=a/b/\n DESCRIPTION=d, SUBDIRECTORY=c/%Period%, FILENAME=e\n")
    assert [new.path for new in found.decks] == ["a/b/c/08/e.keyxm"]


NASTY = st.text("ab. /\\:%~\0*CONnul-\u00e9\u0301\u2028", max_size=12)


@given(st.lists(NASTY, min_size=1, max_size=4))
def test_a_path_without_a_fault_stays_where_it_is_on_every_system(parts: list[str]) -> None:
    path = "/".join(parts)
    if path_fault(path):
        return
    assert os.path.normpath(path) == path
    for kind in (PurePosixPath, PureWindowsPath):
        pure = kind("root") / path
        assert not pure.drive
        assert ".." not in pure.parts
        assert pure.is_relative_to(kind("root"))
        assert len(pure.parts) == 1 + path.count("/") + 1


CODES = ["REF001", "REF013", "SYN009", "SYN010"]
PARAMETERS = "$PREPROCESSOR\n*PARAMETERS\n Offset, 0.0\n Soil, /soft:5 stiff:9/\n"
VARIATION = "*VARIATION\n NAME=Near Shore\n PARA=offset, VALUE=1, 2\n PARA=Soil_soft, VALUE=5, 6\n"
COMBINATIONS = "*COMBINATIONS\n DIRECTORY=%OFFSET%\n DESCRIPTION=a, SUBDIRECTORY=% soil_stiff %, FILENAME=%Offset%\n"
CALLS = ' VARIATIONS="near  shore", All\n'
WHOLE = PARAMETERS + VARIATION + COMBINATIONS + CALLS


def reported(text: str, name: str = "deck.keyxm") -> list[str]:
    found = lint_bytes(text.encode(), name, select(CODES))
    return [f"{one.line}:{one.column} {one.severity.value} {one.code} {one.message}" for one in found]


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
