"""What the canonical layout is, construct by construct."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest

from mudline.editing.formatting.document import formatted
from mudline.language.deck.loading import dump, load_bytes
from tests.docs.blocks import Page


def record_schema(text: str, encoding: str = "utf-8") -> str:
    """The formatted text, which formatting again leaves as it is."""
    new = formatted(text.encode(encoding), "deck.keyxm")
    assert formatted(new, "deck.keyxm") == new
    return new.decode(encoding)


def model(text: str) -> str:
    """The formatted lines of `$MODEL`."""
    head, _, body = record_schema("$MODEL\n" + text).partition("\n")
    assert head == "$MODEL"
    return body


def same(text: str, expected: str) -> None:
    assert model(dedent(text)) == dedent(expected)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("  $ model \n", "$MODEL\n"),
        ("$load\t case\n", "$LOAD CASE\n"),
        ("$MODEL\n  *element   sets\t\n", "$MODEL\n*ELEMENT SETS\n"),
        ("$MODEL\n*node , curvilinear\n", "$MODEL\n*NODE,CURVILINEAR\n"),
        ("$MODEL\n*gel\xe4nde\n", "$MODEL\n*GEL\xc4NDE\n"),
    ],
)
def test_sections_and_keywords(text: str, expected: str) -> None:
    assert record_schema(text) == expected


def test_other_letters_stay_where_their_bytes_could_be_taken_for_others() -> None:
    assert record_schema("$model\n * gel\xe4nde \n", "cp1252") == "$MODEL\n* gel\xe4nde\n"


def test_settings() -> None:
    same(
        """\
        *seabed properties
        type = elastic
        \tset =  Flow Line
        stiffness=clay one ,
        Friction = , 0.5 ,,
        SET=ALL
        friction=0.3 0.5\t0.03
        """,
        """\
        *SEABED PROPERTIES
         TYPE=ELASTIC
         SET=Flow Line
         STIFFNESS=clay one
         FRICTION=, 0.5
         SET=ALL
         FRICTION=0.3, 0.5, 0.03
        """,
    )


def test_several_settings_on_a_line() -> None:
    same(
        """\
        *geometric sets
        option=rigid
        set=ALL,buoyancy = distributed ,, Plastic  Hardening=steel
        2E11,8E10,.3,.28,7850.,,
        """,
        """\
        *GEOMETRIC SETS
         OPTION=RIGID
         SET=ALL, BUOYANCY=DISTRIBUTED, PLASTIC HARDENING=steel
         2E11, 8E10, .3, .28, 7850.
        """,
    )


def test_a_key_that_begins_with_c_in_column_one_is_data_and_is_indented() -> None:
    same(
        "*SEABED STIFFNESS\nCURVE=clay\n0,0\n1,2\nClay of the west\n",
        "*SEABED STIFFNESS\n CURVE=clay\n 0, 0\n 1, 2\nClay of the west\n",
    )


def test_a_name_in_brackets_does_not_become_an_equation() -> None:
    same(
        "*ELEMENT SETS\nSET= [a\nGEN=1,2\nSET=[b]\nGEN=3,4\nSET =[ c ]\nGEN=5,6\n",
        "*ELEMENT SETS\n SET= [a\n GEN=1, 2\n SET=[b]\n GEN=3, 4\n SET=[ c ]\n GEN=5, 6\n",
    )


def test_columns_of_numbers() -> None:
    same(
        """\
        *node
        1,0,0
        2,0.,100.5,,
        10,-1.5E+02,1000.25,0.0
        C between
         11\t1\t2

        c rows
        12, =[depth/2], 3,
         gen = 1 2
        100,0,0
        """,
        """\
        *NODE
          1,    0,          0
          2,    0.,       100.5
         10,   -1.5E+02, 1000.25, 0.0
        C between
         11,    1,          2

        c rows
         12, =[depth/2],    3
         GEN=1, 2
         100, 0, 0
        """,
    )


def test_columns_with_labels() -> None:
    same(
        "*ELEMENT\n1 1 2\n2,2,{Seabed, End}\n100,{a},{b},0,,1\n",
        "*ELEMENT\n   1,   1,             2\n   2,   2, {Seabed, End}\n 100, {a},           {b}, 0, , 1\n",
    )
    same(
        "*ELEMENT SETS\nSET=ends\n{a},{long label}\n{longer},{b}\n",
        "*ELEMENT SETS\n SET=ends\n {a},      {long label}\n {longer}, {b}\n",
    )


def test_a_long_equation_does_not_widen_its_column() -> None:
    equation = "=[if(depth > 100.0, 0.5*depth, 0.25*depth)]"
    same(
        f"*NODE\n1,0.5,{equation},7\n2,{equation},1.5,8\n20,0.25,2,9\n",
        f"*NODE\n  1, 0.5,  {equation}, 7\n  2, {equation}, 1.5, 8\n 20, 0.25, 2,   9\n",
    )


def test_rows_of_another_kind_have_columns_of_their_own() -> None:
    same(
        "*RIGID SURFACE\n.3,.5\n0 10\n100 -20.5\n*ELASTIC SURFACE\n50000.0,0.3,\n-2\n",
        "*RIGID SURFACE\n .3, .5\n   0,  10\n 100, -20.5\n*ELASTIC SURFACE\n 50000.0, 0.3\n -2\n",
    )


TRAILING = """\
$MODEL
*OCEAN
 350.0, 1025.0, 9.81
