"""Which decks are planned: cases, products, names of files."""

from __future__ import annotations

import pytest

from mudline.editing.variations.planning import plan
from tests.helpers.builders.decks import varied_deck
from tests.helpers.builders.scenes import deck_of, only, planned, refused

WAVES = " NAME=Waves\n PARA=Period, VALUE=08, 09, 10\n"
SIDES = " NAME=Sides\n PARA=Offset, VALUE=-100, 100\n PARA=Folder, VALUE=Near, Far side\n"


def test_variations_are_multiplied_and_parameters_of_one_go_in_step() -> None:
    found = planned(SIDES + WAVES, " DESCRIPTION=all of them, SUBDIRECTORY=%Folder%, FILENAME=Wave %Period%s\n")
    assert [new.path for new in found.decks] == [
        "Near/Wave 08s.keyxm",
        "Near/Wave 09s.keyxm",
        "Near/Wave 10s.keyxm",
        "Far side/Wave 08s.keyxm",
        "Far side/Wave 09s.keyxm",
        "Far side/Wave 10s.keyxm",
    ]
    assert found.decks[-1].values == {"Offset": "100", "Folder": '"Far side"', "Period": "10"}
    assert found.decks[-1].description == "all of them"
    assert found.decks[-1].variations == ["Sides", "Waves"]
    assert found.source == "study.keyxm"


@pytest.mark.parametrize(
    "called", ["", " VARIATIONS=ALL\n", " VARIATIONS=waves, all\n", " VARIATIONS=sides\n VARIATIONS=WAVES\n"]
)
def test_all_variations(called: str) -> None:
    found = planned(SIDES + WAVES, f" DESCRIPTION=d, FILENAME=%offset% %PERIOD%\n{called}")
    assert len({new.path for new in found.decks}) == 6


def test_a_combination_calls_variations_by_name_and_several_follow_each_other() -> None:
    combinations = " DIRECTORY=All\n DESCRIPTION=a, SUBDIRECTORY=%Folder%\n VARIATIONS=Sides\n"
    combinations += " DESCRIPTION=b, FILENAME=w%Period%.keyx\n VARIATIONS=Waves, Waves\n"
    found = planned(SIDES + WAVES, combinations)
    assert [new.path for new in found.decks] == [
        "All/Near/study.keyxm",
        "All/Far side/study.keyxm",
        "All/w08.keyx",
        "All/w09.keyx",
        "All/w10.keyx",
    ]


def test_without_a_name_decks_are_counted() -> None:
    four = " NAME=v\n PARA=Depth, GEN=1, 12\n"
    found = planned(four, ' DIRECTORY="d e"\n DESCRIPTION=none\n')
    assert [found.decks[0].path, found.decks[11].path] == ["d e/study 01.keyxm", "d e/study 12.keyxm"]


@pytest.mark.parametrize(
    ("generated", "values"),
    [
        ("1, 3", ["1", "2", "3"]),
        ("0.1, 0.3, 0.1", ["0.1", "0.2", "0.3"]),
        ("3, 1, -1", ["3", "2", "1"]),
        ("=[Depth/2], =[Depth], =[Depth/4]", ["50", "75", "100"]),
        ("0, 1, =[1/3]", ["0", "0.3333333333333333", "0.6666666666666666", "0.9999999999999999"]),
        ("1e20, 3e20, 1e20", ["1E+20", "2E+20", "3E+20"]),
        ("5, 5", ["5"]),
        ("1, 2, 4", ["1"]),
    ],
)
def test_ranges(generated: str, values: list[str]) -> None:
    found = planned(f" NAME=v\n PARA=Depth, GEN={generated}\n", " DESCRIPTION=d\n")
    assert [new.values["Depth"] for new in found.decks] == values


@pytest.mark.parametrize(
    ("name", "path"),
    [
        ("%Folder%", "Near side.keyxm"),
        ("%Twice%", "200.keyxm"),
        ("%Depth%", "100.0.keyxm"),
        ("%Point_X% %Point_y%", "11 22.keyxm"),
        ("%Period% of 100 %", "08 of 100 %.keyxm"),
        ("Wave 0.5", "Wave 0.5.keyxm"),
        ("a.KEYX", "a.KEYX"),
    ],
)
def test_names_hold_values_as_written(name: str, path: str) -> None:
    assert [new.path for new in planned("", f" DESCRIPTION=d, FILENAME={name}\n").decks] == [path]


