"""Names of new files: none leaves the folder, none fails on another system."""

from __future__ import annotations

import os
from pathlib import PurePosixPath, PureWindowsPath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.variations.files import Taken, path_fault
from mudline.variations.names import filled, placeholders, unquoted
from tests.builders.decks import varied_deck
from tests.builders.scenes import only, planned, refused

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


@pytest.mark.parametrize("file", ["..", "../a", "/a", "b\\c", "NUL", "a:b", "", "%Folder%"])
def test_no_file_name_leads_out_of_the_output_folder(file: str) -> None:
    variations = " NAME=v\n PARA=Folder, VALUE=../../etc/passwd\n" if "%" in file else ""
    assert {found.code for found in refused(varied_deck(variations, f' DESCRIPTION=d, FILENAME="{file}"\n'))} == {
        "EXP001"
    }


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


def test_placeholders() -> None:
    assert placeholders("a %b c% % d %e") == ["b c", "d"]
    assert placeholders("100 % sure") == []
    assert filled("%a%-%B %%", str.upper) == "A-B%"
    assert unquoted('"a"') == "a"
    assert unquoted('"') == '"'


def test_what_is_taken() -> None:
    taken = Taken()
    assert taken.take("a/b", 0) is None
    assert taken.take("A/B", 1) == 0
    assert taken.take("a", 2) == 0
    assert taken.take("a/b/c", 3) == 0
    assert taken.take("a/c", 4) is None
