"""What a new deck is: the text of the source but for values, and blocks that come and go."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mudline.checks.engine import lint_bytes
from mudline.checks.registry import select
from mudline.editing.variations.cases import parameter_field
from mudline.editing.variations.files import ExpansionPlan
from mudline.editing.variations.planning import plan
from mudline.language.deck.forms import form_names
from mudline.language.deck.loading import dump, load_bytes
from mudline.language.deck.parameters import Parameters, folded
from mudline.language.keywords.values import Equation
from tests.helpers.builders.decks import VARIED_MODEL, VARIED_PARAMETERS, varied_deck
from tests.helpers.builders.scenes import deck_of, only, refused
from tests.helpers.samples import SAMPLES

ALL = " DESCRIPTION=d, FILENAME=%Period%\n"
WAVES = " NAME=Waves\n PARA=Period, VALUE=09, =[1+Twice]\n"


def contents(found: ExpansionPlan) -> list[str]:
    return [found.content(new).decode() for new in found.decks]


def test_only_values_change_and_the_two_keywords_go() -> None:
    new = contents(plan(deck_of(varied_deck(WAVES, ALL))))
    expected = f"{VARIED_PARAMETERS}C model\n{VARIED_MODEL}"
    assert new == [expected.replace(", 08\n", ", 09\n"), expected.replace(", 08\n", ", =[1+Twice]\n")]


def test_comments_and_blank_lines_behind_a_block_stay() -> None:
    content = varied_deck(" NAME=v\nC in it\n\n PARA=Depth, VALUE=2\n\nC behind\n", f"C before\n{ALL}  \nCnote\n\n")
    new = contents(plan(deck_of(content)))[0]
    assert new == f"{VARIED_PARAMETERS}\nC behind\n  \nCnote\n\nC model\n{VARIED_MODEL}".replace("100.0", "2")


@pytest.mark.parametrize(
    ("value", "item"),
    [("07", "07"), ("=[Point_X+1]", "=[Point_X+1]"), ("a:b", '"a:b"'), ('"c, d"', '"c, d"'), ("e/f", '"e/f"')],
)
def test_an_item_of_a_list_varies_in_its_place(value: str, item: str) -> None:
    found = plan(deck_of(varied_deck(f" NAME=v\n PARA=point_y, VALUE={value}\n", " DESCRIPTION=d, SUBDIRECTORY=a\n")))
    assert found.decks[0].values == {"Point_Y": item}
    assert contents(found) == [f"{VARIED_PARAMETERS}C model\n{VARIED_MODEL}".replace("Y:22", f"Y:{item}")]
    values = Parameters(deck_of(found.content(found.decks[0]))).values
    assert values["point_x"] == 11
    assert values["point_y"] == {"07": 7, "=[Point_X+1]": 12}.get(value, value.strip('"'))


def test_an_item_of_a_list_in_a_name() -> None:
    lines = " NAME=v\n PARA=Point_X, VALUE=1, =[Offset/2]\n"
    content = varied_deck(lines, " DESCRIPTION=d, FILENAME=%Sum% %Point_x%\n")
    content = content.replace("*VARIATION", "*PARAMETERS\n Sum, =[Point_X + Point_Y]\n*PARAMETERS\n*VARIATION")
    assert [new.path for new in plan(deck_of(content)).decks] == ["23 1.keyxm", "-3 -25.keyxm"]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252"])
def test_line_ends_and_encodings_stay(end: str, encoding: str, tmp_path: Path) -> None:
    (tmp_path / "block.txt").write_bytes("C \u00fcber\r\n*TITLE\r a\n".encode())
    variations = " NAME=v\n PARA=Folder, VALUE=S\u00fcd\n ACTION=ADD, KEYWORD=TITLE, FILE=block.txt, SECTION=MODEL\n"
    content = varied_deck(variations, " DESCRIPTION=d, FILENAME=%Folder%\n").replace("\n", end).encode(encoding)
    found = plan(deck_of(content, folder=tmp_path))
    expected = f"{VARIED_PARAMETERS}C model\n{VARIED_MODEL}".replace('"Near side"', "S\u00fcd")
    expected = expected.replace(" 1, 1, 2\n", " 1, 1, 2\nC \u00fcber\n*TITLE\n a\n")
    assert found.decks[0].path == "S\u00fcd.keyxm"
    assert found.content(found.decks[0]) == expected.replace("\n", end).encode(encoding)


# --------------------------------------------------------------------------------------------------------- properties

values = st.one_of(
    st.sampled_from(["08", "-100", "1.5E3", "Near", "Far side", '"a, b"', "/x/", "=[3*2]", "c:\\d", "\u00e9t\u00e9"]),
    st.floats(-1e6, 1e6).map(repr),
)


@st.composite
def studies(draw: st.DrawFn) -> tuple[list[dict[str, list[str]]], str]:
    """Variations as columns of values, each parameter in one of them, and their lines."""
    columns: list[dict[str, list[str]]] = []
    lines = ""
    free = draw(st.permutations(["Depth", "Offset", "Period", "Folder"]))
    while free:
        mine, free = free[: draw(st.integers(1, 3))], free[3:]
        count = draw(st.integers(1, 3))
        column = {name: draw(st.lists(values, min_size=count, max_size=count)) for name in mine}
        columns.append(column)
        lines += f" NAME=v{len(columns)}\n"
        lines += "".join(f" PARA={name.upper()}, VALUE={', '.join(given)}\n" for name, given in column.items())
        if draw(st.booleans()):
            break
    return columns, lines


@given(studies())
def test_every_combination_is_a_deck_whose_parameters_are_those_of_the_case(
    study: tuple[list[dict[str, list[str]]], str],
) -> None:
    columns, lines = study
    found = plan(deck_of(varied_deck(lines, " DESCRIPTION=d\n VARIATIONS=ALL\n")))
    assert len(found.decks) == math.prod(len(next(iter(column.values()))) for column in columns)
    assert len({new.path for new in found.decks}) == len(found.decks)
    for index, new in enumerate(found.decks):
        cases: dict[str, str] = {}
        rest = index
        for column in reversed(columns):
            rest, case = divmod(rest, len(next(iter(column.values()))))
            cases |= {name: texts[case] for name, texts in column.items()}
        assert new.values == {name: parameter_field(written) for name, written in cases.items()}
        read = load_bytes(found.content(new), new.path)
        assert read.problems == []
        parameters = Parameters(read)
        expected = f"{VARIED_PARAMETERS}C model\n{VARIED_MODEL}"
        for name, written in cases.items():
            assert same(parameters.values[folded(name)], written)
            expected = expected.replace(OLD[name], f"{OLD[name].partition(',')[0]}, {parameter_field(written)}\n")
        assert found.content(new).decode() == expected


OLD = {"Depth": " Depth, 100.0\n", "Offset": " Offset, -50\n", "Period": " Period , 08\n"} | {
    "Folder": ' Folder, "Near side"\n'
}
"""The lines of the parameters."""


def same(value: float | str, written: str) -> bool:
    """Whether a parameter has the value that is written."""
    if Equation.match(written):
        return value == 6.0
    return value == (written.strip('"') if isinstance(value, str) else float(written))


# ------------------------------------------------------------------------------------------------------------ actions


def acting(*actions: str) -> str:
    return varied_deck(
        " NAME=v\n" + "".join(f" ACTION={action}\n" for action in actions), " DESCRIPTION=d, FILENAME=a\n"
    )


BARE = f"{VARIED_PARAMETERS}C model\n{VARIED_MODEL}"


def test_a_block_is_removed_and_its_comments_stay() -> None:
    new = contents(
        plan(deck_of(acting("REMOVE, KEYWORD=TOP TENSION", "Remove, keyword=wave-regular, section=$load case")))
    )
    assert new == [BARE.replace("*TOP TENSION\n =[Offset]\n", "").replace("*WAVE-REGULAR\n 1.0, =[Period], 0.0\n", "")]


def test_all_blocks_of_a_keyword_are_removed_once() -> None:
    content = (
        acting("REMOVE, KEYWORD=TOP TENSION", "REMOVE, KEYWORD=TOP TENSION") + "$LOAD CASE\n*TOP TENSION\n 1\nC end"
    )
    assert contents(plan(deck_of(content))) == [BARE.replace("*TOP TENSION\n =[Offset]\n", "") + "$LOAD CASE\nC end"]


def test_data_that_looks_like_a_comment_goes_with_its_block() -> None:
    more = "$MODEL\n*SEABED STIFFNESS\nCURVE=a\n 0, 0\n 1, 1\nCURVE=b\nCnote\n*OCEAN\n 1\n"
    found = plan(deck_of(acting("REMOVE, KEYWORD=SEABED STIFFNESS") + more))
    assert contents(found) == [BARE + "$MODEL\nCnote\n*OCEAN\n 1\n"]


@pytest.mark.parametrize(
    ("data", "added"),
    [
        (b" 7\n", "*TOP TENSION\n 7\n"),
        (b"7", "*TOP TENSION\n7\n"),
        (
            b"C of the file\n\n*top tension\n 7\n*TOP TENSION\n 8",
            "C of the file\n\n*top tension\n 7\n*TOP TENSION\n 8\n",
        ),
        (b"\xef\xbb\xbf*TOP TENSION\r\n 7\r\n", "*TOP TENSION\n 7\n"),
        (b"C no line of data\n", "*TOP TENSION\nC no line of data\n"),
        (b"", "*TOP TENSION\n"),
    ],
)
def test_a_block_is_added_behind_the_last_of_its_section(data: bytes, added: str, tmp_path: Path) -> None:
    (tmp_path / "my block.txt").write_bytes(data)
    found = plan(deck_of(acting('ADD, KEYWORD=TOP TENSION, FILE="my block.txt"'), folder=tmp_path))
    assert contents(found) == [BARE + added]


def test_a_file_without_a_last_line_end_gets_one_before_what_is_added() -> None:
    content = acting("ADD, KEYWORD=VESSEL,INTEGRATED", "ADD, KEYWORD=NO FRICTION, SECTION=LOAD CASE").removesuffix("\n")
    added = BARE.replace(" 1, 1, 2\n", " 1, 1, 2\n*VESSEL,INTEGRATED\n")
    assert contents(plan(deck_of(content))) == [added + "*NO FRICTION\n"]


@pytest.mark.parametrize(
    ("action", "message"),
    [
        ("REMOVE, KEYWORD=TOP TENSON, SECTION=LOAD CASE", "$LOAD CASE has no *TOP TENSON (did you mean TOP TENSION?)"),
        ("REMOVE, KEYWORD=TOP TENSON", "missing SECTION= for *TOP TENSON"),
        ("REMOVE, KEYWORD=FRICTION", "missing SECTION= for *FRICTION: $LOAD CASE or $MODES"),
        ("REMOVE, KEYWORD=OCEAN, SECTION=MODELL", "the deck has no section $MODELL (did you mean MODEL?)"),
        ("REMOVE, KEYWORD=PARAMETERS", "*PARAMETERS describes the decks"),
        ("ADD, KEYWORD=TOP TENSION, FILE=none.txt", "file 'none.txt' was not found beside the deck"),
        ("ADD, KEYWORD=TOP TENSION, FILE=other.txt", "other.txt holds *OCEAN, expected *TOP TENSION only"),
        ("ADD, KEYWORD=TOP TENSION, FILE=section.txt", "section.txt opens the section $MODEL"),
        ("ADD, KEYWORD=TOP TENSION, FILE=utf16.txt", "utf16.txt: the file is UTF-16"),
        ("ADD, KEYWORD=OCEAN, FILE=bad.txt", "the new deck 'a.keyxm' cannot be read: line 20: 'x' is not a number"),
    ],
)
def test_actions_that_cannot_be_done(action: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "other.txt").write_text("*TOP TENSION\n*OCEAN\n")
    (tmp_path / "section.txt").write_text("*TOP TENSION\n$MODEL\n")
    (tmp_path / "utf16.txt").write_bytes("*TOP TENSION\n".encode("utf-16"))
    (tmp_path / "bad.txt").write_text(" x\n")
    found = only(refused(acting(action), folder=tmp_path))
    assert message in found[3]
    assert found[:3] == ("EXP001", *((1, 1) if "bad.txt" in action else (12, 2)))


# ------------------------------------------------------------------------------------------------- other forms, samples


def test_a_deck_from_nowhere_has_no_files_beside_it() -> None:
    found = only(refused(acting("ADD, KEYWORD=TOP TENSION, FILE=a.txt")))
    assert "which came from standard input" in found[3]


@pytest.mark.parametrize("form", ["json", "yaml"])
def test_a_deck_in_another_form_gives_decks_in_that_form(form: str) -> None:
    original = deck_of(
        varied_deck(WAVES + " PARA=Folder, VALUE=Far side, b\n", " DESCRIPTION=d, FILENAME=Wave %Period%\n")
    )
    found = plan(deck_of(dump(original, form), f"study.{form}"))
    assert [new.path for new in found.decks] == [f"Wave 09.{form}", f"Wave 201.{form}"]
    by_text = plan(original)
    for new, other in zip(found.decks, by_text.decks, strict=True):
        read = load_bytes(found.content(new), new.path)
        again = load_bytes(by_text.content(other), other.path)
        assert read.sections == again.sections
        assert read.source == new.path


@pytest.mark.parametrize("name", ["variations.keyxm", "parametric.keyxm"])
def test_new_decks_of_samples_are_found_fault_with_as_little_as_their_source(name: str) -> None:
    found = plan(load_bytes((SAMPLES / name).read_bytes(), name))
    assert len(found.decks) == 6
    for new in found.decks:
        assert {one.code for one in lint_bytes(found.content(new), new.path, select())} <= {"TIM005"}
        read = load_bytes(found.content(new), new.path)
        assert not read.keywords("PREPROCESSOR") & {"VARIATION", "COMBINATIONS"}


@pytest.mark.parametrize("form", form_names())
def test_findings_are_those_of_the_source(form: str) -> None:
    content = varied_deck(WAVES, ALL) + "$MODEL\n*SEABED STIFFNESS\n CURVE=Clay\n 1, 1\n 0, 0\n"
    original = deck_of(content)
    suffix = {"keyword": "keyxm"}.get(form, form)
    source = dump(original, form).encode() if form != "keyword" else content.encode()
    found = plan(deck_of(source, f"study.{suffix}"))
    before = sorted(finding.code for finding in lint_bytes(source, f"study.{suffix}", select()))
    assert "CRV002" in before
    for new in found.decks:
        codes = sorted(finding.code for finding in lint_bytes(found.content(new), new.path, select()))
        unusual = ["UNT007"] if "201" in new.path else []  # a wave period of 201 s
        assert codes == sorted([*before, *unusual])