def test_a_name_holds_the_value_that_an_equation_has_in_the_case() -> None:
    found = planned(" NAME=v\n PARA=Depth, VALUE=1, =[Offset*2], 0.25\n", " DESCRIPTION=d, FILENAME=%Twice% %Depth%\n")
    assert [new.path for new in found.decks] == ["2 1.keyxm", "-200 -100.keyxm", "0.5 0.25.keyxm"]


def test_the_last_definition_of_a_parameter_is_the_one_that_varies() -> None:
    content = varied_deck(WAVES, " DESCRIPTION=d, FILENAME=%Period%\n").replace("*VARIATION", " period, 7\n*VARIATION")
    found = plan(deck_of(content))
    assert found.decks[0].values == {"period": "08"}
    assert b" Period , 08\n" in found.content(found.decks[1])
    assert b" period, 09\n" in found.content(found.decks[1])


def test_excel_variations_are_reported() -> None:
    content = varied_deck(WAVES, " DESCRIPTION=d, FILENAME=%Period%\n").replace(
        "*VARIATION", "*EXCEL VARIATIONS\n EXCEL=a, RANGE=A1:B2\n*VARIATION"
    )
    found = plan(deck_of(content))
    assert found.notes == ["*EXCEL VARIATIONS is not expanded: it is passed through unchanged"]
    assert b"*EXCEL VARIATIONS\n EXCEL=a, RANGE=A1:B2\n" in found.content(found.decks[0])


# ---------------------------------------------------------------------------------------------------------- refusals

START = 11
"""The line of the first line of `*VARIATION`."""


@pytest.mark.parametrize(
    ("variations", "place", "code", "message"),
    [
        (
            " NAME=v\n PARA=Dept, VALUE=1\n",
            (START + 1, 2),
            "REF013",
            "parameter 'Dept' is not defined (did you mean Depth?)",
        ),
        (" NAME=v\n PARA=Point_Z, VALUE=1\n", (START + 1, 2), "REF013", "did you mean Point_X?"),
        (" NAME=v\n PARA=Point, VALUE=1\n", (START + 1, 2), "REF013", "parameter 'Point' is not defined"),
        (
            " NAME=v\n PARA=Depth, VALUE=1, 2\n PARA=Offset, VALUE=1\n",
            (START, 2),
            "EXP001",
            "PARA=Depth has 2, PARA=Offset has 1",
        ),
        (
            " NAME=v\n PARA=Depth, VALUE=1\n PARA=depth, VALUE=1\n",
            (START + 2, 2),
            "EXP001",
            "'Depth' varies twice in 'v'",
        ),
        (
            " NAME=v\n PARA=Depth, VALUE=1,,2\n",
            (START + 1, 22),
            "EXP001",
            "value 2 of PARA=Depth, '', cannot be a",
        ),
        (' NAME=v\n PARA=Depth, VALUE=1" 2 "\n', (START + 1, 20), "EXP001", "cannot be a value"),
        (" NAME=v\n PARA=Depth, VALUE==[Ofset]\n", (START + 1, 20), "REF013", "parameter Ofset is not defined"),
        (" NAME=v\n PARA=Depth, GEN=1, 3, 0\n", (START + 1, 14), "EXP001", "GEN= gives no value"),
        (
            " NAME=v\n PARA=Depth, GEN=3, 1\n",
            (START + 1, 14),
            "EXP001",
            "GEN= gives no value: from 3.0 to 1.0 in steps of 1.0",
        ),
        (" NAME=v\n PARA=Depth, GEN=0, 1, 1e-300\n", (START + 1, 14), "EXP001", "GEN= gives more than 100000 values"),
        (" NAME=v\n PARA=Depth, GEN=0, =[1/0]\n", (START + 1, 14), "EXP001", "GEN= needs numbers"),
        (" NAME=v\n NAME=V\n", (START + 1, 7), "EXP001", "variation 'V' is already defined"),
        (
            " NAME=v\n PARA=Depth, VALUE=1\n NAME=w\n PARA=Depth, VALUE=2\n",
            (START + 5, 2),
            "EXP001",
            "'Depth' varies in 'v' and in 'w'",
        ),
    ],
)
def test_variations_that_cannot_be(variations: str, place: tuple[int, int], code: str, message: str) -> None:
    found = only(refused(varied_deck(variations, " DESCRIPTION=d\n")))
    assert found[:3] == (code, *place)
    assert message in found[3]