*NODE
 1, -0.0055, 0.0, 0.0
 6, -0.0055, 25.0
 GEN=1, 6
*ELEMENT
 1, 1, 2
 2, 2, {End}, , , 1
 GEN=1, 5
*ELEMENT SETS
 SET=Line
 1, 2, 3
 GEN=1, 5
*GEOMETRIC SETS
 OPTION=RIGID
 SET=Line
 207.0E9, 79.6E9, 0.2191, 0.1905, 7850.0
*SEABED PROPERTIES
 TYPE=ELASTIC
 SET=Line
 STIFFNESS=60000.0
 FRICTION=0.35, , 0.1
*SEABED STIFFNESS
 CURVE=Clay
 0.0,    0.0
 0.5, 4200.0
*ELASTIC SURFACE
 ,
"""


@pytest.mark.parametrize("commas", [",", " ,", ",,", " , , ,", ",,,,,,,,,,,,"])
def test_commas_behind_the_last_field_go(commas: str) -> None:
    alone = [line for line in TRAILING.splitlines() if line[0] == " " and "=" not in line]
    keyed = [line for line in TRAILING.splitlines() if "GEN=" in line or "SET=" in line or "FRICTION=" in line]
    more = "".join(f"{line}{commas if line in alone + keyed else ''}\n" for line in TRAILING.splitlines())
    assert record_schema(more) == record_schema(TRAILING)
    one, other = (load_bytes(text.encode(), "deck.keyxm") for text in (TRAILING, more))
    assert dump(one, "json") == dump(other, "json")


def test_commas_at_the_ends_of_a_long_table_go() -> None:
    rows = "".join(f" {row}, 0.0, {row}.5\n" for row in range(1000, 1200))
    same(f"*NODE\n{rows}", f"*NODE\n{rows}")
    same("*NODE\n" + rows.replace("\n", ",\n"), f"*NODE\n{rows}")
    same("*NODE\n" + rows.replace("5\n", "5, , , ,\n", 100), f"*NODE\n{rows}")


def test_comments_and_blank_lines() -> None:
    same(
        "\n\n \t\nC   As  it is \t\nc too\t\nC----  \n\n\n*OCEAN\nC\t\tx \n\n \n100\nCabc  \n\n\n\n",
        "\nC   As  it is\nc too\nC----\n\n*OCEAN\nC\t\tx\n\n 100\nCabc\n",
    )


def test_blocks_without_a_model_keep_their_lines() -> None:
    text = "*new thing\n\tA = 1 ,2 \n\n\n  \nCabc \nC x \n1 2\t\n"
    assert model(text + "\n\n*OCEAN\n5\n") == "*NEW THING" + text[10:] + "\n\n*OCEAN\n 5\n"
    assert model(text + " \n\n") == "*NEW THING" + text[10:] + " \n\n"
    assert model("*new thing\n raw \n ") == "*NEW THING\n raw \n \n"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=["LF", "CRLF", "CR"])
def test_the_line_end_that_prevails_holds_for_all_lines(end: str) -> None:
    other = "\r\n" if end == "\n" else "\n"
    text = f"$MODEL{end}*NEW{end} a{other} b {end}*ocean{other}5{end}C x{end}"
    assert record_schema(text) == end.join(["$MODEL", "*NEW", " a", " b ", "*OCEAN", " 5", "C x", ""])


def test_numbers_and_names_are_spelled_as_they_were() -> None:
    same(
        "*EMBEDMENT\nset=clay  One\n007,1.0D3\n+1.E0,-.5\n",
        "*EMBEDMENT\n SET=clay  One\n 007,    1.0D3\n  +1.E0, -.5\n",
    )


def test_the_page_shows_what_comes_out() -> None:
    page = Path(__file__).parents[3] / "docs" / "format.md"
    before, after = (block.text for block in Page.read(page).blocks if block.language == "mudline")
    assert record_schema(before) == after


def test_lines_that_are_kept_stay_as_they_are() -> None:
    text = "$LOAD CASE\n*FRICTION\n   MODES=3,4\nC x  \n1,2\n*BOUNDARY\nTYPE=vessel\n   12,   Semi\n"
    wanted = "$LOAD CASE\n*FRICTION\n   MODES=3,4\nC x\n 1, 2\n*BOUNDARY\n TYPE=VESSEL\n   12,   Semi\n"
    assert formatted(text.encode(), "deck.keyxm").decode() == wanted
    assert formatted(wanted.encode(), "deck.keyxm").decode() == wanted