@pytest.mark.parametrize(
    ("combinations", "column", "code", "message"),
    [
        (
            " DESCRIPTION=d, FILENAME=%Periode%\n",
            2,
            "REF013",
            "parameter 'Periode' is not defined (did you mean Period?)",
        ),
        (
            " DESCRIPTION=d, FILENAME=%\n VARIATIONS=Wave\n",
            13,
            "EXP001",
            "there is no variation 'Wave' (did you mean Waves?)",
        ),
        (
            " DESCRIPTION=d, FILENAME=a\n",
            2,
            "EXP001",
            "the deck with Period=09: its name 'a.keyxm' is that of the deck with Period=08",
        ),
        (" DESCRIPTION=d, FILENAME=a/b%Period%\n", 2, "EXP001", "has a / in FILENAME="),
    ],
)
def test_combinations_that_cannot_be(combinations: str, column: int, code: str, message: str) -> None:
    found = refused(varied_deck(WAVES, combinations))
    line = START + 2 + combinations.count("\n")
    assert {(one.code, one.line, one.column) for one in found} == {(code, line, column)}
    assert message in found[0].message


@pytest.mark.parametrize("names", ["A, a", "\u00c9, \u00e9", "\u00e9, e\u0301"])
def test_names_that_some_systems_take_for_one(names: str) -> None:
    found = only(refused(varied_deck(f" NAME=v\n PARA=Folder, VALUE={names}\n", " DESCRIPTION=d, FILENAME=%Folder%\n")))
    assert "that of the deck with" in found[3]


def test_a_file_where_another_deck_needs_a_folder() -> None:
    combinations = " DESCRIPTION=d, SUBDIRECTORY=a.keyxm, FILENAME=b\n DESCRIPTION=e, FILENAME=a\n"
    assert "its name 'a.keyxm' is that of" in only(refused(varied_deck("", combinations)))[3]
    back = " DESCRIPTION=e, FILENAME=a\n DESCRIPTION=d, SUBDIRECTORY=A.keyxm, FILENAME=b\n"
    assert "its name 'A.keyxm/b.keyxm' is that of" in only(refused(varied_deck("", back)))[3]


def test_the_list_of_decks_has_its_name_for_itself() -> None:
    found = only(refused(varied_deck("", " DESCRIPTION=d, FILENAME=Manifest.json\n")))
    assert "is that of the manifest" in found[3]


def test_a_value_that_a_name_needs_and_that_is_none() -> None:
    variations = " NAME=v\n PARA=Depth, VALUE=0, 1\n"
    content = varied_deck(variations, " DESCRIPTION=d, FILENAME=%Part%\n").replace(
        "*VARIATION", " Part, =[1/Depth]\n*VARIATION"
    )
    found = only(refused(content))
    assert found[0] == "EXP001"
    assert "the deck with Depth=0: its name '.keyxm' needs the value of 'Part', which has none" in found[3]


def test_the_number_of_decks_is_bounded_before_any_is_made() -> None:
    variations = "".join(f" NAME={name}\n PARA={name}, GEN=1, 2000\n" for name in ("Depth", "Offset", "Period"))
    found = only(refused(varied_deck(variations, " DESCRIPTION=d\n")))
    assert "8000000000 decks would be written: expected no more than 100000" in found[3]


@pytest.mark.parametrize("more", ["", "*EXCEL VARIATIONS\n EXCEL=a, RANGE=A1:B2\n"])
def test_nothing_to_expand(more: str) -> None:
    found = only(refused(f"$PREPROCESSOR\n*VARIATION\n NAME=a\n{more}"))
    assert found[:3] == ("EXP001", 1, 1)
    assert ("*EXCEL VARIATIONS is not expanded" in found[3]) == bool(more)
